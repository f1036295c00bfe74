#!/bin/sh
# tests.sh BUILD SLOW: the tests of a sanitized build whose names do not match SLOW. An error of a sanitizer or a leak
# ends a test.
set -u
slow=$2
here=$(cd "$(dirname "$0")" && pwd)
export LSAN_OPTIONS="suppressions=$here/leaks.txt:print_suppressions=0"
cd "$1" || exit 1
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
echo "left out: $(ctest -N -R "$slow" | sed -n 's/^ *Test *#[0-9]*: //p' | tr '\n' ' ')"
ctest --output-on-failure -L 'unit|physics|fuzz|cli' -E "$slow" -j "$(nproc)" --timeout 600
