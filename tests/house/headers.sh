#!/bin/sh
# headers.sh ROOT CC CXX: every header of a module compiles by itself, in C17 and (but for app, which is C) in C++17.
set -u
cd "$1" || exit 1
cc=$2 cxx=$3 failed=0 count=0
for header in geometry/*.h sim/*.h render/*.h app/*.h; do
    [ -f "$header" ] || continue
    count=$((count + 1))
    line="#include \"$header\""
    echo "$line" | "$cc" -std=c17 -D_GNU_SOURCE -Wall -Wextra -Wpedantic -Werror -I. -fsyntax-only -x c - ||
        { echo "$header does not compile alone in C17"; failed=1; }
    case $header in app/*) continue ;; esac
    echo "$line" | "$cxx" -std=c++17 -D_GNU_SOURCE -Wall -Wextra -Wno-missing-field-initializers -Werror -I. \
        -fsyntax-only -x c++ - ||
        { echo "$header does not compile alone in C++17"; failed=1; }
    grep -q '^#pragma once' "$header" || { echo "$header has no #pragma once"; failed=1; }
done
echo "$count headers"
[ $failed -eq 0 ] && [ $count -gt 0 ]
