// SPDX-License-Identifier: MIT
import type { PackReport } from "./core_reports.js";
import type { NewFloat32Array, NewUint8Array } from "./types.js";

export { TspaceError } from "./types.js";
export type { NewFloat32Array, NewUint8Array, PackReport };

/** Resolves when the module is ready for calls. */
export const ready: Promise<void>;

/** Releases the module's memory. The next call starts with little memory. */
export function release(): void;

/**
 * Storage format of a frame, with its size and the maximum error of N and T in degrees: "frame32" 4 bytes, 0.135 and
 * 0.135; "frame48" 6, 0.0037 and 0.0042; "frame64" 8, 0.0001 and 0.00015; "oct32" 4, 0.15 and 0.165; "qtangent64" 8,
 * 0.004 and 0.004; vectors as snorm numbers: "snorm8_pair" 8 bytes, "snorm16_pair" 16, "gltf_snorm8" 7, "gltf_snorm16"
 * 14. Signs are always exact.
 */
export type FrameFormat =
  | "frame32" | "frame48" | "frame64" | "oct32" | "qtangent64" | "snorm8_pair" | "snorm16_pair" | "gltf_snorm8" | "gltf_snorm16";

/** All formats. */
export const frameFormats: readonly FrameFormat[];

/** Returns the bytes of one frame. */
export function frameBytes(format: FrameFormat): number;

/**
 * Packs frames independently of each other. Accepts any input: invalid frames are repaired and counted.
 * @param normals three numbers per frame, unit
 * @param tangents four numbers per frame: unit, orthogonal to the normal, and the sign
 * @param options `report`: an object that receives the counts
 * @returns `frameBytes(format)` bytes per frame, for the shaders of tspace or unpackFrames
 */
export function packFrames(
  normals: Float32Array, tangents: Float32Array, format: FrameFormat, options?: { report?: Partial<PackReport> },
): NewUint8Array;

/** Unpacks frames: all bytes are valid frames, finite and unit. */
export function unpackFrames(frames: Uint8Array, format: FrameFormat): { normals: NewFloat32Array; tangents: NewFloat32Array };
