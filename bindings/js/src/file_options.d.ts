// SPDX-License-Identifier: MIT
// Options of calls on files, with the help of the tool.

// Everything below is written by scripts/api.

export interface GenerateFileOptions {
  /** Report what would be written, and all problems, without writing anything. */
  dryRun?: boolean;
  /**
   * Geometry compression of the output. keep: the compression of the input; none: uncompressed; meshopt:
   * EXT_meshopt_compression, which is lossless; draco: KHR_draco_mesh_compression, which quantizes positions, normals
   * and UVs, except attributes that are already Draco-compressed in the input. Default: keep.
   */
  compress?: "keep" | "none" | "meshopt" | "draco";
  /**
   * Write the coordinates of OBJ, PLY and STL files unchanged. By default, coordinates that are too far from the origin
   * for the 32-bit floats of glTF (map coordinates in meters, for example) are moved by an offset, which becomes the
   * translation of the nodes.
   */
  keepCoordinates?: boolean;
  /** Also process primitives whose material needs no tangents. */
  all?: boolean;
  /** Add missing tangents and keep existing ones. This is the default. */
  onlyMissing?: boolean;
  /** Recompute existing tangents. */
  overwrite?: boolean;
  /**
   * Add missing tangents, keep correct ones, and repair tangents that are not finite, not of unit length or not
   * orthogonal to the normal, that have a wrong sign, or that do not follow the UVs.
   */
  repair?: boolean;
  /** Remove tangents that no material needs, including their buffer data. */
  strip?: boolean;
  /**
   * Treatment of KHR_texture_transform. apply: tangents follow the transformed UVs, for viewers that use tangents
   * unchanged; ignore: tangents follow the stored UVs, for viewers that rotate tangents themselves. Default: apply.
   */
  textureTransform?: "apply" | "ignore";
  /**
   * Tangent method. mikktspace: the method of bakers and engines, bit-identical to its reference implementation;
   * lengyel: one tangent per vertex, no splits; uniform, angle, area: averages over the adjacent triangles with these
   * weights; fast, best: closer to dP/du of the smooth surface, for maps that were not baked (best is slower and more
   * accurate); flat: one per face; basis: from the normals alone, without UVs. Default: mikktspace.
   */
  method?: "mikktspace" | "lengyel" | "uniform" | "angle" | "area" | "flat" | "basis" | "fast" | "best";
  /**
   * Faces that mikktspace works on. triangles: the triangles of the file, for maps baked from triangulated models;
   * quads: pairs of consecutive triangles are treated as quads, as in Blender before export; auto: quads if existing
   * tangents match quads, or if a Blender file without tangents consists of split quads, otherwise triangles. See
   * docs/concepts/quads.md. Default: triangles; with `repair`: auto.
   */
  faces?: "triangles" | "quads" | "auto";
  /**
   * Neighbor search of mikktspace. reference: as in mikktspace.c, which misses some neighbors in the last bucket of its
   * edge list, depending on face order; corrected: all neighbors are found, so the result does not depend on face order.
   * See docs/concepts/methods/mikktspace.md. Default: reference.
   */
  pairing?: "reference" | "corrected";
  /**
   * Angular threshold of mikktspace: tangents of adjacent faces that differ by this angle or more are not averaged. In
   * degrees, 0 to 180; a value above 180 has the effect of 360 minus the value, because only the cosine is used. Bakers
   * use 180. Default: 180.
   */
  threshold?: number | string;
  /**
   * Tangent direction where UVs are sheared. gram-schmidt: along dP/du; symmetric: halfway between dP/du and the
   * direction perpendicular to dP/dv. symmetric is not available with `method` mikktspace or basis. Default: gram-
   * schmidt.
   */
  frame?: "gram-schmidt" | "symmetric";
  /**
   * Number of refinement steps of `method` best and `normals` best: 0, 1 or 2. Each step reduces the shading error
   * between vertices, by fitting the interpolated tangents and normals to the edges of the mesh. Default: 1 for
   * tangents, 2 for normals.
   */
  refine?: number | string;
  /**
   * Also write the direction of dP/dv as the attribute _BITANGENT, for shaders that read it. It differs from cross(N, T)
   * where UVs are sheared. It is written only where tangents are computed, and without morph target deltas.
   */
  bitangents?: boolean;
  /**
   * Sign convention of the output tangents: gltf, opengl, directx, unreal, unity, blender or godot. Positions, UVs and
   * normals are unchanged. Use a value other than gltf only for readers that expect it. Default: gltf.
   */
  convention?: "gltf" | "opengl" | "directx" | "unreal" | "unity" | "blender" | "godot";
  /**
   * Component type of written tangents and normals: float, snorm16 (half the size) or snorm8 (a quarter of the size).
   * snorm16 and snorm8 keep the sign exact and declare KHR_mesh_quantization. Default: float.
   */
  format?: "float" | "snorm16" | "snorm8";
  /**
   * Also write the whole frame of each vertex (N, T and the sign) as one packed attribute such as _FRAME32, for engines
   * that read it: frame32, frame48, frame64, oct32, qtangent64, snorm8_pair, snorm16_pair, gltf_snorm8 or gltf_snorm16.
   * Applies to every primitive that has normals and tangents in the output, including existing ones. See
   * docs/concepts/pack.md.
   */
  pack?: "frame32" | "frame48" | "frame64" | "oct32" | "qtangent64" | "snorm8_pair" | "snorm16_pair" | "gltf_snorm8" | "gltf_snorm16";
  /**
   * Attributes to remove where frames were packed. tangents: TANGENT; all: TANGENT and NORMAL, for engines that read
   * only packed frames. Attributes with morph target deltas are kept. By default both attributes are kept.
   */
  packDrop?: "tangents" | "all";
  /**
   * Invert the green channel of normal maps in which check detects that green points down throughout (as in DirectX).
   * Image files of a .gltf are not changed; the output gets new files.
   */
  flipGreen?: boolean;
  /** Invert the green channel of every normal map, whatever its direction. */
  flipGreenAll?: boolean;
  /**
   * Rewrite normal maps whose encoding is not that of glTF, as detected by check: maps with only x and y, with exchanged
   * channels, with x in the alpha channel (DXT5nm), with values encoded as sRGB, or with vectors in object space.
   * Rewritten maps are PNG, even if the input is KTX2 or DDS. Height maps are kept, because their strength is unknown
   * (see tspace height-to-normal).
   */
  fixMaps?: boolean;
  /** The name of fix-maps before 0.1. */
  mendMaps?: boolean;
  /**
   * Do not read the pixels of normal maps. `repair` then keeps inverted tangent signs, because it cannot determine
   * whether the maps are inverted too.
   */
  noImages?: boolean;
  /**
   * Texture compression of normal maps. keep, the only value: images keep their format (KTX2 and DDS too), except that
   * normal maps rewritten by another option become PNG. To compress maps for engines, use tspace compress-map. Default:
   * keep.
   */
  compressMaps?: "keep";
  /**
   * Method for missing normals (or all, with `overwriteNormals`). flat: one normal per face; uniform, area, angle,
   * angle-area, max: mean of the face normals with these weights (angle-area: angle times area; max: weights of N. Max
   * 1999, exact on spheres); best: fitted quadratic surface, the most accurate and slowest. Default: flat, as glTF
   * specifies; for an OBJ file with smoothing groups, these groups with angle weights.
   */
  normals?: "flat" | "uniform" | "area" | "angle" | "max" | "angle-area" | "best";
  /**
   * Crease angle for computed normals: edges whose faces meet at a larger angle stay hard. In degrees, 0 to 180; 180: no
   * hard edges; auto: an angle chosen per mesh, which the report states. Without `normals`, this option implies angle
   * weights. Default: 180.
   */
  crease?: number | string;
  /**
   * Denoising for `normals` best on noisy positions, such as scans: normals are computed from a larger neighborhood, so
   * that noise does not show in the shading. Vertices do not move. auto: strength from the measured noise level, or off
   * if the deviations look like real detail; 0: off; up to 4: multiple of the measured noise level, applied even if the
   * deviations look like real detail. Default: 0.
   */
  denoise?: number | string;
  /**
   * Weld distance, in mesh units (before node transforms): positions that differ by at most this distance in each
   * coordinate are welded when normals are computed and winding is fixed. 0: only equal positions; auto: twice the float
   * spacing at the largest coordinate of the mesh. Tangents are always computed on the unwelded positions. Default:
   * auto.
   */
  weldDistance?: number | string;
  /**
   * Compute the normals of each primitive only from its own triangles. By default, normals are smooth across the border
   * of two primitives of a mesh that share edges; `crease` applies there too.
   */
  normalsPerPrimitive?: boolean;
  /**
   * Recompute existing normals and add missing ones in every primitive, as set by `normals` and `crease`. Without
   * `normals`, angle weights are used. Existing tangents are recomputed too, because they would not fit the new normals.
   */
  overwriteNormals?: boolean;
  /**
   * Normal deltas of morph targets. keep: keep existing ones; missing: add them to targets without any; all: recompute
   * them for all targets. Computed deltas rotate the normal as the target rotates the surrounding surface. Default:
   * keep.
   */
  morphNormals?: "keep" | "missing" | "all";
  /**
   * Flip triangles whose winding disagrees with their neighbors, and connected components that are inside out, before
   * any other step. The outside of a component is determined by the first of these rules that applies: (1) its existing
   * normals, if they agree; (2) if it is closed, its signed volume or its nesting in other components; (3) if it is open
   * but has an inside, its winding number; (4) the winding of most of its area. See docs/concepts/winding.md.
   */
  fixWinding?: boolean;
  /** The name of fix-winding before 0.1. */
  mendWinding?: boolean;
  /**
   * Write the raw tangents of the method, even if they contain NaN or infinity, are zero, do not have unit length, are
   * parallel to the normal, or have different signs within a face. By default such tangents are repaired and counted.
   */
  noSanitize?: boolean;
  /**
   * Normalize every tangent and make it orthogonal to its normal, including tangents that need no repair. Where normals
   * do not have unit length, the result then no longer matches bakes exactly.
   */
  orthogonalize?: boolean;
}

export interface CheckFileOptions {
  /** Exit with code 1 if there is a finding of this severity or higher: note, warning or error. Default: error. */
  failOn?: "note" | "warning" | "error";
  /**
   * Minimum severity to report: note, warning or error. Findings below it are not printed and do not affect the exit
   * code. Default: note.
   */
  severity?: "note" | "warning" | "error";
  /**
   * Ignore findings with this code, such as tangentsUnused: they are not printed and do not affect the exit code. Comma-
   * separated; may be given several times.
   */
  ignore?: string | readonly string[];
  /**
   * Tolerance in degrees, 0 to 180: how far a tangent may lie outside the range of directions that its adjacent
   * triangles span. Default: 10.
   */
  angle?: number | string;
  /** Expected sign convention: gltf, opengl, directx, unreal, unity, blender or godot, as in generate. Default: gltf. */
  convention?: "gltf" | "opengl" | "directx" | "unreal" | "unity" | "blender" | "godot";
  /**
   * Faces used to compute the tangents that stored tangents are compared with: triangles; quads; or auto: quads where
   * the stored tangents clearly fit quads better, as in files from Blender, otherwise triangles. Default: auto.
   */
  faces?: "triangles" | "quads" | "auto";
  /**
   * Weld distance, in mesh units (before node transforms): positions that differ by at most this distance in each
   * coordinate are welded for the checks of winding, primitive borders and noise. 0: only equal positions; auto: twice
   * the float spacing at the largest coordinate of the mesh. Tangents are always computed on the unwelded positions.
   * Default: auto.
   */
  weldDistance?: number | string;
  /** Do not examine the pixels of normal maps. */
  noImages?: boolean;
}

export interface FileOptions {
  /**
   * Also follow paths in a model that lead outside its own folder. By default, absolute paths, paths with '..' and URLs
   * are rejected.
   */
  allowExternal?: boolean;
  /**
   * Approximate memory limit per file, e.g. 512M or 4G (at least 64M), or none. Memory use is estimated first, and a
   * file that would exceed the limit is rejected. Default: 64M plus 16 times the size of the input (for a model,
   * including the files it references), which protects against small files that declare huge sizes.
   */
  memoryLimit?: number | string;
}

export interface IdentifyFileOptions {
  /** Tangents that differ by at most this angle are treated as equal. In degrees, 0 to 180. Default: 1. */
  tolerance?: number | string;
}

export interface DiffFileOptions {
  /**
   * Exit with code 1 if an angle exceeds this tolerance, a sign differs, or a triangle has no match. In degrees, 0 to
   * 180. Default: 1.
   */
  tolerance?: number | string;
  /** Number of vertices to list, in order of decreasing difference. Default: 8. */
  worst?: number | string;
}
