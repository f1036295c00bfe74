#!/bin/sh
# norm_heads.sh GNATHOS FOLDER FIRST LAST [COARSENESS]: synthetic heads of the seeds FIRST to LAST through check, cut and
# predict.
# Classes, sexes, open bites and asymmetries take turns; each head gets the plan of its kind in cases/. FOLDER/heads.csv:
# seed, class, sex, plan, outcome ("solved", or the verb that refused and its words), largest errors of the measures asked
# for (cephalometry: mm or degrees; depths of soft tissue: mm), inverted tets, smallest J, seconds of the four steps.
set -eu
[ $# -eq 4 ] || [ $# -eq 5 ] || { echo "usage: norm_heads.sh GNATHOS FOLDER FIRST LAST [COARSENESS]" >&2; exit 2; }
gnathos=$(realpath "$1") cases=$(cd "$(dirname "$0")/../../cases" && pwd)
mkdir -p "$2"
cd "$2"
[ -f heads.csv ] || echo 'seed,class,sex,plan,outcome,measure_error,depth_error_mm,inverted,min_J,seconds' >heads.csv
seed=$3
while [ "$seed" -le "$4" ]; do
    class=$((seed % 3 + 1)) sex=f plan=norm extra=
    [ $((seed % 2)) -eq 0 ] && sex=m
    [ $class -ne 1 ] && plan=class$class
    [ $((seed % 5)) -eq 0 ] && plan=asymmetry extra='--asymmetry 4'
    [ $((seed % 7)) -eq 3 ] && extra="$extra --open-bite 2"
    head=head$seed outcome=solved start=$(date +%s)
    rm -rf "$head" "$head.cut" "$head.out" "$head.log"
    step() { # VERB ARGUMENT...: the first step that fails names the outcome
        [ "$outcome" = solved ] || return 0
        "$gnathos" "$@" >"$head.log" 2>"$head.err" || outcome="$1: $(tail -n 1 "$head.err" | tr ',"' ';_')"
    }
    # shellcheck disable=SC2086
    step new "$head" --norm --coarseness "${5:-1}" --class $class --sex $sex --seed "$seed" $extra
    step check "$head" --plan "$cases/$plan/plan.json"
    step cut "$head" -o "$head.cut"
    step predict "$head" --plan "$cases/$plan/plan.json" -o "$head.out" --no-pictures
    errors=$(awk -F, 'NR > 1 { d = $2 - $3; if (d < 0) d = -d; depth = $4 == "T-Table" && $1 ~ /_soft_mm$/
        if (depth ? d > b : d > a) { if (depth) b = d; else a = d } } END { printf "%.2f,%.2f", a, b }' \
        "$head/measures.csv" 2>/dev/null || echo ,)
    quality=$(sed -n 's/.*"inverted_tets": *\([0-9]*\).*"min_J": *\([-0-9.e]*\).*/\1,\2/p' "$head.out/outcome.json" 2>/dev/null |
        head -n 1)
    [ -n "$quality" ] || quality=$(tr -d '\n' <"$head.out/outcome.json" 2>/dev/null |
        sed -n 's/.*"inverted_tets": *\([0-9]*\), *"min_J": *\([-0-9.e]*\).*/\1,\2/p')
    echo "$seed,$class,$sex,$plan,$outcome,$errors,${quality:-,},$(($(date +%s) - start))" >>heads.csv
    seed=$((seed + 1))
done
! grep -v ',solved,' heads.csv | grep -v '^seed,' | grep .
