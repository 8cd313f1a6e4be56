// SPDX-License-Identifier: MIT
// Options of calls on files, with the help of the tool. Written by scripts/api.

export interface GenerateFileOptions {
  /** Do everything but write: say what would be written, and where something is wrong. */
  dryRun?: boolean;
  /**
   * How geometry is packed. keep: what came in compressed goes out compressed the same way; none: everything is
   * unpacked; meshopt: EXT_meshopt_compression, which changes no value; draco: KHR_draco_mesh_compression, which rounds
   * positions, normals and UVs that were not in it before. Default: keep.
   */
  compress?: "keep" | "none" | "meshopt" | "draco";
  /**
   * For OBJ, PLY and STL: write coordinates as they are. By default an offset is taken out of those that are too far
   * from the origin for the 32-bit floats of glTF, such as metres of a map, and becomes the translation of the nodes.
   */
  keepCoordinates?: boolean;
  /** Also for primitives whose material needs no tangents. */
  all?: boolean;
  /** Add tangents where there are none and keep those that are there. This is the default. */
  onlyMissing?: boolean;
  /** Compute tangents anew where they are there. */
  overwrite?: boolean;
  /**
   * Add tangents where there are none, keep good ones, and compute anew where they are wrong: not finite, not unit, not
   * orthogonal to the normal, of a wrong sign, or not along the UVs.
   */
  repair?: boolean;
  /** Take tangents away where no material needs them, and their data with them. */
  strip?: boolean;
  /**
   * For textures with KHR_texture_transform. apply: tangents follow the transformed UVs, as viewers want that use
   * tangents as they are; ignore: those before, for viewers that turn tangents themselves. Default: apply.
   */
  textureTransform?: "apply" | "ignore";
  /**
   * How tangents are computed. mikktspace: bit for bit what bakers and engines use; lengyel: one per vertex, no splits;
   * uniform, angle, area: plain weighted means; fast, best: more accurate, for maps that were not baked; flat: one per
   * face; basis: from the normals alone, without UVs. Default: mikktspace.
   */
  method?: "mikktspace" | "lengyel" | "uniform" | "angle" | "area" | "flat" | "basis" | "fast" | "best";
  /**
   * What mikktspace is computed on. triangles: those of the file, which fit bakes of triangulated models; quads: pairs
   * of triangles that follow each other, as Blender does before it writes triangles; auto: quads where the file's
   * tangents show it, or where it has none, comes from Blender and its triangles are cut quads. `repair` takes auto
   * where nothing else is given. See docs/concepts/quads.md. Default: triangles.
   */
  faces?: "triangles" | "quads" | "auto";
  /**
   * For mikktspace. reference: neighbours as the reference implementation finds them, with its known defect; corrected:
   * without it, so that the order of faces does not matter. Default: reference.
   */
  pairing?: "reference" | "corrected";
  /**
   * For mikktspace: faces whose tangents differ by this angle or more are not averaged. In degrees, 0 to 360. 180 is
   * what every baker uses. Default: 180.
   */
  threshold?: number | string;
  /**
   * What the tangent is where UVs are sheared. gram-schmidt: the direction of dP/du; symmetric: half of the way to the
   * direction perpendicular to dP/dv. Not for mikktspace and basis. Default: gram-schmidt.
   */
  frame?: "gram-schmidt" | "symmetric";
  /**
   * For `method` best and `normals` best: steps after the fit, each of which makes what is interpolated along edges fit
   * the edges better: 0, 1 or 2. Without it normals take 2 steps. Default: 1.
   */
  refine?: number | string;
  /**
   * Also write the direction of dP/dv, which is not cross(N, T) where UVs are sheared, as the attribute _BITANGENT: for
   * shaders that read it. Only where tangents are computed; morph targets get no deltas of it.
   */
  bitangents?: boolean;
  /**
   * Whose sign is stored: gltf, opengl, directx, unreal, unity, blender or godot. Positions, UVs and normals stay as
   * they are. Any other than gltf is only for readers that expect it. Default: gltf.
   */
  convention?: "gltf" | "opengl" | "directx" | "unreal" | "unity" | "blender" | "godot";
  /**
   * Numbers of the tangents and normals that are written: float, snorm16 (half the size) or snorm8 (a quarter). The sign
   * stays exact. The last two declare KHR_mesh_quantization. Default: float.
   */
  format?: "float" | "snorm16" | "snorm8";
  /**
   * Also write the whole frame of each vertex, N, T and the sign, as an attribute of its own: _FRAME32 and so on, for
   * engines that read it. Of every primitive that has normals and tangents in the end, old ones too. See
   * docs/concepts/pack.md.
   */
  pack?: "frame32" | "frame48" | "frame64" | "oct32" | "qtangent64" | "snorm8_pair" | "snorm16_pair" | "gltf_snorm8" | "gltf_snorm16";
  /**
   * What to take away where frames were packed. tangents: TANGENT; all: NORMAL too, for engines that read nothing but
   * packed frames. What morph targets add to stays. Without this, both stay.
   */
  packDrop?: "tangents" | "all";
  /**
   * Invert the green channel of normal maps whose green points down throughout (as DirectX has it), as check finds them;
   * all others stay. Images beside a .gltf stay as they are, and the output gets new ones.
   */
  flipGreen?: boolean;
  /** Invert the green channel of every normal map, whichever way it points. */
  flipGreenAll?: boolean;
  /**
   * Write normal maps anew that hold something else than glTF reads, as check finds them: two channels, exchanged
   * channels, x in alpha, colors (sRGB), object space. They become PNGs, from KTX2 and DDS too. Height maps stay: their
   * strength is not known (tspace height-to-normal).
   */
  mendMaps?: boolean;
  /**
   * Do not read the pixels of normal maps, which `repair` does where most signs are inverted. Such signs then stay,
   * since the maps may be inverted too.
   */
  noImages?: boolean;
  /**
   * keep: images come out as they went in, KTX2 and DDS too, but for normal maps that another option writes anew: those
   * are PNGs. Textures for engines: tspace compress-map. Default: keep.
   */
  compressMaps?: "keep";
  /**
   * How normals are made where they are missing (or all, with `overwriteNormals`): flat, uniform, area, angle, angle-
   * area, max or best. Default: flat, as glTF asks for; for OBJ files with smoothing groups those decide, with angle
   * weights.
   */
  normals?: "flat" | "uniform" | "area" | "angle" | "max" | "angle-area" | "best";
  /**
   * For normals that are made: edges sharper than this stay hard. In degrees, 0 to 180; 180 makes none hard. auto: an
   * angle by the mesh, which the report says. Given without `normals` it takes the weights of angle. Default: 180.
   */
  crease?: number | string;
  /**
   * For `normals` best on noisy positions, such as scans: normals by more of the surface around, so that noise is not
   * shaded. Vertices stay. auto: as much as is measured, and nothing where that is shape; 0 to 4: so many times the
   * noise that is measured, also where it looks like shape. Default: 0.
   */
  denoise?: number | string;
  /**
   * Positions that differ by no more than this in each coordinate are one, where normals are made and triangles turned,
   * in the unit of positions before nodes move them. 0: only equal ones are. auto: twice the spacing of floats at the
   * largest coordinate of the mesh. Tangents are computed on positions as they are. Default: auto.
   */
  weldDistance?: number | string;
  /**
   * Make the normals of each primitive from its own triangles. By default they are smooth over the border of two
   * primitives of a mesh that are one surface (they share edges); `crease` holds there too.
   */
  normalsPerPrimitive?: boolean;
  /**
   * Make normals anew where they are there, by `normals` and `crease`, and where they are missing, in every primitive.
   * Without `normals`: with the weights of angle. Tangents that are there are computed anew with them, because old ones
   * would not fit.
   */
  overwriteNormals?: boolean;
  /**
   * What morph targets add to normals that stay. keep: what is there; missing: targets without it get it; all: it is
   * computed for all. The normal turns as the surface around it turns. Default: keep.
   */
  morphNormals?: "keep" | "missing" | "all";
  /**
   * Turn triangles that are wound against their neighbours, and parts that are inside out as a whole, before anything
   * else is done. Normals that stay say which side is out where they agree; else the volume, the inside or the majority
   * does.
   */
  mendWinding?: boolean;
  /**
   * Write what the method gives, even where it is not finite, zero, not unit, parallel to the normal, or of mixed sign
   * inside a face. By default such tangents are mended and counted.
   */
  noSanitize?: boolean;
  /**
   * Also make every sound tangent unit and orthogonal to its normal. The result then no longer matches bakes exactly
   * where normals are not unit.
   */
  orthogonalize?: boolean;
}

export interface CheckFileOptions {
  /** Exit with code 1 when there is a finding of this severity or above: note, warning or error. Default: error. */
  failOn?: "note" | "warning" | "error";
  /**
   * Leave out findings below this severity: note, warning or error. They are not shown, and do not count for the exit
   * code. Default: note.
   */
  severity?: "note" | "warning" | "error";
  /**
   * Leave out findings of this code, such as tangentsUnused: they are not shown, and do not count for the exit code.
   * Several with commas between them, or several times.
   */
  ignore?: string | readonly string[];
  /**
   * How far a tangent may lie outside the directions that the triangles around it give. In degrees, 0 to 180. Default:
   * 10.
   */
  angle?: number | string;
  /** Whose signs are right: gltf, opengl, directx, unreal, unity, blender or godot, as for generate. Default: gltf. */
  convention?: "gltf" | "opengl" | "directx" | "unreal" | "unity" | "blender" | "godot";
  /**
   * What tangents are compared with. auto: triangles, and quads where the tangents fit clearly better to those, as
   * Blender's do; triangles, quads: only those. Default: auto.
   */
  faces?: "triangles" | "quads" | "auto";
  /**
   * Positions that differ by no more than this in each coordinate are one, for winding, borders of primitives and noise,
   * in the unit of positions before nodes move them. 0: only equal ones are. auto: twice the spacing of floats at the
   * largest coordinate of the mesh. Tangents are computed on positions as they are. Default: auto.
   */
  weldDistance?: number | string;
  /** Do not look at the pixels of normal maps. */
  noImages?: boolean;
}

export interface FileOptions {
  /**
   * Also follow paths in a model that lead outside its own folder. By default absolute paths, paths with '..' and URLs
   * are refused.
   */
  allowExternal?: boolean;
  /**
   * What working on one file may take of memory, about: a number with M or G (64M or more), or none. What it would take
   * is estimated first, and more is refused. Default: 64M, and 16 times the bytes of the file and of those it names, so
   * that a small file that claims to be huge does no harm.
   */
  memoryLimit?: number | string;
}

export interface IdentifyFileOptions {
  /** Tangents nearer than this count as the same. In degrees, 0 to 180. Default: 1. */
  tolerance?: number | string;
}

export interface DiffFileOptions {
  /**
   * Exit with 1 when an angle is above this, a sign differs, or a triangle has no partner. In degrees, 0 to 180.
   * Default: 1.
   */
  tolerance?: number | string;
  /** How many of the worst places are listed. Default: 8. */
  worst?: number | string;
}
