"""Mistakes in what a case is imported from: label maps, CTs, scenes."""
import json

import numpy as np

import table
from mistakes import *
from table import row, warn

table.group = "import"
MADE = "import --labels l.nrrd --edge 8 --skin skin.ply -o made "
NAMES = [(1, "Skull"), (2, "Mandible")]


def volume(change=None, name="l.nrrd", coarse=(5, 5, 2), names=(), space="left-posterior-superior"):
    """The phantom's label map, every fifth voxel of every second slice, changed."""
    def plant(h):
        v, origin, spacing = read_nrrd(h.data + "/phantom_head_labels.nrrd")
        v, spacing = v[::coarse[0], ::coarse[1], ::coarse[2]].copy(), spacing * coarse
        if change:
            v = change(v)
        h.extra.update([nrrd(name, v, origin, spacing, space, names)])
    return plant


def relabel(*pairs):
    return lambda v: np.select([v == a for a, _ in pairs], [b for _, b in pairs], 0).astype("int16")


def halves(v):
    middle = v.shape[0] // 2
    v[:middle][v[:middle] == 2] = 3
    return v


def ct(change, kind="int16"):
    def plant(h):
        volume()(h)
        v, origin, spacing = read_nrrd(h.data + "/phantom_head_ct.nrrd")
        h.extra.update([nrrd("ct.nrrd", change(v[::5, ::5, ::2].astype(float)).astype(kind), origin, spacing * (5, 5, 2))])
    return plant


def scene(*parts, weights=None):
    def plant(h):
        h.extra["scene.gltf"] = gltf([(p, *h.mesh[p]) for p in parts], weights)
    return plant


WITH_CT = "import --labels l.nrrd --skull 1 --mandible 2 --ct ct.nrrd --edge 8 -o made"
PARTS_OF = "import --skin skin.ply --skull skull.ply --mandible mandible.ply --landmarks landmarks.mrk.json -o made"
row("numbers of skull and mandible exchanged", volume(), "are they exchanged", by=MADE + "--skull 2 --mandible 1", status=4, head="phantom")
row("one label for two parts", volume(), "the label \"2\" is named for the mandible and for the", by=MADE + "--skull 1 --mandible 2 --lower-teeth 2", status=2, head="phantom")
row("a label that is not there", volume(), "7", by=MADE + "--skull 1 --mandible 7", head="phantom")
row("preset of another tool", volume(relabel((1, 3), (2, 1))), "lacks the label of the mandible that dental-segmentator makes", by=MADE + "--preset dental-segmentator", head="phantom")
row("two segments of one name", volume(halves, names=[(1, "Skull"), (2, "Mandible"), (3, "Mandible")]), by=MADE + "--skull Skull --mandible Mandible", head="phantom",
    harmless="both are taken, and the jaw is whole")
row("a segment misspelt", volume(names=NAMES), "Mandible", by=MADE + "--skull Skull --mandible Mandibel", head="phantom")
row("segment of the wrong name", volume(names=[(2, "Skull"), (1, "Mandible")]), "are they exchanged", by=MADE + "--skull Skull --mandible Mandible", status=4, head="phantom")
row("half of the mandible under a label not named", volume(halves), "1 label makes no part", by=MADE + "--skull 1 --mandible 2", status=0, head="phantom")
row("slices 6 mm thick", volume(coarse=(5, 5, 3)), "voxels of", "x 6 mm", "slices this thick", by=MADE + "--skull 1 --mandible 2", status=0, head="phantom")
row("label map in RAS of an LPS head", volume(space="right-anterior-superior"), "beyond the skin's box", by=MADE + "--skull 1 --mandible 2", status=4, head="phantom")
row("slices in reverse order", volume(lambda v: v[:, :, ::-1]), "-z up", by=MADE + "--skull 1 --mandible 2", status=4, head="phantom")
row("CT stored from 0 (uint16)", ct(lambda v: v + 1024, "uint16"), "Hounsfield", by=WITH_CT, head="phantom")
row("CT stored from 0 (int16)", ct(lambda v: v + 1024), "Hounsfield", by=WITH_CT, head="phantom")
row("CT in twice its units", ct(lambda v: v * 2), by=WITH_CT, head="phantom",
    harmless="the skin lies at -150 instead of -300 HU, within the voxel between air and skin")
row("CT with inverted grey", ct(lambda v: -v), "Hounsfield", by=WITH_CT, head="phantom")
row("several meshes in a scene, none chosen", scene("skull", "mandible"), "scene.gltf", "mandible", by=PARTS_OF.replace("skull.ply", "scene.gltf"))
row("a node that is not there", scene("skull", "mandible"), "jaw", by=PARTS_OF.replace("mandible.ply", "scene.gltf#jaw"))
row("a morph target switched on", scene("skull", weights=[1.0]), "morph", by=PARTS_OF.replace("skull.ply", "scene.gltf"))
row("a surface of cm among others of mm", linear("mandible", .1), "mandible", by=PARTS_OF, status=4)
row("skull and mandible exchanged in the command", lambda h: None, "are they exchanged", by=PARTS_OF.replace("skull.ply", "x").replace("mandible.ply", "skull.ply").replace("x", "mandible.ply", 1), status=4)
row("skull named twice", lambda h: None, "named twice", by=PARTS_OF + " --skull skull.ply", status=2)
warn("skin of RAS, no tag", linear("skin", RAS), "the skin lies off its landmarks", "in RAS", by=PARTS_OF)
row("all surfaces y up, without landmarks", linear("all", Y_UP), "y up", by=PARTS_OF.replace(" --landmarks landmarks.mrk.json", ""), status=4)
warn("all surfaces in RAS, without landmarks", linear("all", RAS), "the jaws lie as if", "in RAS", by=PARTS_OF.replace(" --landmarks landmarks.mrk.json", ""))
row("skin twice in one file (two heads)", again("skin", 60, 0, 0), "2 heads", by=PARTS_OF, status=0)
