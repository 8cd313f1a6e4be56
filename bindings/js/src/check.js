// SPDX-License-Identifier: MIT
// What callers hand over is looked at before anything is copied. The module checks counts and indices, not types.
import { TspaceError } from "./error.js";

export const fail = (code, message, element) => {
  throw new TspaceError(code, message, element);
};

const describe = (value) =>
  value === null ? "null" : typeof value === "object" ? (value.constructor?.name ?? "an object") : `a ${typeof value}`;

const isMissing = (value) => value === undefined || value === null;

/** Throws for a view whose buffer is gone or became too short. */
function mustBeAttached(array, name) {
  try {
    array.indexOf(0, array.length);
  } catch {
    fail("detached", `${name} cannot be read: its buffer was detached or resized`);
  }
}

/** A Float32Array, or undefined. `size`: numbers of an element. */
export function floats(array, name, size, isRequired = false) {
  if (isMissing(array)) {
    if (isRequired) fail("missingAttribute", `${name} is missing: a Float32Array, ${size} numbers for each element`);
    return undefined;
  }
  if (!(array instanceof Float32Array)) fail("wrongType", `${name} is ${describe(array)}, not a Float32Array`);
  mustBeAttached(array, name);
  if (array.length % size !== 0)
    fail("countMismatch", `${name} has ${array.length} numbers, which is no multiple of ${size}`);
  return array;
}

/** Bytes as a Uint8Array. */
export function bytes(value, name) {
  const isBuffer = value instanceof ArrayBuffer;
  if (isBuffer && value.byteLength === 0) return new Uint8Array(0); // detached, or nothing in it
  const array = isBuffer ? new Uint8Array(value) : value;
  if (!(array instanceof Uint8Array)) fail("wrongType", `${name} is ${describe(array)}, not a Uint8Array or an ArrayBuffer`);
  mustBeAttached(array, name);
  return array;
}

/** An array of unsigned integers, or undefined. */
export function integers(array, name) {
  if (isMissing(array)) return undefined;
  if (!(array instanceof Uint32Array || array instanceof Uint16Array || array instanceof Uint8Array))
    fail("wrongType", `${name} is ${describe(array)}, not a Uint32Array, Uint16Array or Uint8Array`);
  mustBeAttached(array, name);
  return array;
}

export function count(value, name) {
  if (!Number.isInteger(value) || value < 0 || value > 0xffffffff)
    fail("invalidOption", `${name} is ${String(value)}, not a whole number from 0 to 4294967295`);
  return value;
}

export function number(value, name) {
  if (typeof value !== "number") fail("wrongType", `${name} is ${describe(value)}, not a number`);
  return value;
}

export function boolean(value, name) {
  if (typeof value !== "boolean") fail("wrongType", `${name} is ${describe(value)}, not true or false`);
  return value;
}

/** The place of a name in a list. */
export function choice(value, name, list) {
  const place = list.indexOf(value);
  const text = typeof value === "string" ? JSON.stringify(value) : isMissing(value) ? "missing" : describe(value);
  if (place < 0) fail("invalidOption", `${name} is ${text}, not one of ${list.join(", ")}`);
  return place;
}

export function object(value, name) {
  if (typeof value !== "object" || value === null) fail("wrongType", `${name} is ${describe(value)}, not an object`);
  return value;
}
