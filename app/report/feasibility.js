// Feasibility: the limits of the plan with their levels, and how far each control may go where gnathos audit found out.
import { fixed, make, table } from "./text.js";

const digits = x => (typeof x !== "number" ? "–" : fixed(x, Math.abs(x) >= 100 ? 0 : 2));

/** "1.00 to 5.00", "at least 3.00", "–". */
function range([low, high]) {
    if (low === null && high === null) return "–";
    if (low === null) return `at most ${digits(high)}`;
    return high === null ? `at least ${digits(low)}` : `${digits(low)} to ${digits(high)}`;
}

const level = name => ({ text: name, class: `level ${name.split(" ")[0]}` });

/** All that the prediction found, and what an audit of the plan found besides or otherwise: nothing hides the other. */
function findings(own, audit) {
    const alike = (a, b) => ["limit", "where", "level", "value"].every(key => a[key] === b[key]);
    const other = (audit ?? []).filter(a => !own.some(o => alike(a, o)));
    return [...own, ...other.map(a => ({ ...a, where: [a.where, "by the audit"].filter(Boolean).join(", ") }))];
}

/** One plan for all limits together, or what contradicts. */
function remedy(r) {
    if (!r) return null;
    const change = c =>
        typeof c.wanted === "number"
            ? `${c.control} ${digits(c.wanted)} → ${digits(c.proposed)} ${c.unit}`
            : `${c.control} by ${digits(c.by)} ${c.unit}`;
    const text = r.found
        ? `The nearest plan found that nothing stops, all changes together: ${r.changes.map(change).join("; ")}.`
        : `No change of the pieces that the plan moves was found that brings all limits together; these contradict: ${r.contradict.join("; ")}.`;
    return make("p", { class: "note remedy" }, text);
}

function planAudit(limits, audit) {
    const order = ["stop", "caution", "not judged"];
    const all = findings(limits.limits, audit?.limits);
    const worst = ["stop", "caution", "fine"].find(l => all.some(f => f.level === l));
    const first = all.find(f => f.limit === limits.decides && f.level === limits.worst && f.level !== "fine");
    const told = all
        .filter(l => order.includes(l.level))
        .sort((a, b) => order.indexOf(a.level) - order.indexOf(b.level));
    const fine = [...new Set(all.filter(l => l.level === "fine").map(l => l.what))];
    const unit = l => ({ deg: "°", mm2: " mm²", mm3: " mm³", "": "" })[l.unit ?? ""] ?? ` ${l.unit}`;
    const rows = told.map(l => [
        level(l.level),
        { text: [l.what, l.where].filter(Boolean).join(", "), head: true, title: l.source },
        {
            text: `${l.estimated ? "≈ " : ""}${digits(l.value)}${typeof l.value === "number" ? unit(l) : ""}`,
            value: l.value,
            class: "number",
        },
        range(l.fine),
        range(l.stop),
        l.note ?? "",
    ]);
    const verdict =
        audit?.feasible === false
            ? "Not feasible as it stands"
            : ({ stop: "Stopped, and accepted by an override", caution: "Feasible, with caution", fine: "Feasible" }[
                  worst
              ] ?? limits.worst);
    return [
        make(
            "p",
            { class: "lead" },
            `${verdict}: ${all.length} limits judged, ${told.length} of them not fine.`,
        ),
        first
            ? make(
                  "p",
                  { class: "lead" },
                  `First ${first.level}: ${[first.what, first.where].filter(Boolean).join(", ")}: ${digits(first.value)}${unit(first)}${first.note ? ` (${first.note})` : ""}.`,
              )
            : null,
        rows.length
            ? table(
                  "Limits that are not fine (≈ estimated)",
                  [
                      "Level",
                      "Limit",
                      { text: "is", class: "number" },
                      "fine",
                      "stops outside",
                      "to know",
                  ],
                  rows,
                  { class: "limits" },
              )
            : null,
        remedy(audit?.remedy),
        fine.length ? make("p", { class: "note" }, `Fine: ${fine.join("; ")}.`) : null,
    ];
}

/** A control's box as a bar of fine, caution and stop, with the plan's value on it. */
function bar(bound, planned) {
    const [low, high] = bound.box,
        w = 240,
        x = v => (w * (v - low)) / (high - low);
    const svg = (tag, attributes) => {
        const e = document.createElementNS("http://www.w3.org/2000/svg", tag);
        for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
        return e;
    };
    const root = svg("svg", {
        viewBox: `0 0 ${w} 16`,
        class: "range",
        role: "img",
        "aria-label": bound.pieces.map(p => `${fixed(p.from, 2)} to ${fixed(p.to, 2)} ${p.level}`).join(", "),
    });
    bound.pieces.forEach((p, i) => {
        // pieces are runs of samples: each reaches to the middle of the gap to the next
        const from = i ? (bound.pieces[i - 1].to + p.from) / 2 : low,
            to = i + 1 < bound.pieces.length ? (p.to + bound.pieces[i + 1].from) / 2 : high;
        root.append(svg("rect", { x: x(from), y: 3, width: x(to) - x(from), height: 10, class: p.level }));
    });
    if (typeof planned === "number" && planned >= low && planned <= high)
        root.append(svg("rect", { x: x(planned) - 1.5, y: 0, width: 3, height: 16, class: "plan" }));
    return root;
}

function caseAudit(audit, outcome) {
    const names = Object.fromEntries(audit.limits.map(l => [l.name, l.what]));
    const why = end =>
        end.stopped_beyond
            ? `${names[end.stopped_beyond.limit] ?? end.stopped_beyond.limit}${end.stopped_beyond.where ? `, ${end.stopped_beyond.where}` : ""}`
            : "no limit in the range looked at";
    const rows = audit.bounds.map(b => {
        const planned = outcome.plan.measures[b.control],
            unit = b.unit === "deg" ? "°" : ` ${b.unit}`;
        return [
            { text: (names[b.control] ?? b.control) + "," + unit, head: true, title: b.control },
            { text: digits(planned), value: planned, class: "number" },
            { text: digits(b.low.feasible_to), value: b.low.feasible_to, class: "number" },
            why(b.low),
            { text: digits(b.high.feasible_to), value: b.high.feasible_to, class: "number" },
            why(b.high),
            { text: bar(b, planned) },
        ];
    });
    return [
        table(
            "How far each control may go, all others as the audit found them; the mark is this plan",
            [
                "Control",
                { text: "planned", class: "number" },
                { text: "from", class: "number" },
                "because of",
                { text: "to", class: "number" },
                "because of",
                "fine, caution, stop",
            ],
            rows,
            { class: "bounds" },
        ),
    ];
}

/** audit: what gnathos audit wrote, of the plan or of the case; or null. */
export const feasibility = (outcome, audit) => [
    ...planAudit(outcome.limits, audit?.bounds ? null : audit),
    ...(audit?.bounds ? caseAudit(audit, outcome) : []),
];
