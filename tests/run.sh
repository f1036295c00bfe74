#!/bin/sh
# run.sh [CTEST OPTION...]: builds gnathos (gcc, optimised, asserts on) and runs every test. The last line is
# "N passed, N failed", with ", N skipped" where tests lacked their data; the status is 0 if none failed.
# GNATHOS_BUILD: the build folder (build/). `sh tests/run.sh -L unit` runs one label.
set -u
cd "$(dirname "$0")/.." || exit 1
sh .ci/setup || { echo "0 passed, 1 failed"; exit 1; }
build=${GNATHOS_BUILD:-build}
if ! cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release >"$build.log" 2>&1 ||
    ! cmake --build "$build" >>"$build.log" 2>&1; then
    grep -E 'error|FAILED|undefined|CMake Error' -A 3 "$build.log" | head -60
    echo "the build failed; all of it is in $build.log"
    echo "0 passed, 1 failed"
    exit 1
fi
rm -f "$build.log"
logs=$build/Testing/Temporary
rm -f "$logs/LastTestsFailed.log"
(cd "$build" && ctest --output-on-failure -j "$(nproc)" "$@")
[ -f "$logs/LastTestsFailed.log" ] || : >"$logs/LastTestsFailed.log"

# Counts single tests: an executable says how many of its tests passed, failed and were skipped; anything else is one.
# Which executables failed, crashed or are missing, ctest knows best.
awk '
FILENAME ~ /LastTestsFailed/ { sub(/^[0-9]+:/, ""); wrong[$0] = 1; next }
/^[0-9]+\/[0-9]+ Test: / { name = $3; ok = bad = skip = 0 }
/^\[  PASSED  \] [0-9]+ test/ { ok += $4 }
/^\[  FAILED  \] [0-9]+ test/ { bad += $4 }
/^\[  SKIPPED \] [0-9]+ test/ { skip += $4 }
/^"[^"]*" end time: / && name != "" {
    if (name in wrong) failed += bad ? bad : 1
    else if (!(ok + skip)) passed++
    passed += ok
    skipped += skip
    name = ""
}
END {
    printf "%d passed, %d failed", passed, failed
    if (skipped) printf ", %d skipped", skipped
    printf "\n"
    exit failed || !passed
}' "$logs/LastTestsFailed.log" "$logs/LastTest.log"
