#!/bin/sh
# run_predict.sh GNATHOS PLAN CASE|--class N [KEEP]: predicts a plan on a case (or on a synthetic head made here), and reads
# the outcome as a user's script would. A case that is absent is skipped (status 77). KEEP: the outcome is left
# there, and the prepared case in KEEP.case.
set -eu
gnathos=$1 plan=$2 case=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAIL: $*" >&2; exit 1; }
if [ "$case" = --class ]; then
    "$gnathos" new "$work/case" --norm --class "$4" --json >"$work/made.json"
    pictures=
else
    [ -f "$case/skin.ply" ] || { echo "skipped: $case is not here"; exit 77; }
    "$gnathos" import --skin "$case/skin.ply" --skull "$case/skull.ply" --mandible "$case/mandible.ply" \
        --landmarks "$case/landmarks.mrk.json" -o "$work/case" -q --json >"$work/made.json"
    pictures=--no-pictures
fi
"$gnathos" check -q "$work/case" --plan "$plan" --json >"$work/check.json"
# what is printed is the record in the folder
# shellcheck disable=SC2086
"$gnathos" predict "$work/case" --plan "$plan" -o "$work/out" $pictures --json >"$work/predict.json" 2>"$work/warned.txt"
cmp "$work/predict.json" "$work/out/outcome.json" || fail "predict prints another record than it writes"
"$gnathos" audit "$work/case" --plan "$plan" -o "$work/judged" --json -q >"$work/audit.json" # feasible: status 0
cmp "$work/audit.json" "$work/judged/audit.json" || fail "audit prints another record than it writes"
"$gnathos" prepare "$work/case" --json >"$work/prepare.json"
/usr/bin/python3 - "$work" <<'PY'
import json, sys
audit = json.load(open(sys.argv[1] + "/audit.json"))
outcome = json.load(open(sys.argv[1] + "/out/outcome.json"))["limits"]
assert audit["feasible"] and audit["worst"] != "stop", audit["worst"]
n = len(audit["limits"])
for a, o in zip(audit["limits"], outcome["limits"]):
    assert (a["limit"], a["where"], a["value"], a["level"]) == (o["limit"], o["where"], o["value"], o["level"]), (a, o)
    assert a["level"] != "not judged" or a["note"], a
assert [f["limit"] for f in outcome["limits"][n:n + 3]] == ["solved", "smallest_j", "largest_stretch"]
PY
printf '{ "gnathos": 1, "segments": { "distal": { "translate_mm": [0, 0, 8] } } }\n' >"$work/bite.json"
status=0
"$gnathos" predict "$work/case" --plan "$work/bite.json" -o "$work/none" -q 2>"$work/refused.txt" || status=$?
[ $status -eq 6 ] && [ ! -e "$work/none" ] || fail "teeth 8 mm into each other are not refused: status $status"
grep -q 'override' "$work/refused.txt" || fail "the refusal does not say how to go on: $(cat "$work/refused.txt")"
if [ -z "$pictures" ]; then
# a plan that several limits stop has one remedy, a plan that is feasible as it is written
printf '{ "gnathos": 1, "maxilla_advance_mm": 9, "mandible_advance_mm": -12 }\n' >"$work/far.json"
status=0
"$gnathos" audit "$work/case" --plan "$work/far.json" -o "$work/far" --json -q >"$work/far_audit.json" || status=$?
[ $status -eq 6 ] || fail "a plan beyond its limits ends with status $status"
"$gnathos" audit "$work/case" --plan "$work/far/remedy.json" --json -q >"$work/remedy_audit.json"
/usr/bin/python3 - "$work" <<'PY'
import json, sys
far, then = (json.load(open("%s/%s.json" % (sys.argv[1], n))) for n in ("far_audit", "remedy_audit"))
assert sum(l["level"] == "stop" for l in far["limits"]) >= 2 and far["remedy"]["found"], far["remedy"]
assert then["feasible"] and then["worst"] != "stop" and then["remedy"] is None
value = {l["limit"]: l["value"] for l in then["limits"]}
for change in far["remedy"]["changes"]: assert abs(value[change["control"]] - change["proposed"]) < 1e-6, change
PY
for record in far_audit remedy_audit; do
    /usr/bin/python3 "$(dirname "$0")/check_record.py" "$gnathos" "$work/$record.json"
done
fi
/usr/bin/python3 - "$work/out" <<'PY'
import json, os, sys
out = sys.argv[1]
o = json.load(open(os.path.join(out, "outcome.json")))
s = o["solve"]
assert s["solved"] and s["inverted_tets"] == 0, s["outcome"]
assert s["relative_residual"] < 1e-6, s["relative_residual"]
assert s["min_J"] > 0
assert abs(s["force_imbalance"]) < 1e-6, s["force_imbalance"]
for cut in o["prepared"]["cuts"]["balance"]:
    assert cut["error_share"] < 1e-3, cut
assert o["prepared"]["attachment"]["max_bone_gap_mm"] <= 0.051
for name in ("skin_before.ply", "skin_after.ply", "skin_after.stl", "tissue.vtu", "landmarks_planned.mrk.json",
             "segment_maxilla.ply", "segment_distal.stl"):
    assert os.path.getsize(os.path.join(out, name)) > 1000, name
# bone landmarks go where the plan sends them, to the digit
for l in o["landmarks"]:
    if l["label"] in ("Co_L", "Co_R", "N", "Or_L"):
        assert max(abs(x) for x in l["forward_up_left_mm"]) == 0, l
PY
[ -n "$pictures" ] || [ -s "$work/out/pictures/overview.png" ] || fail "no pictures"
# prepared once: the second plan of the case reuses it
"$gnathos" predict "$work/case" --plan "$plan" -o "$work/again" --no-pictures >"$work/again.txt" 2>"$work/warned_again.txt"
cat "$work/again.txt"
if [ -z "$pictures" ]; then # class III turned round: what leads stands first
    head -n 1 "$work/again.txt" | grep -q '^caution: bite_contacts is 0: no tooth' || fail "lost teeth are no headline"
fi
grep -q reused "$work/again.txt" || fail "the prepared case was not reused"
# no face without what is doubtful about its case: told by every verb, in check's words, and judged
cmp "$work/warned.txt" "$work/warned_again.txt" || fail "the second prediction tells other warnings"
"$gnathos" check "$work/case" 2>&1 >/dev/null | grep 'warning: ' >"$work/checked.txt" || true
grep -v '^gnathos: cuts: ' "$work/warned.txt" | cmp - "$work/checked.txt" || fail "predict warns of something else than check"
/usr/bin/python3 - "$work" <<'PY'
import json, sys
o = json.load(open(sys.argv[1] + "/out/outcome.json"))
doubts = o["prepared"]["warnings"]
judged = [l for l in o["limits"]["limits"] if l["limit"] == "case_warnings" and l["level"] == "caution"]
assert [w["text"] for w in doubts] == [l["note"] for l in judged], (doubts, judged)
assert [w["text"] for w in doubts if w["part"] == "cuts"] == o["prepared"]["cuts"]["warnings"]
told = open(sys.argv[1] + "/warned.txt").read().splitlines()
assert len(told) == len(doubts) > 0 and all(t.endswith("warning: " + w["text"]) for t, w in zip(told, doubts)), told
PY
cmp "$work/out/skin_after.ply" "$work/again/skin_after.ply" || fail "the same plan gave another face"
cmp "$work/out/tissue.vtu" "$work/again/tissue.vtu" || fail "the same plan gave another tissue"
# the profile is measured, and the outcome compares with itself as equal and with the face before as changed
"$gnathos" ceph "$work/out" >"$work/ceph.txt" && grep -q planned "$work/ceph.txt" || fail "no cephalometry"
"$gnathos" compare "$work/out" "$work/again" --json >"$work/same.json"
"$gnathos" compare "$work/out" "$work/out/skin_before.ply" --json >"$work/before.json"
if [ -z "$pictures" ]; then /usr/bin/python3 "$(dirname "$0")/turned_face.py" "$gnathos" "$work/out" "$work"; fi
"$gnathos" compare "$work/out" "$work/again" -o "$work/compared" $pictures --json >"$work/compared.json"
cmp "$work/compared.json" "$work/compared/comparison.json" || fail "compare prints another record than it writes"
"$gnathos" ceph "$work/out" --json >"$work/ceph.json"
"$gnathos" export "$work/out" --format obj -o "$work/shapes" --json >"$work/export.json"
for record in made check predict audit prepare same before compared ceph export; do
    /usr/bin/python3 "$(dirname "$0")/check_record.py" "$gnathos" "$work/$record.json"
done
[ -s "$work/compared/comparison.vtp" ] && [ -s "$work/compared/regions.csv" ] || fail "compare wrote no files"
/usr/bin/python3 - "$work" <<'PY'
import json, os, sys
same, before = (json.load(open(os.path.join(sys.argv[1], n + ".json"))) for n in ("same", "before"))
rows = same["regions"]["prediction"]
assert len(rows) == 8 and all(r["points"] > 100 and r["rms_mm"] < 1e-9 for r in rows.values()), rows
assert same["alignment"]["turn_deg"] < 1e-6 and same["closer_than_both_trivial"]["face"]
assert before["regions"]["no_change"]["face"]["rms_mm"] < 0.01, before["regions"]["no_change"]["face"]
assert before["regions"]["prediction"]["face"]["rms_mm"] > 0.2 and not before["closer_than_both_trivial"]["face"]
parts = [rows[n]["points"] for n in ("nose", "upper lip", "lower lip", "chin", "left cheek", "right cheek")]
assert sum(parts) == rows["face"]["points"]
PY
# pictures on demand: named after what they show, the same bytes for any number of threads
if [ -z "$pictures" ]; then
    for jobs in 1 2; do
        "$gnathos" render "$work/out" -o "$work/shown$jobs" -j $jobs --size 320x200 --pose wipe --view 30,-10 --show bones \
            --show contour --show signed --show stretch --show tracing >"$work/shown.txt"
        "$gnathos" render "$work/out" -o "$work/shown$jobs" -j $jobs --size 240x160 --turntable 3 --centre Pn --zoom 2 -q
    done
    [ "$(wc -l <"$work/shown.txt")" -eq 5 ] || fail "wanted five pictures: $(cat "$work/shown.txt")"
    for name in bones_wipe_az30_el-10 contour signed_az30_el-10 stretch_az30_el-10 tracing skin_both_turn_002; do
        cmp "$work/shown1/$name.png" "$work/shown2/$name.png" || fail "$name.png depends on the threads, or is missing"
    done
    "$gnathos" render "$work/out" -o "$work/shown" --size 160x120 --show skin --json >"$work/render.json"
    "$gnathos" cut "$work/case" -o "$work/cut" --json >"$work/cut.json"
    cmp "$work/cut.json" "$work/cut/cut_report.json" || fail "cut prints another record than it writes"
    /usr/bin/python3 "$(dirname "$0")/check_record.py" "$gnathos" "$work/render.json" "$work/cut.json"
    [ -s "$work/compared/signed.png" ] || fail "compare drew no picture"
fi
# an output in use is not replaced unasked
if "$gnathos" predict "$work/case" --plan "$plan" -o "$work/out" >/dev/null 2>&1; then fail "an old output was replaced"; fi
[ -z "${5:-}" ] || { rm -rf "$5" "$5.case"; mv "$work/out" "$5"; mkdir "$5.case"; cp -R "$work/case/prepared" "$work/case"/*.* "$5.case"; }
# and the bounds of its controls, on the synthetic head, which is prepared by now
if [ -n "$pictures" ]; then exit 0; fi
sh "$(dirname "$0")/run_audit.sh" "$gnathos" "$work/case"
