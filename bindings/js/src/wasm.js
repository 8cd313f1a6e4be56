// SPDX-License-Identifier: MIT
// A WebAssembly module, its instance, and the transfer of arrays. The modules import one function (file modules import
// several), which ends a call when memory runs out by throwing through the module's frames. The state after such a call
// is undefined, so the next call gets a new instance.
import { TspaceError, codeName, inJavaScriptNames } from "./error.js";

/** Thrown for an error code of the module; the error text is still in the module's memory. */
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
  /**
   * State of the instance, in an object that plans keep: `exports` is undefined once the instance has been released.
   */
  #current = {};
  #imports;
  #ready;
  #isWorn = false;
  #translated;

  /**
   * `imports`: functions that a file module needs in addition to `endCall`. `translated`: replaces names in error
   * messages; those of file modules may contain paths.
   */
  constructor(imports, translated = imports ? (text) => text : inJavaScriptNames) {
    this.#imports = imports ?? {};
    this.#translated = translated;
  }

  /** Starts loading; later calls have no effect. `source`: URL of the module, or a function that returns its bytes. */
  start(source) {
    if (this.#ready) return this.#ready;
    this.#ready = (source instanceof URL ? fetched(source) : source()).then(WebAssembly.compile).then((module) => {
      this.#module = module;
    });
    this.#ready.catch(() => {}); // callers that await `ready` get the error; other calls report it below
    return this.#ready;
  }

  get exports() {
    if (!this.#module) throw new TspaceError("notReady", "tspace is not loaded; call `await ready` first");
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

  /**
   * Wraps an import. An error that it throws unwinds frames of the module, whose allocations are not freed, so the
   * instance must be released.
   */
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

  /** Calls a function of the module. Returns 1 if the call ended because of invalid input. */
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

  /** Releases the instance, so that its memory can be garbage-collected. The next call creates a new one. */
  release() {
    this.#current.exports = undefined;
  }

  memoryBytes() {
    return this.#current.exports?.memory.buffer.byteLength ?? 0;
  }

  /** Returns body(call), and frees what the call allocated. */
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

/** Returns null-terminated text in the module's memory. */
export function textAt(exports, place) {
  const bytes = new Uint8Array(exports.memory.buffer, place >>> 0);
  return utf8.decode(bytes.slice(0, bytes.indexOf(0)));
}

/** Returns the code, message and element of the last failed call. */
function errorOf(exports, number) {
  const element = exports.errorElement();
  return [codeName(number), textAt(exports, exports.errorText()), element < 0 ? undefined : element];
}

/** Arrays of one call in the module's memory. Views are created on each access, because memory moves when it grows. */
class Call {
  #places = [];

  constructor(exports) {
    this.wasm = exports;
  }

  allocate(bytes) {
    const place = bytes > 0xfff00000 ? 0 : this.wasm.allocate(bytes) >>> 0;
    if (place === 0) throw new TspaceError("outOfMemory", `out of memory: ${bytes} more bytes are needed`);
    this.#places.push(place);
    return place;
  }

  /**
   * Copies a typed array to the module and returns its address; 0 if it is missing. Vectors of three components are
   * read as four, so the array is followed by readable bytes.
   */
  put(array, Type = array?.constructor) {
    if (!array) return 0;
    const place = this.allocate(array.length * Type.BYTES_PER_ELEMENT + 16);
    new Type(this.wasm.memory.buffer, place, array.length).set(array);
    return place;
  }

  /** Returns a copy of an array in the module's memory. */
  get(Type, place, count) {
    // slice() would fill the array with zeros first
    return new Type(new Type(this.wasm.memory.buffer, place >>> 0, count));
  }

  /** Returns a copy of an array that the module allocated for its caller, and frees it after the call. */
  take(Type, place, count) {
    this.#places.push(place >>> 0);
    return this.get(Type, place, count);
  }

  /** Throws an error if a function returned an error code. */
  check(number) {
    if (number !== 0) throw new Failure(number);
  }

  /** Fills in the report of the last function. `first`: index of its first number. */
  report(names, to, first = 0) {
    const numbers = new Float64Array(this.wasm.memory.buffer, (this.wasm.report() >>> 0) + 8 * first, names.length);
    names.forEach((name, i) => (to[name] = numbers[i]));
    return to;
  }

  end() {
    while (this.#places.length) this.wasm.release(this.#places.pop());
  }
}
