// SPDX-License-Identifier: MIT
import type { CheckReport, DiffReport, Finding, GenerateReport, IdentifyReport, InspectReport } from "./reports.js";
import type { CheckFileOptions, DiffFileOptions, FileOptions, GenerateFileOptions, IdentifyFileOptions } from "./file_options.js";
import type { NewUint8Array } from "./types.js";

export { TspaceError } from "./types.js";
/** Reports are the entries of the tool's JSON (docs/reference/json.md) for one file, with the exit code; that of diff is all of it. */
export * from "./reports.js";
export type Report = GenerateReport | CheckReport | InspectReport | IdentifyReport;

/** Resolves when calls can be made. */
export const ready: Promise<void>;

/** Gives the module's memory back. The next call starts with little memory. */
export function release(): void;

/** A file: .glb, .vrm, .gltf or, where `name` ends in .obj, OBJ. Read during the call only, and never changed. */
export type Bytes = Uint8Array | ArrayBuffer;

/**
 * The files that a model names, by their paths relative to it ("textures/normal.png"). Paths that lead out of the model's folder
 * are never asked for. Without a buffer (.bin) the call fails; without an image it goes on.
 */
export type Resources =
  | Readonly<Record<string, Bytes>>
  | ReadonlyMap<string, Bytes>
  | ((path: string) => Bytes | null | undefined);

/** MeshoptDecoder and MeshoptEncoder of npm's meshoptimizer, both ready. */
export interface Meshopt {
  decoder: { decodeGltfBuffer(target: Uint8Array, count: number, size: number, source: Uint8Array, mode: string, filter?: string): void };
  encoder?: { encodeGltfBuffer(source: Uint8Array, count: number, size: number, mode: string, version?: number): Uint8Array };
}

/** What `createDecoderModule` and `createEncoderModule` of npm's draco3d resolve to. */
export interface Draco {
  decoder: object;
  encoder?: object;
}

/** Four numbers for each pixel, the top row first: as the file has them, neither multiplied by alpha nor changed by a colour profile. */
export interface Pixels {
  width: number;
  height: number;
  /** A Uint16Array for 16 bits. */
  rgba: Uint8Array | Uint8ClampedArray | Uint16Array;
}

/** What an image becomes that is written. */
export interface PixelsToEncode {
  width: number;
  height: number;
  /** Numbers for each pixel. The file must have as many, and as many bits. */
  channels: 3 | 4;
  bits: 8 | 16;
  data: Uint8Array | Uint16Array;
  /** Of a JPEG: 1 to 100. */
  quality: number;
}

/** How far a call is: `done` of `total` steps of what it does ("reading", "computing tangents"). 0 of 0: nobody knows. */
export interface Progress {
  what: string;
  done: number;
  total: number;
}

/** An AbortSignal, or anything that says so: it is looked at while a call runs, many times a second. */
export interface StopSignal {
  readonly aborted: boolean;
  readonly reason?: unknown;
}

export type ImageType = "image/png" | "image/jpeg" | "image/webp";

/** Options are those of the tool (docs/reference/tool.md), in camelCase: --memory-limit is memoryLimit. */
export interface ModelOptions extends FileOptions {
  /** What reports call the model. OBJ is told by its ending. */
  name?: string;
  resources?: Resources;
  /** For models compressed by meshopt; `generate` needs the encoder too where the output is compressed. */
  meshopt?: Meshopt;
  /** For models compressed by Draco, in the same way. */
  draco?: Draco;
  /**
   * Ends the call: it throws `signal.reason`, or a TspaceError with the code "stopped". Events are not heard while a call runs, so a
   * signal of another thread has to go through shared memory (docs/reference/javascript.md).
   */
  signal?: StopSignal;
}

/** Nothing, or an error thrown: the image is not looked at, and the report says so. */
export type DecodeImage = (file: Uint8Array, type: ImageType) => Pixels | null | undefined;

export interface WatchOptions {
  /** What it throws ends the call. */
  onProgress?: (progress: Progress) => void;
}

export interface ImageOptions {
  /** Decodes normal maps, at once. {@link decodeImages} makes one of a function that takes its time. */
  decodeImage?: DecodeImage;
}

export interface GenerateOptions extends ModelOptions, ImageOptions, WatchOptions, GenerateFileOptions {
  /** The image as a file of this type, without loss but for a JPEG. */
  encodeImage?: (pixels: PixelsToEncode, type: ImageType) => Uint8Array;
}

export interface CheckOptions extends ModelOptions, ImageOptions, WatchOptions, CheckFileOptions {}

export interface IdentifyOptions extends ModelOptions, IdentifyFileOptions {}

export interface DiffOptions extends Omit<ModelOptions, "name">, DiffFileOptions {}

export type Severity = "error" | "warning" | "note";

/**
 * Adds normals and tangents where materials need them, or mends them.
 * @returns the bytes of a .glb with everything in it, none after `dryRun`; and what was done
 */
export function generate(model: Bytes, options?: GenerateOptions): { bytes: NewUint8Array; report: GenerateReport };

/** Says what is wrong with the frames of a model: inverted signs, averaged seams, the wrong UV set, and more. */
export function check(model: Bytes, options?: CheckOptions): CheckReport;

/** The remedy of a finding with calls of this module in place of command lines: `generate(model, { repair: true })`. */
export function remedyText(finding: Finding): string;

/** Says what is in a model: meshes, attributes, materials that need tangents. */
export function inspect(model: Bytes, options?: ModelOptions): InspectReport;

/** Says which method and convention made the tangents of a model. */
export function identify(model: Bytes, options?: IdentifyOptions): IdentifyReport;

/** Compares the frames of two models that show the same surface. Resources are those of both. */
export function diff(a: Bytes, b: Bytes, options?: DiffOptions): DiffReport;

/**
 * Decodes the normal maps of a model by a function that may give promises, before a call that cannot wait for them:
 * `check(model, { decodeImage: await decodeImages(model, decodeByCanvas) })`.
 * @param options those of the call; `resources`, `meshopt`, `draco`, `allowExternal` and `memoryLimit` count
 * @returns the option decodeImage of calls with this model
 */
export function decodeImages(
  model: Bytes,
  decode: (file: Uint8Array, type: ImageType) => Pixels | null | undefined | Promise<Pixels | null | undefined>,
  options?: ModelOptions & Record<string, unknown>,
): Promise<DecodeImage>;

/** Decodes by what browsers and their workers have (createImageBitmap, OffscreenCanvas): 8 bits a channel, exact where nothing is transparent. */
export function decodeByCanvas(file: Uint8Array, type: ImageType): Promise<Pixels>;
