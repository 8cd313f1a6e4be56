// SPDX-License-Identifier: MIT

/**
 * Error of a failed call: `code` is stable, `message` is human-readable, `element` is the index of the invalid element,
 * if any.
 */
export class TspaceError extends Error {
  constructor(code, message, element) {
    super(message);
    this.name = "TspaceError";
    this.code = code;
    this.element = element;
    errors.add(this);
  }

  static [Symbol.hasInstance](error) {
    return errors.has(error);
  }
}

const errors = new WeakSet();

/** Creates a TypeError (used by JavaScript for wrong types and unknown names) that is also a tspace error. */
export function typeError(code, message) {
  const error = Object.assign(new TypeError(message), { code });
  errors.add(error);
  return error;
}

/** Names of the error numbers in tspace/result.h. */
const codes = {
  1: "nullData", 2: "countMismatch", 3: "indexOutOfRange", 4: "strideTooSmall", 5: "misaligned", 6: "tooLarge",
  7: "missingAttribute", 8: "invalidOption", 9: "outOfMemory", 10: "planMismatch", 11: "internal", 12: "cancelled",
  100: "invalidFile", 101: "unsupportedFile", 102: "forbiddenPath", 103: "cannotRead", 104: "cannotWrite",
};

/** Returns the JavaScript name for a name in C or on the command line: memoryLimit for memory_limit and memory-limit. */
export const camelCase = (name) => name.replace(/[_-]([a-z])/g, (_, letter) => letter.toUpperCase());

/**
 * Replaces names in a message of the core by JavaScript names: normalIndices for normal_indices, creaseAngle for
 * crease_angle_deg, "auto" for weld_auto (-1).
 */
export const inJavaScriptNames = (text) =>
  text
    .replace(/\b(?:crease|denoise|weld)_auto\b(?: \(-1\))?/g, '"auto"')
    .replace(/\b[a-z]+(?:_[a-z]+)+\b/g, (name) => camelCase(name.replace(/_deg$/, "")));

export const codeName = (number) => codes[number] ?? "internal";
