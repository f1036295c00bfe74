"""turned_face.py GNATHOS OUT WORK: compares the predicted face of OUT with itself, turned by known angles, as it is and as
another scan of it (noise of 0.3 mm, and smooth changes of 0.5 mm, both RMS), and asks how well
alignment finds the turn and where it leaves the chin. Prints a table; ends with an error where a bound is passed."""
import json, os, subprocess, sys
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

gnathos, out, work = sys.argv[1:]
outcome = json.load(open(os.path.join(out, "outcome.json")))
chin = np.array(next(l["after_lps_mm"] for l in outcome["landmarks"] if l["label"] in ("Pg'", "Me'")))
reader = vtk.vtkPLYReader()
reader.SetFileName(os.path.join(out, "skin_after.ply"))
reader.Update()
face = reader.GetOutput()
points = vtk_to_numpy(face.GetPoints().GetData()).astype(float)
rng = np.random.default_rng(7)


def another_scan():
    smooth = np.zeros(points.shape)
    for centre in points[rng.integers(0, len(points), 120)]:
        near = np.exp(-((points - centre) ** 2).sum(1) / (2 * 15.0**2))
        smooth += near[:, None] * rng.normal(0, 1, 3)
    smooth *= 0.5 / np.sqrt((smooth**2).sum(1).mean())
    return points + rng.normal(0, 0.3 / np.sqrt(3), points.shape) + smooth


def turn_of(degrees, axis):
    a, k = np.radians(degrees), np.array(axis, float) / np.linalg.norm(axis)
    K = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    m = np.eye(4)
    m[:3, :3] = np.eye(3) + np.sin(a) * K + (1 - np.cos(a)) * K @ K
    m[:3, 3] = points.mean(0) - m[:3, :3] @ points.mean(0)
    return m


def write(p, path):
    copy = vtk.vtkPolyData()
    copy.DeepCopy(face)
    copy.GetPoints().SetData(numpy_to_vtk(p.astype(np.float32), deep=True))
    writer = vtk.vtkPLYWriter()
    writer.SetFileName(path)
    writer.SetInputData(copy)
    writer.Write()


def compare(path, *how):
    return json.loads(subprocess.check_output([gnathos, "compare", out, path, "--json", *how]))


print("%-8s %5s  %-10s %9s %16s %20s" % ("face", "turn", "about", "found", "chin left at, mm", "of it without, mm"))
for name, p, bound_deg, bound_mm in (("itself", points, 0.005, 0.01), ("a scan", another_scan(), 0.5, 0.9)):
    for degrees, word, axis in ((0.3, "left", (1, 0, 0)), (1, "left", (1, 0, 0))):
        T, path = turn_of(degrees, axis), os.path.join(work, "turned.ply")
        write(p @ T[:3, :3].T + T[:3, 3], path)
        c = compare(path)
        M = np.array(c["alignment"]["matrix"]).reshape(4, 4) @ T
        left = np.linalg.norm(M[:3, :3] @ chin + M[:3, 3] - chin)
        away = np.linalg.norm(T[:3, :3] @ chin + T[:3, 3] - chin)
        print("%-8s %5.1f  %-10s %9.3f %16.3f %20.2f" % (name, degrees, word, c["alignment"]["turn_deg"], left, away))
        assert c["aligned_on"].startswith("skin") and c["by_skin"] is None
        assert abs(c["alignment"]["turn_deg"] - degrees) < bound_deg and left < bound_mm
# as registered: nothing is moved, and what skin would do is told
c = compare(path, "--align", "none")
assert c["alignment"] is None and c["aligned_on"].startswith("as registered")
assert abs(c["by_skin"]["turn_deg"] - degrees) < bound_deg and abs(c["by_skin"]["chin_mm"] - away) < bound_mm
assert c["regions"]["prediction"]["chin"]["mean_abs_mm"] > 0.2
# with its skull the face is laid back by bone, whatever the skin says
skull, turned = os.path.join(work, "turned_skull.ply"), os.path.join(work, "turned.ply")
write(p @ T[:3, :3].T + T[:3, 3], turned)
reader.SetFileName(os.path.join(out, "segment_cranium.ply"))
reader.Update()
face = reader.GetOutput()
q = vtk_to_numpy(face.GetPoints().GetData()).astype(float)
write(q @ T[:3, :3].T + T[:3, 3], skull)
c = compare(turned, "--actual-skull", skull)
M = np.array(c["alignment"]["matrix"]).reshape(4, 4) @ T
left = np.linalg.norm(M[:3, :3] @ chin + M[:3, 3] - chin)
print("a scan on its skull: chin left at %.3f mm; skin alone would move it by %.3f mm" % (left, c["by_skin"]["chin_mm"]))
assert c["aligned_on"] == "bone: the front of the cranium" and left < 0.02
