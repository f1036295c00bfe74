#!/bin/sh
# headers.sh ROOT CC CXX: every header that another folder may include compiles by itself, in C17 and (but for app, which
# is C) in C++17.
set -u
cd "$1" || exit 1
cc=$2 cxx=$3 failed=0 count=0
built='-DGNATHOS_WITH_CGAL=1 -DGNATHOS_WITH_SIM=1 -DGNATHOS_WITH_RENDER=1 -DGNATHOS_WITH_REPORT=1'
for header in geometry/*.h sim/*.h render/*.h $(find app -name '*.h' | sort); do
    count=$((count + 1))
    line="#include \"$header\""
    echo "$line" | "$cc" -std=c17 -D_GNU_SOURCE $built -Wall -Wextra -Wpedantic -Werror -I. -fsyntax-only -x c - ||
        { echo "$header does not compile alone in C17"; failed=1; }
    grep -q '^#pragma once' "$header" || { echo "$header has no #pragma once"; failed=1; }
    case $header in app/*) continue ;; esac
    echo "$line" | "$cxx" -std=c++17 -D_GNU_SOURCE -Wall -Wextra -Wno-missing-field-initializers -Werror -I. \
        -fsyntax-only -x c++ - ||
        { echo "$header does not compile alone in C++17"; failed=1; }
done
echo "$count headers"
[ $failed -eq 0 ] && [ $count -gt 0 ]
