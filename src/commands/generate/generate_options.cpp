// SPDX-License-Identifier: MIT
// Options for the output and for the computation of frames. The meaning, unit and default of each option are defined in
// this file only.
#include <optional>

#include "commands/shared/file_options.h"
#include "commands/shared/request.h"

namespace tspace::options {
namespace {

constexpr Named<Pairing> kPairings[] = {
    {"reference", Pairing::reference},
    {"corrected", Pairing::corrected},
};
constexpr Named<FrameShape> kFrames[] = {
    {"gram-schmidt", FrameShape::gramSchmidt},
    {"symmetric", FrameShape::symmetric},
};
constexpr Named<NormalWeighting> kWeightings[] = {
    {"flat", NormalWeighting::flat}, {"uniform", NormalWeighting::uniform},
    {"area", NormalWeighting::area}, {"angle", NormalWeighting::angle},
    {"max", NormalWeighting::max},   {"angle-area", NormalWeighting::angleArea},
    {"best", NormalWeighting::best},
};
constexpr Named<TextureTransform> kTextureTransforms[] = {
    {"apply", TextureTransform::apply},
    {"ignore", TextureTransform::ignore},
};
constexpr Named<Compression> kCompressions[] = {
    {"keep", Compression::keep},
    {"none", Compression::none},
    {"meshopt", Compression::meshopt},
    {"draco", Compression::draco},
};
constexpr Named<VectorFormat> kVectorFormats[] = {
    {"float", VectorFormat::float32},
    {"snorm16", VectorFormat::snorm16},
    {"snorm8", VectorFormat::snorm8},
};
constexpr Named<std::optional<FrameFormat>> kPackFormats[] = {
    {"frame32", FrameFormat::frame32},          {"frame48", FrameFormat::frame48},
    {"frame64", FrameFormat::frame64},          {"oct32", FrameFormat::oct32},
    {"qtangent64", FrameFormat::qtangent64},    {"snorm8_pair", FrameFormat::snorm8Pair},
    {"snorm16_pair", FrameFormat::snorm16Pair}, {"gltf_snorm8", FrameFormat::gltfSnorm8},
    {"gltf_snorm16", FrameFormat::gltfSnorm16},
};
constexpr Named<MorphNormals> kMorphNormals[] = {
    {"keep", MorphNormals::keep},
    {"missing", MorphNormals::missing},
    {"all", MorphNormals::all},
};
constexpr Named<PackDrop> kPackDrops[] = {
    {"tangents", PackDrop::tangents},
    {"all", PackDrop::all},
};
void addOutput(OptionList& list, GenerateOptions& options) {
    const auto add = adder(list, kInputAndOutput);
    add(flag("--dry-run", options.dry_run,
             "Report what would be written, and all problems, without writing anything."));
    add(choice("--compress", "HOW", kCompressions, options.storage.compression,
               "Geometry compression of the output. keep: the compression of the input; none: uncompressed; meshopt: "
               "EXT_meshopt_compression, which is lossless; draco: KHR_draco_mesh_compression, which quantizes "
               "positions, normals and UVs, except attributes that are already Draco-compressed in the input."));
    addKeepCoordinates(list, options.file);
    addAllowExternal(list, options.file);
}

/// Adds the options that select which primitives get tangents, and how existing tangents are treated.
void addSelection(OptionList& list, GenerateOptions& options) {
    const auto add = adder(list, "Tangents");
    add(flag("--all", options.selection.all, "Also process primitives whose material needs no tangents."));
    add(setting("--only-missing", options.selection.existing, ExistingTangents::keep,
                "Add missing tangents and keep existing ones. This is the default."));
    add(setting("--overwrite", options.selection.existing, ExistingTangents::replace, "Recompute existing tangents."))
        .excludes = {"--only-missing"};
    add(setting("--repair", options.selection.existing, ExistingTangents::repair,
                "Add missing tangents, keep correct ones, and repair tangents that are not finite, not of unit length "
                "or not orthogonal to the normal, that have a wrong sign, or that do not follow the UVs."))
        .excludes = {"--only-missing", "--overwrite"};
    add(flag("--strip", options.selection.strip,
             "Remove tangents that no material needs, including their buffer data."))
        .excludes = {"--all"};
}

void addTangentOptions(OptionList& list, GenerateOptions& options) {
    const auto add = adder(list, "Tangents");
    TangentOptions& tangents = options.tangents.compute;
    add(choice("--texture-transform", "READING", kTextureTransforms, options.tangents.texture_transform,
               "Treatment of KHR_texture_transform. apply: tangents follow the transformed UVs, for viewers that use "
               "tangents unchanged; ignore: tangents follow the stored UVs, for viewers that rotate tangents "
               "themselves."));
    add(choice("--method", "NAME", kMethods, tangents.method,
               "Tangent method. mikktspace: the method of bakers and engines, bit-identical to its reference "
               "implementation; lengyel: one tangent per vertex, no splits; uniform, angle, area: averages over the "
               "adjacent triangles with these weights; fast, best: closer to dP/du of the smooth surface, for maps "
               "that were not baked (best is slower and more accurate); flat: one per face; basis: from the normals "
               "alone, without UVs."));
    add(choice("--faces", "FACES", kFaces, options.tangents.faces,
               "Faces that mikktspace works on. triangles: the triangles of the file, for maps baked from triangulated "
               "models; quads: pairs of consecutive triangles are treated as quads, as in Blender before export; auto: "
               "quads if existing tangents match quads, or if a Blender file without tangents consists of split quads, "
               "otherwise triangles. See docs/concepts/quads.md. Default: triangles; with --repair: auto."))
        .default_text.clear();
    add(choice("--pairing", "NAME", kPairings, tangents.pairing,
               "Neighbor search of mikktspace. reference: as in mikktspace.c, which misses some neighbors in the last "
               "bucket of its edge list, depending on face order; corrected: all neighbors are found, so the result "
               "does not depend on face order. See docs/concepts/methods/mikktspace.md."));
    add(degrees("--threshold", tangents.angular_threshold_deg, 360,
                "Angular threshold of mikktspace: tangents of adjacent faces that differ by this angle or more are not "
                "averaged. In degrees, 0 to 180; a value above 180 has the effect of 360 minus the value, because only "
                "the cosine is used. Bakers use 180."));
    add(choice(
        "--frame", "NAME", kFrames, tangents.frame,
        "Tangent direction where UVs are sheared. gram-schmidt: along dP/du; symmetric: halfway between dP/du and "
        "the direction perpendicular to dP/dv. symmetric is not available with --method mikktspace or basis."));
    add(number("--refine", tangents.refine, 2,
               "Number of refinement steps of --method best and --normals best: 0, 1 or 2. Each step reduces the "
               "shading error between vertices, by fitting the interpolated tangents and normals to the edges of the "
               "mesh. Default: 1 for tangents, 2 for normals."))
        .default_text.clear();
    add(flag("--bitangents", options.tangents.bitangents,
             "Also write the direction of dP/dv as the attribute _BITANGENT, for shaders that read it. It differs from "
             "cross(N, T) where UVs are sheared. It is written only where tangents are computed, and without morph "
             "target deltas."));
    add(choice(
        "--convention", "NAME", kConventions, tangents.convention,
        "Sign convention of the output tangents: gltf, opengl, directx, unreal, unity, blender or godot. "
        "Positions, UVs and normals are unchanged. Use a value other than gltf only for readers that expect it."));
    add(choice("--format", "NUMBERS", kVectorFormats, options.storage.format,
               "Component type of written tangents and normals: float, snorm16 (half the size) or snorm8 (a quarter of "
               "the size). snorm16 and snorm8 keep the sign exact and declare KHR_mesh_quantization."));
}

void addPackOptions(OptionList& list, GenerateOptions& options) {
    const auto add = adder(list, "Packed frames");
    add(choice("--pack", "FORMAT", kPackFormats, options.storage.pack,
               "Also write the whole frame of each vertex (N, T and the sign) as one packed attribute such as "
               "_FRAME32, for engines that read it: frame32, frame48, frame64, oct32, qtangent64, snorm8_pair, "
               "snorm16_pair, gltf_snorm8 or gltf_snorm16. Applies to every primitive that has normals and tangents in "
               "the output, including existing ones. See docs/concepts/pack.md."));
    add(choice("--pack-drop", "WHAT", kPackDrops, options.storage.pack_drop,
               "Attributes to remove where frames were packed. tangents: TANGENT; all: TANGENT and NORMAL, for engines "
               "that read only packed frames. Attributes with morph target deltas are kept. By default both attributes "
               "are kept."))
        .needs = "--pack";
}

/// Returns the option whose only value is `keep`; the error message for uastc names alternatives.
Option compressMapsOption() {
    const auto take = [](const std::string& how) {
        return how == "uastc"
                   ? std::string("not supported; use basisu to encode UASTC, or PNG or WebP for a lossless map")
                   : std::string();
    };
    Option made = option("--compress-maps", "HOW", take,
                         "Texture compression of normal maps. keep, the only value: images keep their format (KTX2 and "
                         "DDS too), except that normal maps rewritten by another option become PNG. To compress maps "
                         "for engines, use tspace compress-map.");
    made.choices = {"keep"};
    made.default_text = "keep";
    return made;
}

void addMapOptions(OptionList& list, GenerateOptions& options) {
    const auto add = adder(list, "Normal maps");
    add(setting("--flip-green", options.maps.flip_green, FlipGreen::down,
                "Invert the green channel of normal maps in which check detects that green points down throughout (as "
                "in DirectX). Image files of a .gltf are not changed; the output gets new files."));
    add(setting("--flip-green-all", options.maps.flip_green, FlipGreen::all,
                "Invert the green channel of every normal map, whatever its direction."))
        .excludes = {"--flip-green"};
    add(flag("--fix-maps", options.maps.mend,
             "Rewrite normal maps whose encoding is not that of glTF, as detected by check: maps with only x and y, "
             "with exchanged channels, with x in the alpha channel (DXT5nm), with values encoded as sRGB, or with "
             "vectors in object space. Rewritten maps are PNG, even if the input is KTX2 or DDS. Height maps are kept, "
             "because their strength is unknown (see tspace height-to-normal)."))
        .old_names = {"--mend-maps"};
    add(flag("--convert-maps", options.maps.convert,
             "Rewrite normal maps for the computed tangents, so that the shading does not change. Maps and materials "
             "shared by several primitives are copied if the primitives need different maps. Image files of a .gltf "
             "are not changed; the output gets new files."))
        .excludes = {"--flip-green", "--flip-green-all", "--fix-maps", "--repair"};
    add(setting("--no-images", options.maps.read, false,
                "Do not read the pixels of normal maps. --repair then keeps inverted tangent signs, because it cannot "
                "determine whether the maps are inverted too."))
        .excludes = {"--flip-green", "--flip-green-all", "--fix-maps", "--convert-maps"};
    add(compressMapsOption());
}

void addOtherOptions(OptionList& list, GenerateOptions& options) {
    const auto add = adder(list, "Normals"), addRepair = adder(list, "Repair");
    add(choice("--normals", "NAME", kWeightings, options.normals.compute.weighting,
               "Method for missing normals (or all, with --overwrite-normals). flat: one normal per face; uniform, "
               "area, angle, angle-area, max: mean of the face normals with these weights (angle-area: angle times "
               "area; max: weights of N. Max 1999, exact on spheres); best: fitted quadratic surface, the most "
               "accurate and slowest. Default: flat, as glTF specifies; for an OBJ file with smoothing groups, these "
               "groups with angle weights."))
        .default_text.clear();
    add(numberOrAuto("--crease", "DEG", "a number of degrees", options.normals.compute.crease_angle_deg,
                     NormalOptions::crease_auto, 180,
                     "Crease angle for computed normals: edges whose faces meet at a larger angle stay hard. In "
                     "degrees, 0 to 180; 180: no hard edges; auto: an angle chosen per mesh, which the report states. "
                     "Without --normals, this option implies angle weights."));
    add(numberOrAuto("--denoise", "FACTOR", "a number", options.normals.compute.denoise, NormalOptions::denoise_auto, 4,
                     "Denoising for --normals best on noisy positions, such as scans: normals are computed from a "
                     "larger neighborhood, so that noise does not show in the shading. Vertices do not move. auto: "
                     "strength from the measured noise level, or off if the deviations look like real detail; 0: off; "
                     "up to 4: multiple of the measured noise level, applied even if the deviations look like real "
                     "detail."));
    add(weldOption(options.normals.compute.weld_distance,
                   "Weld distance, in mesh units (before node transforms): positions that differ by at most this "
                   "distance in each coordinate are welded when normals are computed and winding is fixed. 0: only "
                   "equal positions; auto: twice the float spacing at the largest coordinate of the mesh. Tangents "
                   "are always computed on the unwelded positions."));
    add(flag("--normals-per-primitive", options.normals.per_primitive,
             "Compute the normals of each primitive only from its own triangles. By default, normals are smooth across "
             "the border of two primitives of a mesh that share edges; --crease applies there too."));
    add(flag("--overwrite-normals", options.normals.overwrite,
             "Recompute existing normals and add missing ones in every primitive, as set by --normals and --crease. "
             "Without --normals, angle weights are used. Existing tangents are recomputed too, because they would not "
             "fit the new normals."))
        .excludes = {"--convert-maps"};
    add(choice("--morph-normals", "WHICH", kMorphNormals, options.normals.morphs,
               "Normal deltas of morph targets. keep: keep existing ones; missing: add them to targets without any; "
               "all: recompute them for all targets. Computed deltas rotate the normal as the target rotates the "
               "surrounding surface."));
    addRepair(flag("--fix-winding", options.mend_winding,
                   "Flip triangles whose winding disagrees with their neighbors, and connected components that are "
                   "inside out, before any other step. The outside of a component is determined by the first of "
                   "these rules that applies: (1) its existing normals, if they agree; (2) if it is closed, its "
                   "signed volume or its nesting in other components; (3) if it is open but has an inside, its "
                   "winding number; (4) the winding of most of its area. See docs/concepts/winding.md."))
        .old_names = {"--mend-winding"};
    addRepair(setting("--no-sanitize", options.tangents.sanitize, false,
                      "Write the raw tangents of the method, even if they contain NaN or infinity, are zero, do not "
                      "have unit length, are parallel to the normal, or have different signs within a face. By "
                      "default such tangents are repaired and counted."));
    options::add(
        list, "Repair",
        flag("--orthogonalize", options.tangents.sanitize_options.orthogonalize_all,
             "Normalize every tangent and make it orthogonal to its normal, including tangents that need no repair. "
             "Where normals do not have unit length, the result then no longer matches bakes exactly."));
    addRunning(list, options.execution, options.file);
}

}  // namespace

OptionList generateOptions(GenerateOptions& options) {
    OptionList list;
    addOutput(list, options);
    addSelection(list, options);
    addTangentOptions(list, options);
    addPackOptions(list, options);
    addMapOptions(list, options);
    addOtherOptions(list, options);
    return list;
}

std::string finish(const Given& given, GenerateOptions& options) {
    const Method method = options.tangents.compute.method;
    if (options.tangents.compute.frame == FrameShape::symmetric && method == Method::mikktspace)
        return "--frame symmetric cannot be combined with --method mikktspace";
    if (options.tangents.compute.frame == FrameShape::symmetric && method == Method::basis)
        return "--frame symmetric cannot be combined with --method basis";
    if (options.tangents.faces == Faces::quads && method != Method::mikktspace)
        return "--faces quads can only be combined with --method mikktspace";
    if (options.selection.existing == ExistingTangents::repair && !given.has("--faces"))
        options.tangents.faces = Faces::automatic;
    if (given.has("--normals")) {
        options.normals.use_smoothing_groups = false;
    } else if (given.has("--crease") || options.normals.overwrite) {
        options.normals.compute.weighting = NormalWeighting::angle;
    }
    if (given.has("--refine")) options.normals.compute.refine = options.tangents.compute.refine;
    return {};
}

}  // namespace tspace::options
