"""Label maps that name a thing twice, not at all, or by another tool's numbers: nothing named vanishes, nothing is taken for what it is
not. And CTs that are not in Hounsfield units."""
from common import *
import math, meshes, struct

skin = meshes.ball((0, 0, 0), (80, 100, 120))
meshes.write(skin, work / "skin.stl")
SIZE, STEP = 24, 8  # voxels a side, mm

# centre and radii in mm; the left half and the right half of the jaw are two of them
boxes = {"skull": (-50, 50, -60, 60, 8, 80), "jaw right": (-40, 0, -70, 10, -70, -24), "jaw left": (0, 40, -70, 10, -70, -24),
         "upper teeth": (-24, 24, -72, -40, -8, 8), "lower teeth": (-24, 24, -72, -40, -24, -8), "canal": (-32, -24, -40, 0, -56, -40)}

def cells(low, high):
    """The voxels whose middles lie between two coordinates."""
    return range(*(math.ceil((x + SIZE * STEP / 2) / STEP - 0.5) for x in (low, high)))

def box_cells(box):
    return [cells(*boxes[box][2 * c:2 * c + 2]) for c in range(3)]

def voxels(numbers, layers=1):
    """numbers: {box: (number, layer)}; later ones lie over earlier ones of their layer."""
    out = bytearray(SIZE ** 3 * layers)
    for box, (number, layer) in numbers.items():
        x, y, z = box_cells(box)
        for k in z:
            for j in y:
                for i in x:
                    out[((k * SIZE + j) * SIZE + i) * layers + layer] = number
    return bytes(out)

def seg(path, numbers, segments, layers=1, first=0):
    """segments: [(name, number, layer)]; first: number of the first segment's keys, or a list of them."""
    keys = first if isinstance(first, list) else range(first, first + len(segments))
    head = ["NRRD0004", "type: uint8", f"dimension: {3 + (layers > 1)}", "space: left-posterior-superior", "sizes: " + f"{layers} " * (layers > 1) + f"{SIZE} " * 3,
            "space directions: " + "none " * (layers > 1) + f"({STEP},0,0) (0,{STEP},0) (0,0,{STEP})", "kinds: " + "list " * (layers > 1) + "domain domain domain",
            "encoding: raw", f"space origin: ({-SIZE * STEP / 2 + STEP / 2},{-SIZE * STEP / 2 + STEP / 2},{-SIZE * STEP / 2 + STEP / 2})"]
    for key, (name, number, layer) in zip(keys, segments):
        head += [f"Segment{key}_Name:={name}", f"Segment{key}_ID:=S{key}", f"Segment{key}_LabelValue:={number}", f"Segment{key}_Layer:={layer}"]
    path.write_bytes("\n".join(head).encode() + b"\n\n" + voxels(numbers, layers))

def jaw_width(out):
    """Voxels of the mandible as mm3."""
    found = re.search(r'"mandible": {.*?"label_mm3": ([\d.]+)', out, re.S)
    return float(found[1]) if found else 0

whole = STEP ** 3 * sum(math.prod(map(len, box_cells(b))) for b in ("jaw right", "jaw left"))
base = {"skull": (1, 0), "jaw right": (2, 0), "jaw left": (3, 0)}
counter = iter(range(1000))

def imported(name, words, ok):
    status, out, err = run("import", "--skin", "skin.stl", "--edge", "10", "-o", f"new{next(counter)}", "--json", *words)
    row(name, ok(status, out, err), f"status {status}, {jaw_width(out)} of {whole}\n{err[:500]}")

both = lambda status, out, err: status == 0 and abs(jaw_width(out) - whole) < 1
told = lambda status_wanted, words: lambda status, out, err: status in status_wanted and re.search(words, err)

# one name twice: both, wherever the two are
seg(work / "a.seg.nrrd", base, [("Skull", 1, 0), ("Mandible", 2, 0), ("Mandible", 3, 0)])
imported("one name twice", ["--labels", "a.seg.nrrd", "--skull", "Skull", "--mandible", "Mandible"], both)
seg(work / "b.seg.nrrd", {"skull": (1, 0), "jaw right": (1, 1), "jaw left": (2, 1)}, [("Skull", 1, 0), ("Mandible", 1, 1), ("Mandible", 2, 1)], 2)
imported("one name twice in a second layer", ["--labels", "b.seg.nrrd", "--skull", "Skull", "--mandible", "Mandible"], both)
seg(work / "c.seg.nrrd", {"skull": (1, 0), "jaw right": (2, 0), "jaw left": (1, 1)}, [("Skull", 1, 0), ("Mandible", 2, 0), ("Mandible", 1, 1)], 2)
imported("one name in two layers", ["--labels", "c.seg.nrrd", "--skull", "Skull", "--mandible", "Mandible"], both)
seg(work / "d.seg.nrrd", base, [("Skull", 1, 0), ("Mandible", 2, 0), ("Mandible", 3, 0)], first=[4, 7, 12])
imported("keys with gaps", ["--labels", "d.seg.nrrd", "--skull", "Skull", "--mandible", "Mandible"], both)
seg(work / "e.seg.nrrd", base, [("Skull", 1, 0), ("Mandible", 2, 0), ("Mandible", 3, 0)], first=1)
imported("keys from 1", ["--labels", "e.seg.nrrd", "--skull", "Skull", "--mandible", "Mandible"], both)
seg(work / "f.seg.nrrd", base, [("Skull", 1, 0), ("Jaw right", 2, 0), ("Jaw left", 3, 0)])
for words in (["--mandible", "Jaw right,Jaw left"], ["--mandible", "Jaw right", "--mandible", "Jaw left"], ["--mandible", "Jaw left", "--mandible", "Jaw right"]):
    imported("two names for one part: " + " ".join(words), ["--labels", "f.seg.nrrd", "--skull", "Skull", *words], both)
imported("a segment that is not used is told", ["--labels", "f.seg.nrrd", "--skull", "Skull", "--mandible", "Jaw left"], told((0,), 'label makes no part of the case: "Jaw right"'))

# one label for two parts
five = {**base, "upper teeth": (4, 0), "lower teeth": (5, 0)}
seg(work / "g.seg.nrrd", five, [("Skull", 1, 0), ("Right", 2, 0), ("Left", 3, 0), ("Up", 4, 0), ("Low", 5, 0)])
usual = {"--skull": "Skull", "--mandible": "Right,Left", "--upper-teeth": "Up", "--lower-teeth": "Low"}
for a, b in (("--skull", "--mandible"), ("--upper-teeth", "--lower-teeth"), ("--skull", "--upper-teeth"), ("--mandible", "--lower-teeth"), ("--mandible", "--upper-teeth")):
    words = [w for option, name in {**usual, b: usual[a].split(",")[0]}.items() for w in (option, name)]
    imported(f"{a} and {b}", ["--labels", "g.seg.nrrd", *words], told((2, 3), "named for the .* and for the"))
imported("twice for one part", ["--labels", "g.seg.nrrd", "--skull", "Skull,Skull", "--mandible", "Right,Left"], lambda s, o, e: s in (0, 2, 3) and (s or both(s, o, e)))
ball, chin = meshes.ball((0, 0, 30), (60, 70, 60)), meshes.ball((0, -20, -60), (40, 30, 20))
for name, mesh in (("skull.stl", ball), ("jaw.obj", chin), ("teeth.ply", meshes.ball((0, -40, -31), (30, 25, 5)))):
    meshes.write(mesh, work / name)
usual = {"--skin": "skin.stl", "--skull": "skull.stl", "--mandible": "jaw.obj", "--upper-teeth": "teeth.ply"}
for option, path in (("--skull", "skin.stl"), ("--mandible", "skull.stl"), ("--mandible", "./skull.stl"), ("--lower-teeth", "teeth.ply"), ("--upper-teeth", "jaw.obj")):
    words = [w for pair in {**usual, option: path}.items() for w in pair]
    refused(f"one file for two parts: {option} {path}", ["import", *words, "-o", "none"], (2, 3, 4), "is one surface for two parts")
for name, path in (("skull.off", "./skin.off"), ("mandible.off", "skull.off"), ("mandible.off", "./skull.off")):
    edit(fresh() / "case.json", (f'"{name}"', f'"{path}"'))
    refused(f"a case with {path} for {name}", ["check", "case"], (3, 4), "is one surface for two parts")

# another tool's numbers under a preset
def nifti(path, numbers):
    head = bytearray(352)
    struct.pack_into("<i", head, 0, 348)
    struct.pack_into("<8h", head, 40, 3, SIZE, SIZE, SIZE, 1, 1, 1, 1)
    struct.pack_into("<hh", head, 70, 2, 8)
    struct.pack_into("<4f", head, 76, 1, STEP, STEP, STEP)
    struct.pack_into("<f", head, 108, 352)
    head[123] = 2  # mm
    struct.pack_into("<hh", head, 252, 0, 1)
    edge = SIZE * STEP / 2 - STEP / 2
    for r, line in enumerate(((-STEP, 0, 0, edge), (0, -STEP, 0, edge), (0, 0, STEP, -edge))):
        struct.pack_into("<4f", head, 280 + 16 * r, *line)
    head[344:348] = b"n+1\0"
    path.write_bytes(bytes(head) + voxels(numbers))

tools = {"dental-segmentator": ("skull", "jaw", "upper teeth", "lower teeth", "canal"), "totalsegmentator-craniofacial": ("jaw", "lower teeth", "skull", "head", None, None, "upper teeth"),
         "toothfairy": ("jaw", "skull")}
for tool, names in tools.items():
    numbers = {}
    for number, name in enumerate(names, 1):
        for box in boxes:
            if name and box.split()[0] == name.split()[0] and (name == "jaw" or box == name):
                numbers[box] = (number, 0)
    nifti(work / f"{tool}.nii", numbers)
for tool in tools:
    for preset in tools:
        if (tool, preset) == ("toothfairy", "toothfairy") or tool == preset:
            continue
        imported(f"{tool} read as {preset}", ["--labels", f"{tool}.nii", "--preset", preset], lambda s, o, e: s in (2, 3, 4) or "warning" in e)
finish()
