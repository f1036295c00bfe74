// What lies over the picture: the read-out of the place under the cursor, the patient's sides, a scale bar.
import { directed, fixed, make, word } from "./text.js";

/** What is under the cursor, in words. */
function describe(found, stage) {
    if (!found) return "";
    const axes = u => {
        const along = k => u.reduce((s, x, i) => s + x * stage.frame[k][i], 0);
        return [
            directed(-along("posterior"), ["forward", "back"]),
            directed(along("up"), ["up", "down"]),
            directed(along("left"), ["left", "right"]),
        ].join(" · ");
    };
    if (found.mark) {
        const u = found.mark.after_lps_mm.map((x, i) => x - found.mark.before_lps_mm[i]);
        return `${found.mark.label}: ${fixed(Math.hypot(...u))} mm (${axes(u)})`;
    }
    const { mesh, vertex } = found;
    if (mesh.shape.moves) {
        const u = stage.displacement(vertex);
        return `Skin: ${fixed(stage.moved(vertex))} mm (${axes(u)}); ${directed(stage.outward(vertex), ["outward", "inward"])}`;
    }
    const x = [...mesh.shape.xyz.subarray(3 * vertex, 3 * vertex + 3)],
        m = mesh.shape.matrix;
    const u = x.map((_, i) => m[4 * i] * x[0] + m[4 * i + 1] * x[1] + m[4 * i + 2] * x[2] + m[4 * i + 3] - x[i]);
    return `${word(mesh.name)}: ${fixed(Math.hypot(...u))} mm (${axes(u)})`;
}

/** Returns a function that reads the middle of the picture. */
export function addReadout(stage, box) {
    const out = make("output", { class: "readout", "aria-live": "polite" });
    const hint = matchMedia("(pointer: coarse)").matches
        ? "Drag to turn · pinch to zoom · two fingers to shift"
        : "Drag to turn · wheel to zoom · right button to shift";
    let waiting = 0,
        place = null;
    const show = text => {
        out.textContent = text || hint;
    };
    const look = () => {
        waiting = 0;
        if (place) show(describe(stage.at(...place), stage));
    };
    stage.canvas.addEventListener("pointermove", e => {
        const r = stage.canvas.getBoundingClientRect();
        place = e.buttons ? null : [e.clientX - r.left, e.clientY - r.top];
        if (!waiting) waiting = requestAnimationFrame(look);
    });
    stage.canvas.addEventListener("pointerleave", () => {
        place = null;
        show("");
    });
    show("");
    box.append(out, make("i", { class: "cross", "aria-hidden": "true" }));
    return () =>
        show(
            describe(stage.at(box.clientWidth / 2, box.clientHeight / 2), stage) ||
                "Nothing in the middle of the picture",
        );
}

/** Marks of the patient's sides, and a scale bar. */
export function addMarks(stage, box) {
    const sides = ["left", "right"].map(at => make("span", { class: `side ${at}`, "aria-hidden": "true" }));
    const bar = make("span", { class: "scale", "aria-hidden": "true" });
    box.append(...sides, bar);
    stage.canvas.addEventListener("drawn", () => {
        const { scale, left } = stage.look(),
            seen = Math.abs(left) > 0.5;
        sides.forEach((mark, i) => {
            mark.textContent = seen ? ((i === 1) === left > 0 ? "L" : "R") : "";
        });
        const length = [5, 10, 20, 50].find(mm => mm * scale > 60) ?? 100;
        bar.textContent = `${length} mm`;
        bar.style.width = `${length * scale}px`;
    });
}
