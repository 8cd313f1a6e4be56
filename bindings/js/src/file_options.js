// SPDX-License-Identifier: MIT
// Names of the options of each call on files; those of inspect are those of all.

// Everything below is written by scripts/api.
export const optionNames = {
  generate: [
    "dryRun", "compress", "keepCoordinates", "all", "onlyMissing", "overwrite", "repair", "strip",
    "textureTransform", "method", "faces", "pairing", "threshold", "frame", "refine", "bitangents", "convention",
    "format", "pack", "packDrop", "flipGreen", "flipGreenAll", "fixMaps", "mendMaps", "noImages", "compressMaps",
    "normals", "crease", "denoise", "weldDistance", "normalsPerPrimitive", "overwriteNormals", "morphNormals",
    "fixWinding", "mendWinding", "noSanitize", "orthogonalize",
  ],
  check: [
    "failOn", "severity", "ignore", "angle", "convention", "faces", "weldDistance", "noImages",
  ],
  inspect: [
    "allowExternal", "memoryLimit",
  ],
  identify: [
    "tolerance",
  ],
  diff: [
    "tolerance", "worst",
  ],
};
