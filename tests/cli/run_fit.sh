#!/bin/sh
# run_fit.sh GNATHOS: the template on a patient that is the template itself, larger, turned, elsewhere and without neck
# and crown; the fitted head is a case; what is no head is refused. GNATHOS_TEMPLATE names the template.
set -eu
gnathos=$1 here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAIL: $*" >&2; exit 1; }
"$gnathos" template -o "$work/t" -q >/dev/null
/usr/bin/python3 - "$work" <<'PY'
import json, math, os, struct, sys
work = sys.argv[1]
a, b = math.radians(12), 1.04
turn = lambda p: [b * (math.cos(a) * p[0] - math.sin(a) * p[1]) + 30, b * (math.sin(a) * p[0] + math.cos(a) * p[1]) - 20,
                  b * p[2] + 45]
def ply(name):
    data = open(f"{work}/t/{name}.ply", "rb").read()
    head, body = data.split(b"end_header\n", 1)
    n, m = (int(head.split(b"element " + w)[1].split()[0]) for w in (b"vertex", b"face"))
    x = [struct.unpack_from("<3d", body, 24 * i) for i in range(n)]
    f = [struct.unpack_from("<B3i", body, 24 * n + 13 * i)[1:] for i in range(m)]
    return x, f
def off(path, x, f):
    with open(path, "w") as out:
        out.write(f"OFF\n{len(x)} {len(f)} 0\n")
        for p in x: out.write("%.9f %.9f %.9f\n" % tuple(p))
        for t in f: out.write("3 %d %d %d\n" % tuple(t))
points = json.load(open(work + "/t/landmarks.mrk.json"))
def case(name, move, cut, flip=False, parts=("skin", "skull", "mandible", "upper_teeth", "lower_teeth")):
    folder = f"{work}/{name}"
    os.mkdir(folder)
    for part in parts:
        x, f = ply(part)
        if part == "skin" and cut: f = [t for t in f if all(-100 < x[v][2] < 90 for v in t)]
        if flip: f = [t[::-1] for t in f]
        off(f"{folder}/{part}.off", [move(p) for p in x], f)
    moved = json.loads(json.dumps(points))
    for p in moved["markups"][0]["controlPoints"]: p["position"] = move(p["position"])
    json.dump(moved, open(folder + "/landmarks.mrk.json", "w"))
    json.dump({"gnathos": 1, "name": name, "units": "mm", "frame": "LPS", "landmarks": "landmarks.mrk.json",
               "surfaces": {p: p + ".off" for p in parts}},
              open(folder + "/case.json", "w"))
case("patient", turn, True)
case("face", turn, True, parts=("skin",))
case("metres", lambda p: [0.001 * c for c in p], False)
case("mirrored", lambda p: [-p[0], p[1], p[2]], False, True)
PY
"$gnathos" fit "$work/patient" -o "$work/out" --json >"$work/fit.json" 2>"$work/told.txt"
cmp "$work/fit.json" "$work/out/fit.json" || fail "fit prints another record than it writes"
/usr/bin/python3 "$here/check_record.py" "$gnathos" "$work/fit.json"
grep -q '^gnathos: skin: warning: [1-5][0-9] % of it is guessed from the template: the scan has nothing there$' "$work/told.txt" ||
    fail "nothing warns of what is guessed: $(cat "$work/told.txt")"
"$gnathos" check "$work/out/case" >"$work/check.txt" 2>&1 || fail "the fitted head is no case: $(cat "$work/check.txt")"
/usr/bin/python3 - "$work" <<'PY'
import json, math, os, sys, meshio
work = sys.argv[1]
f = json.load(open(work + "/fit.json"))
assert f["place"]["by_landmarks"] and abs(f["place"]["scale"] - 1.04) < 1e-6 and abs(f["place"]["turn_deg"] - 12) < 1e-4
assert f["tissue"]["inverted_tets"] == 0 and f["tissue"]["min_j"] > 0.3, f["tissue"]
for name, p in f["parts"].items():
    assert p["scanned"] and p["mean_mm"] < 0.2, (name, p)
    assert abs(p["guessed_share"] + p["missed_share"] - (1 - p["with_target"] / p["vertices"])) < 1e-12
    back = p["scan"]
    assert 0 < back["covered"] <= back["vertices"] and back["mean_mm"] < 0.3 <= back["max_mm"] + 0.3, (name, back)
    head, arrays = (open(f"{work}/out/{name}.{kind}", "rb").read(3000) for kind in ("ply", "vtp"))
    assert b"property uchar red" in head and b"element vertex %d\n" % p["vertices"] in head, name
    assert b'"distance_mm"' in arrays and b'"guessed"' in arrays, name
    assert b'"distance_mm"' in open(f"{work}/out/scan_{name}.vtp", "rb").read(3000), name
assert 0.1 < f["parts"]["skin"]["guessed_share"] < 0.6, f["parts"]["skin"]
assert f["parts"]["skull"]["guessed_share"] < 0.02
t = meshio.read(work + "/out/tissue.vtu")
assert {"J", "to_rest", "attachment", "segment"} <= set(t.point_data) and t.point_data["J"].min() > 0
case = json.load(open(work + "/out/case/case.json"))
skin = f["parts"]["skin"]
assert abs(case["guessed"]["skin"] - skin["guessed_share"] - skin["missed_share"]) < 1e-12 and case["guessed"]["jaw_turned_deg"] == 0, case
assert case["guessed"]["landmarks"] == f["guessed_landmarks"] and not {"N", "U1", "Me"} & set(f["guessed_landmarks"]), case
# landmarks lie where the patient's are
at = {p["label"]: p["position"] for p in json.load(open(work + "/out/case/landmarks.mrk.json"))["markups"][0]["controlPoints"]}
own = {p["label"]: p["position"] for p in json.load(open(work + "/patient/landmarks.mrk.json"))["markups"][0]["controlPoints"]}
away = sorted(math.dist(at[l], own[l]) for l in own)
assert set(at) == set(own) and away[len(away) // 2] < 0.3 and away[-1] < 3, away[-5:]
for picture in ("residual_skin", "residual_bones", "residual_scan", "beside"):
    assert os.path.getsize(f"{work}/out/{picture}.png") > 20000, picture
PY
refused() { # CASE WORDS STATUS
    status=0
    "$gnathos" fit "$work/$1" -o "$work/none" >"$work/stdout" 2>"$work/stderr" || status=$?
    [ $status -eq "$3" ] && [ ! -e "$work/none" ] || fail "$1: status $status: $(cat "$work/stderr")"
    grep -qiF -- "$2" "$work/stderr" || fail "$1: wanted '$2': $(cat "$work/stderr")"
}
refused face 'face/case.json: surfaces.skull: is missing; name its file, or let `gnathos fit --complete` guess it' 3
status=0
"$gnathos" fit "$work/face" -o "$work/none" --model m >/dev/null 2>"$work/stderr" || status=$?
[ $status -eq 2 ] && grep -q -- '--complete' "$work/stderr" || fail "--model alone: status $status: $(cat "$work/stderr")"
GNATHOS_IDENTITIES="$work/no.model" "$gnathos" fit "$work/face" -o "$work/whole" --complete --no-pictures --json >"$work/whole.json" 2>"$work/told.txt"
/usr/bin/python3 "$here/check_record.py" "$gnathos" "$work/whole.json"
grep -q "the mean head's: there is no model .*/no.model" "$work/told.txt" || fail "by what it is completed is not told: $(cat "$work/told.txt")"
grep -q '^gnathos: mandible: warning: 100 % of it is guessed from the template: the scan has no such surface$' "$work/told.txt" ||
    fail "nothing warns of a guessed mandible: $(cat "$work/told.txt")"
/usr/bin/python3 - "$work" <<'PY'
import json, sys
work = sys.argv[1]
f = json.load(open(work + "/whole.json"))
assert f["completion"]["jaw"]["stop"] == "not_open" and f["completion"]["jaw"]["turn_deg"] == 0, f["completion"]
assert f["parts"]["skin"]["mean_mm"] < 0.2 and f["parts"]["skin"]["guessed_share"] < 0.6, f["parts"]["skin"]
for part in ("skull", "mandible", "upper_teeth", "lower_teeth"):
    p = f["parts"][part]
    assert not p["scanned"] and p["guessed_share"] == 1 and p["mean_mm"] is None, (part, p)
case = json.load(open(work + "/whole/case/case.json"))
assert case["guessed"]["upper_teeth"] == 1 and {"U1", "N", "Me"} <= set(case["guessed"]["landmarks"]), case
assert "completion" not in json.load(open(work + "/fit.json"))
PY
"$gnathos" check "$work/whole/case" >"$work/check.txt" 2>&1 || fail "the whole head is no case: $(cat "$work/check.txt")"
grep -q 'upper_teeth.ply: warning: 100 % of it is guessed, not from the scan$' "$work/check.txt" ||
    fail "check does not warn of guessed teeth: $(cat "$work/check.txt")"
grep -q 'landmarks.mrk.json: warning: [0-9]* of 81 are guessed, not from the scan: .*U1' "$work/check.txt" ||
    fail "check does not warn of guessed landmarks: $(cat "$work/check.txt")"
refused metres metre 4
refused mirrored mirror 4
refused absent 'absent' 3
echo "the template fits, and what is no head is refused"
