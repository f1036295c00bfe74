"""Paths at and beyond the most that is read, wherever a path is named: refused with that most, or by the system's own word;
never cut off, never a crash. What is just short enough works."""
from common import *
import json

most = 4095  # bytes that a path may have
long = "x" * 5000
deep = "/".join(["d" * 250] * 20)
told = r"more than \d+ bytes|at most \d+|File name too long|has \d+ bytes"

def case_with(change):
    case = fresh()
    value = json.loads((case / "case.json").read_text())
    change(value)
    (case / "case.json").write_text(json.dumps(value))

for end, path in {"long": long, "deep": deep, "at the end": "case" + "/." * 2040}.items():
    for name, change in {
        "skin": lambda v: v["surfaces"].update(skin=path + ".off"), "skull": lambda v: v["surfaces"].update(skull=path + ".stl"),
        "teeth": lambda v: v["surfaces"].update(upper_teeth=path + ".glb"), "node": lambda v: v["surfaces"].update(mandible="a.glb#" + path),
        "landmarks": lambda v: v.update(landmarks=path + ".fcsv"), "planes": lambda v: v.update(planes=path + ".mrk.json"),
    }.items():
        case_with(change)
        err = refused(f"{name}, {end}", ["check", "case"], 3, told + ("|not exist|No such file" if end == "at the end" else ""))
        for number in re.findall(r"more than (\d+) bytes", err):
            row(f"{name}, {end}: the most, not its own length", int(number) < len(path), err[:200])
    fresh()
    (work / "case/plan.json").write_text(json.dumps({"gnathos": 1, "segments": {"maxilla": {"file": path + ".tfm"}}}))
    refused(f"transform, {end}", ["check", "case", "--plan", "case/plan.json"], 3, told + "|No such file")

fresh()
files = ["--skin", "case/skin.off", "--skull", "case/skull.off", "--mandible", "case/mandible.off"]
for i, path in enumerate((long, deep)):
    for words in (["check", path], ["prepare", path], ["check", "case", "--plan", path], ["predict", "case", "--plan", "case/plan.json", "-o", path],
                  ["predict", "case", "--plan", path, "-o", "out"], ["cut", "case", "-o", path], ["audit", "case", "-o", path], ["audit", "case", "--around", path, "-o", "out"],
                  ["study", "case", "--plan", "case/plan.json", "-o", path], ["import", *files, "-o", path], ["import", *files, "--landmarks", path + ".fcsv", "-o", "n"],
                  ["import", "--skin", path + ".off", *files[2:], "-o", "n"], ["import", "--labels", path + ".nii", "--skull", "1", "--mandible", "2", *files[:2], "-o", "n"],
                  ["import", *files[2:], "--ct", path + ".nrrd", "-o", "n"], ["render", path], ["ceph", path], ["export", path, "--format", "obj", "-o", "n"], ["report", path],
                  ["compare", path, "case/skin.off"], ["compare", "case/skin.off", path + ".off", "--landmarks", "case/landmarks.mrk.json"], ["compare", "case/skin.off", "case/skin.off", "--landmarks", path],
                  ["new", path, "--norm", "--coarseness", "3"], ["stress", "--only", "poisson/0.45", "-o", path])[i::2]:  # one of the two each
        refused(" ".join(words).replace(path, "LONG" if path == long else "DEEP"), words, (2, 3, 7))
finish()
