#!/bin/sh
# memory.sh [OUTCOME [MOST]]: check, import and render of an outcome (that of the tests) with every 50th of their
# allocations failing in turn, or MOST (300) of them, evenly, where that would be more; a table of how they ended.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${GNATHOS_BUILD:-$root/build}
exec sh "$root/tests/cli/run_memory.sh" "$build/app/gnathos" "$build/tests/cli/libfail_malloc.so" "$root/tests/cli" 50 \
    "${2:-300}" "${1:-$build/tests/synthetic_outcome}"
