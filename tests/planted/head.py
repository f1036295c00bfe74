"""A case in a folder, to be damaged: surfaces, landmarks and fields in memory, written as a case of its own."""
import copy
import json
import os
import shutil
import struct

import numpy as np

PARTS = ["skin", "skull", "mandible", "upper_teeth", "lower_teeth"]
BONES = PARTS[1:]


def read_ply(path):
    """Corners (n x 3, mm) and triangles (m x 3) of a binary PLY as gnathos writes it."""
    whole = open(path, "rb").read()
    start = whole.index(b"end_header\n") + len(b"end_header\n")
    kinds = {"double": "<f8", "float": "<f4", "uchar": "u1"}
    count, fields, element = {}, [], None
    for words in (line.split() for line in whole[:start].decode().splitlines()):
        if words[0] == "element":
            element = words[1]
            count[element] = int(words[2])
        elif words[0] == "property" and element == "vertex":
            fields.append((words[2], kinds[words[1]]))
    corners = np.frombuffer(whole, np.dtype(fields), count["vertex"], start)
    start += corners.nbytes
    faces = np.frombuffer(whole, np.dtype([("n", "u1"), ("v", "<i4", 3)]), count["face"], start)
    return np.stack([corners[axis] for axis in "xyz"], axis=1).astype(float), faces["v"].astype(np.int32)


def write_ply(path, xyz, tri):
    faces = np.zeros(len(tri), np.dtype([("n", "u1"), ("v", "<i4", 3)]))
    faces["n"], faces["v"] = 3, tri
    with open(path, "wb") as out:
        out.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty double x\nproperty double y\n"
                  b"property double z\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n"
                  % (len(xyz), len(tri)))
        out.write(np.ascontiguousarray(xyz, "<f8").tobytes())
        out.write(faces.tobytes())


def write_stl(path, xyz, tri):
    rows = np.zeros(len(tri), np.dtype([("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("attribute", "<u2")]))
    rows["corner"] = xyz[tri]
    with open(path, "wb") as out:
        out.write(b"gnathos".ljust(80) + struct.pack("<I", len(tri)))
        out.write(rows.tobytes())


def joined(*meshes):
    """Several meshes as one."""
    start = np.cumsum([0] + [len(xyz) for xyz, _ in meshes])
    return (np.concatenate([xyz for xyz, _ in meshes]),
            np.concatenate([tri + first for (_, tri), first in zip(meshes, start)]).astype(np.int32))


class Head:
    """mesh[part] = (xyz, tri), point[label] = xyz, case and plan as their JSON; extra[name] = bytes of another file."""

    def __init__(self, folder):
        self.case = json.load(open(os.path.join(folder, "case.json")))
        markups = json.load(open(os.path.join(folder, self.case["landmarks"])))
        self.point = {p["label"]: np.array(p["position"], float) for p in markups["markups"][0]["controlPoints"]}
        self.mesh = {part: read_ply(os.path.join(folder, name)) for part, name in self.case["surfaces"].items()}
        self.plan = {"gnathos": 1, "name": "planted", "maxilla_advance_mm": 4, "mandible_advance_mm": -2}
        self.point_space, self.point_unit, self.extra = "LPS", "mm", {}
        self.folder, self.changed = folder, set()  # parts of which the mesh is no longer the file's

    def copy(self):
        other = copy.copy(self)
        other.case, other.plan = copy.deepcopy(self.case), copy.deepcopy(self.plan)
        other.mesh, other.extra, other.changed = dict(self.mesh), dict(self.extra), set()
        other.point = {label: xyz.copy() for label, xyz in self.point.items()}
        return other

    def set_mesh(self, part, xyz, tri):
        self.mesh[part] = (np.asarray(xyz, float), np.asarray(tri, np.int32))
        self.case["surfaces"][part] = part + ".ply"
        self.changed.add(part)

    def drop(self, part):
        del self.mesh[part]
        del self.case["surfaces"][part]

    def write(self, folder):
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
        for part, (xyz, tri) in self.mesh.items():
            to = os.path.join(folder, part + ".ply")
            if part in self.changed:
                write_ply(to, xyz, tri)
            else:
                shutil.copyfile(os.path.join(self.folder, part + ".ply"), to)
        points = [{"label": label, "position": list(xyz), "positionStatus": "defined"}
                  for label, xyz in self.point.items()]
        files = {"landmarks.mrk.json": {"markups": [{"type": "Fiducial", "coordinateSystem": self.point_space,
                                                     "coordinateUnits": self.point_unit, "controlPoints": points}]},
                 "case.json": self.case, "plan.json": self.plan}
        for name, value in files.items():
            with open(os.path.join(folder, name), "w") as out:
                json.dump(value, out, indent=1)
        for name, value in self.extra.items():
            with open(os.path.join(folder, name), "wb") as out:
                out.write(value)
