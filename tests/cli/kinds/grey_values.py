"""CTs whose grey values are not Hounsfield units: refused or told, never a skin at the border of the image. Right ones are taken, and
so are others once --skin-hu names the skin's own value."""
from common import *
import array, math, meshes, struct

SIZE, STEP = 20, 14  # voxels a side, mm: a head of 200 mm in air
meshes.write(meshes.ball((0, 0, 30), (50, 60, 45)), work / "skull.stl")
meshes.write(meshes.ball((0, -20, -50), (40, 30, 20)), work / "jaw.stl")

def nifti(path, code, kind, value, slope=0, shift=0):
    """value: of (air, tissue) as a function of whether a voxel is in the head."""
    head = bytearray(352)
    struct.pack_into("<i", head, 0, 348)
    struct.pack_into("<8h", head, 40, 3, SIZE, SIZE, SIZE, 1, 1, 1, 1)
    struct.pack_into("<hh", head, 70, code, 8 * array.array(kind).itemsize)
    struct.pack_into("<4f", head, 76, 1, STEP, STEP, STEP)
    struct.pack_into("<3f", head, 108, 352, slope, shift)
    head[123] = 2  # mm
    struct.pack_into("<hh", head, 252, 0, 1)
    edge = SIZE * STEP / 2 - STEP / 2
    for r, line in enumerate(((-STEP, 0, 0, edge), (0, -STEP, 0, edge), (0, 0, STEP, -edge))):
        struct.pack_into("<4f", head, 280 + 16 * r, *line)
    head[344:348] = b"n+1\0"
    at = [(n + 0.5) * STEP - SIZE * STEP / 2 for n in range(SIZE)]
    values = array.array(kind, [value(math.hypot(x / 80, y / 95, z / 110) < 1, i) for i, (x, y, z) in enumerate((x, y, z) for z in at for y in at for x in at)])
    path.write_bytes(bytes(head) + values.tobytes())

def ct(name, code, kind, air, tissue, ok, words=(), **scale):
    nifti(work / f"{name}.nii", code, kind, lambda inside, i: tissue if inside else air, **scale)
    line = ["import", "--skull", "skull.stl", "--mandible", "jaw.stl", "--ct", f"{name}.nii", "--edge", "10", *words, "-o", f"new {name} {len(words)}"]
    if ok:
        accepted(f"{name} {words}", line, "thresholded skin")
    else:
        refused(f"{name} {words}", line, (3, 4), r"Hounsfield|above|below|holds no|all voxels")

ct("hounsfield", 4, "h", -1000, 40, True)
ct("hounsfield of floats", 16, "f", -1000, 40, True)
ct("hounsfield by slope and shift", 512, "H", 0, 1064, True, slope=1, shift=-1000)
ct("from 0 upwards", 512, "H", 24, 1064, False)
ct("from 0 upwards", 512, "H", 24, 1064, True, ("--skin-hu", "700"))
ct("signed, from 0 upwards", 4, "h", 0, 1064, False)
ct("of one byte", 2, "B", 0, 110, False)
ct("from 0 to 1", 16, "f", 0, 1, False)
ct("shift left out", 512, "H", 24, 1064, False, slope=1, shift=0)
ct("nothing but air", 4, "h", -1000, -1000, False)
ct("nothing but tissue", 4, "h", 40, 40, False)
ct("attenuation per cm", 16, "f", 0.0, 0.2, False)
ct("air at -200", 4, "h", -200, 1040, False)
ct("upside down", 4, "h", 1000, -40, False)
finish()
