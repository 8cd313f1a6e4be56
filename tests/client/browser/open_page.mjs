// SPDX-License-Identifier: MIT
// openPage: opens a page in headless Chromium, served by a local HTTP server that also receives the page's posts. Needs
// no network and no WebDriver.
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import http from "node:http";
import os from "node:os";
import path from "node:path";

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".glb": "model/gltf-binary" };

function startServer(answer, received) {
    const server = http.createServer(async (request, response) => {
        const [, ...parts] = decodeURIComponent(request.url.split("?")[0]).split("/");
        try {
            if (request.method === "POST") {
                const bytes = [];
                for await (const part of request) bytes.push(part);
                received(parts, Buffer.concat(bytes));
                return response.end();
            }
            const given = parts.includes("..") ? undefined : answer(parts);
            if (given === undefined) return response.writeHead(404).end();
            if (given.json !== undefined) return response.end(JSON.stringify(given.json));
            const type = TYPES[path.extname(given.file)] ?? "application/octet-stream";
            response.writeHead(200, { "content-type": type }).end(readFileSync(given.file));
        } catch (error) {
            response.writeHead(404).end(String(error));
        }
    });
    return new Promise((done) => server.listen(0, "127.0.0.1", () => done(server)));
}

/// Starts Chromium with all of its files in `home`. Uses software rendering, so that all machines give the same
/// picture.
function startChromium(chromium, more_flags, address, home) {
    const flags = [
        "--headless", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
        "--no-sandbox", // root may not have a sandbox, and the page is trusted
        "--disable-dev-shm-usage", // /dev/shm is small in containers
        "--no-first-run", "--no-proxy-server", "--disable-background-networking", "--disable-component-update",
        "--disable-extensions", "--disable-sync", "--disable-crash-reporter", "--disable-breakpad", "--mute-audio",
        `--user-data-dir=${home}/profile`, `--crash-dumps-dir=${home}/crashes`,
    ];
    const env = { ...process.env, HOME: home, TMPDIR: home, XDG_CONFIG_HOME: home, XDG_CACHE_HOME: home, XDG_RUNTIME_DIR: home };
    // Chromium gets a process group of its own, so that all of its processes can be ended together.
    return spawn(chromium, [...flags, ...more_flags, address], { env, detached: true, stdio: ["ignore", "ignore", "pipe"] });
}

/// Ends the process group. Processes that remain after two seconds are killed.
async function stopGroup(pid) {
    const there = (signal) => { try { return process.kill(-pid, signal); } catch { return false; } };
    there("SIGTERM");
    for (let i = 0; i < 100 && there(0); ++i) {
        if (i === 20) there("SIGKILL");
        await new Promise((done) => setTimeout(done, 100));
    }
}

/// Opens `page`, an address on the server, and returns the data that it posts to /done. Throws if the page posts to
/// /failed, or nothing within `timeout_ms`. answer(parts of an address) returns { file: path }, { json: value } or
/// undefined. received(parts, bytes) is called for other posts.
export async function openPage({ chromium, flags = [], page, answer, received, timeout_ms }) {
    const home = mkdtempSync(path.join(os.tmpdir(), "tspace-chromium-"));
    const outcome = {};
    const finished = new Promise((resolve, reject) => Object.assign(outcome, { resolve, reject }));
    const timer = setTimeout(() => outcome.reject(new Error(`nothing came within ${timeout_ms / 1000} s`)), timeout_ms);
    for (const signal of ["SIGTERM", "SIGINT", "SIGHUP"]) process.once(signal, () => outcome.reject(new Error(signal)));
    let server, browser, log = "";
    try {
        server = await startServer(answer, (parts, bytes) => {
            if (parts[0] === "done") outcome.resolve(bytes.toString());
            else if (parts[0] === "failed") outcome.reject(new Error(bytes.toString()));
            else received(parts, bytes);
        });
        browser = startChromium(chromium, flags, `http://127.0.0.1:${server.address().port}${page}`, home);
        browser.stderr.on("data", (text) => (log += text));
        browser.once("error", outcome.reject);
        browser.once("exit", (code) => outcome.reject(new Error(`Chromium ended with ${code}`)));
        return await finished;
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
}
