"""Surfaces of triangles that share no corner: joined where the corners lie within rounding, and told; refused as loose
triangles where they do not. In every format, by check and by import."""
from common import *
import meshes

skin, skull, jaw = meshes.ball((0, 0, 0), (80, 100, 120)), meshes.ball((0, 0, 30), (60, 70, 60)), meshes.ball((0, -20, -60), (40, 30, 20))
for end in (".stl", ".text.stl", ".obj", ".off", ".ply", ".gltf"):
    case = fresh()
    for name, mesh in (("skin", skin), ("skull", skull)):
        meshes.write(mesh, case / f"{name}.off")
    (case / "landmarks.mrk.json").unlink()
    path = f"jaw{end}"
    files = ["--skin", "skin.off", "--skull", "skull.off", "--mandible", path]
    count = len(jaw[1])
    for apart, told in ((0, ""), (0.0002, f"holds loose triangles; \\d+ corners were joined with others within"), (0.001, "joined with others within")):
        meshes.write(meshes.loose(jaw, apart), case / path)
        status, out, err = run("import", *files, "-o", f"new{end}{apart}", "--json", cwd=case)
        triangles = re.search(r'"mandible": {.*?"triangles": (\d+).*?"open_edges": (\d+)', out, re.S)
        row(f"{path}, corners {apart} mm off", status == 0 and triangles and int(triangles[1]) == count and triangles[2] == "0" and re.search(told, err + out),
            f"status {status}, {triangles and triangles.groups()} of {count}\n{err[:400]}")
    for apart in (0.5, 3):
        meshes.write(meshes.loose(jaw, apart), case / path)
        refused(f"{path}, corners {apart} mm off", ["import", *files, "-o", "none"], (3, 4), f"loose triangles", cwd=case)
finish()
