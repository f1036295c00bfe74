#!/bin/sh
# contact_table.sh [-w WORK] [-m "MM..."] [-o OLD_BENCH_HEAD] [ROW...]: what contact costs, as ratios of processor time in one
# run on one thread, beside their goals. Prints a table of markdown; the runs' own tables go to WORK (contact_table in the
# build folder).
#   phantom  the phantom's mandible advanced by 6 mm, meshed at 3, 2 and 1.4 mm: cold, and 1 mm further (bench_head)
#   lips     the same with lips that part and meet, at 3 mm
#   block    a block on a plane, beside CalculiX where ccx is there (bench_peer)
#   growth   of time with size, up to 978 thousand unknowns (bench_growth; 5 GB)
#   prepare  the whole of it against meshing alone, phantom (gnathos prepare --json)
#   predict  all but the solve against the solve, on the prepared phantom (gnathos predict)
# Without rows: all. -m: these meshes of the phantom alone, mm. -o: bench_head of an older build, run on the last of them.
# What cannot be made (no GNATHOS_DATA, no ccx, no older build) is named in the table. Cases in WORK are made once; runs
# are made each time.
set -eu
export LC_ALL=C
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${GNATHOS_BUILD:-$root/build}
work=$build/contact_table old= meshes="3 2 1.4"
while getopts w:m:o: option; do
    case $option in
    w) work=$OPTARG ;;
    m) meshes=$OPTARG ;;
    o) old=$OPTARG ;;
    *) exit 2 ;;
    esac
done
shift $((OPTIND - 1))
[ $# -gt 0 ] || set -- phantom lips block growth prepare predict
for row; do
    case $row in
    phantom | lips | block | growth | prepare | predict) ;;
    *) echo "contact_table.sh: there is no row $row" >&2; exit 2 ;;
    esac
done
mkdir -p "$work"
work=$(cd "$work" && pwd)
gnathos=$build/app/gnathos bench=$build/tests/bench plan=$root/tests/cli/plans/mandible_advance.json
cmake --build "$build" --target gnathos bench_head bench_peer bench_growth >"$work/build.log" 2>&1 ||
    { cat "$work/build.log" >&2; exit 1; }
data=${GNATHOS_DATA:-}/phantom_head_ct
have_data() { [ -f "$data/skin.ply" ]; }

row() { echo "| $1 | $2 | $3 | $4 |"; } # what, value, good, goal
missing() { row "$1" "not made: $2" "$3" "$4"; }

# phantom_at MM: the case of that mesh, prepared
phantom_at() {
    folder=$work/phantom_$1
    if [ ! -d "$folder" ]; then
        "$gnathos" import --skin "$data/skin.ply" --skull "$data/skull.ply" --mandible "$data/mandible.ply" \
            --landmarks "$data/landmarks.mrk.json" --name phantom -o "$folder.part" -q
        sed -i '0,/{/s//{ "tissue": { "element_mm": '"$1"' },/' "$folder.part/case.json"
        mv "$folder.part" "$folder"
    fi
    "$gnathos" prepare "$folder" -j 1 -q >/dev/null
}
# value FILE WAY COLUMN: of a table of bench_head; empty where there is none
value() { awk -F, -v way="$2" -v column="$3" 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k; next } $at["way"] == way { print $at[column] }' "$1"; }
# over FILE WAY OTHER: processor time of one way against another's, and how either ended if not well
over() {
    awk -F, -v one="$2" -v other="$3" 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k; next }
        $at["way"] == one { a = $at["cpu_s"]; if ($at["outcome"] != "solved") said = said " (" one ": " $at["outcome"] ")" }
        $at["way"] == other { b = $at["cpu_s"]; if ($at["outcome"] != "solved") said = said " (" other ": " $at["outcome"] ")" }
        END { if (a && b) printf "%.2f%s", a / b, said; else printf "not made: no %s", a ? other : one }' "$1"
}

phantom_rows() {
    if ! have_data; then missing "phantom" "no phantom_head_ct in GNATHOS_DATA" "" ""; return; fi
    for mm in $meshes; do
        phantom_at $mm
        file=$work/head_$mm.csv
        "$bench/bench_head" "$folder" "$plan" 1 >"$file" 2>"$work/head_$mm.log"
        case $mm in 3) good=2.5 ;; 2) good=2 ;; *) good=1.5 ;; esac
        size="$(($(value "$file" off unknowns) / 1000))k unknowns"
        row "cold with bones : cold without, phantom $size" "$(over "$file" bones off)" $good 1.5
        row "re-plan by 1 mm : cold with bones, $size" "$(over "$file" bones-replan bones)" 0.25 0.1
        row "factorisations begun, cold / re-plan, $size" "$(value "$file" bones factorisations) / $(value "$file" bones-replan factorisations)" "8 / 2" "4 / 0"
        row "iterations, without / cold / re-plan, $size" "$(value "$file" off iterations) / $(value "$file" bones iterations) / $(value "$file" bones-replan iterations)" "" ""
        row "cold without / cold with bones / re-plan, in L, $size" "$(value "$file" off cpu_ratio) / $(value "$file" bones cpu_ratio) / $(value "$file" bones-replan cpu_ratio)" "" ""
        if [ -n "$(value "$file" preview cpu_ratio)" ]; then
            row "preview of a re-plan, in L, $size" "$(value "$file" preview cpu_ratio)" 0.1 0.05
        else
            missing "preview of a re-plan, in L, $size" "bench_head has none" 0.1 0.05
        fi
    done
    if [ -x "$old" ]; then
        "$old" "$folder" "$plan" 1 >"$work/head_old.csv" 2>"$work/head_old.log"
        row "this build : the older one, cold with bones, $size" \
            "$(awk -v a="$(value "$file" bones cpu_s)" -v b="$(value "$work/head_old.csv" bones cpu_s)" 'BEGIN { printf "%.2f", a / b }')" 0.3 0.15
    else
        missing "this build : the older one, cold with bones, $size" "no bench_head of an older build (-o)" 0.3 0.15
    fi
}

lips_rows() {
    if ! have_data; then missing "lips : bones" "no phantom_head_ct in GNATHOS_DATA" 2 1.3; return; fi
    phantom_at 3
    "$bench/bench_head" "$folder" "$plan" 1 bones lips >"$work/lips.csv" 2>"$work/lips.log"
    row "contact with lips : with bones, phantom at 3 mm" "$(over "$work/lips.csv" lips bones)" 2 1.3
}

block_rows() {
    "$bench/bench_peer" - 0.05 16 20 >"$work/block.csv" 2>"$work/block.log"
    awk -F, 'NR > 1 { printf "| block on plane, %dk unknowns, in L | %s (%s iterations, %s factorisations%s) | 3 | 2 |\n",
        $2 / 1000, $12, $6, $7, $5 == "solved" ? "" : ", " $5 }' "$work/block.csv"
    if ! command -v ccx >/dev/null; then missing "block beside CalculiX" "no program ccx" "1.5; 5" "1; 10"; return; fi
    mkdir -p "$work/ccx"
    "$bench/bench_peer" "$work/ccx" 0.003 5 8 >"$work/peer.csv" 2>"$work/peer.log"
    awk -F, '$3 == "gnathos" { n = $6; cpu = $10; force = $13; off = $15 }
        $3 == "CalculiX" && $5 != "solved" { printf "| block, %d nodes, beside CalculiX | not made: CalculiX %s | 1.5; 5 | 1; 10 |\n", $1, $5 }
        $3 == "CalculiX" && $5 == "solved" { printf "| block, %d nodes, depth 0.003 mm: iterations : CalculiX'\''s; CPU of CalculiX : ours | %.1f (%d : %d); %.1f (%.2g mm apart, force %.2f %%) | 1.5; 5 | 1; 10 |\n",
            $1, n / $6, n, $6, $10 / cpu, off, 100 * (force / $13 - 1) }' "$work/peer.csv"
}

growth_rows() {
    "$bench/bench_growth" 1 22 0.45 >"$work/growth.csv" 2>"$work/growth.log" || { missing "growth" "bench_growth failed" "1.2; 5" "1.1; 4"; return; }
    awk -F, 'NR == 2 { low = $2 } END { printf "| growth exponent %dk to %dk unknowns; Newton steps there | %s; %s | 1.2; 5 | 1.1; 4 |\n",
        low / 1000, $2 / 1000, $13, $6 }' "$work/growth.csv"
}

prepare_rows() {
    if ! have_data; then missing "prepare : its own Mesh_3 part" "no phantom_head_ct in GNATHOS_DATA" 4 3; return; fi
    phantom_at 3
    rm -rf "$work/fresh"
    "$gnathos" prepare "$folder" --cache "$work/fresh" -j 1 --json -q >"$work/prepare.json"
    rm -rf "$work/fresh"
    /usr/bin/python3 -c '
import json, sys
s = {k: v["cpu_s"] for k, v in json.load(open(sys.argv[1]))["stages"].items()}
print("| prepare : its own Mesh_3 part, phantom | %.1f (%.0f : %.0f CPU s) | 4 | 3 |" % (sum(s.values()) / s["mesh"], sum(s.values()), s["mesh"]))' "$work/prepare.json"
}

predict_rows() {
    if ! have_data; then missing "predict without the solve : the solve" "no phantom_head_ct in GNATHOS_DATA" 0.8 0.4; return; fi
    phantom_at 3
    rm -rf "$work/face"
    "$gnathos" predict "$folder" --plan "$plan" -o "$work/face" -j 1 -q --json >"$work/predict.json"
    rm -rf "$work/face"
    /usr/bin/python3 -c '
import json, sys
s = {k: v["cpu_s"] for k, v in json.load(open(sys.argv[1]))["stages"].items()}
rest = sum(s.values()) - s["solve"]
print("| predict on a prepared case without the solve : the solve | %.2f (%.1f : %.1f CPU s) | 0.8 | 0.4 |" % (rest / s["solve"], rest, s["solve"]))' "$work/predict.json"
}

echo "| ratio of processor time, one thread | now | good | goal |"
echo "|---|---|---|---|"
for row_name; do "${row_name}_rows"; done
