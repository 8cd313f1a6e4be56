// SPDX-License-Identifier: MIT
// A WebAssembly module, its instance, and the transfer of arrays. The modules import one function (file modules import
// several), which ends a call when memory runs out by throwing through the module's frames. The state after such a call
// is undefined, so the next call gets a new instance.
import { TspaceError, codeName, inJavaScriptNames } from "./error.js";

/** A code that the module returned; its text is still there. */
class Failure {
  constructor(number) {
    this.number = number;
  }
}

async function fetched(url) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`tspace: cannot load ${url} (${answer.status})`);
  return answer.arrayBuffer();
}

export class Wasm {
  #module;
  /** Of the instance, in an object that plans keep: `exports` is undefined once the instance has ended. */
  #current = {};
  #imports;
  #ready;
  #isWorn = false;
  #translated;

  /** `imports`: functions that a module of files needs beside `endCall`. Only sentences of other modules are translated, since paths stay. */
  constructor(imports) {
    this.#imports = imports ?? {};
    this.#translated = imports ? (text) => text : inJavaScriptNames;
  }

  /** Starts loading, once. `source`: where the module lies, or a function that gives its bytes. */
  start(source) {
    if (this.#ready) return this.#ready;
    this.#ready = (source instanceof URL ? fetched(source) : source()).then(WebAssembly.compile).then((module) => {
      this.#module = module;
    });
    this.#ready.catch(() => {}); // callers that await `ready` get the error; other calls report it below
    return this.#ready;
  }

  get exports() {
    if (!this.#module) throw new TspaceError("notReady", "tspace is not loaded: `await ready` first");
    if (!this.#current.exports) {
      const imports = { endCall: (number) => this.#endCall(number), attempt: (...given) => this.#attempt(...given), ...this.#imports };
      const env = Object.fromEntries(Object.entries(imports).map(([name, call]) => [name, this.#throughFrames(call)]));
      this.#current = { exports: new WebAssembly.Instance(this.#module, { env }).exports };
      this.#current.exports.__wasm_call_ctors();
    }
    return this.#current.exports;
  }

  get instance() {
    return this.#current;
  }

  /** What `call` throws goes through frames of the module, and what those had allocated stays behind. */
  #throughFrames(call) {
    return (...given) => {
      try {
        return call(...given);
      } catch (error) {
        this.#isWorn = true;
        throw error;
      }
    };
  }

  #endCall(number) {
    if (number === 9) throw new TspaceError("outOfMemory", "out of memory");
    if (number === 11) throw new TspaceError("internal", "internal error of tspace");
    throw new Failure(number);
  }

  /** Calls a function of the module; 1 where it ended as calls do whose input is wrong. */
  #attempt(body, context) {
    const { stackSave, stackRestore, __indirect_function_table: functions } = this.#current.exports;
    const top = stackSave();
    try {
      functions.get(body)(context);
      return 0;
    } catch (error) {
      if (!(error instanceof Failure)) throw error;
      stackRestore(top);
      return 1;
    }
  }

  /** Ends the instance, whose memory the collector then frees; the next call gets a new one. */
  release() {
    this.#current.exports = undefined;
  }

  memoryBytes() {
    return this.#current.exports?.memory.buffer.byteLength ?? 0;
  }

  /** body(call), and the end of what it allocated. */
  run(body) {
    const call = new Call(this.exports);
    try {
      return body(call);
    } catch (error) {
      if (error instanceof Failure) {
        const [code, text, element] = errorOf(call.wasm, error.number);
        throw new TspaceError(code, this.#translated(text), element);
      }
      // a stack overflow is a RangeError
      this.#isWorn ||= error instanceof WebAssembly.RuntimeError || error instanceof RangeError;
      if (error instanceof WebAssembly.RuntimeError)
        throw new TspaceError("internal", `internal error of tspace: ${error.message}`);
      throw error;
    } finally {
      if (this.#isWorn) this.release();
      else call.end();
      this.#isWorn = false;
    }
  }
}

const utf8 = new TextDecoder();

/** Text in the module's memory that a 0 ends. */
export function textAt(exports, place) {
  const bytes = new Uint8Array(exports.memory.buffer, place >>> 0);
  return utf8.decode(bytes.slice(0, bytes.indexOf(0)));
}

/** Code, sentence and element of the last call that failed. */
function errorOf(exports, number) {
  const element = exports.errorElement();
  return [codeName(number), textAt(exports, exports.errorText()), element < 0 ? undefined : element];
}

/** The arrays of one call in the module's memory. Views are made anew each time, since memory moves when it grows. */
class Call {
  #places = [];

  constructor(exports) {
    this.wasm = exports;
  }

  allocate(bytes) {
    const place = bytes > 0xfff00000 ? 0 : this.wasm.allocate(bytes) >>> 0;
    if (place === 0) throw new TspaceError("outOfMemory", `out of memory: ${bytes} bytes more are needed`);
    this.#places.push(place);
    return place;
  }

  /** Copies a typed array in; 0 for none. Vectors of three are read as four: behind the last one are bytes as well. */
  put(array, Type = array?.constructor) {
    if (!array) return 0;
    const place = this.allocate(array.length * Type.BYTES_PER_ELEMENT + 16);
    new Type(this.wasm.memory.buffer, place, array.length).set(array);
    return place;
  }

  /** A copy of what lies at a place. */
  get(Type, place, count) {
    // slice() would fill the array with zeros first
    return new Type(new Type(this.wasm.memory.buffer, place >>> 0, count));
  }

  /** The same for an array that the module allocated for its caller. */
  take(Type, place, count) {
    this.#places.push(place >>> 0);
    return this.get(Type, place, count);
  }

  /** Throws the error of a function that returned one. */
  check(number) {
    if (number !== 0) throw new Failure(number);
  }

  /** Fills in the last function's report, whose numbers begin at `first`. */
  report(names, to, first = 0) {
    const numbers = new Float64Array(this.wasm.memory.buffer, (this.wasm.report() >>> 0) + 8 * first, names.length);
    names.forEach((name, i) => (to[name] = numbers[i]));
    return to;
  }

  end() {
    while (this.#places.length) this.wasm.release(this.#places.pop());
  }
}
