"""A closed surface, and its file in every format that gnathos reads; for the tables of mistakes."""
import base64, json, math, struct


def ball(centre, radii, rings=10):
    """Vertices and triangles of an ellipsoid that face outwards."""
    at, tri, n = [], [], 2 * rings
    for i in range(rings + 1):
        for k in range(n):
            t, p = math.pi * i / rings, 2 * math.pi * k / n
            at.append(tuple(c + r * x for c, r, x in zip(centre, radii, (math.sin(t) * math.cos(p), math.sin(t) * math.sin(p), math.cos(t)))))
    index = lambda i, k: 0 if i == 0 else rings * n if i == rings else i * n + k % n
    for i in range(rings):
        for k in range(n):
            a, b, c, d = index(i, k), index(i + 1, k), index(i + 1, k + 1), index(i, k + 1)
            tri += [t for t in ((a, b, c), (a, c, d)) if len(set(t)) == 3]
    used = sorted({v for t in tri for v in t})
    number = {v: i for i, v in enumerate(used)}
    return [at[v] for v in used], [tuple(number[v] for v in t) for t in tri]


def joined(*meshes):
    at, tri = [], []
    for own, faces in meshes:
        tri += [tuple(v + len(at) for v in t) for t in faces]
        at += own
    return at, tri


def mirrored(mesh):
    return [(-x, y, z) for x, y, z in mesh[0]], mesh[1]


def loose(mesh, apart_mm):
    """Every triangle with corners of its own, which lie apart_mm from where they belong, each in another direction."""
    at, tri = [], []
    for t in mesh[1]:
        tri.append(tuple(len(at) + k for k in range(3)))
        for v in t:
            turn = 2.4 * len(at)
            at.append(tuple(x + apart_mm * d for x, d in zip(mesh[0][v], (math.cos(turn), math.sin(turn), 0))))
    return at, tri


def write(mesh, path):
    at, tri = mesh
    kind = path.suffix
    if path.name.endswith(".text.stl"):
        text = "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex %.7g %.7g %.7g\n" % at[v] for v in t) + "endloop\nendfacet\n" for t in tri)
        path.write_text(f"solid s\n{text}endsolid s\n")
    elif kind == ".stl":
        path.write_bytes(b" " * 80 + struct.pack("<I", len(tri)) + b"".join(struct.pack("<12fH", 0, 0, 0, *(x for v in t for x in at[v]), 0) for t in tri))
    elif kind == ".obj":
        path.write_text("".join("v %.7g %.7g %.7g\n" % p for p in at) + "".join("f %d %d %d\n" % tuple(v + 1 for v in t) for t in tri))
    elif kind == ".off":
        path.write_text(f"OFF\n{len(at)} {len(tri)} 0\n" + "".join("%.7g %.7g %.7g\n" % p for p in at) + "".join("3 %d %d %d\n" % t for t in tri))
    elif kind == ".ply":
        path.write_text(f"ply\nformat ascii 1.0\nelement vertex {len(at)}\nproperty float x\nproperty float y\nproperty float z\nelement face {len(tri)}\n"
                        "property list uchar int vertex_indices\nend_header\n" + "".join("%.7g %.7g %.7g\n" % p for p in at) + "".join("3 %d %d %d\n" % t for t in tri))
    else:
        assert kind == ".gltf", path
        blob = b"".join(struct.pack("<3f", x / 1000, z / 1000, -y / 1000) for x, y, z in at) + b"".join(struct.pack("<3I", *t) for t in tri)
        n, low, high = 12 * len(at), [min(c) for c in zip(*at)], [max(c) for c in zip(*at)]
        path.write_text(json.dumps({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "s"}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "buffers": [{"byteLength": len(blob), "uri": "data:application/octet-stream;base64," + base64.b64encode(blob).decode()}],
            "bufferViews": [{"buffer": 0, "byteLength": n}, {"buffer": 0, "byteOffset": n, "byteLength": len(blob) - n}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(at), "type": "VEC3", "min": low, "max": high},
                          {"bufferView": 1, "componentType": 5125, "count": 3 * len(tri), "type": "SCALAR"}]}))
