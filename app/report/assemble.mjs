// assemble.mjs PAGE STYLE SCRIPT OUT: puts style and script into the page, and their hashes into its security policy.
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";

const [page, style, script] = process.argv.slice(2, 5).map(path => readFileSync(path, "utf8"));
const hash = text => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
if (/<\/(script|style)/i.test(script + style)) throw new Error("a closing tag inside the script or the style");

const parts = {
    "{{policy}}":
        `default-src 'none'; script-src ${hash(script)}; style-src ${hash(style)}; img-src data:; ` +
        "base-uri 'none'; form-action 'none'",
    "{{style}}": style,
    "{{script}}": script,
};
let out = page;
for (const [mark, text] of Object.entries(parts)) {
    if (out.split(mark).length !== 2) throw new Error(`${mark} must stand in the page once`);
    out = out.replace(mark, () => text);
}
writeFileSync(process.argv[5], out);
