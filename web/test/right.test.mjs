// SPDX-License-Identifier: MIT
// Models that the page calls correct are correct, its advice fixes faults, and parts that it cannot show affect no others.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { Glb } from "./glb.mjs";
import { choose, drawn, farApart, fixAndDownload, missing, noShared, openFile, openSample, pixelsOf, settled, shared, shareOf, shoot, withPage } from "./support.mjs";

const rightLabel = (tab) => tab.locator(".side.right").textContent();
const cat = () => join(shared, "models/assets/Cat.glb");

/** Returns the share of pixels that differ between two pictures by more than rounding. */
const differing = (one, other) => shareOf(one, (i) => farApart(one.data, i, other.data, i) > 6);

async function picture(tab, split) {
  await tab.locator(".split").fill(split);
  return pixelsOf(tab);
}

test("if green points down, the right side shows the file with inverted green", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await openSample(tab, "ring-directx.glb");
    assert.equal(await rightLabel(tab), "correct frames (mikktspace), green inverted");
    const left = await picture(tab, "1000"), right = await picture(tab, "0");
    assert.ok(differing(left, right) > 0.02, "as the file is, bumps are dents");
    await tab.locator(".split").fill("500");
    await shoot(tab, "ring-green-turned");
    await tab.locator(".mend > summary").click();
    assert.equal(await tab.getByLabel("Invert green in maps").isChecked(), true, "what the finding asks for is switched on");
    assert.match(await tab.locator(".reasons").textContent(), /Green points down in 1 normal map/);
    await fixAndDownload(tab);
    await tab.waitForFunction(() => window.tspaceView.views.stage.viewport.scene.drawn.every(({ rightMap, part }) => rightMap !== part.normalMap));
    assert.equal(await rightLabel(tab), "fixed");
    assert.ok(differing(right, await picture(tab, "0")) < 0.002, "and the fixed file looks the same");
    await openSample(tab, "crate.glb");
    assert.equal(await rightLabel(tab), "correct frames (mikktspace)", "nothing of it is left on the next model");
  });
});

test("a fix shows the findings before and after, and is undone by one key", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await tab.locator(".mend > summary").click();
    await fixAndDownload(tab);
    assert.equal(await tab.locator(".result .counts").textContent(), "1 error → 0 errors");
    await tab.getByRole("button", { name: "Open the fixed file" }).click();
    await tab.waitForFunction(() => window.tspaceView.model?.name === "crate-signs-lost-fixed.glb");
    await settled(tab);
    assert.equal(await tab.locator(".back").textContent(), "Back to crate-signs-lost.glb");
    await shoot(tab, "way-back");
    await tab.keyboard.press("Backspace");
    await tab.waitForFunction(() => window.tspaceView.model?.name === "crate-signs-lost.glb");
    await settled(tab);
    assert.equal(await tab.locator(".back").isVisible(), false);
  });
});

test("a fix that changes nothing is reported, without a download", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await openSample(tab, "crate.glb");
    await tab.locator(".mend > summary").click();
    await fixAndDownload(tab);
    assert.match(await tab.locator(".result").textContent(), /No changes were needed/);
    assert.equal(await tab.locator(".result a").getAttribute("class"), "button plain-link");
    await choose(tab, "recompute all", ".mend");
    await tab.locator(".mend select").selectOption("best");
    await tab.getByLabel("Invert green in maps").check();
    await openSample(tab, "crate-signs-lost.glb");
    assert.match(await tab.locator(".command").textContent(), / --repair$/, "no choice is taken over to the next model");
  });
});

test("inverted signs and green that cancel out are fixed together or not at all", { skip: noShared }, async () => {
  await withPage(async (tab) => {
    await openFile(tab, cat());
    await tab.locator(".mend > summary").click();
    assert.match(await tab.locator(".reasons").textContent(), /cancel out, so this file renders correctly/);
    assert.match(await tab.locator(".command").textContent(), / --repair$/);
    await fixAndDownload(tab);
    assert.match(await tab.locator(".result .counts").textContent(), /^3 errors, .* → 0 errors, /);
    await choose(tab, "recompute all", ".mend");
    assert.match(await tab.locator(".command").textContent(), / --overwrite --flip-green$/);
    assert.match(await tab.locator(".reasons").textContent(), /was selected for you/);
    await choose(tab, "inverted", ".mend");
    assert.match(await tab.locator(".command").textContent(), / --overwrite --convention opengl$/);
    await tab.locator(".look select").first().selectOption("mikktspace");
    await tab.locator(".figures", { hasText: "mikktspace" }).waitFor();
    const left = await picture(tab, "1000"), right = await picture(tab, "0");
    assert.ok(differing(left, right) < 0.03, "both sides are right, and look the same");
  }, { allowMessages: true });
});

test("findings of a kind are one entry, shown together and one after another", { skip: noShared }, async () => {
  await withPage(async (tab) => {
    await openFile(tab, cat());
    const codes = await tab.locator(".finding").evaluateAll((items) => items.map((item) => `${item.className} ${item.dataset.code}`));
    assert.equal(new Set(codes).size, codes.length, codes.join());
    const signs = tab.locator(".finding[data-code=signsInverted]"), details = signs.locator("xpath=following-sibling::*[1]");
    assert.match(await signs.textContent(), /44 locations/);
    const eye = () => tab.evaluate(() => window.tspaceView.views.stage.viewport.camera.position.toArray());
    await drawn(tab);
    const before = await eye();
    await signs.click();
    await drawn(tab);
    assert.deepEqual(await eye(), before, "what is everywhere is seen from where the eye is");
    const triangles = await tab.evaluate(() => window.tspaceView.views.stage.viewport.scene.drawn.reduce((sum, { corners }) => sum + corners.positions.length / 9, 0));
    assert.ok(Number(await tab.locator(".frame canvas").getAttribute("data-outlined")) > 0.9 * triangles, "all triangles are outlined, not those of the first eight vertices");
    await shoot(tab, "cat-signs");
    await details.getByRole("button", { name: "Next" }).click();
    assert.match(await details.locator(".step").textContent(), /^1 of 44: mesh 0 “head_lambert2_0”/);
    await details.getByRole("button", { name: "Previous" }).click();
    assert.match(await details.locator(".step").textContent(), /^44 of 44: mesh 43/);
    await drawn(tab);
    assert.notDeepEqual(await eye(), before, "one of many parts is flown to");
    await tab.locator(".filter").fill("pcube19");
    const left = await tab.locator(".finding:visible").evaluateAll((items) => items.map((item) => item.dataset.code));
    assert.ok(left.includes("signsMixed") && !left.includes("greenFlipped"), left.join());
  }, { allowMessages: true });
});

test("the button of a finding sets the fix panel to its remedy", { skip: missing }, async () => {
  await withPage(async (tab) => {
    await tab.locator(".finding").click();
    await tab.locator(".mend-this").click();
    assert.equal(await tab.locator("details.mend").evaluate((panel) => panel.open), true);
    assert.match(await tab.locator(".command").textContent(), / --repair$/);
    assert.equal(await tab.evaluate(() => document.activeElement.textContent), "Fix with these options");
  });
});

test("without WebGL, findings and fixes work, and a message replaces the picture", { skip: missing }, async () => {
  await withPage(async (tab) => {
    assert.equal(await tab.evaluate(() => document.documentElement.dataset.picture), "none");
    assert.match(await tab.locator(".remark").textContent(), /does not support WebGL, so there is no picture/);
    assert.equal(await tab.locator(".finding").getAttribute("data-code"), "signsWrong");
    assert.match(await tab.locator(".figures").textContent(), /1,728 of 5,184 corners have the wrong sign/);
    await shoot(tab, "no-webgl");
    await tab.locator(".mend > summary").click();
    await fixAndDownload(tab);
    assert.equal(await tab.locator(".result .counts").textContent(), "1 error → 0 errors");
    await tab.locator(".uv > summary").click();
    await tab.locator(".uv", { hasText: "needs WebGL, which this browser does not support" }).waitFor();
    await openSample(tab, "ring-directx.glb");
    assert.ok((await tab.locator(".finding").count()) > 0);
  }, { hasWebGl: false, allowMessages: true });
});

test("an image that cannot be drawn is omitted, and the model is shown", { skip: missing }, async () => {
  const folder = mkdtempSync(join(tmpdir(), "tspace-images-"));
  try {
    await withPage(async (tab) => {
      const bytes = await tab.evaluate(() => [...window.tspaceView.model.bytes]);
      const kinds = {
        "as KTX2 that has no other image": (glb) => {
          const [texture] = glb.json.textures;
          glb.json.images[texture.source] = { bufferView: glb.addView(Buffer.from("no KTX2")), mimeType: "image/ktx2" };
          texture.extensions = { KHR_texture_basisu: { source: texture.source } };
          delete texture.source;
          glb.json.extensionsUsed = glb.json.extensionsRequired = ["KHR_texture_basisu"];
        },
        "as a PNG that is none": (glb) => (glb.json.images[0] = { bufferView: glb.addView(Buffer.from("no PNG")), mimeType: "image/png" }),
      };
      for (const [kind, change] of Object.entries(kinds)) {
        const glb = new Glb(Buffer.from(bytes)), path = join(folder, "crate.glb");
        change(glb);
        writeFileSync(path, glb.finish());
        assert.equal(await openFile(tab, path), "ready", kind);
        assert.equal(await tab.evaluate(() => document.documentElement.dataset.picture), "drawn", kind);
        assert.match(await tab.locator(".remark").textContent(), kind.includes("KTX2") ? /1 image cannot be displayed \(it is neither KTX2 nor DDS\)/ : /1 image cannot be displayed,/, kind);
        assert.ok((await tab.locator(".finding").count()) > 0, kind);
      }
      await shoot(tab, "image-left-out");
    }, { allowMessages: true });
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});

test("the address stores the view and restores it", { skip: missing }, async () => {
  let address;
  await withPage(async (tab) => {
    await openSample(tab, "crate-signs-inverted.glb");
    await tab.locator(".finding").click();
    await choose(tab, "Difference");
    await tab.locator(".frame canvas").focus();
    for (const key of ["ArrowLeft", "ArrowUp", "+"]) await tab.keyboard.press(key);
    await tab.waitForFunction(() => /look=difference/.test(location.hash) && /finding=0/.test(location.hash));
    await tab.waitForTimeout(600);
    address = await tab.evaluate(() => location.href);
  });
  await withPage(async (tab) => {
    assert.equal(await tab.locator(".model-name").textContent(), "crate-signs-inverted.glb");
    assert.equal(await tab.locator(".finding").getAttribute("aria-expanded"), "true");
    const now = await tab.evaluate(() => ({ look: window.tspaceView.views.stage.viewport.settings.look, eye: window.tspaceView.views.stage.viewport.camera.position.toArray() }));
    assert.equal(now.look, "difference");
    const eye = new URLSearchParams(new URL(address).hash.slice(1)).get("camera").split(",").map(Number);
    assert.ok(now.eye.every((x, i) => Math.abs(x - eye[i]) < 1e-3), `${now.eye} and ${eye}`);
  }, { url: address });
});

test("Back and Forward switch between models and their views, and a typed address is followed", { skip: missing }, async () => {
  await withPage(async (tab) => {
    const look = () => tab.evaluate(() => window.tspaceView.views.stage.viewport.settings.look);
    const shows = async (name) => {
      await tab.waitForFunction((name) => document.querySelector(".model-name").textContent === name, name);
      assert.equal(await settled(tab), "ready");
    };
    await choose(tab, "Signs");
    await tab.waitForFunction(() => /look=signs/.test(location.hash));
    await openSample(tab, "ring-directx.glb");
    await choose(tab, "Islands");
    await tab.waitForFunction(() => /sample=ring.*look=islands/.test(location.hash));
    await tab.evaluate(() => void window.tspaceView.open(async () => ({ ...window.tspaceView.model, name: "mine.glb" })));
    await shows("mine.glb");
    await tab.evaluate(() => history.back());
    await shows("ring-directx.glb");
    assert.equal(await look(), "islands");
    await tab.evaluate(() => history.back());
    await shows("crate-signs-lost.glb");
    assert.equal(await look(), "signs");
    await tab.evaluate(() => history.go(2));
    await shows("mine.glb");
    await tab.evaluate(() => (location.hash = "#sample=crate.glb&look=mirrored"));
    await shows("crate.glb");
    assert.equal(await look(), "mirrored");
    await tab.evaluate(() => history.back());
    await shows("mine.glb");
    await tab.evaluate(() => history.forward());
    await shows("crate.glb");
    await tab.evaluate(() => (location.hash = "#sample=crate.glb&look=normals&split=0.25"));
    await tab.waitForFunction(() => window.tspaceView.views.stage.viewport.settings.look === "normals");
    assert.equal(await tab.evaluate(() => window.tspaceView.views.stage.viewport.settings.split), 0.25, "the model stays, and is seen as the address says");
  });
});
