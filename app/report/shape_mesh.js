// One shape as three.js draws it: its geometry with the planned place as a morph target, and the colours of the skin.
import {
    BufferAttribute,
    BufferGeometry,
    CanvasTexture,
    Color,
    DoubleSide,
    Matrix4,
    Mesh,
    MeshStandardMaterial,
    Points,
    PointsMaterial,
    SRGBColorSpace,
} from "three";

const skinColour = [0.85, 0.68, 0.59]; // sRGB
const fade = 0.2; // in this part of the scale the skin's colour passes into the map, as in the stills
const linear = Float32Array.from({ length: 256 }, (_, i) => new Color().setRGB(i / 255, 0, 0, SRGBColorSpace).r);

function normalsOf(xyz, triangles) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(xyz, 3));
    geometry.setIndex(new BufferAttribute(triangles, 1));
    geometry.computeVertexNormals();
    return geometry.getAttribute("normal").array;
}

const sum = (a, b) => a.map((x, i) => x + b[i]);
const difference = (a, b) => a.map((x, i) => x - b[i]);

function geometryOf(shape) {
    const geometry = new BufferGeometry(),
        normals = normalsOf(shape.xyz, shape.triangles);
    geometry.setAttribute("position", new BufferAttribute(shape.xyz, 3));
    geometry.setAttribute("normal", new BufferAttribute(normals, 3));
    geometry.setIndex(new BufferAttribute(shape.triangles, 1));
    if (shape.u) {
        geometry.morphTargetsRelative = true;
        geometry.morphAttributes.position = [new BufferAttribute(shape.u, 3)];
        geometry.morphAttributes.normal = [
            new BufferAttribute(difference(normalsOf(sum(shape.xyz, shape.u), shape.triangles), normals), 3),
        ];
        geometry.setAttribute("color", new BufferAttribute(new Float32Array(shape.xyz.length), 3));
    }
    return geometry;
}

/** A white disc with a soft rim, for the landmarks. */
function disc() {
    const canvas = document.createElement("canvas"),
        context = canvas.getContext("2d");
    canvas.width = canvas.height = 32;
    context.fillStyle = "#fff";
    context.arc(16, 16, 14, 0, 2 * Math.PI);
    context.fill();
    return new CanvasTexture(canvas);
}

/** The mesh of a shape; `planned` is the matrix of a segment's move. */
export function meshOf(shape) {
    const look = shape.moves
        ? { vertexColors: true, roughness: 0.62, side: DoubleSide }
        : { color: new Color().setRGB(...shape.rgb, SRGBColorSpace), roughness: 0.7, side: DoubleSide };
    const mesh = new Mesh(geometryOf(shape), new MeshStandardMaterial(look));
    Object.assign(mesh, { name: shape.name, shape, frustumCulled: false, renderOrder: shape.moves ? 1 : 0 });
    if (!shape.moves) {
        mesh.matrixAutoUpdate = false;
        mesh.planned = new Matrix4().set(...shape.matrix);
    }
    return mesh;
}

/** Landmarks as dots of `size` pixels. */
export function dotsOf(marks, color, size) {
    const geometry = new BufferGeometry(),
        before = marks.flatMap(p => p.before_lps_mm),
        after = marks.flatMap(p => p.after_lps_mm);
    geometry.setAttribute("position", new BufferAttribute(Float32Array.from(before), 3));
    geometry.morphTargetsRelative = true;
    geometry.morphAttributes.position = [new BufferAttribute(Float32Array.from(difference(after, before)), 3)];
    const look = { color, size, map: disc(), sizeAttenuation: false, depthTest: false, transparent: true };
    return Object.assign(new Points(geometry, new PointsMaterial(look)), {
        renderOrder: 2,
        frustumCulled: false,
        marks,
    });
}

/** How far a vertex of the skin moves, mm. */
export function movedBy({ shape }, v) {
    return Math.hypot(shape.u[3 * v], shape.u[3 * v + 1], shape.u[3 * v + 2]);
}

/** The part of it along the outward normal, mm. */
export function outwardBy({ shape, geometry }, v) {
    const n = geometry.getAttribute("normal").array,
        u = shape.u;
    return n[3 * v] * u[3 * v] + n[3 * v + 1] * u[3 * v + 1] + n[3 * v + 2] * u[3 * v + 2];
}

/** Colours of the skin: "skin", "moved" (size of the displacement) or "signed" (along the outward normal); high: mm. */
export function paint(mesh, colour, maps, high) {
    const out = mesh.geometry.getAttribute("color"),
        to = out.array,
        own = mesh.shape.colours;
    const base = skinColour.map(c => linear[Math.round(255 * c)]);
    const map = maps[{ moved: "viridis", signed: "coolwarm" }[colour]],
        low = colour === "signed" ? -high : 0;
    for (let v = 0; v < out.count; v++) {
        const value = colour === "moved" ? movedBy(mesh, v) : colour === "signed" ? outwardBy(mesh, v) : 0;
        const entry = 3 * Math.min(255, Math.max(0, Math.round((255 * (value - low)) / (high - low))));
        const share = colour === "moved" ? Math.min(1, value / (fade * high)) : 1;
        for (let c = 0; c < 3; c++) {
            const skin = colour === "skin" && own ? linear[own[3 * v + c]] : base[c];
            to[3 * v + c] = map ? share * linear[map[entry + c]] + (1 - share) * skin : skin;
        }
    }
    out.needsUpdate = true;
}
