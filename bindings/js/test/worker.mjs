// SPDX-License-Identifier: MIT
import { parentPort } from "node:worker_threads";
import { generateTangents, ready } from "tspace";

parentPort.on("message", async ({ mesh, options }) => {
  await ready;
  const tangents = generateTangents(mesh, options);
  parentPort.postMessage(tangents, [tangents.buffer]);
});
