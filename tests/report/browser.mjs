// A headless Chromium, driven through its debugging pipe (Chrome DevTools Protocol; messages end in a zero byte).
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export const findBrowser = () => ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(p => existsSync(p));

const flags = [
    "--headless",
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",
    "--remote-debugging-pipe",
];

/** { send(method, params), evaluate(expression), on(event, handler), close() } of one blank page. */
export async function openBrowser(size, more = []) {
    const profile = mkdtempSync(join(tmpdir(), "gnathos-browser-"));
    const child = spawn(
        findBrowser(),
        [...flags, `--window-size=${size}`, `--user-data-dir=${profile}`, ...more, "about:blank"],
        { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] },
    );
    const waiting = new Map(),
        handlers = [];
    let number = 0,
        rest = Buffer.alloc(0),
        session;
    const gone = new Promise(resolve => child.once("exit", resolve));
    gone.then(() => waiting.forEach(w => w.reject(new Error("the browser ended"))));
    child.stdio[4].on("data", data => {
        rest = Buffer.concat([rest, data]);
        for (let end; (end = rest.indexOf(0)) >= 0; rest = rest.subarray(end + 1)) {
            const message = JSON.parse(rest.subarray(0, end).toString());
            const asked = waiting.get(message.id);
            waiting.delete(message.id);
            if (asked) message.error ? asked.reject(new Error(message.error.message)) : asked.resolve(message.result);
            else handlers.filter(h => h.event === message.method).forEach(h => h.act(message.params));
        }
    });
    const send = (method, params = {}) =>
        new Promise((resolve, reject) => {
            waiting.set(++number, { resolve, reject });
            child.stdio[3].write(JSON.stringify({ id: number, method, params, sessionId: session }) + "\0");
        });
    const { targetInfos } = await send("Target.getTargets");
    const page = targetInfos.find(t => t.type === "page");
    session = (await send("Target.attachToTarget", { targetId: page.targetId, flatten: true })).sessionId;
    for (const domain of ["Page", "Runtime", "Log", "Network"]) await send(`${domain}.enable`);
    return {
        send,
        on: (event, act) => handlers.push({ event, act }),
        async evaluate(expression) {
            const { result, exceptionDetails } = await send("Runtime.evaluate", {
                expression,
                awaitPromise: true,
                returnByValue: true,
            });
            if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
            return result.value;
        },
        async close() {
            send("Browser.close").catch(() => {}); // it may end before it answers
            await gone;
            rmSync(profile, { recursive: true, force: true, maxRetries: 20, retryDelay: 100 }); // its helpers end a little later
        },
    };
}
