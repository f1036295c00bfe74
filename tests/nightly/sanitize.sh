#!/bin/sh
# sanitize.sh [CTEST OPTION...]: every test that takes no other program, under ASan and UBSan, the slow ones too (an hour).
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${GNATHOS_BUILD:-$root/build}-sanitized
sh "$root/tests/net/sanitized.sh" "$root" "$build"
export LSAN_OPTIONS="suppressions=$root/tests/net/leaks.txt:print_suppressions=0"
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
cd "$build"
exec ctest --output-on-failure -LE 'net|house' --timeout 3600 "$@"
