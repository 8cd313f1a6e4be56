// SPDX-License-Identifier: MIT
// Page and lesson in Debian's Firefox, controlled by puppeteer-core with WebDriver BiDi, because playwright-core does not
// support it. WebGL needs a display, which Xvfb provides.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { decode } from "fast-png";
import { kPatience, page, screenshots, tool } from "./support.mjs";

const firefox = ["/usr/bin/firefox-esr", "/usr/bin/firefox"].find(existsSync);
const puppeteer = (await import("puppeteer-core").catch(() => null))?.default;
const lesson = process.env.TSPACE_LESSON;
const skip = (!firefox && "no Firefox here: scripts/web --all") || (!puppeteer && "puppeteer-core is not installed")
  || (!existsSync("/usr/bin/Xvfb") && "no Xvfb here: scripts/web --all") || (!page && "the page was not built") || false;
const timeout = 5 * kPatience;

let home, display, browser;

/** Starts Xvfb; resolves with the number of the display that Xvfb chose. */
const startDisplay = () => new Promise((done, fail) => {
  display = spawn("/usr/bin/Xvfb", ["-displayfd", "3", "-screen", "0", "1600x1200x24", "-nolisten", "tcp"], { stdio: ["ignore", "ignore", "ignore", "pipe"] });
  display.on("error", fail);
  display.on("exit", () => fail(new Error("Xvfb ended")));
  display.stdio[3].once("data", (number) => done(`:${String(number).trim()}`));
});

before(async () => {
  if (skip) return;
  home = mkdtempSync(join(tmpdir(), "tspace-home-"));
  browser = await puppeteer.launch({
    browser: "firefox", executablePath: firefox, headless: false, timeout: kPatience, protocolTimeout: kPatience,
    env: { ...process.env, DISPLAY: await startDisplay(), HOME: home, XDG_RUNTIME_DIR: home },
  });
}, { timeout });
after(async () => {
  await browser?.close();
  display?.removeAllListeners("exit");
  display?.kill();
  if (home) rmSync(home, { recursive: true, force: true });
});

/** Calls run(tab) on a page. Any error, and any request except for the page and its embedded data, fails the test. */
async function withTab(url, viewport, run) {
  const tab = await browser.newPage(), faults = [];
  tab.setDefaultTimeout(kPatience);
  tab.on("pageerror", (error) => faults.push(error.message));
  tab.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  tab.on("request", (request) => !/^(data|blob):/.test(request.url()) && request.url() !== url && faults.push(`asked for ${request.url()}`));
  await tab.setViewport(viewport);
  await tab.goto(url, { timeout: kPatience });
  await tab.waitForSelector("html:is([data-state=ready], [data-state=failed])");
  assert.equal(await tab.evaluate(() => document.documentElement.dataset.state), "ready");
  await run(tab);
  assert.deepEqual(faults, []);
  await tab.close();
}

const text = (tab, selector) => tab.$eval(selector, (element) => element.textContent);

async function shoot(tab, name) {
  // Waits for two frames, after which a change has been drawn.
  await tab.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 200)))));
  const png = await tab.screenshot();
  if (screenshots) mkdirSync(screenshots, { recursive: true }), writeFileSync(join(screenshots, `firefox-${name}.png`), png);
  return decode(png);
}

for (const [name, viewport] of [["wide", { width: 1280, height: 800 }], ["narrow", { width: 390, height: 844 }]])
  test(`Firefox shows the faulty crate and its findings: ${name}`, { skip, timeout }, async () => {
    await withTab(pathToFileURL(page).href, viewport, async (tab) => {
      assert.equal(await tab.evaluate(() => document.documentElement.dataset.picture), "drawn");
      assert.equal(await tab.$eval(".finding", (button) => button.dataset.code), "signsWrong");
      assert.match(await text(tab, ".verdict"), /mikktspace/);
      assert.ok(await tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "nothing is wider than the window");
      await tab.evaluate(() => [...document.querySelectorAll("label.check")].find((label) => label.textContent === "Colors").click());
      const { data, width, height, channels } = await shoot(tab, name);
      let orange = 0;
      for (let i = 0; i < width * height * channels; i += channels) orange += data[i] > 150 && data[i + 1] > 60 && data[i + 1] < 140 && data[i + 2] < 60;
      assert.ok(orange > 0.02 * width * height, `the crate is orange: ${orange} pixels`);
    });
  });

test("Firefox fixes the faulty crate with the bytes of the tool", { skip: skip || (!tool && "the tool is not built"), timeout }, async () => {
  await withTab(pathToFileURL(page).href, { width: 1280, height: 800 }, async (tab) => {
    const bytesOf = async (script) => Buffer.from(await tab.evaluate(script), "base64");
    await tab.evaluate(() => (window.base64Of = (bytes) => btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""))));
    const broken = await bytesOf(() => window.base64Of(window.tspaceView.model.bytes));
    await tab.$eval(".mend", (panel) => (panel.open = true));
    await tab.$eval(".mend .main", (button) => button.click());
    await tab.waitForSelector(".result a:not(.folder)");
    const made = await bytesOf(async () => window.base64Of(new Uint8Array(await (await fetch(document.querySelector(".result a:not(.folder)").href)).arrayBuffer())));
    writeFileSync(join(home, "broken.glb"), broken);
    execFileSync(tool, ["generate", "--quiet", "--repair", join(home, "broken.glb"), "-o", join(home, "mended.glb")]);
    assert.ok(made.equals(readFileSync(join(home, "mended.glb"))));
  });
});

test("Firefox shows the lesson, and its figures follow the keys", { skip: skip || (!lesson && "the lesson was not built"), timeout }, async () => {
  await withTab(pathToFileURL(lesson).href, { width: 1280, height: 900 }, async (tab) => {
    const row = (figure, name) => tab.$$eval(`#${figure} .numbers div`, (rows, wanted) => rows.find((one) => one.querySelector("dt").textContent === wanted)?.querySelector("dd").textContent, name);
    assert.match(await row("triangle", "the library"), /sign = \+1/);
    await tab.$eval('[aria-label="UV of corner 2"]', (knob) => knob.focus());
    for (let i = 0; i < 40; ++i) await tab.keyboard.press("ArrowDown");
    assert.match(await row("triangle", "the library"), /sign = \u22121/);
    await shoot(tab, "lesson");
  });
});
