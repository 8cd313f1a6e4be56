// SPDX-License-Identifier: MIT
// Names of choices, and of numbers of reports.

// Everything below is written by scripts/api.
export const methodNames = [
  "mikktspace", "lengyel", "uniform", "angle", "area", "flat", "basis", "fast", "best",
];
export const pairingNames = [
  "reference", "corrected",
];
export const ngonsNames = [
  "triangulate", "skip",
];
export const outputDomainNames = [
  "corner", "vertex",
];
export const frameShapeNames = [
  "gramSchmidt", "symmetric",
];
export const normalWeightingNames = [
  "flat", "uniform", "area", "angle", "angleArea", "max", "best",
];
export const frameFormatNames = [
  "frame32", "frame48", "frame64", "oct32", "qtangent64", "snorm8_pair", "snorm16_pair", "gltf_snorm8",
  "gltf_snorm16",
];
export const tangentReportNames = [
  "triangleCount", "degenerateTriangleCount", "degenerateUvCount", "mirroredCount", "skippedFaceCount", "groupCount",
  "defaultCornerCount", "notFiniteCount", "referenceOrderAbandoned",
];
export const sanitizeReportNames = [
  "notFiniteCount", "zeroCount", "notUnitCount", "parallelCount", "placeholderCount", "badSignCount",
  "mixedSignCount", "orthogonalizedCount", "normalizedCount", "fromNeighborCount", "fromBasisCount", "badNormalCount",
  "mendedCount",
];
export const normalReportNames = [
  "faceCount", "degenerateFaceCount", "fallbackCornerCount", "noise", "creaseAngle",
];
