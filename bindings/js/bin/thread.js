// SPDX-License-Identifier: MIT
import { workerData } from "node:worker_threads";
import { giveUp, serve } from "./threads.js";

try {
  serve(workerData);
} catch (error) {
  giveUp(workerData.table, error);
}
