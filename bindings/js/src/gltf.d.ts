// SPDX-License-Identifier: MIT
import type { CheckReport, DiffReport, Finding, GenerateReport, IdentifyReport, InspectReport } from "./reports.js";
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
export interface ModelOptions {
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
  /** Memory that working on the model may take, such as "2G"; 0: by its size. */
  memoryLimit?: string | number;
  /** Also ask for files outside of the model's folder. */
  allowExternal?: boolean;
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

export interface GenerateOptions extends ModelOptions, ImageOptions, WatchOptions {
  /** Also where the material needs no tangents. */
  all?: boolean;
  /** Keep tangents that are there (the default), compute them anew, or mend what is wrong with them. */
  onlyMissing?: boolean;
  overwrite?: boolean;
  repair?: boolean;
  /** Take tangents away where no material needs them. */
  strip?: boolean;
  method?: "mikktspace" | "uniform" | "angle" | "area" | "fast" | "best" | "lengyel" | "flat" | "basis";
  faces?: "triangles" | "quads" | "auto";
  pairing?: "reference" | "corrected";
  /** Degrees. */
  threshold?: number | string;
  frame?: "gram-schmidt" | "symmetric";
  refine?: number | string;
  convention?: "gltf" | "opengl" | "directx" | "unreal" | "unity" | "blender" | "godot";
  textureTransform?: "apply" | "ignore";
  bitangents?: boolean;
  format?: "float32" | "snorm16" | "snorm8";
  pack?: string;
  packDrop?: "nothing" | "tangents" | "all";
  /** How normals are made where they are missing. */
  normals?: "flat" | "uniform" | "area" | "angle" | "angle-area" | "max" | "best";
  /** Degrees, or "auto". */
  crease?: number | string;
  /** For `best` on noisy positions: "auto", or 0 to 4 times the noise that is measured. */
  denoise?: number | string;
  /** Positions that differ by no more than this in each coordinate are one, for normals and winding; "auto", the default: by the spacing of floats. */
  weldDistance?: number | string;
  /** Normals of each primitive from its own triangles; else they are smooth over the borders of primitives of one mesh. */
  normalsPerPrimitive?: boolean;
  /** Normals that are there are made anew too, and the tangents that are there with them. */
  overwriteNormals?: boolean;
  /** What morph targets add to normals that stay. */
  morphNormals?: "keep" | "missing" | "all";
  /** How geometry is packed: as it came (the default), not at all, or by a codec, which must be given. */
  compress?: "keep" | "none" | "meshopt" | "draco";
  /** Inverts the green channel of normal maps whose green points down, or of all of them. Needs decodeImage and encodeImage. */
  flipGreen?: boolean;
  flipGreenAll?: boolean;
  /** Writes normal maps anew whose channels hold something else than glTF reads. Needs decodeImage and encodeImage. */
  mendMaps?: boolean;
  /** Leaves inverted signs as they are with `repair`, instead of reading the pixels of normal maps. */
  noImages?: boolean;
  /** Images come out as they went in, but for normal maps that another option writes anew. */
  compressMaps?: "keep";
  /** The image as a file of this type, without loss but for a JPEG. */
  encodeImage?: (pixels: PixelsToEncode, type: ImageType) => Uint8Array;
  /** Turns triangles that are wound against their neighbours, and parts that are inside out as a whole. */
  mendWinding?: boolean;
  noSanitize?: boolean;
  orthogonalize?: boolean;
  /** For OBJ: no offset is taken out of coordinates far from the origin. */
  keepCoordinates?: boolean;
  /** Nothing is made, but the report says what would be. */
  dryRun?: boolean;
}

export interface CheckOptions extends ModelOptions, ImageOptions, WatchOptions {
  /** Findings from this severity on make exitCode 1. */
  failOn?: Severity;
  /** Findings below it are left out. */
  severity?: Severity;
  /** Codes of findings that are left out. */
  ignore?: string | readonly string[];
  /** Degrees: angles up to it are right. */
  angle?: number | string;
  /** Positions that differ by no more than this in each coordinate are one, for winding and borders; "auto" by default. */
  weldDistance?: number | string;
  convention?: GenerateOptions["convention"];
  faces?: GenerateOptions["faces"];
  noImages?: boolean;
}

export interface IdentifyOptions extends ModelOptions {
  /** Degrees: a method explains a tangent that it comes this close to. */
  tolerance?: number | string;
}

export interface DiffOptions extends Omit<ModelOptions, "name"> {
  /** Degrees: larger angles are differences. */
  tolerance?: number | string;
  /** How many of the worst places are listed. */
  worst?: number | string;
}

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
