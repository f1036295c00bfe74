"""What goes wrong with a head: each function makes a mistake that is then planted into a copy of it."""
import gzip
import json

import numpy as np

from head import BONES, PARTS, joined, write_stl

MIRROR_X, RAS, TURNED_ABOUT_Y = np.diag([-1, 1, 1]), np.diag([-1, -1, 1]), np.diag([-1, 1, -1])
UPSIDE_DOWN, Z_FLIPPED = np.diag([1, -1, -1]), np.diag([1, 1, -1])
Y_UP = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])
X_FRONT = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
INFERIOR = {"mandible", "lower_teeth"}


def parts_of(h, which):
    return [p for p in ({"bones": BONES, "all": PARTS}.get(which) or which.split()) if p in h.mesh]


def after(*mistakes):
    def plant(h):
        for m in mistakes:
            m(h)
    return plant


def swap(a, b):
    def plant(h):
        h.point[a], h.point[b] = h.point[b], h.point[a]
    return plant


def swap_all(words, a, b):
    """A and b exchanged at the end or beginning of all labels that hold them: sides, upper and lower teeth."""
    return after(*(swap(w.replace("*", a), w.replace("*", b)) for w in words.split()))


def swap_sides(h):
    for label in list(h.point):
        if label.endswith("_L"):
            swap(label, label[:-1] + "R")(h)


def shift_point(label, *by):
    def plant(h):
        h.point[label] += by
    return plant


def shift_points(which, *by):
    """which: part, "all" or a list of labels."""
    def plant(h):
        for label in h.point:
            if which == "all" or label in which.split():
                h.point[label] += by
    return plant


def along(part, label, mm, *toward):
    """The point slides over its surface: to the corner mm away that lies farthest to that side."""
    def plant(h):
        xyz, way = h.mesh[part][0], np.asarray(toward, float)
        far = np.linalg.norm(xyz - h.point[label], axis=1)
        ring = xyz[abs(far - mm) < 1.5]
        h.point[label] = ring[np.argmax(ring @ way)].copy()
    return plant


def place(label, at, *by):
    """The label is put on another point, or beside it."""
    def plant(h):
        h.point[label] = h.point[at] + (by or (0, 0, 0))
    return plant


def lose(*labels):
    def plant(h):
        for label in labels:
            del h.point[label]
    return plant


def rename(a, b):
    def plant(h):
        h.point[b] = h.point.pop(a)
    return plant


def toothless(all_teeth=False, points=True):
    """A jaw without incisors, or without any tooth: their landmarks and surfaces go, those of the alveolar process come,
    each on the bone a crown's length from where the edge was."""
    crest = {"U1": "Pr", "L1": "Id"}
    crest |= {f"{jaw}6_{side}": f"{jaw}6_crest_{side}" for jaw in "UL" for side in "LR"} if all_teeth else {}

    def plant(h):
        for tooth, label in crest.items():
            part, away = ("skull", 10) if tooth[0] == "U" else ("mandible", -9)
            xyz = h.mesh[part][0]
            near = np.linalg.norm(xyz - h.point[tooth] - (0, 0, away), axis=1)
            if points:
                h.point[label] = xyz[near.argmin()].copy()
        for label in (t for t in h.point if t.startswith("L7") and all_teeth):
            xyz = h.mesh["mandible"][0]
            h.point[label] = xyz[np.linalg.norm(xyz - h.point[label], axis=1).argmin()].copy()
        for label in [t for t in h.point if t in crest or t in ("U1_apex", "L1_apex") or (all_teeth and t[:2] in ("U3", "L3"))]:
            del h.point[label]
        for part in ("upper_teeth", "lower_teeth"):
            if all_teeth:
                h.drop(part)
            else:
                xyz, tri = h.mesh[part]
                h.set_mesh(part, xyz, tri[(abs(xyz[tri][:, :, 0]) > 9).any(axis=1)])
    return plant


def linear(which, m, with_points=False, shift=(0, 0, 0)):
    """All corners of the parts by a matrix and a shift, mm; det < 0 mirrors without turning the triangles."""
    m = np.asarray(m, float) if np.ndim(m) else float(m) * np.eye(3)

    def plant(h):
        for part in parts_of(h, which):
            xyz, tri = h.mesh[part]
            h.set_mesh(part, xyz @ m.T + shift, tri)
        if with_points:
            for label in h.point:
                h.point[label] = m @ h.point[label] + shift
    return plant


def bones_with_points(factor, by=(0, 0, 0)):
    """All bones and teeth with their landmarks, the skin and its landmarks not."""
    def plant(h):
        skin = h.mesh["skin"][0]
        for label, at in h.point.items():
            if np.linalg.norm(skin - at, axis=1).min() > 2.5:
                h.point[label] = factor * at + by
        linear("bones", factor, shift=by)(h)
    return plant


def shift(which, *by):
    return linear(which, 1, shift=by)


def scale_about_middle(which, factor):
    """As a program does that scales about the object's own middle."""
    def plant(h):
        for part in parts_of(h, which):
            middle = (h.mesh[part][0].min(0) + h.mesh[part][0].max(0)) / 2
            linear(part, factor, shift=middle * (1 - factor))(h)
    return plant


def turn(which, degrees, about="x"):
    a = np.radians(degrees)
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[about]
    m = np.eye(3)
    m[i, i] = m[j, j] = np.cos(a)
    m[i, j], m[j, i] = -np.sin(a), np.sin(a)
    return linear(which, m)


def inside_out(which):
    def plant(h):
        for part in parts_of(h, which):
            xyz, tri = h.mesh[part]
            h.set_mesh(part, xyz, tri[:, ::-1])
    return plant


def mirror_properly(which, with_points=False):
    """A mirror image whose triangles are turned, as careful programs make it."""
    return after(linear(which, MIRROR_X, with_points), inside_out(which))


def become(part, *of):
    """The part's file holds other parts."""
    def plant(h):
        h.set_mesh(part, *joined(*(h.mesh[p] for p in of)))
    return plant


def exchange(a, b):
    def plant(h):
        one, other = h.mesh[a], h.mesh[b]
        h.set_mesh(a, *other)
        h.set_mesh(b, *one)
    return plant


def again(part, *by):
    """The part's file holds it twice, the second one moved: before and after, or two people."""
    def plant(h):
        xyz, tri = h.mesh[part]
        h.set_mesh(part, *joined((xyz, tri), (xyz + by, tri)))
    return plant


def cut_off(part, axis, keep):
    """Triangles of which a corner's axis lies outside keep (low, high; shares of the box) are gone."""
    def plant(h):
        xyz, tri = h.mesh[part]
        x = (xyz[:, axis] - xyz[:, axis].min()) / np.ptp(xyz[:, axis])
        kept = tri[((x >= keep[0]) & (x <= keep[1]))[tri].all(1)]
        used = np.unique(kept)
        number = np.zeros(len(xyz), int)
        number[used] = np.arange(len(used))
        h.set_mesh(part, xyz[used], number[kept])
    return plant


def hole(part, label, mm):
    def plant(h):
        xyz, tri = h.mesh[part]
        far = np.linalg.norm(xyz - h.point[label], axis=1) > mm
        h.set_mesh(part, xyz, tri[far[tri].all(1)])
    return plant


def stairs(which, mm):
    """Voxels of slices that thick, not smoothed: every corner at the height of a slice's edge."""
    def plant(h):
        for part in parts_of(h, which):
            xyz, tri = h.mesh[part]
            xyz = xyz.copy()
            xyz[:, 2] = np.round(xyz[:, 2] / mm) * mm
            tri = tri[(xyz[tri[:, 0]] != xyz[tri[:, 1]]).any(1) & (xyz[tri[:, 1]] != xyz[tri[:, 2]]).any(1)
                      & (xyz[tri[:, 2]] != xyz[tri[:, 0]]).any(1)]
            h.set_mesh(part, xyz, tri)
    return plant


def soup(part, rounding):
    """Every triangle with corners of its own, rounded apart."""
    def plant(h):
        xyz, tri = h.mesh[part]
        loose = xyz[tri].reshape(-1, 3)
        noise = np.random.default_rng(1).uniform(-rounding, rounding, loose.shape)
        h.set_mesh(part, loose + noise, np.arange(len(loose)).reshape(-1, 3))
    return plant


def field(name, value):
    def plant(h):
        where, *names = [h.case] + name.split(".")
        for n in names[:-1]:
            where = where.setdefault(n, {})
        where[names[-1]] = value
    return plant


def points_as(space, unit="mm", times=(1, 1, 1)):
    def plant(h):
        h.point_space, h.point_unit = space, unit
        for label in h.point:
            h.point[label] = h.point[label] * times
    return plant


def plan(**fields):
    def plant(h):
        h.plan = {"gnathos": 1, "name": "planted", **fields}
    return plant


def segments(**of):
    return plan(segments=of)


def tfm(file, move, **of):
    """A plan with one transform file; move: 3 x 4, LPS mm, of the bone's points; stored as Slicer stores it."""
    m = np.vstack([np.asarray(move, float), [0, 0, 0, 1]])
    inverse = np.linalg.inv(m)
    numbers = " ".join("%.12g" % v for v in np.r_[inverse[:3, :3].ravel(), inverse[:3, 3]])
    text = ("#Insight Transform File V1.0\n#Transform 0\nTransform: AffineTransform_double_3_3\nParameters: %s\n"
            "FixedParameters: 0 0 0\n" % numbers)

    def plant(h):
        segments(**{segment: {"file": file} for segment in of})(h)
        h.plan.update({k: v for one in of.values() for k, v in one.items()})
        h.extra[file] = text.encode()
    return plant


def moved(x=0, y=0, z=0, matrix=None):
    return np.c_[np.eye(3) if matrix is None else matrix, [x, y, z]]


def nrrd(name, values, origin, spacing, space="left-posterior-superior", names=()):
    """values[x, y, z]; names: of labels 1, 2 ..., as 3D Slicer writes them."""
    kind = {"int16": "short", "uint16": "ushort", "uint8": "uchar"}[values.dtype.name]
    lines = ["NRRD0004", "type: " + kind, "dimension: 3", "space: " + space,
             "sizes: %d %d %d" % values.shape, "space directions: (%g,0,0) (0,%g,0) (0,0,%g)" % tuple(spacing),
             "kinds: domain domain domain", "endian: little", "encoding: gzip", "space origin: (%g,%g,%g)" % tuple(origin)]
    lines += ["Segment%d_%s:=%s" % (i, key, value) for i, (label, word) in enumerate(names)
              for key, value in (("ID", "s%d" % i), ("LabelValue", label), ("Layer", 0), ("Name", word))]
    return name, "\n".join(lines).encode() + b"\n\n" + gzip.compress(np.asfortranarray(values).tobytes("F"), 1)


def read_nrrd(path):
    whole = open(path, "rb").read()
    at = whole.index(b"\n\n") + 2
    head = dict(line.split(": ", 1) for line in whole[:at].decode().splitlines() if ": " in line and line[0] != "#")
    size = [int(n) for n in head["sizes"].split()]
    spacing = [abs(np.array(eval(v))).max() for v in head["space directions"].split()]
    data = gzip.decompress(whole[at:]) if head["encoding"] == "gzip" else whole[at:]
    return np.frombuffer(data, "<i2").reshape(size, order="F"), np.array(eval(head["space origin"])), np.array(spacing)


def stl_bytes(mesh, folder):
    path = folder + "/planted.stl"
    write_stl(path, *mesh)
    return open(path, "rb").read()


def gltf(meshes, weights=None):
    """A glTF scene, metres and y up, one node for each (name, xyz, tri) in LPS mm; weights: of a morph target."""
    import base64
    blob, views, accessors, nodes, out = b"", [], [], [], []
    for name, xyz, tri in meshes:
        at = (xyz @ Y_UP.T * 0.001).astype("<f4")
        first = len(accessors)
        for array, kind, component in ((at, "VEC3", 5126), (tri.astype("<u4").ravel(), "SCALAR", 5125), (at * 0 + 0.01, "VEC3", 5126)):
            views.append({"buffer": 0, "byteOffset": len(blob), "byteLength": array.nbytes})
            accessors.append({"bufferView": len(views) - 1, "componentType": component, "type": kind,
                              "count": len(array), **({"min": array.min(0).tolist(), "max": array.max(0).tolist()} if kind == "VEC3" else {})})
            blob += array.tobytes()
        primitive = {"attributes": {"POSITION": first}, "indices": first + 1}
        one = {"name": name, "primitives": [primitive]}
        if weights:
            primitive["targets"] = [{"POSITION": first + 2}]
            one["weights"] = weights
        out.append(one)
        nodes.append({"mesh": len(out) - 1, "name": name})
    return json.dumps({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}],
                       "nodes": nodes, "meshes": out, "accessors": accessors, "bufferViews": views,
                       "buffers": [{"byteLength": len(blob), "uri": "data:application/octet-stream;base64,"
                                    + base64.b64encode(blob).decode()}]}).encode()
