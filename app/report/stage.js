// The stage: skin, segments and landmarks before and as planned, drawn by three.js on one canvas.
//
// t goes from 0 (before) to 1 (planned). Skin moves as a morph target, each segment by its matrix; between the ends both
// are blended along straight lines, which is a picture and not a prediction.
import {
    AmbientLight,
    DirectionalLight,
    DoubleSide,
    FrontSide,
    Group,
    Matrix4,
    OrthographicCamera,
    Scene,
    Vector3,
    WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Picker } from "./pick.js";
import { dotsOf, meshOf, movedBy, outwardBy, paint } from "./shape_mesh.js";

export class Stage {
    /** region: { centre [3], radius } in mm, the sphere to show; frame: left, posterior, up; maps: names to 768 bytes. */
    constructor(canvas, { shapes, points, region, frame, maps, movedHigh }) {
        Object.assign(this, { canvas, region, frame, maps, movedHigh, mode: "blend", t: 0, wipe: 0.5 });
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
        const key = new DirectionalLight(0xffffff, 1.75),
            fill = new DirectionalLight(0xeef2ff, 1.1);
        key.position.set(-0.45, 0.75, 1); // beside the camera: light moves with the eye, so no side is ever dark
        fill.position.set(1, 0.15, 0.7);
        this.camera.add(key, key.target, fill, fill.target, new AmbientLight(0xffffff, 0.7));
        this.scene.add(this.camera);
    }

    #load(shapes, points) {
        this.skin = shapes.find(s => s.moves);
        this.bones = new Group();
        this.points = new Group();
        this.points.visible = false;
        this.meshes = new Map(shapes.map(shape => [shape.name, meshOf(shape)]));
        this.skinMesh = this.meshes.get(this.skin.name);
        this.bones.add(...[...this.meshes.values()].filter(m => m !== this.skinMesh));
        const soft = points.filter(p => p.carried_by === "skin"),
            size = 8 * this.renderer.getPixelRatio();
        this.points.add(
            dotsOf(soft, 0x1f5fae, size),
            dotsOf(
                points.filter(p => !soft.includes(p)),
                0xb23a2e,
                size,
            ),
        );
        this.scene.add(this.skinMesh, this.bones, this.points);
    }

    /** The eye goes to one of the standard places. */
    setView(name) {
        const { left, posterior, up } = this.frame;
        const along = {
            front: [0, -1, 0],
            left: [1, 0, 0],
            right: [-1, 0, 0],
            three_quarter_left: [1, -1, 0],
            three_quarter_right: [-1, -1, 0],
            below: [0, -0.62, -1],
        }[name];
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
        const up = new Vector3(...this.frame.up),
            arm = this.camera.position.clone().sub(this.controls.target);
        arm.applyAxisAngle(up, around);
        const tilt = arm.angleTo(up) - over;
        if (tilt > 0.05 && tilt < Math.PI - 0.05)
            arm.applyAxisAngle(new Vector3().crossVectors(arm, up).normalize(), over);
        this.camera.position.copy(this.controls.target).add(arm);
        this.controls.update();
        this.request();
    }

    zoom(factor) {
        this.camera.zoom = Math.min(20, Math.max(0.3, this.camera.zoom * factor));
        this.camera.updateProjectionMatrix();
        this.request();
    }

    /** See paint(). */
    paint(colour) {
        paint(this.skinMesh, colour, this.maps, this.movedHigh);
        this.request();
    }

    displacement(v) {
        return [...this.skin.u.subarray(3 * v, 3 * v + 3)];
    }
    moved(v) {
        return movedBy(this.skinMesh, v);
    }
    outward(v) {
        return outwardBy(this.skinMesh, v);
    }

    /** opacity 1: the skin alone; below 1: the bones show through its front; 0: the bones alone. */
    setSkin(opacity) {
        const clear = opacity < 1,
            side = clear ? FrontSide : DoubleSide;
        this.bones.visible = clear;
        this.skinMesh.visible = opacity > 0;
        Object.assign(this.skinMesh.material, { opacity, transparent: clear, side, needsUpdate: true });
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
        if (this.mode === "wipe")
            return [
                { from: 0, to: this.wipe, t: 0, whole: true },
                { from: this.wipe, to: 1, t: 1, whole: true },
            ];
        if (this.mode === "side")
            return [
                { from: 0, to: 0.5, t: 0 },
                { from: 0.5, to: 1, t: 1 },
            ];
        return [{ from: 0, to: 1, t: this.t }];
    }

    #aim(part, w, h) {
        const x = Math.round(part.from * w),
            width = Math.round(part.to * w) - x;
        const seen = part.whole ? w : width,
            half = this.region.radius * Math.max(1, h / seen);
        Object.assign(this.camera, { left: (-half * seen) / h, right: (half * seen) / h, top: half, bottom: -half });
        this.camera.updateProjectionMatrix();
        return { x, width, view: part.whole ? [0, 0, w, h] : [x, 0, width, h] };
    }

    /** Pixels of the canvas for a millimetre, and the head's left as seen: -1 to 1 from left to right of the picture. */
    look() {
        const left = new Vector3(...this.frame.left).transformDirection(this.camera.matrixWorldInverse);
        return {
            scale: (this.canvas.parentElement.clientHeight * this.camera.zoom) / (this.camera.top - this.camera.bottom),
            left: left.x,
        };
    }

    request() {
        if (this.pending) return;
        this.pending = requestAnimationFrame(() => {
            this.pending = 0;
            this.draw();
        });
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
        return (
            this.#mark(px, py, view, part.t) ??
            this.picker.pick(
                this.scene,
                this.camera,
                [...this.meshes.values()],
                this.points,
                (px - view[0]) / view[2],
                py / view[3],
            )
        );
    }

    #mark(px, py, view, t) {
        let best = null,
            nearest = 9;
        for (const dots of this.points.visible ? this.points.children : [])
            for (const mark of dots.marks) {
                const p = new Vector3(...mark.before_lps_mm)
                    .lerp(new Vector3(...mark.after_lps_mm), t)
                    .project(this.camera);
                const gap = Math.hypot(view[0] + (view[2] * (p.x + 1)) / 2 - px, (view[3] * (1 - p.y)) / 2 - py);
                if (gap < nearest) [nearest, best] = [gap, { mark }];
            }
        return best;
    }
}
