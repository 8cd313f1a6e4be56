// SPDX-License-Identifier: MIT
// The page's side of the worker. A call into WebAssembly cannot be interrupted, so stopping means terminating the
// worker; the next call starts a new one.
import type { Answer, Call, Calls } from "./protocol.js";
import Worker from "./worker.js?worker&inline";

/** An error reported by the library, or a cancellation by the user (`code` is "stopped"). */
export class WorkError extends Error {
  constructor(readonly code: string, message: string) {
    super(message);
  }
}

interface Waiting {
  done(answer: unknown): void;
  failed(error: WorkError): void;
}

export class Work {
  /** Resolved when the first worker starts to load the library; work of the page from then on does not delay it. */
  readonly started: Promise<unknown>;
  #worker: globalThis.Worker | undefined;
  #waiting = new Map<number, Waiting>();
  #next = 0;

  constructor() {
    this.started = this.run("forget", {}).catch(() => {});
  }

  run<K extends Call>(call: K, ask: Calls[K]["ask"], transfer: Transferable[] = []): Promise<Calls[K]["answer"]> {
    const worker = (this.#worker ??= this.#start());
    const id = this.#next++;
    return new Promise((done, failed) => {
      this.#waiting.set(id, { done: done as (answer: unknown) => void, failed });
      worker.postMessage({ id, call, ask }, transfer);
    });
  }

  /** Prepares for another model: terminates running calls, or else only makes the worker forget its parts. */
  forget(): void {
    if (this.#waiting.size > 0) this.stop();
    // if it was terminated meanwhile, nothing needs to be forgotten
    else if (this.#worker) this.run("forget", {}).catch(() => {});
  }

  /** Terminates all running calls. The worker loses its parts. */
  stop(code = "stopped", message = "Stopped."): void {
    this.#worker?.terminate();
    this.#worker = undefined;
    const waiting = [...this.#waiting.values()];
    this.#waiting.clear();
    for (const one of waiting) one.failed(new WorkError(code, message));
  }

  #start(): globalThis.Worker {
    const worker = new Worker();
    worker.onmessage = ({ data }: MessageEvent<Answer>) => {
      const waiting = this.#waiting.get(data.id);
      this.#waiting.delete(data.id);
      if ("code" in data) waiting?.failed(new WorkError(data.code, data.message));
      else waiting?.done(data.answer);
    };
    worker.onerror = (event) => this.stop("internal", `The worker stopped: ${event.message || "probably out of memory"}`);
    return worker;
  }
}
