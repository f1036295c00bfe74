#!/bin/sh
# seeds.sh [LAST [FILE]]: synthetic heads of the seeds 1 to LAST (200), classes and sexes in turn: teeth and mandible as
# `gnathos new` makes them and the sagittal split as `gnathos cut` lays it. On one core, about 7 s a seed. FILE (seeds.csv in
# the build folder) has a line per seed; what it has already is not done again. Prints a table per class and sex, and every
# seed whose proximal pieces are not of genus 0, whose bite is outside the range of its class, without contact on a side or
# with teeth in each other by 0.1 mm, or whose occlusal plane is canted by more than 0.5 degrees; fails if there is one.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${GNATHOS_BUILD:-$root/build}
last=${1:-200} file=${2:-$build/seeds.csv}
cmake --build "$build" --target bench_seeds >"$build/seeds.log" 2>&1 || { cat "$build/seeds.log"; exit 1; }
OMP_NUM_THREADS=1 nice "$build/tests/bench/bench_seeds" 1 "$last" "$file"
awk -F, -v last="$last" '
function faults() {
    f = ""
    if ($16 != "") f = f "; " $16
    if ($4 != 0 || $5 != 0) f = f "; proximal pieces of genus " $4 " and " $5
    if (!$10) f = f "; overjet " $8 " and overbite " $9 " mm are not of its class"
    if ($11 < 1 || $12 < 1) f = f "; " $11 " teeth touch on the left, " $12 " on the right"
    if ($13 >= 0.1) f = f "; teeth lie " $13 " mm in each other"
    if ($14 > 0.5 || $14 < -0.5) f = f "; canted by " $14 " degrees"
    return substr(f, 3)
}
$1 + 0 > 0 && $1 + 0 <= last {
    k = $2 " " $3; n[k]++; pieces[k] += ($4 == 0) + ($5 == 0); anew[k] += $7; made[k] += $6
    bite[k] += $10 && $11 > 0 && $12 > 0 && $13 < 0.1
    cant = $14 < 0 ? -$14 : $14; if (cant > most[k]) most[k] = cant
    if (n[k] == 1 || $8 < low[k]) low[k] = $8; if (n[k] == 1 || $8 > high[k]) high[k] = $8
    if (n[k] == 1 || $9 < down[k]) down[k] = $9; if (n[k] == 1 || $9 > up[k]) up[k] = $9
    if ((f = faults()) != "") { bad++; list = list "seed " $1 " (class " $2 ", " $3 "): " f "\n" }
    all++; sum += pieces[k] - was[k]; was[k] = pieces[k]
}
END {
    printf "%-9s %5s %21s %10s %13s %15s %15s %9s %8s\n", "class sex", "seeds", "proximal of genus 0", "laid anew",
        "distal pierced", "overjet mm", "overbite mm", "bite fits", "cant deg"
    for (c = 1; c <= 3; c++) for (s = 1; s <= 2; s++) {
        k = c " " (s == 1 ? "f" : "m"); if (!n[k]) continue
        printf "%-9s %5d %14d of %3d %10d %14d %7.1f to %4.1f %7.1f to %4.1f %9d %8.2f\n", k, n[k], pieces[k], 2 * n[k],
            anew[k], made[k], low[k], high[k], down[k], up[k], bite[k], most[k]
    }
    printf "%d seeds, %d of %d proximal pieces of genus 0, %d with a fault\n%s", all, sum, 2 * all, bad, list
    exit bad > 0 || all < last
}' "$file"
