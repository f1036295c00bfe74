"""A head whose surfaces all face inwards may be mirrored: one warning that says so, by import and by check, whatever parts and
formats it has. One surface alone is a slip of its own, told as such and no more."""
from common import *
import itertools, meshes

parts = {"skin": meshes.ball((0, 0, 0), (80, 100, 120)), "skull": meshes.ball((0, 0, 30), (60, 70, 60)), "mandible": meshes.ball((0, -20, -60), (40, 30, 20)),
         "upper-teeth": meshes.ball((0, -40, -31), (30, 25, 5)), "lower-teeth": meshes.ball((0, -40, -42), (28, 25, 5))}
ends = itertools.cycle((".stl", ".obj", ".off", ".ply", ".gltf", ".text.stl"))
all_of_them, one = r"all (\d) surfaces face inwards, as those of a mirrored head do", r"the triangles face inwards; they will be turned"

def head(inwards, names, extra=()):
    """Makes the files, imports and checks; what was said by each."""
    case = fresh()
    words = []
    for name in names:
        path = f"{name}{next(ends)}"
        meshes.write(meshes.mirrored(parts[name]) if name in inwards else parts[name], case / path)
        words += [f"--{name}", path]
    imported = run("import", *words, *extra, "-o", "made", cwd=case)
    return imported[0], imported[2], run("check", "made", cwd=case)[2]

three, five = list(parts)[:3], list(parts)
for names in (three, five, five[:4], three + five[4:]):
    status, *told = head(names, names)
    row(f"all of {names}", status == 0 and all(len(re.findall(all_of_them, t)) == 1 and re.search(all_of_them, t)[1] == str(len(names)) and not re.search(one, t) for t in told), told)
status, *told = head(three, three, ["--frame", "ras"])
row("all, read as RAS", status == 0 and all(re.search(all_of_them, t) for t in told), told)
for name in three:
    status, *told = head([name], three)
    row(f"{name} alone", status == 0 and not any(re.search(all_of_them, t) for t in told) and re.search(f"{name}[^:]*: (info: )?{one}", told[1]), told)
    status, *told = head([n for n in three if n != name], three)
    row(f"all but the {name}", status == 0 and not any(re.search(all_of_them, t) for t in told) and len(re.findall(one, told[1])) == 2, told)
status, *told = head([], five)
row("none", status == 0 and not any("inwards" in t for t in told), told)
finish()
