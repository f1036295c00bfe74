#!/bin/sh
# options.sh: each module left out alone, and all of them, configures, builds and passes the unit tests that remain.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
failed=0
for off in CGAL SIM RENDER REPORT "CGAL SIM RENDER REPORT"; do
    build=${GNATHOS_BUILD:-$root/build}-without
    rm -rf "$build"
    options=
    for option in $off; do options="$options -DGNATHOS_$option=OFF"; done
    # shellcheck disable=SC2086
    if cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release $options >"$build.log" 2>&1 &&
        cmake --build "$build" >"$build.log" 2>&1 &&
        (cd "$build" && ctest -L 'fuzz|house' && app/gnathos --version) >"$build.log" 2>&1; then
        echo "without $off: builds"
    else
        echo "without $off: FAILED"
        grep -E 'error|FAILED|undefined|CMake Error|Failed' -A 2 "$build.log" | head -20
        failed=1
    fi
done
rm -rf "$build" "$build.log"
exit $failed
