#!/bin/sh
# same_bits.sh [RUNS [ELEMENT_MM [CLASS [COARSENESS]]]], or same_bits.sh RUNS CASE PLAN: new (or a copy of CASE without what
# was prepared), cut, prepare and predict, RUNS (10) times with 1, 2, 3 and 8 threads in turn and other bytes in fresh memory
# each time, write the same bytes; without a CASE that of the synthetic class III head. Every file of every run is compared
# with that of the first; of outcome.json times and the peak of memory are left out of that.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
gnathos=${GNATHOS_BUILD:-$root/build}/app/gnathos
runs=${1:-10} failed=0
if [ -d "${2:-}" ]; then
    case=$(realpath "$2") plan=$(realpath "$3")
else
    case= element=${2:-3} class=${3:-3} coarseness=${4:-1}
    plan=$root/cases/class$class/plan.json
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
timeless() { # takes out of RUN/out/outcome.json: the object "seconds", numbers named ..._s, and peak_memory_MB
    /usr/bin/python3 - "$1/out/outcome.json" <<'PY'
import json, sys
def timeless(value):
    if isinstance(value, dict):
        return {k: timeless(v) for k, v in value.items() if not k.endswith(("seconds", "_s", "memory_MB"))}
    return [timeless(v) for v in value] if isinstance(value, list) else value
outcome = timeless(json.load(open(sys.argv[1])))
json.dump(outcome, open(sys.argv[1], "w"), indent=1)
PY
}
for run in $(seq "$runs"); do
    jobs=$(echo 8 1 2 3 | cut -d ' ' -f $((run % 4 + 1)))
    mkdir "$run"
    export MALLOC_PERTURB_=$((run * 25 % 256))
    if [ -n "$case" ]; then
        cp -R "$case" "$run/case"
        find "$run/case" -name '*.pack' -delete
    else
        "$gnathos" new "$run/case" --norm --class "$class" --coarseness "$coarseness" -j "$jobs" -q >"$run/new.txt"
        sed 's/"osteotomies"/"tissue": { "element_mm": '"$element"' }, "osteotomies"/' "$run/case/case.json" >"$run/case.json"
        mv "$run/case.json" "$run/case/case.json"
    fi
    "$gnathos" cut "$run/case" -o "$run/cut" -j "$jobs" -q >"$run/cut.txt"
    "$gnathos" prepare "$run/case" -j "$jobs" -q >"$run/prepare.txt"
    "$gnathos" predict "$run/case" --plan "$plan" -o "$run/out" --no-pictures -j "$jobs" -q >"$run/predict.txt"
    timeless "$run"
    rm "$run"/*.txt
    if [ "$run" -eq 1 ]; then
        echo "run 1, $jobs threads: $(find 1 -type f | wc -l) files"
    elif diff -rq 1 "$run"; then
        echo "run $run, $jobs threads: the same"
        rm -r "${work:?}/$run"
    else
        echo "run $run, $jobs threads: DIFFERS"
        failed=1
        [ -z "${KEEP:-}" ] || cp -R . "$KEEP"
    fi
done
[ $failed -eq 0 ] && echo "$runs runs: same bits"
exit $failed
