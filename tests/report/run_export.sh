#!/bin/sh
# run_export.sh GNATHOS NODE MODULES OUT: what is exported of the outcome OUT, and what the outcome itself holds, loads in
# VTK with the right frame, units and arrays; the .glb passes the Khronos validator, the .ply becomes what three.js can draw
# (both in MODULES), meshio reads the tissue.
set -eu
gnathos=$1 node=$2 modules=$3 out=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for format in glb obj ply stl vtp; do "$gnathos" export "$out" --format $format -o "$work/$format" -q; done
if "$gnathos" export "$out" --format stl -o "$work/stl" >/dev/null 2>&1; then echo "a folder in use was replaced"; exit 1; fi
NODE_PATH=$modules "$node" -e '
require("gltf-validator").validateBytes(new Uint8Array(require("fs").readFileSync(process.argv[1]))).then(r => {
    const { numErrors, numWarnings, messages } = r.issues;
    console.log(`validator: ${numErrors} errors, ${numWarnings} warnings`);
    if (numErrors || numWarnings || !r.info.hasMorphTargets) { console.log(messages.slice(0, 9)); process.exit(1); }
});' "$work/glb/head.glb"
"$node" --input-type=module -e '
const { PLYLoader } = await import(process.argv[1]), file = (await import("node:fs")).readFileSync(process.argv[2]);
const at = new PLYLoader().parse(file.buffer.slice(file.byteOffset, file.byteOffset + file.length)).getAttribute("position");
console.log(`three.js: ${at.count} vertices as ${at.array.constructor.name}`);
if (!(at.array instanceof Float32Array) || !at.array.every(Number.isFinite)) process.exit(1);
' "$modules/three/examples/jsm/loaders/PLYLoader.js" "$work/ply/skin_after.ply"
/usr/bin/python3 - "$out" "$work" <<'PY'
import json, meshio, os, sys, vtk
out, work = sys.argv[1:]
moves = {m["segment"] for m in json.load(open(out + "/outcome.json"))["movements"]}
assert moves, "this plan moves nothing"

def read(reader, path):
    reader.SetFileName(path)
    reader.Update()
    mesh = reader.GetOutput()
    assert mesh.GetNumberOfPoints() > 100 and mesh.GetNumberOfCells() > 100, path
    return mesh

def near(a, b, tolerance, what):
    assert max(abs(x - y) for x, y in zip(a, b)) <= tolerance, (what, a, b)

def tagged(path):
    with open(path, "rb") as f: return b"SPACE=LPS" in f.read(400)

cloud = meshio.read(out + "/tissue.vtu")
assert len(cloud.cells_dict["tetra"]) > 1000 and cloud.point_data["displacement"].shape == cloud.points.shape

readers = {"ply": vtk.vtkPLYReader, "stl": vtk.vtkSTLReader, "obj": vtk.vtkOBJReader}
rest = {f: read(readers[f](), "%s/%s/skin_before.%s" % (work, f, f)) for f in readers}
want = rest["ply"].GetBounds()
assert 100 < want[3] - want[2] < 500, "the head is in mm"
for f in readers:
    names = sorted(os.listdir(os.path.join(work, f)))
    assert all(tagged(os.path.join(work, f, n)) for n in names), f
    assert {"skin_before." + f, "skin_after." + f, "segment_cranium." + f} <= set(names), names
    for s in moves: assert {"segment_%s_before.%s" % (s, f), "segment_%s_after.%s" % (s, f)} <= set(names), names
    near(rest[f].GetBounds(), want, 1e-4, f)
    assert rest[f].GetNumberOfCells() == rest["ply"].GetNumberOfCells()
after = read(vtk.vtkPLYReader(), work + "/ply/skin_after.ply")
near(after.GetBounds(), read(vtk.vtkPLYReader(), out + "/skin_after.ply").GetBounds(), 0, "skin_after")

def space(mesh): return mesh.GetFieldData().GetAbstractArray("SPACE").GetValue(0)
moved = {}
for name in ["skin"] + ["segment_" + s for s in moves]:
    mesh = read(vtk.vtkXMLPolyDataReader(), "%s/vtp/%s.vtp" % (work, name))
    u = mesh.GetPointData().GetArray("displacement")
    assert space(mesh) == "LPS" and u.GetNumberOfComponents() == 3
    end = read(vtk.vtkPLYReader(), "%s/ply/%s_after.ply" % (work, name))
    for i in range(0, mesh.GetNumberOfPoints(), 53): # rest + displacement is the planned place
        near([a + b for a, b in zip(mesh.GetPoint(i), u.GetTuple(i))], end.GetPoint(i), 1e-4, name)
    moved[name] = max(u.GetMaxNorm(), 0)
assert all(m > 0.5 for m in moved.values()), moved

# glTF: metres, +y up, +z the way the face looks (LPS: -y)
importer = vtk.vtkGLTFReader()
importer.SetFileName(work + "/glb/head.glb")
importer.Update()
box = vtk.vtkBoundingBox()
def walk(block):
    for i in range(block.GetNumberOfBlocks()):
        b = block.GetBlock(i)
        if b is None: continue
        if b.IsA("vtkPolyData"): box.AddBounds(b.GetBounds())
        else: walk(b)
walk(importer.GetOutput())
got = [0] * 6
box.GetBounds(got)
whole = vtk.vtkBoundingBox()
for name in os.listdir(work + "/ply"):
    if not name.endswith("_after.ply"): whole.AddBounds(read(vtk.vtkPLYReader(), work + "/ply/" + name).GetBounds())
b = [0] * 6
whole.GetBounds(b)
near(got, [1e-3 * x for x in (b[0], b[1], b[4], b[5], -b[3], -b[2])], 1e-6, "glb")

tissue = read(vtk.vtkXMLUnstructuredGridReader(), out + "/tissue.vtu")
assert tissue.GetCellType(0) == vtk.VTK_TETRA
assert tissue.GetPointData().GetVectors().GetName() == "displacement"
assert {"displacement", "attachment", "segment"} <= {tissue.GetPointData().GetArrayName(i) for i in range(tissue.GetPointData().GetNumberOfArrays())}
for s in moves: assert open("%s/%s.tfm" % (out, s)).readline() == "#Insight Transform File V1.0\n"
marks = json.load(open(out + "/landmarks_planned.mrk.json"))["markups"][0]
assert marks["coordinateSystem"] == "LPS" and len(marks["controlPoints"]) > 10
print("VTK %s reads them all" % vtk.vtkVersion.GetVTKVersion())
PY
