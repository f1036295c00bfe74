// report.mjs FOLDER: FOLDER/out is an outcome, FOLDER/report.html its page, FOLDER/named.html the page of the same outcome
// with hostile names, made with --name, and FOLDER/unnamed.html without it. Each is opened in a headless browser.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { openBrowser } from "./browser.mjs";

const folder = process.argv[2],
    page = name => `file://${join(folder, name)}`;
const outcome = JSON.parse(readFileSync(join(folder, "out/outcome.json"), "utf8"));
const rounded = (x, digits = 1) =>
    (Number(x.toFixed(digits)) === 0 ? (0).toFixed(digits) : x.toFixed(digits)).replace("-", "−");

async function open(name, more) {
    const b = await openBrowser("1280,800", more),
        complaints = [],
        requests = [];
    b.on("Runtime.consoleAPICalled", p =>
        complaints.push(`${p.type}: ${p.args.map(a => a.value ?? a.description).join(" ")}`),
    );
    b.on("Runtime.exceptionThrown", p => complaints.push(p.exceptionDetails.exception?.description));
    b.on("Log.entryAdded", p => complaints.push(`${p.entry.level}: ${p.entry.text}`));
    b.on("Network.requestWillBeSent", p => requests.push(p.request.url.slice(0, 60)));
    await b.send("Page.navigate", { url: page(name) });
    await until(b, "Boolean(window.stage?.drawn || document.getElementById('no-viewer')?.textContent)");
    return { ...b, complaints, requests };
}

async function until(b, condition) {
    while (!(await b.evaluate(condition))) await new Promise(r => setTimeout(r, 100)); // ctest limits the time
}

async function key(b, name) {
    for (const type of ["keyDown", "keyUp"])
        await b.send("Input.dispatchKeyEvent", {
            type,
            key: name,
            code: name,
            windowsVirtualKeyCode: { End: 35, Home: 36, ArrowLeft: 37 }[name],
        });
}

/** The pixels of the stage as numbers, after `action`. */
const pixels = (b, action = "") =>
    b.evaluate(`(() => {
    ${action};
    stage.draw();
    const gl = stage.renderer.getContext(), w = gl.drawingBufferWidth, h = gl.drawingBufferHeight, all = new Uint8Array(4 * w * h);
    gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, all);
    const row = [];
    for (let y = 0; y < h; y += 4) for (let x = 0; x < w; x += 4) row.push(all[4 * (y * w + x)] << 16 | all[4 * (y * w + x) + 1] << 8 | all[4 * (y * w + x) + 2]);
    return { width: Math.ceil(w / 4), row };
})()`);
const differing = (a, b, where = () => true) => a.row.filter((x, i) => where(i % a.width) && x !== b.row[i]).length;
const choose = (name, value) => `document.querySelector('[name=${name}][value=${value}]').click()`;

async function drawsAndMoves(b) {
    await b.evaluate(choose("mode", "blend"));
    const ground = 0xf2f4f6,
        before = await pixels(b, "stage.setView('left')");
    const head = before.row.filter(x => x !== ground).length;
    assert.ok(
        head > 0.1 * before.row.length && head < 0.95 * before.row.length,
        `a head is drawn: ${head} of ${before.row.length}`,
    );
    assert.ok(new Set(before.row).size > 100, "it is shaded");
    await b.evaluate("document.getElementById('morph').focus()");
    await key(b, "End");
    assert.equal(await b.evaluate("document.getElementById('morph').value"), "100", "the slider obeys the keyboard");
    const planned = await pixels(b);
    assert.ok(differing(before, planned) > 100, "the slider changes pixels");
    await b.evaluate(choose("mode", "wipe"));
    const wipe = await pixels(b),
        middle = wipe.width / 2;
    assert.equal(
        differing(wipe, before, x => x < middle - 1),
        0,
        "left of the line is the face before",
    );
    assert.equal(
        differing(wipe, planned, x => x > middle + 1),
        0,
        "right of it the planned one, seen by the same eye",
    );
    await b.evaluate(choose("mode", "blend"));
    await b.evaluate("stage.canvas.focus()");
    await key(b, "ArrowLeft");
    assert.ok(differing(planned, await pixels(b)) > 100, "arrows turn the head");
    assert.ok(
        differing(planned, await pixels(b, choose("colour", "moved") + "; stage.setView('left')")) > 100,
        "the heat map shows",
    );
    const bones = await pixels(b, choose("layers", "none")),
        without = await pixels(b, "document.querySelector('.ticks-list input').click()");
    assert.ok(differing(bones, without) > 100, "a segment can be put away");
}

async function readsOut(b) {
    await b.evaluate(`${choose("layers", "whole")}; stage.setView('front'); stage.draw()`);
    const box = await b.evaluate(
        "(() => { const r = stage.canvas.getBoundingClientRect(); return [r.left + r.width / 2, r.top + r.height * 0.75]; })()",
    );
    await b.send("Input.dispatchMouseEvent", { type: "mouseMoved", x: box[0], y: box[1] });
    await until(b, "document.querySelector('.readout').textContent.includes('mm (')");
    const [text, moved] = await b.evaluate(`[document.querySelector('.readout').textContent, (() => {
        const r = stage.canvas.getBoundingClientRect(), found = stage.at(${box[0]} - r.left, ${box[1]} - r.top);
        return stage.moved(found.vertex); })()]`);
    assert.ok(text.startsWith(`Skin: ${rounded(moved)} mm (`), text);
}

/** Vertices of a binary .ply of doubles, as gnathos writes it. */
function vertices(path) {
    const bytes = readFileSync(path),
        end = bytes.indexOf("end_header\n") + 11,
        header = bytes.subarray(0, end).toString();
    const count = Number(/element vertex (\d+)/.exec(header)[1]),
        size = 24 + (header.includes("uchar red") ? 3 : 0);
    return {
        count,
        triangles: Number(/element face (\d+)/.exec(header)[1]),
        at: v => [0, 8, 16].map(k => bytes.readDoubleLE(end + size * v + k)),
    };
}

async function holdsEveryVertex(b) {
    const before = vertices(join(folder, "out/skin_before.ply")),
        after = vertices(join(folder, "out/skin_after.ply")),
        step = 17;
    const [count, triangles, xyz, u, stated] = await b.evaluate(`(() => {
        const s = stage.skin, some = a => Array.from({ length: Math.ceil(s.vertices / ${step}) }, (_, i) => [...a.subarray(3 * ${step} * i, 3 * ${step} * i + 3)]);
        return [s.vertices, s.triangles.length / 3, some(s.xyz), some(s.u), JSON.parse(document.getElementById('scene').textContent).largest_error_mm]; })()`);
    assert.deepEqual([count, triangles], [before.count, before.triangles], "nothing is left out");
    assert.ok(stated < 0.01);
    xyz.forEach((p, i) => {
        const rest = before.at(step * i),
            end = after.at(step * i);
        assert.ok(Math.hypot(...rest.map((x, c) => x - p[c])) <= stated, "positions are as exact as stated");
        assert.ok(Math.hypot(...end.map((x, c) => x - p[c] - u[i][c])) <= stated + 1e-4, "and so are the planned ones");
    });
}

async function tablesHoldTheOutcome(b) {
    const cells = await b.evaluate(
        `[...document.querySelectorAll("table")].flatMap(t => [...t.tBodies[0].rows].map(r => [...r.cells].map(c => c.textContent)))`,
    );
    const row = label => cells.find(r => r[0] === label) ?? assert.fail(`no row ${label}`);
    for (const m of outcome.cephalometry) {
        const found = row(m.unit === "deg" ? m.name : `${m.name}, ${m.unit}`),
            unit = m.unit === "deg" ? "°" : "";
        if (typeof m.before !== "number") continue;
        assert.deepEqual(
            found.slice(1, 3),
            [m.before, m.planned].map(x => rounded(x) + unit),
            m.name,
        );
        assert.equal(found[3].replace("+", ""), rounded(m.change) + unit, m.name);
    }
    const moves = cells.filter(r => outcome.movements.some(m => r[1] === m.at) && r.length === 8);
    assert.equal(moves.length, outcome.movements.length);
    outcome.movements.forEach((m, i) => {
        const want = [m.left_mm, m.anterior_mm, m.up_mm, m.yaw_deg, m.pitch_deg, m.roll_deg].map(x =>
            rounded(Math.abs(x)),
        );
        assert.deepEqual(
            moves[i].slice(2).map(t => t.split(/[ °]/)[0]),
            want,
            m.segment,
        );
    });
    outcome.movements.forEach((m, i) => {
        if (Math.abs(m.anterior_mm) < 0.05) return;
        assert.ok(moves[i][3].endsWith(m.anterior_mm > 0 ? " anterior" : " posterior"), `${m.segment}: ${moves[i][3]}`);
    });
    const limits = cells.filter(r => r.length === 6 && ["stop", "caution", "not judged"].includes(r[0]));
    const named = l => [l.what, l.where].filter(Boolean).join(", ");
    const alarming = outcome.limits.limits.filter(l => l.level !== "fine");
    assert.ok(alarming.length > 0);
    for (const l of alarming) // an audit beside it hides nothing of the prediction
        assert.ok(
            limits.some(r => r[0] === l.level && r[1] === named(l)),
            `no row of ${named(l)}`,
        );
    const audit = JSON.parse(readFileSync(join(folder, "out/audit.json"), "utf8"));
    assert.ok(
        limits.some(r => r[0] === "stop" && r[1] === `${named(audit.limits[0])}, by the audit` && r[2] === "8.25 mm"),
        "nor the other way round",
    );
    const text = await b.evaluate("document.body.innerText");
    assert.ok(text.includes("Not feasible as it stands") && text.includes("maxilla_advance_mm 8.25 → 8.00 mm"));
    const first = outcome.limits.limits.find(l => l.limit === outcome.limits.decides);
    assert.ok(text.includes(`First ${outcome.limits.worst}: ${named(first)}: `), "what decides leads");
    for (const said of [
        outcome.trust,
        outcome.case_hash,
        `${outcome.solve.iterations} iterations`,
        outcome.scene.left_out[0].what,
    ])
        assert.ok(text.includes(said), said);
}

async function test(name, run) {
    await run();
    console.log(`ok: ${name}`);
}

await test("the page of an outcome", async () => {
    const b = await open("report.html");
    try {
        await drawsAndMoves(b);
        await readsOut(b);
        await holdsEveryVertex(b);
        await tablesHoldTheOutcome(b);
        const stills = await b.evaluate("[...document.querySelectorAll('#stills img')].map(i => i.naturalWidth)");
        assert.ok(stills.length > 0 && stills.every(w => w > 200), "stills are there for printing");
        const { data } = await b.send("Page.printToPDF", { preferCSSPageSize: true, printBackground: true });
        const pages = Buffer.from(data, "base64")
            .toString("latin1")
            .match(/\/Type\s*\/Page\b/g).length;
        assert.ok(pages >= 1 && pages <= 4, `${pages} pages on paper`);
        assert.deepEqual(
            b.complaints.filter(c => !/GL Driver Message/.test(c)),
            [],
            "the console is quiet",
        );
        assert.deepEqual(
            b.requests.filter(r => !/^(file|data|blob):/.test(r)),
            [],
            "nothing is fetched",
        );
        await b.evaluate(
            "(() => { const s = document.createElement('script'); s.textContent = 'window.ran = 1'; document.body.append(s); })()",
        );
        assert.equal(await b.evaluate("window.ran === undefined"), true, "no other script runs");
    } finally {
        await b.close();
    }
});

await test("a browser without WebGL shows the stills and all tables", async () => {
    const b = await open("report.html", ["--disable-3d-apis"]);
    try {
        assert.ok(await b.evaluate("document.querySelector('#stills img').getBoundingClientRect().width > 100"));
        assert.ok(await b.evaluate("document.getElementById('viewer').hidden"));
        await tablesHoldTheOutcome(b);
    } finally {
        await b.close();
    }
});

await test("names are shown when asked for, as text", async () => {
    const b = await open("named.html");
    try {
        assert.ok(
            (await b.evaluate("document.getElementById('names').textContent")).includes(
                "</script><img src=x onerror=alert(1)> Mustermann",
            ),
        );
        assert.ok((await b.evaluate("document.getElementById('override').textContent")).includes("<b>Mustermann"));
        assert.equal(await b.evaluate("document.querySelectorAll('img[src=x], #override b').length"), 0);
        assert.deepEqual(
            b.complaints.filter(c => !/GL Driver Message/.test(c)),
            [],
        );
    } finally {
        await b.close();
    }
});

await test("and not otherwise", async () => {
    assert.ok(!readFileSync(join(folder, "unnamed.html"), "utf8").includes("Mustermann"));
    assert.ok(!readFileSync(join(folder, "report.html"), "utf8").includes(JSON.stringify(outcome.case)));
});
