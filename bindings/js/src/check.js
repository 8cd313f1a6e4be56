// SPDX-License-Identifier: MIT
// Checks of arguments before anything is copied. The module checks counts and indices, but not types.
import { TspaceError, typeError } from "./error.js";

export const isMissing = (value) => value === undefined || value === null;

/** Returns the value of an option, or its default if it was not given. Only arrays and functions may be null instead. */
export const valueOr = (value, fallback) => (value === undefined ? fallback : value);

export const fail = (code, message, element) => {
  throw code === "wrongType" ? typeError(code, message) : new TspaceError(code, message, element);
};

/** Describes a value for messages. */
function describe(value) {
  const type = typeof value;
  if (type === "string") return JSON.stringify(value.length > 40 ? `${value.slice(0, 40)}...` : value);
  if (type === "number" || type === "boolean" || isMissing(value)) return String(value);
  const kind = (type === "object" && value.constructor?.name) || type;
  return `${/^[AEIO]/i.test(kind) ? "an" : "a"} ${kind}`;
}

export const failType = (value, name, needed) => fail("wrongType", `${name} must be ${needed}, not ${describe(value)}`);

/**
 * Returns a new view of the array with a fixed length, which neither a growing buffer nor getters of the caller's array
 * can change. Accepts arrays of other windows.
 */
function viewOf(array, name, types, needed) {
  const Type = ArrayBuffer.isView(array) && types.find((type) => type.name === array[Symbol.toStringTag]);
  if (!Type) failType(array, name, needed);
  try {
    array.indexOf(0, array.length); // throws if the buffer is detached or too short
    return new Type(array.buffer, array.byteOffset, array.length);
  } catch {
    return fail("detached", `${name} cannot be read: its buffer was detached or resized`);
  }
}

/** Returns a checked view of a Float32Array, or undefined if it is missing. `size`: components per element. */
export function floats(array, name, size, isRequired = false) {
  if (isMissing(array)) {
    if (isRequired) fail("missingAttribute", `${name} is missing; it must be a Float32Array with ${size} numbers for each element`);
    return undefined;
  }
  const numbers = viewOf(array, name, [Float32Array], "a Float32Array");
  if (numbers.length % size !== 0)
    fail("countMismatch", `${name} has ${numbers.length} numbers, which is not a multiple of ${size}`);
  return numbers;
}

/** Returns a checked view of bytes as a Uint8Array. */
export function bytes(value, name) {
  const isBuffer = /ArrayBuffer$/.test(value?.[Symbol.toStringTag]);
  if (isBuffer && value.byteLength === 0) return new Uint8Array(0); // detached, or empty
  return viewOf(isBuffer ? new Uint8Array(value) : value, name, [Uint8Array], "a Uint8Array or an ArrayBuffer");
}

/** Returns a checked view of an array of unsigned integers, or undefined if it is missing. */
export function integers(array, name) {
  if (isMissing(array)) return undefined;
  return viewOf(array, name, [Uint32Array, Uint16Array, Uint8Array], "a Uint32Array, Uint16Array or Uint8Array");
}

export function count(value, name) {
  if (!Number.isInteger(value) || value < 0 || value > 0xffffffff)
    fail("invalidOption", `${name} must be an integer from 0 to 4294967295, not ${describe(value)}`);
  return value;
}

export function number(value, name) {
  return typeof value === "number" && value === value ? value : failType(value, name, "a number");
}

/** Checks a number within an inclusive range. */
export function numberWithin(value, name, least, most, unit) {
  if (number(value, name) < least || value > most)
    fail("invalidOption", `${name} must be a number from ${least} to ${most}${unit}, not ${value}`);
  return value;
}

/** Returns a checked view of a Uint8Array that receives output, or undefined if the caller provides none. */
export function output(array, name, count) {
  if (isMissing(array)) return undefined;
  const given = viewOf(array, name, [Uint8Array], "a Uint8Array");
  if (given.length !== count) fail("countMismatch", `${name} has ${given.length} entries, but needs ${count}`);
  return given;
}

export function boolean(value, name) {
  return typeof value === "boolean" ? value : failType(value, name, "true or false");
}

/** Returns the index of a name in a list. */
export function choice(value, name, list) {
  const place = list.indexOf(value);
  if (place < 0) fail("invalidOption", `${name} must be one of ${list.join(", ")}, not ${describe(value)}`);
  return place;
}

/** Checks an object; if `known` is given, it must not have other members. */
export function object(value, name, known) {
  if (typeof value !== "object" || value === null) failType(value, name, "an object");
  const strange = known && Object.keys(value).find((member) => !known.includes(member));
  if (strange !== undefined)
    throw typeError("invalidOption", `${name}.${strange} is unknown; known names are ${known.join(", ")}`);
  return value;
}

export function optionsOf(value, known) {
  object(valueOr(object(value, "options", known).report, {}), "report");
}
