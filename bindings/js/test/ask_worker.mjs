// SPDX-License-Identifier: MIT
// Counterpart of worker.mjs in the main thread.

/** Returns the worker's answer to a message { mesh, options } or { call, model, options }. */
export function askWorker(worker, message, { signal, onProgress } = {}) {
  const flag = new Int32Array(new SharedArrayBuffer(4)); // in a browser: requires cross-origin isolated pages
  const stop = () => Atomics.store(flag, 0, 1);
  if (signal?.aborted) stop();
  signal?.addEventListener("abort", stop);
  return new Promise((resolve, reject) => {
    const finish = (end, value) => {
      worker.off("message", listen);
      worker.off("error", reject);
      signal?.removeEventListener("abort", stop);
      end(value);
    };
    const listen = ({ made, progress, error }) => {
      if (progress) onProgress?.(progress);
      else if (error) finish(reject, error);
      else finish(resolve, made);
    };
    worker.on("message", listen);
    worker.on("error", reject);
    worker.postMessage({ ...message, flag });
  });
}
