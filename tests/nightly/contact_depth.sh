#!/bin/sh
# contact_depth.sh [-j THREADS] [-w WORK] [-p PLAN]... [CASE...]: does tissue end up in bone? Predicts each case with contact bones
# for four standard plans and ten harder ones, and prints a row for each: how the solve ended, deepest tissue in bone or
# tooth by exact distances and its area, nodes that passed through bone, smallest J and tets inside out, iterations,
# factorisations and processor time of the solve, and where and why a solve stopped. Fails if tissue is deeper than
# 0.1 mm, a node passed through bone, a tet is inside out, or a solve did not end well.
# A harder plan that a limit stops is made smaller by tenths until none does (column `share`); a standard one is overridden.
# -p PLAN: that one alone (several may be named). WORK (contact_depth in the build folder) keeps cases, plans and outcomes:
# what has an outcome there is not predicted again. Without cases: the synthetic class III head, made there, and the two
# real heads of GNATHOS_DATA, which are left out, said so, where that is not set.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${GNATHOS_BUILD:-$root/build}
gnathos=${GNATHOS:-$build/app/gnathos} work=$build/contact_depth threads=1 only=
while getopts j:w:p: option; do
    case $option in
    j) threads=$OPTARG ;;
    w) work=$OPTARG ;;
    p) only="$only $OPTARG" ;;
    *) exit 2 ;;
    esac
done
shift $((OPTIND - 1))
mkdir -p "$work/plans"
work=$(cd "$work" && pwd)

import() { # NAME FOLDER OPTION...
    name=$1 from=$2
    shift 2
    if [ -d "$work/$name" ]; then return; fi
    "$gnathos" import --skin "$from/skin.ply" --skull "$from/skull.ply" --mandible "$from/mandible.ply" \
        --landmarks "$from/landmarks.mrk.json" "$@" -o "$work/$name.part/$name" -q
    mv "$work/$name.part/$name" "$work" && rmdir "$work/$name.part"
}
if [ $# -eq 0 ]; then
    if [ ! -d "$work/class3" ]; then
        "$gnathos" new "$work/class3.part/class3" --norm --class 3 -q >/dev/null
        mv "$work/class3.part/class3" "$work" && rmdir "$work/class3.part"
    fi
    set -- "$work/class3"
    if [ -d "${GNATHOS_DATA:-}" ]; then
        head=$GNATHOS_DATA/vtk_fullhead_ct
        import phantom "$GNATHOS_DATA/phantom_head_ct"
        import fullhead "$head" --upper-teeth "$head/teeth_upper.ply" --lower-teeth "$head/teeth_lower.ply"
        set -- "$@" "$work/phantom" "$work/fullhead"
    else
        echo "GNATHOS_DATA names no folder: the two real heads are left out" >&2
    fi
fi

# Kind, name and moves of each plan; lengths and angles are those at share 1.
table='standard maxilla_advance "maxilla_advance_mm": 5
standard mandible_advance "mandible_advance_mm": 6
standard mandible_setback "mandible_advance_mm": -5
standard two_jaw "maxilla_advance_mm": 4, "mandible_advance_mm": -2
hard maxilla_far "maxilla_advance_mm": 8
hard mandible_far "mandible_advance_mm": 12
hard setback_far "mandible_advance_mm": -10
hard both_forward "maxilla_advance_mm": 8, "mandible_advance_mm": 10
hard overjet_turned "maxilla_advance_mm": 8, "mandible_advance_mm": -7
hard impaction "maxilla_impaction_mm": 6, "maxilla_advance_mm": 3, "mandible_advance_mm": 3
hard yaw "segments": { "maxilla": { "yaw_deg": 5, "pivot": "ANS" }, "distal": { "yaw_deg": 6, "translate_mm": [3, 0, 0] } }
hard cant "segments": { "maxilla": { "roll_deg": 5 }, "distal": { "roll_deg": 5, "translate_mm": [0, -2, 0] } }
hard turn "segments": { "maxilla": { "pitch_deg": -5, "translate_mm": [0, -4, 0] }, "distal": { "pitch_deg": -6, "translate_mm": [0, -8, 0] } }
hard genioplasty "mandible_advance_mm": 5, "segments": { "chin": { "translate_mm": [0, -8, 4], "yaw_deg": 4 } }'

write_plan() { # NAME MOVES SHARE OVERRIDE FILE
    printf '%s\n' "$2" | /usr/bin/python3 -c '
import json, sys
name, share, override, path = sys.argv[1:]
def scaled(x):
    if isinstance(x, dict): return {k: scaled(v) for k, v in x.items()}
    if isinstance(x, list): return [scaled(v) for v in x]
    return x if isinstance(x, str) else round(x * float(share), 6)
plan = {"gnathos": 1, "name": name, **scaled(json.loads("{" + sys.stdin.read() + "}"))}
if override: plan["override"] = override
json.dump(plan, open(path, "w"), indent=1)' "$1" "$3" "$4" "$5"
}

# Sets `share` and writes FILE: the greatest share of the moves that no limit stops.
fit_plan() { # CASE KIND NAME MOVES FILE
    if [ "$2" = standard ]; then
        share=1
        write_plan "$3" "$4" 1 "a measurement of the solver" "$5"
        return
    fi
    for share in 1 .9 .8 .7 .6 .5 .4 .3; do
        write_plan "$3" "$4" $share "" "$5"
        status=0
        "$gnathos" audit "$1" --plan "$5" -q -j "$threads" >"$5.limits" 2>&1 </dev/null || status=$?
        [ $status -ne 0 ] || return 0
        [ $status -eq 6 ] || { cat "$5.limits" >&2; exit 1; }
    done
    share="1, no share is allowed" # limits that the case itself breaks, whatever the plan
    write_plan "$3" "$4" 1 "a measurement of the solver" "$5"
}

echo "case,plan,share,outcome,depth_mm,in_bone_mm2,nodes_in_bone,passed,min_j,inverted,iterations,factorisations,solve_cpu_s,touching,guards,given_up,verdict"
bad=0 rows=0
for folder; do
    name=$(basename "$folder") out=$work/$(basename "$folder").outcomes
    mkdir -p "$out"
    "$gnathos" prepare "$folder" -q -j "$threads" >/dev/null
    while read -r kind plan moves; do
        case " ${only:-$plan} " in *" $plan "*) ;; *) continue ;; esac
        file=$work/plans/$name.$plan.json
        if [ ! -f "$out/$plan/outcome.json" ]; then
            fit_plan "$folder" "$kind" "$plan" "$moves" "$file"
            echo "$share" >"$file.share"
            status=0
            "$gnathos" predict "$folder" --plan "$file" -o "$out/$plan" --force --no-pictures -q -j "$threads" \
                >"$file.table" 2>"$file.said" </dev/null || status=$?
            [ $status -eq 0 ] || [ $status -eq 5 ] || { echo "$name, $plan: predict failed ($status): $(cat "$file.said")" >&2; bad=$((bad + 1)); continue; }
        fi
        rows=$((rows + 1))
        /usr/bin/python3 - "$out/$plan/outcome.json" "$name,$plan,$(tr ',' ';' <"$file.share")" "$file.said" <<'END' || bad=$((bad + 1))
import json, sys
o, said = json.load(open(sys.argv[1])), open(sys.argv[3]).read().strip().replace(",", ";")
s, c, t = o["solve"], o["solve"]["contact"], o.get("tissue_in_bone") or {}
depth = t.get("depth_mm")
faults = [] if s["solved"] else [said.split("(", 1)[-1].split("; so there")[0] or s["outcome"]]
if s["solved"]:
    if depth is None: faults.append("depth not measured")
    elif depth > t["limit_mm"]:
        place = "(" + " ".join("%.1f" % x for x in t["at_lps_mm"]) + ")"
        faults.append("%.2f mm deep in %s at %s; %.1f mm below the skin" % (depth, t["bone"], place, t["from_skin_mm"]))
    if c.get("passed"): faults.append("%d nodes passed through bone" % c["passed"])
    if s["inverted_tets"]: faults.append("%d tets inside out" % s["inverted_tets"])
number = lambda x, f="%s": "" if x is None else f % x
print(",".join([sys.argv[2], "solved" if s["solved"] else s["outcome"].replace(",", ";"), number(depth, "%.3f"), number(t.get("area_mm2"), "%.1f"),
    number(t.get("nodes")), number(c.get("passed")), "%.3f" % s["min_J"], str(s["inverted_tets"]), str(s["iterations"]),
    str(s["factorisations"]), "%.1f" % o["stages"]["solve"]["cpu_s"], number(c.get("touching_nodes")), number(c.get("guards")),
    number(c.get("lost")), "BAD: " + "; ".join(faults) if faults else "ok"]), flush=True)
sys.exit(bool(faults))
END
    done <<END
$table
END
done
echo "$rows rows, $bad bad" >&2
[ $bad -eq 0 ] && [ $rows -gt 0 ]
