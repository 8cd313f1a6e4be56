// SPDX-License-Identifier: MIT
import type { Plan, PlanBufferOptions, PlanBuffers } from "./index.js";

export { TspaceError } from "./types.js";
export type { Plan, PlanBufferOptions, PlanBuffers } from "./index.js";

/** What is used of a WebGPU buffer: a `GPUBuffer` is one. It needs `GPUBufferUsage.STORAGE`. */
export interface StorageBuffer {
  readonly size: number;
  readonly usage: number;
  destroy(): void;
}

/** Elements in a buffer. Offset and stride are in bytes, multiples of 4 (snorm16x3: of 2). */
export interface GpuArray<Format extends string> {
  buffer: StorageBuffer;
  /** 0 unless given. */
  offset?: number;
  /** Bytes from one element to the next; those of an element unless given. */
  stride?: number;
  format?: Format;
}

/** Positions of a pose, one per vertex of the plan's mesh. */
export interface GpuPositions extends GpuArray<"float32x3" | "snorm16x3"> {
  /** What snorm16 numbers are multiplied by, per axis: 1 unless given. */
  scale?: readonly [number, number, number];
}

/** How positions are moved before frames are computed: morphed, then skinned. Offsets are in bytes of `buffer`. */
export interface GpuDeformation {
  buffer: StorageBuffer;
  /** `weights`: a float per target. `deltas`: three floats per vertex, target after target. */
  morph?: { count: number; weights: number; deltas: number } | null;
  /** `joints`: four uint32 per vertex. `weights`: four floats per vertex. `matrices`: three rows of four floats per joint. */
  skin?: { joints: number; weights: number; matrices: number } | null;
}

export interface GpuArrays {
  positions: StorageBuffer | GpuPositions;
  /** Three floats: written, one per result, where the plan makes normals (or left out); else read, one per vertex. */
  normals?: StorageBuffer | GpuArray<"float32x3"> | null;
  /** Written, one per result: four floats (the tangent and its sign), or frames as in "tspace/pack". */
  tangents: StorageBuffer | GpuArray<"float32x4" | "oct32" | "snorm8_pair">;
  deform?: GpuDeformation | null;
}

/** Computes normals and tangents of poses by WebGPU. Buffers stay the caller's, and nothing is read back. */
export class GpuFrames {
  private constructor();
  /**
   * Uploads a plan and compiles the shader, once for each device.
   * @param device a `GPUDevice`
   * @param plan what `planBuffers` gave, its `words`, or a Plan, which is written with `options`
   */
  static create(device: object, plan: Plan | PlanBuffers | Uint32Array, options?: PlanBufferOptions): Promise<GpuFrames>;
  /** Positions that a pose needs. */
  readonly vertexCount: number;
  /** Tangents that are written. */
  readonly resultCount: number;
  /** Normals that are written, or read: see `makesNormals`. */
  readonly normalCount: number;
  /** Whether normals are computed from positions. */
  readonly makesNormals: boolean;
  /**
   * Encodes one dispatch.
   * @param encoder a `GPUCommandEncoder`, which gets a compute pass, or a `GPUComputePassEncoder`
   * @param arrays buffers that the caller owns. `positions` must not share a buffer with what is written; two outputs may
   * share one where their bytes lie in different blocks of 256
   */
  encode(encoder: object, arrays: GpuArrays): void;
  /** Destroys the buffers of the plan, none of the caller's. */
  destroy(): void;
}
