// SPDX-License-Identifier: MIT
import type { CheckReport, DiffReport, Finding, GenerateReport, IdentifyReport, InspectReport } from "./reports.js";
import type { CheckFileOptions, DiffFileOptions, FileOptions, GenerateFileOptions, IdentifyFileOptions } from "./file_options.js";
import type { NewUint8Array } from "./types.js";

export { TspaceError } from "./types.js";
/**
 * Reports are the entries of the tool's JSON (docs/reference/json.md) for one file, with the exit code; the report of
 * diff is the whole document.
 */
export * from "./reports.js";
export type Report = GenerateReport | CheckReport | InspectReport | IdentifyReport;

/** Resolves when the module is ready for calls. */
export const ready: Promise<void>;

/** Releases the module's memory. The next call starts with little memory. */
export function release(): void;

/** A file: .glb, .vrm, .gltf or, if `name` ends in .obj, OBJ. It is read only during the call, and never changed. */
export type Bytes = Uint8Array | ArrayBuffer;

/**
 * The files that a model references, by their paths relative to it ("textures/normal.png"). Paths that leave the
 * model's folder are never requested. The call fails if a buffer (.bin) is missing, but not if an image is.
 */
export type Resources =
  | Readonly<Record<string, Bytes>>
  | ReadonlyMap<string, Bytes>
  | ((path: string) => Bytes | null | undefined);

/** MeshoptDecoder and MeshoptEncoder of npm's meshoptimizer; both must be ready. */
export interface Meshopt {
  decoder: { decodeGltfBuffer(target: Uint8Array, count: number, size: number, source: Uint8Array, mode: string, filter?: string): void };
  encoder?: { encodeGltfBuffer(source: Uint8Array, count: number, size: number, mode: string, version?: number): Uint8Array };
}

/** The resolved values of `createDecoderModule` and `createEncoderModule` of npm's draco3d. */
export interface Draco {
  decoder: object;
  encoder?: object;
}

/**
 * Four numbers per pixel, top row first, as stored in the file: without premultiplied alpha and without color profile
 * conversion.
 */
export interface Pixels {
  width: number;
  height: number;
  /** A Uint16Array has 16 bits per number, the other types have 8. */
  rgba: Uint8Array | Uint8ClampedArray | Uint16Array;
}

/** Pixels of an image to be encoded. */
export interface PixelsToEncode {
  width: number;
  height: number;
  /** Numbers per pixel. The encoded file must have the same number of channels and bits. */
  channels: 3 | 4;
  bits: 8 | 16;
  data: Uint8Array | Uint16Array;
  /** JPEG quality: 1 to 100. */
  quality: number;
}

/**
 * Progress of a call: `done` of `total` steps of the current stage ("reading", "computing tangents"). 0 of 0: unknown.
 */
export interface Progress {
  what: string;
  done: number;
  total: number;
}

/** An AbortSignal, or an object with this property, which is checked many times per second during a call. */
export interface StopSignal {
  readonly aborted: boolean;
  readonly reason?: unknown;
}

export type ImageType = "image/png" | "image/jpeg" | "image/webp";

/** Options are those of the tool (docs/reference/tool.md), in camelCase: --memory-limit is memoryLimit. */
export interface ModelOptions extends FileOptions {
  /** Name of the model in reports. OBJ is recognized by its extension. */
  name?: string;
  resources?: Resources;
  /** For models compressed with meshopt; `generate` also needs the encoder if the output is compressed. */
  meshopt?: Meshopt;
  /** For models compressed with Draco; `generate` also needs the encoder if the output is compressed. */
  draco?: Draco;
  /**
   * Stops the call, which then throws `signal.reason`, or a TspaceError with the code "stopped". Events are not
   * processed during a call, so a signal from another thread must use shared memory (docs/reference/javascript.md).
   */
  signal?: StopSignal;
}

/**
 * Decodes an image file to pixels. If the function returns null or undefined, or throws, the image is not examined, and
 * the report states this.
 */
export type DecodeImage = (file: Uint8Array, type: ImageType) => Pixels | null | undefined;

export interface WatchOptions {
  /** An exception from this callback ends the call. */
  onProgress?: (progress: Progress) => void;
}

export interface ImageOptions {
  /** Decodes normal maps synchronously. {@link decodeImages} converts an asynchronous function. */
  decodeImage?: DecodeImage;
}

export interface GenerateOptions extends ModelOptions, ImageOptions, WatchOptions, GenerateFileOptions {
  /** Encodes the image as a file of this type; lossless except for JPEG. */
  encodeImage?: (pixels: PixelsToEncode, type: ImageType) => Uint8Array;
}

export interface CheckOptions extends ModelOptions, ImageOptions, WatchOptions, CheckFileOptions {}

export interface IdentifyOptions extends ModelOptions, IdentifyFileOptions {}

export interface DiffOptions extends Omit<ModelOptions, "name">, DiffFileOptions {}

export type Severity = "error" | "warning" | "note";

/**
 * Adds normals and tangents where materials need them, or repairs existing ones.
 * @returns the bytes of a .glb with all data embedded (empty after `dryRun`), and the report
 */
export function generate(model: Bytes, options?: GenerateOptions): { bytes: NewUint8Array; report: GenerateReport };

/** Finds errors in the frames of a model: inverted signs, averaged seams, a wrong UV set, and more. */
export function check(model: Bytes, options?: CheckOptions): CheckReport;

/**
 * Returns the remedy of a finding, with calls of this module instead of command lines: `generate(model, { repair: true
 * })`.
 */
export function remedyText(finding: Finding): string;

/** Describes the contents of a model: meshes, attributes, materials that need tangents. */
export function inspect(model: Bytes, options?: ModelOptions): InspectReport;

/** Identifies the method and convention that computed the tangents of a model. */
export function identify(model: Bytes, options?: IdentifyOptions): IdentifyReport;

/** Compares the tangent frames of two models of the same surface. `resources` applies to both. */
export function diff(a: Bytes, b: Bytes, options?: DiffOptions): DiffReport;

/**
 * Decodes the normal maps of a model with a function that may return promises, before a synchronous call: `check(model,
 * { decodeImage: await decodeImages(model, decodeByCanvas) })`.
 * @param options options of the call; `resources`, `meshopt`, `draco`, `allowExternal` and `memoryLimit` are used
 * @returns the option decodeImage for calls with this model
 */
export function decodeImages(
  model: Bytes,
  decode: (file: Uint8Array, type: ImageType) => Pixels | null | undefined | Promise<Pixels | null | undefined>,
  options?: ModelOptions & Record<string, unknown>,
): Promise<DecodeImage>;

/**
 * Decodes with browser features (createImageBitmap, OffscreenCanvas), also in workers: 8 bits per channel, exact for
 * opaque pixels.
 */
export function decodeByCanvas(file: Uint8Array, type: ImageType): Promise<Pixels>;
