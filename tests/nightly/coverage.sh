#!/bin/sh
# coverage.sh [CTEST OPTION...]: the share of lines that the tests run, per module and in all, from gcov; files of which
# less than half is run are named. `coverage.sh -L unit` counts one label.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${GNATHOS_BUILD:-$root/build}-coverage
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE="-O1 --coverage" \
    -DCMAKE_EXE_LINKER_FLAGS=--coverage -DGNATHOS_WERROR=OFF >"$build.log" 2>&1 || { tail -20 "$build.log"; exit 1; }
cmake --build "$build" >"$build.log" 2>&1 || { grep -E 'error|FAILED' "$build.log"; exit 1; }
rm -f "$build.log"
find "$build" -name '*.gcda' -delete
(cd "$build" && ctest -LE 'net|house' --timeout 3600 "$@" >"$build/coverage.log" 2>&1) || tail -15 "$build/coverage.log"
cd "$build"
find . -name '*.gcno' -path '*/CMakeFiles/*' | grep -vE '\.cpp\.gcno|/tests/' | while read -r notes; do
    gcov --no-output "$notes" 2>/dev/null || true
done | awk -v root="$root/" '
/^File / { file = $2; gsub(/\047/, "", file); sub(root, "", file); sub(/^(\.\.\/)+/, "", file); next }
/^Lines executed:/ && file ~ /^(geometry|sim|render|app)\/.*\.c$/ {
    split($2, part, /[:%]/)
    run = part[2] * $4 / 100
    if (!(file in lines) || run > hit[file]) { lines[file] = $4; hit[file] = run }
    file = ""
}
END {
    for (f in lines) {
        module = f; sub(/\/.*/, "", module)
        all[module] += lines[f]; ran[module] += hit[f]; total += lines[f]; totalran += hit[f]
        if (hit[f] < lines[f] / 2) printf "%5.1f %% of %4d lines: %s\n", 100 * hit[f] / lines[f], lines[f], f | "sort -n"
    }
    close("sort -n")
    for (m in all) printf "%-10s %6d lines, %5.1f %% run\n", m, all[m], 100 * ran[m] / all[m]
    if (total) printf "%-10s %6d lines, %5.1f %% run\n", "in all", total, 100 * totalran / total
    exit !total
}'
