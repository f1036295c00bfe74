// The stage: skin, segments and landmarks before and as planned, drawn by three.js on one canvas.
//
// t goes from 0 (before) to 1 (planned). Skin moves as a morph target, each segment by its matrix; between the ends both
// are blended along straight lines, which is a picture and not a prediction.
import {
    AmbientLight, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, FrontSide, Group, Matrix4, Mesh,
    MeshStandardMaterial, OrthographicCamera, Points, PointsMaterial, Scene, SRGBColorSpace, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Picker } from "./pick.js";

const skinColour = [0.85, 0.68, 0.59]; // sRGB
const fade = 0.2;                      // in this part of the scale the skin's colour passes into the map, as in the stills
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
    const geometry = new BufferGeometry(), normals = normalsOf(shape.xyz, shape.triangles);
    geometry.setAttribute("position", new BufferAttribute(shape.xyz, 3));
    geometry.setAttribute("normal", new BufferAttribute(normals, 3));
    geometry.setIndex(new BufferAttribute(shape.triangles, 1));
    if (shape.u) {
        geometry.morphTargetsRelative = true;
        geometry.morphAttributes.position = [new BufferAttribute(shape.u, 3)];
        geometry.morphAttributes.normal =
            [new BufferAttribute(difference(normalsOf(sum(shape.xyz, shape.u), shape.triangles), normals), 3)];
        geometry.setAttribute("color", new BufferAttribute(new Float32Array(shape.xyz.length), 3));
    }
    return geometry;
}

export class Stage {
    /** region: { centre [3], radius } in mm, the sphere to show; frame: left, posterior, up; maps: names to 768 bytes. */
    constructor(canvas, { shapes, points, region, frame, maps, movedHigh }) {
        Object.assign(this, { canvas, region, frame, maps, movedHigh, mode: "blend", t: 0, wipe: 0.5, colour: "skin" });
        this.renderer = new WebGLRenderer({ canvas, antialias: true });
        this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
        this.renderer.setClearColor(0xf2f4f6);
        this.renderer.autoClear = false;
        this.scene = new Scene();
        this.camera = new OrthographicCamera(-1, 1, 1, -1, 1, 2000);
        this.camera.up.fromArray(frame.up);
        this.#light();
        this.#load(shapes, points);
        this.controls = new OrbitControls(this.camera, canvas);
        this.controls.target.fromArray(region.centre);
        this.controls.addEventListener("change", () => this.request());
        this.picker = new Picker(this.renderer);
        new ResizeObserver(() => this.#resize()).observe(canvas.parentElement);
        this.setView("three_quarter_left");
        this.paint("skin");
        this.#resize();
    }

    #light() {
        const key = new DirectionalLight(0xffffff, 1.75), fill = new DirectionalLight(0xeef2ff, 1.1);
        key.position.set(-0.45, 0.75, 1); // beside the camera: light moves with the eye, so no side is ever dark
        fill.position.set(1, 0.15, 0.7);
        this.camera.add(key, key.target, fill, fill.target, new AmbientLight(0xffffff, 0.7));
        this.scene.add(this.camera);
    }

    #load(shapes, points) {
        this.skin = shapes.find(s => s.moves);
        this.bones = new Group();
        this.meshes = new Map();
        for (const shape of shapes) {
            const isSkin = shape === this.skin;
            const material = new MeshStandardMaterial(isSkin
                ? { vertexColors: true, roughness: 0.62, side: DoubleSide }
                : { color: new Color().setRGB(...shape.rgb, SRGBColorSpace), roughness: 0.7, side: DoubleSide });
            const mesh = new Mesh(geometryOf(shape), material);
            Object.assign(mesh, { name: shape.name, shape, frustumCulled: false });
            if (!isSkin) {
                mesh.matrixAutoUpdate = false;
                mesh.planned = new Matrix4().set(...shape.matrix);
            }
            mesh.renderOrder = isSkin ? 1 : 0;
            (isSkin ? this.scene : this.bones).add(mesh);
            this.meshes.set(shape.name, mesh);
        }
        this.scene.add(this.bones);
        this.points = new Group();
        this.points.visible = false;
        for (const [carrier, colour] of [["skin", 0x1f5fae], ["bone", 0xb23a2e]]) {
            const of = points.filter(p => (p.carried_by === "skin") === (carrier === "skin"));
            const geometry = new BufferGeometry(), before = of.flatMap(p => p.before_lps_mm), after = of.flatMap(p => p.after_lps_mm);
            geometry.setAttribute("position", new BufferAttribute(Float32Array.from(before), 3));
            geometry.morphTargetsRelative = true;
            geometry.morphAttributes.position = [new BufferAttribute(Float32Array.from(difference(after, before)), 3)];
            const dots = new Points(geometry, new PointsMaterial({ color: colour, size: 7 * this.renderer.getPixelRatio(),
                                                                   sizeAttenuation: false, depthTest: false, transparent: true }));
            Object.assign(dots, { renderOrder: 2, frustumCulled: false, marks: of });
            this.points.add(dots);
        }
        this.scene.add(this.points);
    }

    /** The eye goes to one of the standard places. */
    setView(name) {
        const { left, posterior, up } = this.frame;
        const along = { front: [0, -1, 0], left: [1, 0, 0], right: [-1, 0, 0], three_quarter_left: [1, -1, 0],
                        three_quarter_right: [-1, -1, 0], below: [0, -0.62, -1] }[name];
        const eye = new Vector3();
        [left, posterior, up].forEach((axis, k) => eye.addScaledVector(new Vector3(...axis), along[k]));
        this.controls.target.fromArray(this.region.centre);
        this.camera.position.fromArray(this.region.centre).addScaledVector(eye.normalize(), 1000);
        this.camera.zoom = 1;
        this.camera.updateProjectionMatrix();
        this.controls.update();
        this.request();
    }

    /** Turns the eye about the head, radians. */
    turn(around, over) {
        const up = new Vector3(...this.frame.up), arm = this.camera.position.clone().sub(this.controls.target);
        arm.applyAxisAngle(up, around);
        const tilt = arm.angleTo(up) - over;
        if (tilt > 0.05 && tilt < Math.PI - 0.05) arm.applyAxisAngle(new Vector3().crossVectors(arm, up).normalize(), over);
        this.camera.position.copy(this.controls.target).add(arm);
        this.controls.update();
        this.request();
    }

    zoom(factor) {
        this.camera.zoom = Math.min(20, Math.max(0.3, this.camera.zoom * factor));
        this.camera.updateProjectionMatrix();
        this.request();
    }

    /** Colours of the skin: "skin", "moved" (size of the displacement) or "signed" (along the outward normal). */
    paint(colour) {
        this.colour = colour;
        const geometry = this.meshes.get(this.skin.name).geometry, out = geometry.getAttribute("color");
        const base = skinColour.map(c => linear[Math.round(255 * c)]);
        const map = this.maps[{ moved: "viridis", signed: "coolwarm" }[colour]];
        const high = this.movedHigh, low = colour === "signed" ? -high : 0, to = out.array;
        for (let v = 0; v < out.count; v++) {
            const value = colour === "moved" ? this.moved(v) : colour === "signed" ? this.outward(v) : 0;
            const entry = map ? 3 * Math.min(255, Math.max(0, Math.round(255 * (value - low) / (high - low)))) : 0;
            const share = colour === "moved" ? Math.min(1, value / (fade * high)) : 1;
            for (let c = 0; c < 3; c++) {
                const own = colour === "skin" && this.skin.colours ? linear[this.skin.colours[3 * v + c]] : base[c];
                to[3 * v + c] = map ? share * linear[map[entry + c]] + (1 - share) * own : own;
            }
        }
        out.needsUpdate = true;
        this.request();
    }

    displacement(v) { return [...this.skin.u.subarray(3 * v, 3 * v + 3)]; }
    moved(v) { return Math.hypot(this.skin.u[3 * v], this.skin.u[3 * v + 1], this.skin.u[3 * v + 2]); }
    outward(v) {
        const n = this.meshes.get(this.skin.name).geometry.getAttribute("normal").array, u = this.skin.u;
        return n[3 * v] * u[3 * v] + n[3 * v + 1] * u[3 * v + 1] + n[3 * v + 2] * u[3 * v + 2];
    }

    /** opacity 1: the skin alone; below 1: the bones show through its front; 0: the bones alone. */
    setSkin(opacity) {
        this.bones.visible = opacity < 1;
        const mesh = this.meshes.get(this.skin.name), material = mesh.material;
        mesh.visible = opacity > 0;
        Object.assign(material, { opacity, transparent: opacity < 1, side: opacity < 1 ? FrontSide : DoubleSide, needsUpdate: true });
        this.request();
    }

    setVisible(name, visible) {
        (name === "landmarks" ? this.points : this.meshes.get(name)).visible = visible;
        this.request();
    }

    #pose(t) {
        for (const mesh of this.meshes.values())
            if (mesh.planned) {
                mesh.matrix.elements = new Matrix4().elements.map((x, i) => (1 - t) * x + t * mesh.planned.elements[i]);
                mesh.matrixWorldNeedsUpdate = true;
            } else {
                mesh.morphTargetInfluences[0] = t;
            }
        for (const dots of this.points.children) dots.morphTargetInfluences[0] = t;
    }

    #resize() {
        const { clientWidth: w, clientHeight: h } = this.canvas.parentElement;
        if (!w || !h) return;
        this.renderer.setSize(w, h, false);
        this.request();
    }

    /** Parts of the canvas from left to right, as shares of its width: which t they show, and how much they see. */
    #parts() {
        if (this.mode === "wipe") return [{ from: 0, to: this.wipe, t: 0, whole: true }, { from: this.wipe, to: 1, t: 1, whole: true }];
        if (this.mode === "side") return [{ from: 0, to: 0.5, t: 0 }, { from: 0.5, to: 1, t: 1 }];
        return [{ from: 0, to: 1, t: this.t }];
    }

    #aim(part, w, h) {
        const x = Math.round(part.from * w), width = Math.round(part.to * w) - x;
        const seen = part.whole ? w : width, half = this.region.radius * Math.max(1, h / seen);
        Object.assign(this.camera, { left: -half * seen / h, right: half * seen / h, top: half, bottom: -half });
        this.camera.updateProjectionMatrix();
        return { x, width, view: part.whole ? [0, 0, w, h] : [x, 0, width, h] };
    }

    /** Pixels of the canvas for a millimetre, and the head's left as seen: -1 to 1 from left to right of the picture. */
    look() {
        const left = new Vector3(...this.frame.left).transformDirection(this.camera.matrixWorldInverse);
        return { scale: this.canvas.parentElement.clientHeight * this.camera.zoom / (this.camera.top - this.camera.bottom), left: left.x };
    }

    request() {
        if (this.pending) return;
        this.pending = requestAnimationFrame(() => { this.pending = 0; this.draw(); });
    }

    draw() {
        const { clientWidth: w, clientHeight: h } = this.canvas.parentElement;
        this.renderer.setScissorTest(false);
        this.renderer.clear();
        this.renderer.setScissorTest(true);
        for (const part of this.#parts()) {
            const { x, width, view } = this.#aim(part, w, h);
            if (!width) continue;
            this.renderer.setViewport(...view);
            this.renderer.setScissor(x, 0, width, h);
            this.#pose(part.t);
            this.renderer.render(this.scene, this.camera);
        }
        this.drawn = true;
        this.canvas.dispatchEvent(new Event("drawn"));
    }

    /** What is seen at a place of the canvas, CSS pixels: { mesh, vertex } or { mark }, or null. */
    at(px, py) {
        const { clientWidth: w, clientHeight: h } = this.canvas.parentElement;
        const part = this.#parts().find(p => px >= p.from * w && px < p.to * w);
        if (!part) return null;
        const { view } = this.#aim(part, w, h);
        this.#pose(part.t);
        this.camera.updateMatrixWorld();
        return this.#mark(px, py, view, part.t) ??
            this.picker.pick(this.scene, this.camera, [...this.meshes.values()], this.points, (px - view[0]) / view[2], py / view[3]);
    }

    #mark(px, py, view, t) {
        let best = null, nearest = 9;
        for (const dots of this.points.visible ? this.points.children : [])
            for (const mark of dots.marks) {
                const p = new Vector3(...mark.before_lps_mm).lerp(new Vector3(...mark.after_lps_mm), t).project(this.camera);
                const gap = Math.hypot(view[0] + view[2] * (p.x + 1) / 2 - px, view[3] * (1 - p.y) / 2 - py);
                if (gap < nearest) [nearest, best] = [gap, { mark }];
            }
        return best;
    }
}
