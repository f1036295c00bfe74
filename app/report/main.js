// The page: reads its data blocks, fills the tables, and opens the viewer where the browser can draw in 3-D.
import { feasibility } from "./feasibility.js";
import { cuts, evidence, provenance, scene as sceneOf } from "./evidence.js";
import { bytesOf, unpackShapes } from "./shapes.js";
import { cephalometry, landmarks, movementNote, movements, softToHard, summary } from "./tables.js";
import { make } from "./text.js";
import { openViewer } from "./viewer.js";

const byId = id => document.getElementById(id);
const block = id => byId(id) && JSON.parse(byId(id).textContent);

function fill(id, ...content) {
    byId(id).append(...content.flat().filter(Boolean));
}

/** The sphere to show: the face from brow to neck, as in the stills; without its landmarks the whole skin. */
function regionOf(outcome, scene, skin) {
    const at = label => outcome.landmarks.find(l => l.label === label)?.before_lps_mm;
    const nasion = at("N"),
        menton = at("Me");
    if (nasion && menton)
        return {
            centre: nasion.map((x, i) => (x + menton[i]) / 2 + 22 * scene.frame.posterior[i]),
            radius: 0.86 * Math.hypot(...nasion.map((x, i) => x - menton[i])),
        };
    const low = [Infinity, Infinity, Infinity],
        high = [-Infinity, -Infinity, -Infinity];
    skin.xyz.forEach((x, i) => {
        low[i % 3] = Math.min(low[i % 3], x);
        high[i % 3] = Math.max(high[i % 3], x);
    });
    return { centre: low.map((x, i) => (x + high[i]) / 2), radius: Math.hypot(...high.map((x, i) => x - low[i])) / 2 };
}

function fillTables(outcome, scene, audit) {
    if (outcome.case) document.title = `${outcome.case}: predicted face`;
    fill("names", [outcome.case, outcome.plan.name].filter(Boolean).join(" · "));
    fill(
        "summary",
        summary(outcome).map(text => make("li", {}, text)),
    );
    if (outcome.plan.override || outcome.withheld.some(w => w.startsWith("reason")))
        fill(
            "override",
            "The plan leaves the bounds of the case" +
                (outcome.plan.override
                    ? `, because: ${outcome.plan.override}`
                    : "; its reason is in outcome.json and not shown here") +
                ".",
        );
    fill(
        "movement",
        make("div", {}, movements(outcome), make("p", { class: "note" }, movementNote)),
        softToHard(outcome),
    );
    fill("ceph", cephalometry(outcome));
    fill("points", landmarks(outcome, scene.landmark_help));
    fill("feasibility", feasibility(outcome, audit));
    fill("trust", outcome.trust);
    fill(
        "evidence",
        evidence(outcome),
        make("div", { class: "pair" }, make("div", {}, sceneOf(outcome)), make("div", {}, cuts(outcome))),
    );
}

async function start() {
    const outcome = block("outcome"),
        scene = block("scene"),
        text = byId("shapes").textContent;
    fillTables(outcome, scene, block("audit"));
    fill("provenance", provenance(outcome, scene, scene.shapes, text.length));
    try {
        const shapes = await unpackShapes(text, scene);
        const maps = Object.fromEntries(Object.entries(scene.maps).map(([name, t]) => [name, bytesOf(t)]));
        const skin = shapes.find(s => s.moves);
        window.stage = openViewer(byId("stage"), byId("controls"), {
            shapes,
            points: outcome.landmarks,
            frame: scene.frame,
            maps,
            movedHigh: scene.heat_high_mm,
            region: regionOf(outcome, scene, skin),
        });
        document.documentElement.classList.add("three");
    } catch (error) {
        byId("viewer").hidden = true;
        fill(
            "no-viewer",
            `The 3-D view needs WebGL 2, which this browser does not offer (${error.message}); the stills show the same.`,
        );
    }
}

start();
