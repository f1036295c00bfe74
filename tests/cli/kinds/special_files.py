"""Pipes, devices, sockets and folders in place of every file that a case, a plan or a command line names: refused at once."""
from common import *
import json, socket

def pipe(path): os.mkfifo(path)
def zero(path): path.symlink_to("/dev/zero")
def folder(path): path.mkdir()
def listening(path): socket.socket(socket.AF_UNIX).bind(os.path.relpath(path))

os.chdir(work)
kinds = {"pipe": (pipe, "is not a regular file"), "device": (zero, "is not a regular file"), "folder": (folder, "is (a folder|not a regular file)"),
         "socket": (listening, "is not a regular file")}
rotate = list(kinds)  # every place meets a pipe and one of the others

# what a case and its plan name
places = {
    "skin.off": [], "skull.ply": [("skull.off", "skull.ply")], "mandible.stl": [("mandible.off", "mandible.stl")],
    "upper.obj": [('"mandible.off" }', '"mandible.off", "upper_teeth": "upper.obj" }')],
    "lower.glb": [('"mandible.off" }', '"mandible.off", "lower_teeth": "lower.glb" }')],
    "lower.gltf": [('"mandible.off" }', '"mandible.off", "lower_teeth": "lower.gltf" }')],
    "landmarks.mrk.json": [], "points.fcsv": [("landmarks.mrk.json", "points.fcsv")],
    "cuts.mrk.json": [('"landmarks":', '"planes": "cuts.mrk.json", "osteotomies": [{"segment": "maxilla", "plane": "p"}], "landmarks":')],
    "case.json": [], "plan.json": [], "maxilla.tfm": [],
}
def try_place(name, changes, kind):
    case = fresh()
    edit(case / "case.json", *changes)
    if name == "maxilla.tfm":
        (case / "plan.json").write_text('{"gnathos": 1, "segments": {"maxilla": {"file": "maxilla.tfm"}}}')
    (case / name).unlink(missing_ok=True)
    make, words = kinds[kind]
    make(case / name)
    refused(f"{name} is a {kind}", ["check", "case", "--plan", "case/plan.json"], 3, words)

for i, (name, changes) in enumerate(places.items()):
    for kind in ("pipe", rotate[1 + i % 3]):
        try_place(name, changes, kind)

# what a command line names
fresh()
for end in ("off", "mrk.json", "nii.gz", "seg.nrrd", "json"):
    pipe(work / f"pipe.{end}")
skin = ["--skin", "case/skin.off", "--skull", "case/skull.off", "--mandible", "case/mandible.off", "-o", "new"]
add_points(work / "case/landmarks.mrk.json", Sn=(0, -90, -8), Al_L=(15, -90, -5), Al_R=(-15, -90, -5), B_s=(0, -90, -45), Me_s=(0, -80, -90))
points = ["--landmarks", "case/landmarks.mrk.json"]
lines = [
    ["import", "--skin", "pipe.off", *skin[2:]], ["import", *skin[:2], "--skull", "pipe.off", *skin[4:]], ["import", *skin, "--upper-teeth", "pipe.off"],
    ["import", *skin, "--landmarks", "pipe.mrk.json"], ["import", "--labels", "pipe.seg.nrrd", "--skull", "1", "--mandible", "2", *skin[:2], *skin[6:]],
    ["import", *skin[2:], "--ct", "pipe.nii.gz"], ["compare", "pipe.off", "case/skin.off", *points], ["compare", "case/skin.off", "pipe.off", *points],
    ["compare", "case/skin.off", "case/skin.off", "--landmarks", "pipe.mrk.json"], ["predict", "case", "--plan", "pipe.json", "-o", "out"],
    ["audit", "case", "--plan", "pipe.json"], ["audit", "case", "--around", "pipe.json", "-o", "out"], ["study", "case", "--plan", "pipe.json", "-o", "study"],
    ["check", "pipe.json"], ["prepare", "pipe.json"],
]
for words in lines:
    refused(" ".join(words), words, 3, "is not a regular file")
for verb in ("render", "report", "export --format obj -o shapes", "ceph", "compare"):
    out = work / "outcome"
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir()
    pipe(out / "outcome.json")
    first, *rest = verb.split()
    refused(f"outcome.json is a pipe, {verb}", [first, "outcome", *rest, *(["case/skin.off"] if verb == "compare" else [])], 3, "is not a regular file")
finish()
