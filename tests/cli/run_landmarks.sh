#!/bin/sh
# run_landmarks.sh GNATHOS: the template as a scan, once imported with landmarks that place themselves and once asked for
# them: both find the same, where the template has them, each with its doubt; check tells who placed them.
# GNATHOS_TEMPLATE names the template.
set -eu
gnathos=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAIL: $*" >&2; exit 1; }
"$gnathos" template -o t -q >/dev/null
"$gnathos" import --skin t/skin.ply --skull t/skull.ply --mandible t/mandible.ply --upper-teeth t/upper_teeth.ply \
    --lower-teeth t/lower_teeth.ply --landmarks auto -o auto --progress=none >import.out 2>import.err || fail "$(cat import.err)"
"$gnathos" check auto >check.out 2>check.err || fail "$(cat check.err)"
grep -q 'landmarks were placed by gnathos and not by hand' check.err || fail "check does not tell who: $(cat check.err)"
"$gnathos" landmarks auto -o found.mrk.json --json --progress=none >found.json
/usr/bin/python3 - <<'PY'
import json, math
read = lambda path: {p["label"]: p for p in json.load(open(path))["markups"][0]["controlPoints"]}
exact, auto, found, told = read("t/landmarks.mrk.json"), read("auto/landmarks.mrk.json"), read("found.mrk.json"), json.load(open("found.json"))
assert auto == found, "import and landmarks place them otherwise"
off, beyond = [], 0
for p in told["landmarks"]:
    assert p["doubt_mm"] > 0, p
    assert p["label"] in found and ("mm" in found[p["label"]]["description"]), p
    assert (found[p["label"]]["positionStatus"] == "defined") == (p["doubt_mm"] <= 5), p
    d = math.dist(p["lps_mm"], exact[p["label"]]["position"])
    off.append(d)
    beyond += d > 2 * p["doubt_mm"]
off.sort()
print(f"{len(off)} landmarks, median {off[len(off) // 2]:.2f} mm, 90 % {off[len(off) * 9 // 10]:.2f}, {beyond} beyond twice their doubt")
assert len(off) > 70 and off[len(off) // 2] < 1 and off[len(off) * 9 // 10] < 4 and beyond <= 0.05 * len(off)
PY
status=0
"$gnathos" landmarks auto -o found.mrk.json >/dev/null 2>again.err || status=$?
[ $status = 2 ] && grep -q 'found.mrk.json.*--force' again.err || fail "written over: $status $(cat again.err)"
