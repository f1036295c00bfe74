#!/bin/sh
# fuzz.sh [SECONDS [RUNS [READER...]]]: libFuzzer on every reader (or those named) for SECONDS (600) or RUNS (-1: no end)
# inputs each, and a table of inputs tried, edges covered and the end. What ends a reader is kept in ./crashes.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${GNATHOS_BUILD:-$root/build}-sanitized
seconds=${1:-600} runs=${2:--1}
[ $# -lt 2 ] || shift
[ $# -lt 1 ] || shift
sh "$root/tests/net/sanitized.sh" "$root" "$build" fuzz_readers
exec sh "$root/tests/net/fuzz.sh" "$build/tests/fuzz/fuzz_readers" "$root/tests/fuzz/corpus" "$seconds" "$runs" "$@"
