#!/bin/sh
# threads.sh [CTEST OPTION...]: the tests of solver, distances and records under ThreadSanitizer, without CGAL. libomp has
# its own word with TSan (libarcher) for what a parallel region orders; CHOLMOD and BLAS are not instrumented and run on
# one thread. `threads.sh -R physics.scene` runs one.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${GNATHOS_BUILD:-$root/build}-threads
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE=-O1 -DCMAKE_C_COMPILER=clang-14 \
    -DCMAKE_CXX_COMPILER=clang++-14 -DGNATHOS_CGAL=OFF -DGNATHOS_RENDER=OFF -DGNATHOS_REPORT=OFF \
    -DGNATHOS_SANITIZE=thread >"$build.log" 2>&1 || { tail -20 "$build.log"; exit 1; }
cmake --build "$build" >"$build.log" 2>&1 || { grep -E 'error|FAILED' "$build.log"; exit 1; }
rm -f "$build.log"
archer=$(ls /usr/lib/llvm-14/lib/libarcher.so 2>/dev/null || true)
[ -n "$archer" ] || echo "no libarcher: what OpenMP orders is reported as a race" >&2
export OMP_TOOL_LIBRARIES="$archer" OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=3
export TSAN_OPTIONS=halt_on_error=1:ignore_noninstrumented_modules=1
cd "$build"
exec ctest --output-on-failure -L 'physics|unit' --timeout 3600 "$@"
