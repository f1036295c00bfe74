"""Line feeds, escapes and other control bytes in every name that gnathos quotes: each line of output stays one message of
gnathos, and no such byte reaches the terminal."""
from common import *
import json

evil = "a\ngnathos: no errors\n\x1b[2J\x9b\x7fz"
raw = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f]|^gnathos: no errors$", re.M)

def quiet_bytes(name, words, shown=r"x0a", cwd=work):
    """Whatever it says, it says it in lines of its own; `shown` is part of it."""
    status, out, err = run(*words, cwd=cwd)
    row(name, status != 124 and not raw.search(out + err) and "\ngnathos: no errors" not in out + err and re.search(shown, out + err)
        and all(l.startswith(("gnathos", "Try", "information.")) for l in err.splitlines()), f"status {status}\n{out[:400]!r}\n{err[:600]!r}")

def case_with(change):
    case = fresh()
    value = json.loads((case / "case.json").read_text())
    change(value)
    (case / "case.json").write_text(json.dumps(value))

def put(*keys):
    def change(value):
        for key in keys[:-1]:
            value = value.setdefault(key, {})
        value[keys[-1]] = evil
    return change

check = ["check", "case", "--plan", "case/plan.json"]
for name, change in {
    "surface": put("surfaces", "skin"), "teeth": put("surfaces", "upper_teeth"), "landmarks": put("landmarks"), "planes": put("planes"),
    "name of the case": put("name"), "units": put("units"), "frame": put("frame"), "field": lambda v: v.update({evil: 1}),
    "field in a group": lambda v: v["surfaces"].update({evil: 1}), "cut": lambda v: v.update({"osteotomies": [evil]}),
    "segment of a cut": lambda v: v.update({"planes": "plan.json", "osteotomies": [{"segment": evil, "plane": evil}]}),
    "limit": lambda v: v.update({"limits": {evil: {"stop": [0, 1]}}}), "element": put("tissue", "element"),
}.items():
    case_with(change)
    quiet_bytes(f"case: {name}", check)
    if name in ("surface", "name of the case"):
        status, out, err = run(*check, "--json")
        row(f"case: {name}, JSON", status != 124 and not raw.search(out + err), repr(out[:300]))

for name, plan in {
    "field": {evil: 1}, "segment": {"segments": {evil: {}}}, "field of a segment": {"segments": {"maxilla": {evil: 1}}},
    "file": {"segments": {"maxilla": {"file": evil + ".tfm"}}}, "pivot": {"segments": {"maxilla": {"pivot": evil}}}, "name": {"name": evil},
    "reason": {"override": evil, "maxilla_advance_mm": 12}, "expression": {"expressions": {evil: 1}},
}.items():
    fresh()
    (work / "case/plan.json").write_text(json.dumps({"gnathos": 1, **plan}))
    quiet_bytes(f"plan: {name}", check, "x0a|x1b|expressions")

for name, key in {"label": "Zz", "needed label": "Po_L"}.items():
    edit(fresh() / "landmarks.mrk.json", (f'"{key}"' if key == "Po_L" else '"Pn"', json.dumps(evil)))
    quiet_bytes(f"landmarks: {name}", ["check", "case"], "x0a|missing")
edit(fresh() / "case.json", ("landmarks.mrk.json", "points.fcsv"))
(work / "case/points.fcsv").write_bytes(b"# CoordinateSystem = L\x1b[2JPS\n# columns = id,x,y\x1b[2J,z,label\n1,1,2,3\x1b[0m,N\x1b\n")
quiet_bytes("points.fcsv", ["check", "case"], "x1b")
fresh()
(work / "case/m.tfm").write_bytes(b"#Insight Transform File V1.0\nTransform: Affine\x1b[2J\nParameters: \x1b\n")
(work / "case/plan.json").write_text('{"gnathos": 1, "segments": {"maxilla": {"file": "m.tfm"}}}')
quiet_bytes("transform", check, "x1b")

# what the command line names, and nodes and segments
files = ["--skin", "skin.off", "--skull", "skull.off", "--mandible", "mandible.off"]
fresh()
for words in (["check", evil], ["prepare", evil], ["check", "case", "--plan", evil], ["predict", "case", "--plan", evil, "-o", "out"],
              ["predict", "case", "--plan", "case/plan.json", "-o", evil + "/no/folder"], ["cut", "case", "-o", evil + "/no"], ["import", "--skin", evil + ".off", *files[2:], "-o", "x"],
              ["import", "--labels", evil + ".nrrd", "--skull", "1", "--mandible", "2", *files[:2], "-o", "x"], ["render", evil], ["report", evil], ["ceph", evil], ["compare", evil, evil],
              ["export", evil, "--format", "obj", "-o", "x"], ["audit", "case", "-o", "x", "--line", evil], ["help", "--record", evil], [evil], ["check", "--" + evil],
              ["render", "case", "--show", evil], ["render", "case", "--view", evil], ["new", "x", "--norm", "--set", evil + "=1"], ["import", "--frame", evil], ["import", evil]):
    quiet_bytes(" ".join(words).replace(evil, "EVIL"), words, "x0a|x1b|\\?|[Uu]nknown|no such|cannot|must|is not")
quiet_bytes("name of a new case", ["import", *files, "--landmarks", "landmarks.mrk.json", "--name", evil, "-o", "named"], "case named", cwd=work / "case")
quiet_bytes("which is then checked", ["check", "case/named"], "x0a")
os.rename(work / "case/named", work / evil)
quiet_bytes("folder of a case", ["check", evil], "x0a")

def seg_nrrd(path, segments, layers=1, shape=(12, 12, 12), fill=lambda x, y, z, k: 0):
    head = ["NRRD0004", "type: uint8", f"dimension: {4 if layers > 1 else 3}", "space: left-posterior-superior",
            "sizes: " + (f"{layers} " if layers > 1 else "") + " ".join(map(str, shape)), "space directions: " + ("none " if layers > 1 else "") + "(10,0,0) (0,10,0) (0,0,10)",
            "kinds: " + ("list " if layers > 1 else "") + "domain domain domain", "encoding: raw", "space origin: (0,0,0)"]
    for i, (name, value) in enumerate(segments):
        head += [f"Segment{i}_Name:={name}", f"Segment{i}_LabelValue:={value}", f"Segment{i}_Layer:=0", f"Segment{i}_ID:=S{i}"]
    body = bytes(fill(x, y, z, k) for z in range(shape[2]) for y in range(shape[1]) for x in range(shape[0]) for k in range(layers))
    path.write_bytes("\n".join(head).encode() + b"\n\n" + body)

block = lambda x, y, z, k: (1 if 6 <= z < 10 else 2 if 2 <= z < 5 else 0) if 2 < x < 9 and 2 < y < 9 else 0
seg_nrrd(work / "names.seg.nrrd", [("Sk\x1b[2Jull\x7f", 1), ("Jaw", 2)], fill=block)
for k, words in enumerate((["--skull", "Skul", "--mandible", "Jaw"], ["--skull", "Sk\x1b[2Jull\x7f", "--mandible", "Jaw,Jaw"], ["--skull", evil, "--mandible", "Jaw"], ["--preset", evil])):
    quiet_bytes("segments: " + " ".join(words).replace(evil, "EVIL"), ["import", "--labels", "names.seg.nrrd", *words, "--skin", "case/skin.off", "-o", f"seg{k}"], "x1b|x0a")
gltf = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0, "name": evil}, {"mesh": 0, "name": "b\x1b[2J"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "extensionsRequired": [evil]}
for node, change in {"": {}, "#none": {}, "#" + evil: {}, "extension": {"extensionsRequired": []}}.items():
    (work / "a.gltf").write_text(json.dumps({**gltf, **({"extensionsRequired": []} if node != "extension" else {})}))
    quiet_bytes("node " + node.replace(evil, "EVIL"), ["import", "--skin", "a.gltf" + (node if node != "extension" else ""), "--skull", "case/skull.off", "--mandible", "case/mandible.off", "-o", "x"],
                "x0a|x1b|cannot be read")
finish()
