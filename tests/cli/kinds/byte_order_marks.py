"""A byte order mark in front of every text that gnathos reads: read as if it was not there, or (meshes) told by name; so is
UTF-16."""
from common import *

mark = b"\xef\xbb\xbf"
fcsv = "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
tfm = "#Insight Transform File V1.0\n#Transform 0\nTransform: AffineTransform_double_3_3\nParameters: 1 0 0 0 1 0 0 0 1 0 -3 0\nFixedParameters: 0 0 0\n"
planes = """{ "markups": [ { "type": "Plane", "coordinateSystem": "LPS", "controlPoints": [
  { "position": [0, -40, -15] }, { "position": [9, -40, -15] }, { "position": [0, -30, -15] } ] } ] }"""

def off(case, name): return [line.split() for line in (case / f"{name}.off").read_text().split("\n")[2:] if line]

def as_stl(case):
    lines = off(case, "skull")
    at = [l for l in lines if l[0] != "3"]
    text = "".join("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {' '.join(at[int(v)])}\n" for v in l[1:4]) + "endloop\nendfacet\n"
                   for l in lines if l[0] == "3" and len(l) == 4)
    (case / "skull.stl").write_text(f"solid skull\n{text}endsolid skull\n")

def as_obj(case):
    (case / "skull.obj").write_text("".join(f"v {' '.join(l)}\n" if len(l) == 3 else f"f {' '.join(str(int(v) + 1) for v in l[1:4])}\n" for l in off(case, "skull")))

def as_ply(case):
    lines = off(case, "skull")
    at, tri = [l for l in lines if len(l) == 3], [l for l in lines if len(l) == 4]
    (case / "skull.ply").write_text(f"ply\nformat ascii 1.0\nelement vertex {len(at)}\nproperty float x\nproperty float y\nproperty float z\n"
                                    f"element face {len(tri)}\nproperty list uchar int vertex_indices\nend_header\n" + "".join(" ".join(l) + "\n" for l in at + tri))

def as_gltf(case):
    import base64, json, struct
    lines = off(case, "skull")
    at, tri = [l for l in lines if len(l) == 3], [l for l in lines if len(l) == 4]
    blob = b"".join(struct.pack("<3f", *(float(x) / 1000 for x in (l[0], l[2], str(-float(l[1]))))) for l in at) + b"".join(struct.pack("<3I", *map(int, l[1:])) for l in tri)
    n = 12 * len(at)
    (case / "skull.gltf").write_text(json.dumps({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], "buffers": [{"byteLength": len(blob), "uri": "data:application/octet-stream;base64," + base64.b64encode(blob).decode()}],
        "bufferViews": [{"buffer": 0, "byteLength": n}, {"buffer": 0, "byteOffset": n, "byteLength": len(blob) - n}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(at), "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1]},
                      {"bufferView": 1, "componentType": 5125, "count": 3 * len(tri), "type": "SCALAR"}]}))

def as_fcsv(case):
    points = re.findall(r'"label": "([^"]*)", "position": \[([^]]*)\]', (case / "landmarks.mrk.json").read_text())
    (case / "points.fcsv").write_text(fcsv + "".join(f"{i},{xyz.replace(' ', '')},0,0,0,1,1,1,0,{label},,\n" for i, (label, xyz) in enumerate(points)))

def as_tfm(case):
    (case / "maxilla.tfm").write_text(tfm)
    (case / "plan.json").write_text('{"gnathos": 1, "segments": {"maxilla": {"file": "maxilla.tfm"}}}')

def with_planes(case): (case / "planes.mrk.json").write_text(planes)

skull = lambda name: [("skull.off", name)]
texts = {
    "case.json": (None, []), "plan.json": (None, []), "landmarks.mrk.json": (None, []), "skin.off": (None, []),
    "points.fcsv": (as_fcsv, [("landmarks.mrk.json", "points.fcsv")]), "maxilla.tfm": (as_tfm, []),
    "planes.mrk.json": (with_planes, [('"landmarks":', '"planes": "planes.mrk.json", "osteotomies": [{"segment": "maxilla", "plane": "planes"}], "landmarks":')]),
    "skull.stl": (as_stl, skull("skull.stl")), "skull.obj": (as_obj, skull("skull.obj")), "skull.ply": (as_ply, skull("skull.ply")), "skull.gltf": (as_gltf, skull("skull.gltf")),
}
for name, (make, changes) in texts.items():
    case = fresh()
    edit(case / "case.json", *changes)
    if make:
        make(case)
    text = (case / name).read_bytes()
    plan = ["--plan", "case/plan.json"] if "planes" not in name else []
    accepted(f"{name} as it is", ["check", "case", *plan], "no errors")
    plain = run("check", "case", *plan)
    (case / name).write_bytes(mark + text)
    if name.startswith("sk"):  # meshes
        refused(f"{name} with a mark", ["check", "case", *plan], 3, f"{name}: begins with a byte order mark")
    else:
        row(f"{name} reads the same with a mark", run("check", "case", *plan) == plain, "another answer")
    (case / name).write_bytes(text.decode().encode("utf-16"))
    refused(f"{name} in UTF-16", ["check", "case", *plan], 3, "UTF-16")
finish()
