// The tables: moves of the segments, soft to hard tissue, landmarks, cephalometry. All numbers are those of outcome.json.
import { directed, fixed, make, number, signed, table, word } from "./text.js";

const sides = ["left", "right"],
    depth = ["anterior", "posterior"],
    height = ["up", "down"];

export function movements(outcome) {
    const rows = outcome.movements.map(m => [
        { text: word(m.segment), head: true },
        m.at ?? "–",
        number(m.left_mm, directed(m.left_mm, sides)),
        number(m.anterior_mm, directed(m.anterior_mm, depth)),
        number(m.up_mm, directed(m.up_mm, height)),
        number(m.yaw_deg, directed(m.yaw_deg, sides, "°")),
        number(m.pitch_deg, directed(m.pitch_deg, ["down", "up"], "°")),
        number(m.roll_deg, directed(m.roll_deg, sides, "°")),
    ]);
    if (!rows.length) return make("p", {}, "No segment moves.");
    return table(
        "Planned moves of the segments, mm and degrees, along and about the head’s own axes",
        [
            "Segment",
            { text: "at", title: "the landmark whose path is given" },
            { text: "R–L", class: "number" },
            { text: "A–P", class: "number" },
            { text: "S–I", class: "number" },
            { text: "Yaw", class: "number", title: "the side to which the front turns" },
            { text: "Pitch", class: "number", title: "the way the front turns" },
            { text: "Roll", class: "number", title: "the side that goes down" },
        ],
        rows,
        { id: "movements" },
    );
}

export const movementNote =
    "Yaw and pitch: the way the front of the segment turns; roll: the side that goes down. " +
    "The chin’s move includes that of the distal segment.";

/** "Maxilla 5.0 mm anterior, 2.0 mm up", one for each segment; a chin that only rides along is left out. */
export function summary(outcome) {
    const part = m =>
        [
            [m.anterior_mm, depth, " mm"],
            [m.up_mm, height, " mm"],
            [m.left_mm, sides, " mm"],
            [m.yaw_deg, ["left", "right"], "° yaw"],
            [m.pitch_deg, ["down", "up"], "° pitch"],
            [m.roll_deg, ["left", "right"], "° roll"],
        ]
            .filter(([x]) => typeof x === "number" && Math.abs(x) >= 0.05)
            .map(([x, pair, unit]) => directed(x, pair, unit));
    const matrix = name => JSON.stringify(outcome.plan.segments[name]?.matrix);
    const own = m => m.segment !== "chin" || matrix("chin") !== matrix("distal");
    return outcome.movements.filter(own).map(m => `${word(m.segment)} ${part(m).join(", ") || "0.0 mm"}`);
}

export function softToHard(outcome) {
    if (!outcome.soft_to_hard?.length) return null;
    const rows = outcome.soft_to_hard.map(r => [
        { text: r.soft, head: true },
        ...[0, 1, 2].map(k => number(r.soft_mm[k], signed(r.soft_mm[k]))),
        r.hard,
        ...[0, 1, 2].map(k => number(r.hard_mm[k], signed(r.hard_mm[k]))),
        number(r.forward_ratio, fixed(r.forward_ratio, 2)),
    ]);
    const axes = ["forward", "up", "left"].map(text => ({ text, class: "number" }));
    return table(
        "How soft tissue follows bone and teeth, mm",
        [
            "Soft",
            ...axes,
            "Hard",
            ...axes,
            { text: "ratio", class: "number", title: "forward, where the hard tissue moves at least 1 mm" },
        ],
        rows,
        { id: "soft" },
    );
}

export function landmarks(outcome, help) {
    const group = l =>
        l.carried_by === "skin" ? "Soft tissue" : l.carried_by === "nothing" ? "Not carried" : "Bone and teeth";
    const row = l => [
        { text: l.label, head: true, title: help[l.label] },
        ...l.forward_up_left_mm.map(x => number(x, signed(x))),
        number(Math.hypot(...l.forward_up_left_mm)),
    ];
    const axes = ["forward", "up", "left", "total"].map(text => ({ text, class: "number" }));
    return ["Soft tissue", "Bone and teeth", "Not carried"].flatMap(name => {
        const all = outcome.landmarks.filter(l => group(l) === name);
        const moved = all.filter(l => Math.hypot(...l.forward_up_left_mm) >= 0.05),
            still = all.filter(l => !moved.includes(l));
        if (!all.length) return [];
        return [
            make(
                "div",
                {},
                moved.length
                    ? table(`${name}, moves in mm`, ["Landmark", ...axes], moved.map(row), { class: "landmarks" })
                    : null,
                still.length
                    ? make(
                          "p",
                          { class: "note" },
                          `${moved.length ? "Moved" : `${name}, moved`} by less than 0.05 mm: ${still.map(l => l.label).join(", ")}.`,
                      )
                    : null,
            ),
        ];
    });
}

const norm = n => (n ? `${fixed(n[0])} ± ${fixed(n[1])}` : "");

/** Two tables of about the same length, so that they stand side by side; groups stay whole. */
export function cephalometry(outcome) {
    const groups = new Map();
    for (const m of outcome.cephalometry) groups.set(m.group, [...(groups.get(m.group) ?? []), m]);
    const sizes = [...groups.values()].map(g => g.length + 1),
        total = sizes.reduce((a, b) => a + b, 0);
    const halves = [[], []];
    let lines = 0;
    [...groups].forEach(([name, measures], i) => {
        halves[lines + sizes[i] / 2 < total / 2 ? 0 : 1].push([name, measures]);
        lines += sizes[i];
    });
    return halves
        .filter(h => h.length)
        .map(half =>
            table(
                "",
                ["Measure", "Before", "Planned", "Change", "Norm, women", "Norm, men"].map((text, i) =>
                    i ? { text, class: "number" } : text,
                ),
                half.flatMap(([name, measures]) => [
                    { class: "group", cells: [{ text: name, head: true, span: 6 }] },
                    ...measures.map(measureRow),
                ]),
                { class: "ceph" },
            ),
        );
}

function measureRow(m) {
    const degrees = m.unit === "deg" ? "°" : "";
    const values =
        typeof m.before === "number"
            ? [
                  number(m.before, fixed(m.before) + degrees),
                  number(m.planned, fixed(m.planned) + degrees),
                  number(m.change, signed(m.change) + degrees),
              ]
            : [{ text: m.note ?? "not measured", span: 3, class: "missing" }];
    return [
        { text: degrees ? m.name : `${m.name}, ${m.unit}`, head: true, title: m.what },
        ...values,
        { text: norm(m.norm_women), class: "number norm", title: m.source },
        { text: norm(m.norm_men), class: "number norm", title: m.source },
    ];
}
