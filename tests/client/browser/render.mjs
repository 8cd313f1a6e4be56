// SPDX-License-Identifier: MIT
// renderModels: opens page.html in headless Chromium, with its own little server on this machine, and returns what the
// page sends back. No network, no driver: the server is all that the two need to talk.
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import http from "node:http";
import os from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";

const page_folder = path.dirname(fileURLToPath(import.meta.url));
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".glb": "model/gltf-binary" };

/// Addresses below /page and /three are files; /models/NAME is models[NAME]; the page posts to the others.
function fileFor(address, three_folder, models) {
    const [, area, ...rest] = decodeURIComponent(address).split("/");
    if (area === "models") return models[rest.join("/")];
    const folder = { page: page_folder, three: three_folder }[area];
    return folder && !rest.includes("..") ? path.join(folder, ...rest) : undefined;
}

/// `received(address, bytes)` gets what the page posts.
function startServer(three_folder, models, received) {
    const server = http.createServer(async (request, response) => {
        const address = request.url.split("?")[0];
        try {
            if (request.method === "POST") {
                const parts = [];
                for await (const part of request) parts.push(part);
                received(address, Buffer.concat(parts));
                return response.end();
            }
            if (address === "/list") return response.end(JSON.stringify(Object.keys(models)));
            const file = fileFor(address, three_folder, models);
            if (!file) return response.writeHead(404).end();
            const bytes = readFileSync(file);
            response.writeHead(200, { "content-type": TYPES[path.extname(file)] ?? "application/octet-stream" }).end(bytes);
        } catch (error) {
            response.writeHead(404).end(String(error));
        }
    });
    return new Promise((done) => server.listen(0, "127.0.0.1", () => done(server)));
}

/// A Chromium whose files all lie in `home`. Software rendering, so that any machine gives the same picture.
function startChromium(chromium, address, home) {
    const flags = [
        "--headless", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
        "--no-sandbox", // root may not have one, and the page is ours
        "--disable-dev-shm-usage", // /dev/shm is small in containers
        "--no-first-run", "--no-proxy-server", "--disable-background-networking", "--disable-component-update",
        "--disable-extensions", "--disable-sync", "--disable-crash-reporter", "--disable-breakpad", "--mute-audio",
        `--user-data-dir=${home}/profile`, `--crash-dumps-dir=${home}/crashes`,
    ];
    const env = { ...process.env, HOME: home, TMPDIR: home, XDG_CONFIG_HOME: home, XDG_CACHE_HOME: home, XDG_RUNTIME_DIR: home };
    // A process group of its own: ending the group ends all of Chromium's processes.
    return spawn(chromium, [...flags, address], { env, detached: true, stdio: ["ignore", "ignore", "pipe"] });
}

/// Ends the group. What does not go within two seconds is killed.
async function stopGroup(pid) {
    const there = (signal) => { try { return process.kill(-pid, signal); } catch { return false; } };
    there("SIGTERM");
    for (let i = 0; i < 100 && there(0); ++i) {
        if (i === 20) there("SIGKILL");
        await new Promise((done) => setTimeout(done, 100));
    }
}

/// models: name -> path of a GLB. Returns { by: what rendered, pixels: name -> side -> bytes, pictures: the same, PNG }.
export async function renderModels({ chromium, three_folder, models, timeout_ms }) {
    const home = mkdtempSync(path.join(os.tmpdir(), "tspace-chromium-"));
    const result = { pixels: {}, pictures: {} };
    const outcome = {};
    const finished = new Promise((resolve, reject) => Object.assign(outcome, { resolve, reject }));
    const timer = setTimeout(() => outcome.reject(new Error(`nothing came within ${timeout_ms / 1000} s`)), timeout_ms);
    for (const signal of ["SIGTERM", "SIGINT", "SIGHUP"]) process.once(signal, () => outcome.reject(new Error(signal)));
    let server, browser, log = "";
    try {
        server = await startServer(three_folder, models, (address, bytes) => {
            const [, what, name, side] = address.split("/");
            if (what === "done") outcome.resolve((result.by = bytes.toString()));
            else if (what === "failed") outcome.reject(new Error(bytes.toString()));
            else ({ pixels: result.pixels, picture: result.pictures }[what][name] ??= {})[side] = bytes;
        });
        browser = startChromium(chromium, `http://127.0.0.1:${server.address().port}/page/page.html`, home);
        browser.stderr.on("data", (text) => (log += text));
        browser.once("error", outcome.reject);
        browser.once("exit", (code) => outcome.reject(new Error(`Chromium ended with ${code}`)));
        await finished;
    } catch (error) {
        error.message += `\n${log.slice(-2000)}`;
        throw error;
    } finally {
        clearTimeout(timer);
        if (browser?.pid) await stopGroup(browser.pid);
        server?.closeAllConnections();
        server?.close();
        rmSync(home, { recursive: true, force: true, maxRetries: 5 });
    }
    return result;
}
