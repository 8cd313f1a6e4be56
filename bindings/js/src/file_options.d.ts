// SPDX-License-Identifier: MIT
// Options of calls on files, with the help of the tool. Written by scripts/api.

export interface GenerateFileOptions {
  /** Dry run: report what would be written and what is wrong, without writing. */
  dryRun?: boolean;
  /**
   * Geometry compression of the output. keep: the compression of the input; none: uncompressed; meshopt:
   * EXT_meshopt_compression, which is lossless; draco: KHR_draco_mesh_compression, which quantizes positions, normals
   * and UVs that were not Draco data before. Default: keep.
   */
  compress?: "keep" | "none" | "meshopt" | "draco";
  /**
   * Write the coordinates of OBJ, PLY and STL files unchanged. By default an offset is subtracted from coordinates that
   * are too far from the origin for the 32-bit floats of glTF, such as map coordinates in meters, and becomes the
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
   * Add missing tangents, keep good ones, and recompute wrong ones: not finite, not unit, not orthogonal to the normal,
   * with a wrong sign, or not along the UVs.
   */
  repair?: boolean;
  /** Remove tangents that no material needs, with their data. */
  strip?: boolean;
  /**
   * Treatment of KHR_texture_transform. apply: tangents follow the transformed UVs, for viewers that use tangents
   * unchanged; ignore: tangents follow the stored UVs, for viewers that rotate tangents themselves. Default: apply.
   */
  textureTransform?: "apply" | "ignore";
  /**
   * Tangent method. mikktspace: bit-identical to what bakers and engines use; lengyel: one tangent per vertex, no
   * splits; uniform, angle, area: weighted means; fast, best: more accurate, for maps that were not baked; flat: one per
   * face; basis: from the normals alone, without UVs. Default: mikktspace.
   */
  method?: "mikktspace" | "lengyel" | "uniform" | "angle" | "area" | "flat" | "basis" | "fast" | "best";
  /**
   * Faces that mikktspace works on. triangles: those of the file, for bakes of triangulated models; quads: pairs of
   * consecutive triangles, as in Blender before export; auto: quads if the file's tangents show it, or if a file without
   * tangents comes from Blender and its triangles are split quads. `repair` uses auto unless another value is given. See
   * docs/concepts/quads.md. Default: triangles.
   */
  faces?: "triangles" | "quads" | "auto";
  /**
   * Neighbor search of mikktspace. reference: as in the reference implementation, including its known defect; corrected:
   * without the defect, so that the result does not depend on face order. Default: reference.
   */
  pairing?: "reference" | "corrected";
  /**
   * Angular threshold of mikktspace: faces whose tangents differ by this angle or more are not averaged. In degrees, 0
   * to 360. Bakers use 180. Default: 180.
   */
  threshold?: number | string;
  /**
   * Tangent direction where UVs are sheared. gram-schmidt: along dP/du; symmetric: halfway between dP/du and the
   * direction perpendicular to dP/dv. Not for mikktspace and basis. Default: gram-schmidt.
   */
  frame?: "gram-schmidt" | "symmetric";
  /**
   * Refinement steps of `method` best and `normals` best: 0, 1 or 2. Each step improves the fit of the interpolated
   * vectors along edges. Without this option normals take 2 steps. Default: 1.
   */
  refine?: number | string;
  /**
   * Also write the direction of dP/dv as the attribute _BITANGENT, for shaders that read it; it differs from cross(N, T)
   * where UVs are sheared. Written only where tangents are computed, and without morph target deltas.
   */
  bitangents?: boolean;
  /**
   * Sign convention of the output tangents: gltf, opengl, directx, unreal, unity, blender or godot. Positions, UVs and
   * normals are unchanged. Use a value other than gltf only for readers that expect it. Default: gltf.
   */
  convention?: "gltf" | "opengl" | "directx" | "unreal" | "unity" | "blender" | "godot";
  /**
   * Component type of the written tangents and normals: float, snorm16 (half the size) or snorm8 (a quarter). The sign
   * stays exact. The last two declare KHR_mesh_quantization. Default: float.
   */
  format?: "float" | "snorm16" | "snorm8";
  /**
   * Also write the whole frame of each vertex (N, T and the sign) as one packed attribute, _FRAME32 for example, for
   * engines that read it. Applies to every primitive that ends up with normals and tangents, existing ones included. See
   * docs/concepts/pack.md.
   */
  pack?: "frame32" | "frame48" | "frame64" | "oct32" | "qtangent64" | "snorm8_pair" | "snorm16_pair" | "gltf_snorm8" | "gltf_snorm16";
  /**
   * Attributes to remove where frames were packed.  tangents: TANGENT; all: NORMAL too, for engines that read only
   * packed frames. Attributes that morph targets add to are kept. By default both are kept.
   */
  packDrop?: "tangents" | "all";
  /**
   * Invert the green channel of normal maps whose green points down throughout (as in DirectX), as detected by check.
   * Images beside a .gltf are not changed; the output gets new files.
   */
  flipGreen?: boolean;
  /** Invert the green channel of every normal map, whichever way it points. */
  flipGreenAll?: boolean;
  /**
   * Rewrite normal maps whose encoding is not that of glTF, as detected by check: two channels, exchanged channels, x in
   * alpha, colors (sRGB), object space. They become PNGs, also from KTX2 and DDS. Height maps are kept, because their
   * strength is unknown (see tspace height-to-normal).
   */
  fixMaps?: boolean;
  /** The name of fix-maps before 0.1. */
  mendMaps?: boolean;
  /**
   * Do not read the pixels of normal maps; `repair` reads them where most signs are inverted. Inverted signs are then
   * kept, since the maps may be inverted too.
   */
  noImages?: boolean;
  /**
   * keep: images are unchanged, including KTX2 and DDS, except normal maps that another option rewrites: those become
   * PNGs. For engine textures see tspace compress-map. Default: keep.
   */
  compressMaps?: "keep";
  /**
   * Method for missing normals (or all, with `overwriteNormals`): flat, uniform, area, angle, angle-area, max or best.
   * Default: flat, as glTF specifies; the smoothing groups of an OBJ file, with angle weights, if it has any.
   */
  normals?: "flat" | "uniform" | "area" | "angle" | "max" | "angle-area" | "best";
  /**
   * Crease angle for computed normals: sharper edges stay hard. In degrees, 0 to 180; 180: no hard edges. auto: an angle
   * chosen per mesh, which the report states. Without `normals` it implies angle weights. Default: 180.
   */
  crease?: number | string;
  /**
   * Denoising for `normals` best on noisy positions, such as scans: uses a larger neighborhood, so that noise is not
   * shaded. Vertices do not move. auto: as much as is measured, and none where that is shape; 0 to 4: this multiple of
   * the measured noise, even where it looks like shape. Default: 0.
   */
  denoise?: number | string;
  /**
   * Weld distance, in the unit of positions before node transforms: positions that differ by at most this in each
   * coordinate count as one when normals are computed and triangles are turned. 0: only equal positions. auto: twice the
   * float spacing at the largest coordinate of the mesh. Tangents are always computed on the unwelded positions.
   * Default: auto.
   */
  weldDistance?: number | string;
  /**
   * Compute the normals of each primitive only from its own triangles. By default normals are smooth across the border
   * of two primitives of a mesh that share edges; `crease` applies there too.
   */
  normalsPerPrimitive?: boolean;
  /**
   * Recompute existing normals and add missing ones in every primitive, by `normals` and `crease`. Without `normals`:
   * with angle weights. Existing tangents are recomputed too, because they would not fit the new normals.
   */
  overwriteNormals?: boolean;
  /**
   * Normal deltas of morph targets. keep: keep existing ones; missing: add them to targets without any; all: recompute
   * them for all targets. The normal rotates as the surrounding surface does. Default: keep.
   */
  morphNormals?: "keep" | "missing" | "all";
  /**
   * Turn triangles whose winding disagrees with their neighbors, and parts that are inside out, before anything else.
   * The outside is given by existing normals where they agree; otherwise by the volume, the inside or the majority.
   */
  fixWinding?: boolean;
  /** The name of fix-winding before 0.1. */
  mendWinding?: boolean;
  /**
   * Write the raw result of the method, even where it is not finite, zero, not unit, parallel to the normal, or of mixed
   * sign within a face. By default such tangents are repaired and counted.
   */
  noSanitize?: boolean;
  /**
   * Also make every valid tangent unit and orthogonal to its normal. The result then no longer matches bakes exactly
   * where normals are not unit.
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
   * Reference faces for tangents. auto: triangles, or quads where the tangents clearly fit those better, as Blender's
   * do; triangles, quads: only those. Default: auto.
   */
  faces?: "triangles" | "quads" | "auto";
  /**
   * Weld distance, in the unit of positions before node transforms: positions that differ by at most this in each
   * coordinate count as one for winding, borders of primitives and noise. 0: only equal positions. auto: twice the float
   * spacing at the largest coordinate of the mesh. Tangents are always computed on the unwelded positions. Default:
   * auto.
   */
  weldDistance?: number | string;
  /** Do not examine the pixels of normal maps. */
  noImages?: boolean;
}

export interface FileOptions {
  /**
   * Also follow paths in a model that lead outside its own folder. By default absolute paths, paths with '..' and URLs
   * are rejected.
   */
  allowExternal?: boolean;
  /**
   * Approximate memory limit per file, e.g. 512M or 4G (at least 64M), or none. Memory use is estimated first, and a
   * file that would exceed the limit is rejected. Default: 64M plus 16 times the size of the file and the files it
   * references, so that a small file that claims huge sizes does no harm.
   */
  memoryLimit?: number | string;
}

export interface IdentifyFileOptions {
  /** Tangents that differ by less than this count as equal. In degrees, 0 to 180. Default: 1. */
  tolerance?: number | string;
}

export interface DiffFileOptions {
  /**
   * Exit with code 1 if an angle exceeds this tolerance, a sign differs, or a triangle has no match. In degrees, 0 to
   * 180. Default: 1.
   */
  tolerance?: number | string;
  /** Number of worst places to list. Default: 8. */
  worst?: number | string;
}
