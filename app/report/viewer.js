// The controls of the stage: every one is a plain form control, so that keyboard and screen reader reach it.
import { addMarks, addReadout } from "./overlay.js";
import { Stage } from "./stage.js";
import { fixed, make, word } from "./text.js";

const views = [
    ["front", "Front"],
    ["three_quarter_left", "¾ left"],
    ["left", "Left"],
    ["three_quarter_right", "¾ right"],
    ["right", "Right"],
    ["below", "Below"],
];

function choice(name, label, options, chosen, onChange) {
    return make(
        "fieldset",
        { class: "choice" },
        make("legend", {}, label),
        make(
            "div",
            {},
            options.map(([value, text]) => {
                const input = make("input", { type: "radio", name, value, checked: value === chosen });
                input.addEventListener("change", () => onChange(value));
                return make("label", {}, input, make("span", {}, text));
            }),
        ),
    );
}

function tick(label, colour, checked, onChange) {
    const input = make("input", { type: "checkbox", checked }),
        swatch = make("i", { class: "swatch" });
    if (colour) swatch.style.background = `rgb(${colour.map(c => Math.round(255 * c)).join(" ")})`;
    input.addEventListener("change", () => onChange(input.checked));
    return make("label", { class: "tick" }, input, colour ? swatch : null, label);
}

/** Bar of a colour map with its ticks, drawn as a small picture. */
function legend(map, low, high, caption, fadeTo) {
    const bar = make("canvas", { width: 256, height: 1, class: "bar", "aria-hidden": "true" });
    const context = bar.getContext("2d"),
        image = context.createImageData(256, 1);
    for (let i = 0; i < 256; i++) {
        const share = fadeTo ? Math.min(1, i / 255 / fadeTo) : 1;
        for (let c = 0; c < 3; c++) image.data[4 * i + c] = share * map[3 * i + c] + (1 - share) * [217, 173, 150][c];
        image.data[4 * i + 3] = 255;
    }
    context.putImageData(image, 0, 0);
    const ticks = [0, 0.25, 0.5, 0.75, 1].map(s =>
        make("span", {}, fixed(low + s * (high - low), (high - low) % 4 ? 1 : 0)),
    );
    return make(
        "figure",
        { class: "legend" },
        bar,
        make("div", { class: "ticks" }, ticks),
        make("figcaption", {}, caption),
    );
}

function addSlider(stage, box) {
    const slider = make("input", { type: "range", min: 0, max: 100, step: 1, value: 0, id: "morph" });
    const left = make("span", {}, "Before"),
        right = make("span", {}, "Planned");
    const line = make("div", { class: "divider" }, make("span", {}, "Before"), make("span", {}, "Planned"));
    const apply = () => {
        const share = slider.value / 100;
        if (stage.mode === "blend") stage.t = share;
        else stage.wipe = share;
        const at = stage.mode === "side" ? 0.5 : stage.wipe;
        line.hidden = stage.mode === "blend";
        line.style.left = `${100 * at}%`;
        slider.setAttribute(
            "aria-valuetext",
            stage.mode === "wipe"
                ? `before on the left ${slider.value} % of the picture`
                : slider.value === "0"
                  ? "before"
                  : slider.value === "100"
                    ? "planned"
                    : `${slider.value} % of the way, a blend`,
        );
        stage.request();
    };
    slider.addEventListener("input", apply);
    line.addEventListener("pointerdown", e => {
        if (stage.mode !== "wipe") return;
        line.setPointerCapture(e.pointerId);
        line.onpointermove = m => {
            const r = box.getBoundingClientRect();
            slider.value = 100 * Math.min(1, Math.max(0, (m.clientX - r.left) / r.width));
            apply();
        };
        line.onpointerup = () => {
            line.onpointermove = null;
        };
    });
    box.append(line);
    const row = make("label", { class: "morph" }, left, slider, right);
    const set = mode => {
        stage.mode = mode;
        slider.disabled = mode === "side";
        slider.value = mode === "blend" ? 100 * stage.t : 100 * stage.wipe;
        slider.setAttribute("aria-label", mode === "wipe" ? "Place of the dividing line" : "From before to planned");
        apply();
    };
    return {
        row,
        set,
        to: value => {
            slider.value = value;
            apply();
        },
    };
}

function addKeys(stage, slider, readMiddle) {
    const step = 0.08;
    const keys = {
        ArrowLeft: () => stage.turn(step, 0),
        ArrowRight: () => stage.turn(-step, 0),
        ArrowUp: () => stage.turn(0, step),
        ArrowDown: () => stage.turn(0, -step),
        "+": () => stage.zoom(1.15),
        "=": () => stage.zoom(1.15),
        "-": () => stage.zoom(1 / 1.15),
        b: () => slider.to(0),
        p: () => slider.to(100),
        r: readMiddle,
    };
    views.forEach(([name], i) => {
        keys[i + 1] = () => stage.setView(name);
    });
    stage.canvas.addEventListener("keydown", e => {
        const act = e.ctrlKey || e.metaKey || e.altKey ? null : keys[e.key];
        if (!act) return;
        e.preventDefault();
        act();
    });
}

/** Fills the two boxes of the page; throws where the browser has no WebGL. */
export function openViewer(box, controls, data) {
    const canvas = make("canvas", {
        tabindex: 0,
        role: "img",
        "aria-describedby": "keys",
        "aria-label": "The head in 3-D, before and as planned",
    });
    box.append(canvas);
    const stage = new Stage(canvas, data),
        slider = addSlider(stage, box);
    addMarks(stage, box);
    addKeys(stage, slider, addReadout(stage, box));
    const bones = data.shapes.filter(s => !s.moves),
        scale = make("div", {}),
        mode = box.clientWidth > 600 ? "side" : "blend";
    const opacity = make("input", {
        type: "range",
        min: 0.1,
        max: 0.9,
        step: 0.05,
        value: 0.35,
        "aria-label": "Opacity of the skin over the bones",
    });
    opacity.addEventListener("input", () => stage.setSkin(Number(opacity.value)));
    const skin = value => {
        opacity.hidden = value !== "clear";
        stage.setSkin({ whole: 1, clear: Number(opacity.value), none: 0 }[value]);
    };
    const paint = colour => {
        stage.paint(colour);
        scale.replaceChildren(
            ...{
                skin: [],
                moved: [legend(data.maps.viridis, 0, data.movedHigh, "skin moves by, mm", 0.2)],
                signed: [
                    legend(
                        data.maps.coolwarm,
                        -data.movedHigh,
                        data.movedHigh,
                        "skin moves inward (−) or outward (+), mm",
                    ),
                ],
            }[colour],
        );
    };
    const buttons = views.map(([name, text], i) => {
        const b = make("button", { type: "button", title: `key ${i + 1}` }, text);
        b.addEventListener("click", () => stage.setView(name));
        return b;
    });
    controls.append(
        slider.row,
        choice(
            "mode",
            "Compare",
            [
                ["blend", "Blend"],
                ["wipe", "Wipe"],
                ["side", "Side by side"],
            ],
            mode,
            slider.set,
        ),
        make("fieldset", { class: "choice views" }, make("legend", {}, "View"), make("div", {}, buttons)),
        choice(
            "colour",
            "Colours of the skin",
            [
                ["skin", "Skin"],
                ["moved", "Displacement"],
                ["signed", "In / out"],
            ],
            "skin",
            paint,
        ),
        scale,
        choice(
            "layers",
            "Show",
            [
                ["whole", "Skin"],
                ["clear", "Skin over bones"],
                ["none", "Bones"],
            ],
            "whole",
            skin,
        ),
        opacity,
        make(
            "fieldset",
            { class: "ticks-list" },
            make("legend", {}, "Segments"),
            bones.map(b => tick(word(b.name), b.rgb, true, on => stage.setVisible(b.name, on))),
        ),
        tick("Landmarks", null, false, on => stage.setVisible("landmarks", on)),
    );
    skin("whole");
    slider.set(mode);
    return stage;
}
