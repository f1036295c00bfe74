"""teeth_missing.py GNATHOS WORK [WAY...]: makes the synthetic class III head, takes landmarks of teeth away in several ways, puts those
of the next teeth there where they are known, and prints how the cuts and the judgement of a plan change: what is
measured otherwise, what is left out by name, what is refused. Ends with an error where a value changes by more than its
bound and nothing says why."""
import json, os, shutil, subprocess, sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "planted"))
from head import Head
from mistakes import toothless

gnathos, work, *only = sys.argv[1:]
base = os.path.join(work, "base")
if not os.path.exists(base):
    subprocess.check_call([gnathos, "new", base, "--norm", "--class", "3", "-q"])
plan = os.path.join(work, "plan.json")
json.dump({"gnathos": 1, "maxilla_advance_mm": 4, "mandible_advance_mm": -2}, open(plan, "w"))
marks = json.load(open(os.path.join(base, "landmarks.mrk.json")))
places = {p["label"]: p["position"] for p in marks["markups"][0]["controlPoints"]}


def along(tooth, side, mm):
    """A cusp on the arch behind (mm > 0) or before the first molar's, towards the canine."""
    a, b = places["%s6_%s" % (tooth, side)], places["%s3_%s" % (tooth, side)]
    length = sum((x - y) ** 2 for x, y in zip(a, b)) ** 0.5
    return [x + mm * (x - y) / length for x, y in zip(a, b)]


def case(name, gone, new):
    folder = os.path.join(work, name)
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(base, folder, ignore=shutil.ignore_patterns("prepared"))
    m = json.loads(json.dumps(marks))
    points = [p for p in m["markups"][0]["controlPoints"] if p["label"] not in gone]
    for label, place in new.items():
        points.append({**points[0], "id": label, "label": label, "position": place})
    m["markups"][0]["controlPoints"] = points
    json.dump(m, open(os.path.join(folder, "landmarks.mrk.json"), "w"))
    return folder


def jaws(name, plant):
    """A case of jaws without teeth, what is gone and what is new."""
    h = Head(base).copy()
    before = set(h.point)
    plant(h)
    h.write(os.path.join(work, name))
    return os.path.join(work, name), before - set(h.point), set(h.point) - before


def judged(folder):
    run = subprocess.run([gnathos, "audit", folder, "--plan", plan, "--json", "-q"], capture_output=True, text=True)
    if run.returncode not in (0, 6):
        return None, run.stderr.strip().splitlines()[-1][:170]
    return json.loads(run.stdout)["limits"], ""


both = lambda *teeth: {"%s_%s" % (t, s) for t in teeth for s in "LR"}
ways = {
    "whole": (set(), {}),
    "U6_R by U7": ({"U6_R"}, {"U7_R": along("U", "R", 10)}),
    "U6 by U7": (both("U6"), {"U7_" + s: along("U", s, 10) for s in "LR"}),
    "U6 by U5": (both("U6"), {"U5_" + s: along("U", s, -6) for s in "LR"}),
    "L6 by L5": (both("L6"), {"L5_" + s: along("L", s, -6) for s in "LR"}),
    "all 6 by 5": (both("U6", "L6"), {"%s5_%s" % (t, s): along(t, s, -6) for t in "UL" for s in "LR"}),
    "canines": (both("U3", "L3"), {}),
    "U6, none": (both("U6"), {}),
    "L6, none": (both("L6"), {}),
    "U1": ({"U1"}, {}),
    "incisors": toothless(),
    "all teeth": toothless(True),
}
whole = None
print("%-12s %8s %8s %8s %9s  %s" % ("without", "changed", "most", "left out", "contacts", "what"))
for name, way in ways.items():
    if only and name not in only: continue
    place = name.replace(" ", "_").replace(",", "")
    folder, gone, new = jaws(place, way) if callable(way) else (case(place, *way), *way)
    limits, refusal = judged(folder)
    if limits is None:
        print("%-12s refused: %s" % (name, refusal))
        assert any(g in refusal for g in gone), "the refusal does not name what is missing"
        continue
    now = {(l["limit"], l["where"]): l for l in limits}
    whole = whole or now
    told = [l for l in limits if l["limit"] == "case_warnings"]
    change, silent = (0, ""), []
    lost = [k for k in whole if k not in now or now[k]["level"] == "not judged" != whole[k]["level"]]
    for k in whole:
        a, b = whole[k]["value"], now.get(k, {}).get("value")
        if not isinstance(a, float) or not isinstance(b, float): continue
        by = abs(a - b) / (100 if whole[k]["unit"] in ("mm2", "mm3") else 1) if whole[k].get("unit") else abs(a - b)
        change = max(change, (by, "%s %s %.2f -> %.2f" % (*k, a, b)))
        if by > 1.5 and not (new and now[k].get("note") or gone & (both("U6", "L6") | {"U1", "L1"}) and told): silent.append(k)
    count = sum(isinstance(whole[k]["value"], float) and whole[k]["value"] != now.get(k, {}).get("value") for k in whole)
    contacts = now[("bite_contacts", "")]["value"]
    print("%-12s %8d %8.2f %8d %9s  %s" % (name, count, change[0], len(lost), contacts, change[1]))
    assert not silent, silent
    if new: assert told and told[0]["value"] >= 1, "a tooth that stands for another is not told"
