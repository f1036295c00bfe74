#!/bin/sh
# sanitized.sh ROOT BUILD [TARGET...]: builds with clang 14, warnings as errors, address and undefined-behaviour
# sanitizers and libFuzzer's counters, into BUILD. C++ (the folder over CGAL alone) is compiled by c++ and without
# sanitizers, as in the main build, so that ccache has it; clang++ links. Status 77 without clang 14.
set -eu
root=$1 build=$2
shift 2
command -v clang-14 >/dev/null || { echo "[  SKIPPED ] 1 test: no clang-14"; exit 77; }
link='clang++-14 <FLAGS> <CMAKE_CXX_LINK_FLAGS> <LINK_FLAGS> <OBJECTS> -o <TARGET> <LINK_LIBRARIES>'
run() { "$@" >"$build.log" 2>&1 || { grep -E 'error|FAILED|undefined' "$build.log" || tail -30 "$build.log"; exit 1; }; }
run cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE=-O1 \
    -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=c++ -DCMAKE_CXX_LINK_EXECUTABLE="$link" \
    -DGNATHOS_SANITIZE=address,undefined,fuzzer-no-link
run cmake --build "$build" -t "${@:-all}" -- -k 0
rm -f "$build.log"
echo "built with clang: no warning"
