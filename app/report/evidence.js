// Evidence, limits and provenance, as outcome.json states them.
import { fixed, make, number, scientific, table } from "./text.js";

const list = pairs =>
    make(
        "dl",
        {},
        pairs.filter(Boolean).map(([name, value]) => make("div", {}, make("dt", {}, name), make("dd", {}, value))),
    );

/** Residual against iteration on a logarithmic scale. */
function convergence(solve) {
    const svg = (tag, attributes, text) => {
        const e = document.createElementNS("http://www.w3.org/2000/svg", tag);
        for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
        if (text) e.textContent = text;
        return e;
    };
    const points = solve.record.filter(r => r.residual_mN > 0);
    if (points.length < 2) return null;
    const logs = points.map(r => Math.log10(r.residual_mN)),
        tolerance = Math.log10(solve.tolerance_mN || 1e-9);
    const low = Math.floor(Math.min(tolerance, ...logs)),
        high = Math.ceil(Math.max(...logs));
    const w = 360,
        h = 150,
        left = 44,
        bottom = 26,
        top = 8;
    const x = i => left + ((w - left - 8) * i) / (points.length - 1),
        y = v => top + ((h - top - bottom) * (high - v)) / (high - low);
    const root = svg("svg", {
        viewBox: `0 0 ${w} ${h}`,
        role: "img",
        class: "chart",
        "aria-label": "Residual force, iteration by iteration",
    });
    for (let p = high; p >= low; p -= Math.max(1, Math.round((high - low) / 4))) {
        root.append(
            svg("line", { x1: left, x2: w - 8, y1: y(p), y2: y(p), class: "grid" }),
            svg(
                "text",
                { x: left - 6, y: y(p) + 3.5, "text-anchor": "end" },
                scientific(10 ** p).replace("1.0 × ", ""),
            ),
        );
    }
    root.append(
        svg("line", { x1: left, x2: w - 8, y1: y(tolerance), y2: y(tolerance), class: "tolerance" }),
        svg("polyline", {
            points: logs.map((v, i) => `${x(i).toFixed(1)},${y(v).toFixed(1)}`).join(" "),
            class: "curve",
        }),
        svg(
            "text",
            { x: (left + w) / 2, y: h - 4, "text-anchor": "middle" },
            `residual force in mN, iteration by iteration, in ${solve.loads} load steps`,
        ),
        svg("text", { x: w - 10, y: y(tolerance) - 4, "text-anchor": "end" }, "tolerance"),
    );
    return root;
}

export function evidence(outcome) {
    const s = outcome.solve,
        c = s.contact,
        p = outcome.prepared,
        material = outcome.material;
    const inverted =
        s.inverted_tets > 0
            ? make(
                  "p",
                  { class: "warning" },
                  `${s.inverted_tets} tetrahedra of the tissue are ` +
                      "turned inside out: the shape is not to be trusted near them.",
              )
            : null;
    return [
        inverted,
        make(
            "div",
            { class: "columns" },
            list([
                ["Outcome of the solve", `${s.outcome}, ${s.iterations} iterations`],
                ["Residual force", `${scientific(s.relative_residual)} of the initial one`],
                ["Balance of forces", `open by ${scientific(Math.abs(s.force_imbalance))}`],
                ["Tets turned inside out", String(s.inverted_tets)],
                ["Tets kept from turning inside out", String(s.crushed_tets ?? 0)],
                ["Smallest volume ratio J", fixed(s.min_J, 2)],
                ["Largest stretch", fixed(s.largest_stretch, 2)],
                c.on
                    ? [
                          "Contact",
                          `${c.touching_nodes} of ${c.nodes} nodes touch, deepest ${fixed(c.depth_mm, 3)} mm, up to ${fixed(c.pressure_kPa)} kPa`,
                      ]
                    : ["Contact", "off"],
                ["Tissue", `Young’s modulus ${material.young_kpa} kPa, Poisson’s ratio ${material.poisson}`],
                [
                    "Mesh",
                    `${p.mesh.nodes} nodes, ${p.mesh.tets} tetrahedra, dihedral angles ${fixed(p.mesh.min_dihedral_deg)}° to ` +
                        `${fixed(p.mesh.max_dihedral_deg)}°, radius ratio at least ${fixed(p.mesh.min_radius_ratio, 3)}`,
                ],
                [
                    "Error of the mesh",
                    typeof outcome.discretisation_error_mm === "number"
                        ? `${fixed(outcome.discretisation_error_mm, 2)} mm`
                        : outcome.discretisation_error_note,
                ],
                [
                    "Tied tissue to bone",
                    p.attachment.max_bone_gap_mm < 0.0005
                        ? "less than 0.001 mm"
                        : `at most ${fixed(p.attachment.max_bone_gap_mm, 3)} mm`,
                ],
            ]),
            convergence(s),
        ),
    ];
}

export function cuts(outcome) {
    const c = outcome.prepared.cuts;
    const rows = c.clearance.map(k => ({
        class: k.ok ? null : "bad",
        cells: [
            { text: k.what, head: true },
            number(k.value_mm, (k.estimated ? "≈ " : "") + fixed(k.value_mm, 2)),
            number(k.limit_mm, fixed(k.limit_mm, 2)),
            k.ok ? "kept" : "too close",
        ],
    }));
    return [
        rows.length
            ? table(
                  "Clearance of the cuts, mm (≈ estimated)",
                  ["Between", { text: "is", class: "number" }, { text: "at least", class: "number" }, ""],
                  rows,
              )
            : null,
    ].filter(Boolean);
}

export function scene(outcome) {
    const error = l =>
        typeof l.skin_error_mm === "number" ? `about ${fixed(l.skin_error_mm, 3)} mm` : "not estimated";
    return [
        make("p", { class: "lead" }, "Modelled: " + outcome.scene.on.join("; ") + "."),
        table(
            "Left out",
            ["What", "Why", "Error on the skin"],
            outcome.scene.left_out.map(l => [{ text: l.what, head: true }, l.why, error(l)]),
            { class: "prose" },
        ),
    ];
}

export function provenance(outcome, scene, shapes, bytes) {
    const triangles = shapes.reduce((sum, s) => sum + s.triangles, 0);
    return list([
        ["gnathos", outcome.version + (scene.version === outcome.version ? "" : `; this page ${scene.version}`)],
        ["Inputs of the case, hash", make("code", {}, outcome.case_hash)],
        ["outcome.json, SHA-256", make("code", {}, scene.outcome_sha256)],
        [
            "Shapes in this page",
            `${triangles.toLocaleString("en")} triangles, none left out, ${(bytes / 1e6).toFixed(1)} MB; ` +
                `positions rounded to ${scene.step_mm} mm, displacements to ${scene.displacement_step_mm} mm: ` +
                `at most ${scene.largest_error_mm.toFixed(4)} mm off`,
        ],
        [
            "Time",
            `preparation ${fixed(outcome.seconds.prepare_wall)} s, solve ${fixed(outcome.seconds.solve_wall)} s, ` +
                `memory ${fixed(outcome.peak_memory_MB, 0)} MB`,
        ],
        outcome.withheld.length ? ["Not shown in this page", outcome.withheld.join("; ")] : null,
        ["Drawn with", "three.js, MIT licence (its notice is in the page’s source)"],
    ]);
}
