// SPDX-License-Identifier: MIT
// Names of choices, and of numbers of reports.

// Everything below is written by scripts/api.
export const packReportNames = [
  "badNormalCount", "notFiniteCount", "zeroCount", "parallelCount", "notUnitCount", "notOrthogonalCount",
  "badSignCount", "mendedCount",
];
export const windingReportNames = [
  "faceCount", "turnedCount", "conflictCountBefore", "conflictCountAfter", "componentCount", "turnedComponentCount",
  "byNormalsCount", "byVolumeCount", "byNestingCount", "byWindingNumberCount", "byMajorityCount", "smallCount",
  "oneSidedCount",
];
export const positionNoiseNames = [
  "sigma", "kinkShare", "noise", "meanEdge",
];
