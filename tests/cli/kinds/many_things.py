"""Thousands of wrong or unknown things in one file: told up to a hundred and counted beyond, in time that grows with their
number. A quadratic reader would not end within the minute that each row has."""
from common import *
import json

many = 40000
check = ["check", "case", "--plan", "case/plan.json"]

def changed(path, change):
    case = fresh()
    value = json.loads((case / path).read_text())
    change(value)
    (case / path).write_text(json.dumps(value, indent=0))

def points(make):
    return lambda v: v["markups"][0]["controlPoints"].extend(make(i) for i in range(10000))

odd = {f"unknown_{i}": i for i in range(many)}
for name, path, change, status, words in (
    ("unknown fields of a case", "case.json", lambda v: v.update(odd), 3, r"and 39900 more of the kind \"error\""),
    ("unknown surfaces", "case.json", lambda v: v["surfaces"].update(odd), 3, r"and 39900 more"),
    ("unknown limits", "case.json", lambda v: v.update(limits=odd), 3, r"and 39900 more"),
    ("forty thousand cuts", "case.json", lambda v: v.update(osteotomies=["bsso"] * many), 3, "lists 40000 cuts; at most 8"),
    ("unknown fields of a plan", "plan.json", lambda v: v.update(odd), 3, r"and 39900 more"),
    ("unknown segments", "plan.json", lambda v: v.update(segments={k: {} for k in odd}), 3, r"more of the kind"),
    ("unknown fields of a segment", "plan.json", lambda v: v.update(segments={"maxilla": odd}), 3, r"more of the kind"),
    ("numbers in place of three", "plan.json", lambda v: v.update(segments={"maxilla": {"translate_mm": [0] * many}}), 3, "translate_mm"),
    ("a text of a megabyte", "case.json", lambda v: v.update(name="n" * 1000000), 3, "has 1000000 bytes; at most"),
    ("forty thousand levels", "case.json", lambda v: None, 3, "nest|depth|maximum|parsing"),
    ("unknown landmarks", "landmarks.mrk.json", points(lambda i: {"label": f"extra {i}", "position": [i, 0, 0]}), 0, "10000 unknown labels are ignored"),
    ("one landmark again and again", "landmarks.mrk.json", points(lambda i: {"label": "Zz", "position": [i, 0, 0]}), 3, "is there twice"),
    ("landmarks without a place", "landmarks.mrk.json", points(lambda i: {"label": f"e{i}", "position": [None] * 3}), 3, "position"),
    ("landmarks never placed", "landmarks.mrk.json", points(lambda i: {"label": f"e{i}", "position": [0, 0, 0], "positionStatus": "undefined"}), 0, "10000 points are not placed"),
):
    changed(path, change)
    if "levels" in name:
        (work / "case/case.json").write_text("[" * many + "]" * many)
    if status:
        refused(name, check, status, words)
    else:
        accepted(name, check, words)
fresh()
lines = (work / "case/skin.off").read_text().split("\n")
(work / "case/skin.off").write_text("\n".join([lines[0], f"{2 ** 31} 12 0", *lines[2:]]))
refused("vertices that are not there", check, 3, "skin.off")
finish()
