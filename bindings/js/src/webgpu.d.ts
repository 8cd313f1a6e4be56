// SPDX-License-Identifier: MIT
import type { Plan, PlanBufferOptions, PlanBuffers } from "./index.js";

export { TspaceError } from "./types.js";
export type { Plan, PlanBufferOptions, PlanBuffers } from "./index.js";

/** The required members of a WebGPU buffer, such as a `GPUBuffer` with `GPUBufferUsage.STORAGE`. */
export interface StorageBuffer {
  readonly size: number;
  readonly usage: number;
  destroy(): void;
}

/** Elements in a buffer. Offset and stride are in bytes, multiples of 4 (snorm16x3: of 2). */
export interface GpuArray<Format extends string> {
  buffer: StorageBuffer;
  /** Default: 0. */
  offset?: number;
  /** Bytes from one element to the next. Default: the size of an element. */
  stride?: number;
  format?: Format;
}

/** Positions of a pose, one per vertex of the plan's mesh. */
export interface GpuPositions extends GpuArray<"float32x3" | "snorm16x3"> {
  /** Factor for snorm16 values, per axis. Default: 1. */
  scale?: readonly [number, number, number];
}

/** Deformation of positions before frames are computed: morphing, then skinning. Offsets are in bytes of `buffer`. */
export interface GpuDeformation {
  buffer: StorageBuffer;
  /** `weights`: a float per target. `deltas`: three floats per vertex, target after target. */
  morph?: { count: number; weights: number; deltas: number } | null;
  /** `joints`: four uint32 per vertex. `weights`: four floats per vertex. `matrices`: three rows of four floats per joint. */
  skin?: { joints: number; weights: number; matrices: number } | null;
}

export interface GpuArrays {
  positions: StorageBuffer | GpuPositions;
  /**
   * Normals of three floats. If the plan computes normals, an optional output, one per result; otherwise an input, one
   * per vertex.
   */
  normals?: StorageBuffer | GpuArray<"float32x3"> | null;
  /** Output, one per result: four floats (tangent and sign), or packed frames as in "tspace/pack". */
  tangents: StorageBuffer | GpuArray<"float32x4" | "frame32" | "oct32" | "snorm8_pair">;
  deform?: GpuDeformation | null;
}

/** Computes normals and tangents of poses with WebGPU. The caller owns the buffers, and nothing is read back. */
export class GpuFrames {
  private constructor();
  /**
   * Uploads a plan and compiles the shader, once for each device.
   * @param device a `GPUDevice`
   * @param plan a result of `planBuffers`, its `words`, or a Plan, which is exported with `options`
   */
  static create(device: object, plan: Plan | PlanBuffers | Uint32Array, options?: PlanBufferOptions): Promise<GpuFrames>;
  /** Number of positions that a pose needs. */
  readonly vertexCount: number;
  /** Number of tangents that are written. */
  readonly resultCount: number;
  /** Number of normals that are written or read (see `makesNormals`). */
  readonly normalCount: number;
  /** True if normals are computed from positions. */
  readonly makesNormals: boolean;
  /**
   * Encodes one dispatch.
   * @param encoder a `GPUCommandEncoder`, to which a compute pass is added, or a `GPUComputePassEncoder`
   * @param arrays buffers that the caller owns. `positions` must not share a buffer with an output; two outputs may
   * share one if they use different blocks of 256 bytes
   */
  encode(encoder: object, arrays: GpuArrays): void;
  /** Destroys the buffers of the plan, but not those of the caller. */
  destroy(): void;
}
