#!/bin/sh
# with_make.sh ROOT BUILD: `cmake -S . -B build && cmake --build build` with CMake's default generator, make, from an
# empty folder: each rule of the page and of the program is there. The compiler flags are those of the main build, so that
# ccache has the objects; without ccache it is skipped (77), because CGAL takes minutes.
set -eu
root=$1 build=$2
command -v ccache >/dev/null || { echo "[  SKIPPED ] 1 test: no ccache"; exit 77; }
rm -rf "$build"
unset CMAKE_GENERATOR
run() { "$@" >"$build.log" 2>&1 || { grep -E '\*\*\*|error|undefined' "$build.log" || tail -30 "$build.log"; exit 1; }; }
run cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DGNATHOS_TESTS=OFF
grep -q 'CMAKE_GENERATOR:INTERNAL=Unix Makefiles' "$build/CMakeCache.txt" || { echo "make is not the default"; exit 1; }
run cmake --build "$build" -j "$(nproc)"
"$build/app/gnathos" --version
rm -rf "$build" "$build.log"
