// SPDX-License-Identifier: MIT
// The parts of tspace's reports on a file that the page reads. docs/json.md describes them whole (`files[]`).

export type Severity = "error" | "warning" | "note";

export interface Finding {
  code: string;
  severity: Severity;
  place: string;
  mesh: number;
  primitive: number;
  meshName: string;
  materialName: string;
  unit: string;
  count: number;
  total: number;
  surfaceShare: number;
  worstDegrees: number;
  vertices: number[];
  message: string;
  remedy: string;
}

export interface CheckFile {
  format: string;
  generator: string;
  primitives: number;
  primitivesWithTangents: number;
  normalMaps: number;
  /** Those of them whose relief says which way green points. */
  normalMapsWithGreen: number;
  counts: Record<Severity, number>;
  findings: Finding[];
}

export interface IdentifyFile {
  verdict: string;
}

export interface InspectPrimitive {
  mesh: number;
  primitive: number;
  meshName: string;
  materialName: string;
  mode: string;
  triangles: number;
  vertices: number;
  compression: string;
  hasTangents: boolean;
  needsTangents: boolean;
  uvSet: number;
  uvIslands: number;
  mirroredUvIslands: number;
}

export interface InspectFile {
  format: string;
  generator: string;
  fileBytes: number;
  images: number;
  extensionsRequired: string[];
  primitives: InspectPrimitive[];
}

export interface GeneratedPrimitive {
  mesh: number;
  primitive: number;
  meshName: string;
  materialName: string;
  action: string;
  reason: string;
  notes: string[];
  verticesBefore: number;
  verticesAfter: number;
  mendedVertices: number;
  normalsGenerated: boolean;
}

export interface JudgedMap {
  image: number;
  name: string;
  flipped: boolean;
  mended: boolean;
  reason: string;
}

export interface GenerateFile {
  changed: boolean;
  inputBytes: number;
  outputBytes: number;
  warnings: string[];
  /** Where green was to be turned. */
  normalMaps?: JudgedMap[];
  primitives: GeneratedPrimitive[];
}
