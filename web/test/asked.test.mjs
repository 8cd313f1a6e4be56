// SPDX-License-Identifier: MIT
// Models named in the address (?model=) are requested only after a click, and only from their server.
import assert from "node:assert/strict";
import { createServer } from "node:http";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { missing, noShared, page, settled, shared, shoot, withPage } from "./support.mjs";

const servers = [];
/** Starts a local server that records its requests. */
async function serve(answer) {
  const asked = [], server = createServer((request, response) => {
    asked.push(request.url);
    const [status, body, headers = { "access-control-allow-origin": "*" }] = answer(decodeURIComponent(request.url));
    response.writeHead(status, headers).end(body);
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  servers.push(server);
  return { asked, host: `127.0.0.1:${server.address().port}` };
}
let models, other, crate;
before(async () => {
  if (missing) return;
  crate = Buffer.from(await withPage((tab) => tab.evaluate(() => [...window.tspaceView.model.bytes])));
  other = await serve(() => [200, "caught"]);
  models = await serve((url) => {
    if (url === "/crate.glb" || url === "/data?id=7") return [200, crate];
    if (url === "/closed.glb") return [200, crate, {}];
    if (url === "/away.glb") return [302, "", { location: `http://${other.host}/crate.glb`, "access-control-allow-origin": "*" }];
    if (url.startsWith("/suzanne/") && shared) {
      try {
        return [200, readFileSync(join(shared, "models/khronos/Suzanne", url.slice("/suzanne/".length)))];
      } catch {
        // The file does not exist.
      }
    }
    return [404, "no"];
  });
});
after(() => servers.forEach((server) => (server.closeAllConnections(), server.close())));
const addressOf = (name) => `${pathToFileURL(page).href}?model=${encodeURIComponent(`http://${models.host}/${name}`)}`;
const mayAsk = () => new RegExp(`^http://(${models.host}|${other.host})/`);
const load = async (tab) => {
  await tab.evaluate(() => (document.documentElement.dataset.state = "asked"));
  await tab.getByRole("button", { name: `Load it from ${models.host}` }).click();
  return settled(tab);
};

test("a model in the address is downloaded after a click, and shown with the view of the address", { skip: missing }, async () => {
  await withPage(async (tab, requests) => {
    assert.equal(requests.length, 1, "nothing was asked for");
    assert.deepEqual(models.asked, []);
    assert.match(await tab.locator(".asked").textContent(), new RegExp(`crate\\.glb on ${models.host}.*Nothing has been downloaded yet`));
    assert.match(await tab.locator("h1").textContent(), new RegExp(`Nothing is uploaded; the page only downloads from ${models.host}`));
    await shoot(tab, "asked");
    assert.equal(await load(tab), "ready");
    assert.deepEqual(models.asked, ["/crate.glb"]);
    assert.equal(await tab.locator(".model-name").textContent(), "crate.glb");
    assert.equal(await tab.locator(".asked").count(), 0);
    assert.equal(await tab.evaluate(() => window.tspaceView.views.stage.viewport.settings.look), "signs");
  }, { url: `${addressOf("crate.glb")}#look=signs`, mayAsk: mayAsk() });
});

test("no other server is contacted, and none without ?model=", { skip: missing }, async () => {
  const reach = (tab, hosts) => tab.evaluate((hosts) => Promise.all(hosts.map((host) => fetch(`http://${host}/crate.glb`, { mode: "no-cors" }).then(() => true, () => false))), hosts);
  const hosts = [models.host, other.host], before = models.asked.length;
  await withPage(async (tab) => assert.deepEqual(await reach(tab, hosts), [true, false]), { url: addressOf("crate.glb"), allowMessages: true, mayAsk: mayAsk() });
  assert.equal(models.asked.length, before + 1);
  await withPage(async (tab) => assert.deepEqual(await reach(tab, hosts), [false, false]), { allowMessages: true, mayAsk: mayAsk() });
  for (const odd of ["javascript:alert(1)", "file:///etc/passwd", "http://", "data:model/gltf-binary;base64,AAAA"]) {
    await withPage(async (tab) => {
      assert.equal(await tab.locator(".asked").count(), 0, odd);
      assert.deepEqual(await reach(tab, hosts), [false, false], odd);
    }, { url: `${pathToFileURL(page).href}?model=${encodeURIComponent(odd)}`, allowMessages: true, mayAsk: mayAsk() });
  }
  assert.equal(models.asked.length, before + 1);
  assert.deepEqual(other.asked, []);
});

test("files missing on the server are reported", { skip: missing }, async () => {
  for (const [name, sentence] of [["none.glb", /none\.glb could not be loaded from .*status 404/], ["closed.glb", /does not allow other pages to read its files/], ["away.glb", /redirects to another server/]]) {
    await withPage(async (tab) => {
      assert.equal(await load(tab), "failed");
      assert.match(await tab.locator(".failure").textContent(), sentence);
    }, { url: addressOf(name), allowMessages: true, mayAsk: mayAsk() });
  }
  assert.deepEqual(other.asked, []);
});

test("a .gltf is loaded with its files, and an address without an extension is recognized by its bytes", { skip: noShared }, async () => {
  await withPage(async (tab) => {
    assert.equal(await load(tab), "ready");
    assert.equal(await tab.locator(".model-name").textContent(), "Suzanne.gltf");
    assert.equal(await tab.locator(".remark").isVisible(), false);
  }, { url: addressOf("suzanne/Suzanne.gltf"), allowMessages: true, mayAsk: mayAsk() });
  await withPage(async (tab) => {
    assert.equal(await load(tab), "ready");
    assert.equal(await tab.locator(".model-name").textContent(), "data.glb");
  }, { url: addressOf("data?id=7"), mayAsk: mayAsk() });
});
