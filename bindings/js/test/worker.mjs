// SPDX-License-Identifier: MIT
import { parentPort } from "node:worker_threads";
import { generateTangents, ready } from "tspace";
import * as files from "tspace/gltf";

parentPort.on("message", async ({ mesh, model, options }) => {
  await Promise.all([ready, files.ready]);
  const made = model ? files.generate(model, options).bytes : generateTangents(mesh, options);
  parentPort.postMessage(made, [made.buffer]);
});
