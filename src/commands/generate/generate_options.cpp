// SPDX-License-Identifier: MIT
// What an output is like and how its frames are made: each option, its meaning, its unit and its default stand here and
// nowhere else.
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
    const char* group = kInputAndOutput;
    add(list, group,
        flag("--dry-run", options.dry_run,
             "Dry run: report what would be written and what is wrong, without writing."));
    add(list, group,
        choice("--compress", "HOW", kCompressions, options.compression,
               "Geometry compression of the output. keep: the compression of the input; none: uncompressed; meshopt: "
               "EXT_meshopt_compression, which is lossless; draco: KHR_draco_mesh_compression, which quantizes "
               "positions, normals and UVs that were not Draco data before."));
    addKeepCoordinates(list, options.file);
    addAllowExternal(list, options.file);
}

/// Options that select the primitives that get tangents, and the treatment of existing tangents.
void addSelection(OptionList& list, GenerateOptions& options) {
    const char* group = "Tangents";
    add(list, group, flag("--all", options.all, "Also process primitives whose material needs no tangents."));
    add(list, group,
        setting("--only-missing", options.existing, ExistingTangents::keep,
                "Add missing tangents and keep existing ones. This is the default."));
    add(list, group,
        setting("--overwrite", options.existing, ExistingTangents::replace, "Recompute existing tangents."))
        .excludes = {"--only-missing"};
    add(list, group,
        setting("--repair", options.existing, ExistingTangents::repair,
                "Add missing tangents, keep good ones, and recompute wrong ones: not finite, not unit, not orthogonal "
                "to the normal, with a wrong sign, or not along the UVs."))
        .excludes = {"--only-missing", "--overwrite"};
    add(list, group, flag("--strip", options.strip, "Remove tangents that no material needs, with their data."))
        .excludes = {"--all"};
}

void addTangentOptions(OptionList& list, GenerateOptions& options) {
    const char* group = "Tangents";
    TangentOptions& tangents = options.tangents;
    add(list, group,
        choice("--texture-transform", "READING", kTextureTransforms, options.texture_transform,
               "Treatment of KHR_texture_transform. apply: tangents follow the transformed UVs, for viewers that use "
               "tangents unchanged; ignore: tangents follow the stored UVs, for viewers that rotate tangents "
               "themselves."));
    add(list, group,
        choice("--method", "NAME", kMethods, tangents.method,
               "Tangent method. mikktspace: bit-identical to what bakers and engines use; lengyel: one tangent per "
               "vertex, no splits; uniform, angle, area: weighted means; fast, best: more accurate, for maps that were "
               "not baked; flat: one per face; basis: from the normals alone, without UVs."));
    add(list, group,
        choice("--faces", "FACES", kFaces, options.faces,
               "Faces that mikktspace works on. triangles: those of the file, for bakes of triangulated models; quads: "
               "pairs of consecutive triangles, as in Blender before export; auto: quads if the file's tangents show "
               "it, or if a file without tangents comes from Blender and its triangles are split quads. --repair uses "
               "auto unless another value is given. See docs/concepts/quads.md."));
    add(list, group,
        choice("--pairing", "NAME", kPairings, tangents.pairing,
               "Neighbor search of mikktspace. reference: as in the reference implementation, including its known "
               "defect; corrected: without the defect, so that the result does not depend on face order."));
    add(list, group,
        degrees("--threshold", tangents.angular_threshold_deg, 360,
                "Angular threshold of mikktspace: faces whose tangents differ by this angle or more are not averaged. "
                "In degrees, 0 to 360. Bakers use 180."));
    add(list, group,
        choice("--frame", "NAME", kFrames, tangents.frame,
               "Tangent direction where UVs are sheared. gram-schmidt: along dP/du; symmetric: halfway between dP/du "
               "and the direction perpendicular to dP/dv. Not for mikktspace and basis."));
    add(list, group,
        number("--refine", tangents.refine, 2,
               "Refinement steps of --method best and --normals best: 0, 1 or 2. Each step improves the fit of the "
               "interpolated vectors along edges. Without this option normals take 2 steps."));
    add(list, group,
        flag("--bitangents", options.bitangents,
             "Also write the direction of dP/dv as the attribute _BITANGENT, for shaders that read it; it differs from "
             "cross(N, T) where UVs are sheared. Written only where tangents are computed, and without morph target "
             "deltas."));
    add(list, group,
        choice(
            "--convention", "NAME", kConventions, tangents.convention,
            "Sign convention of the output tangents: gltf, opengl, directx, unreal, unity, blender or godot. "
            "Positions, UVs and normals are unchanged. Use a value other than gltf only for readers that expect it."));
    add(list, group,
        choice("--format", "NUMBERS", kVectorFormats, options.format,
               "Component type of the written tangents and normals: float, snorm16 (half the size) or snorm8 (a "
               "quarter). The sign stays exact. The last two declare KHR_mesh_quantization."));
}

void addPackOptions(OptionList& list, GenerateOptions& options) {
    const char* group = "Packed frames";
    add(list, group,
        choice("--pack", "FORMAT", kPackFormats, options.pack,
               "Also write the whole frame of each vertex (N, T and the sign) as one packed attribute, _FRAME32 for "
               "example, for engines that read it. Applies to every primitive that ends up with normals and tangents, "
               "existing ones included. See docs/concepts/pack.md."));
    add(list, group,
        choice(
            "--pack-drop", "WHAT", kPackDrops, options.pack_drop,
            "Attributes to remove where frames were packed.  tangents: TANGENT; all: NORMAL too, for engines that read "
            "only packed frames. Attributes that morph targets add to are kept. By default both are kept."))
        .needs = "--pack";
}

/// There is one answer alone, and a sentence why.
Option compressMapsOption() {
    const auto take = [](const std::string& how) {
        return how == "uastc" ? std::string(
                                    "tspace has no encoder of UASTC that is nearer than that of basisu, which is "
                                    "there for it; PNG and WebP without loss are exact")
                              : std::string();
    };
    Option made = option("--compress-maps", "HOW", take,
                         "keep: images are unchanged, including KTX2 and DDS, except normal maps that another "
                         "option rewrites: those become PNGs. For engine textures see tspace compress-map.");
    made.choices = {"keep"};
    made.default_text = "keep";
    return made;
}

void addMapOptions(OptionList& list, GenerateOptions& options) {
    const char* group = "Normal maps";
    add(list, group,
        setting("--flip-green", options.flip_green, FlipGreen::down,
                "Invert the green channel of normal maps whose green points down throughout (as in DirectX), as "
                "detected by check. Images beside a .gltf are not changed; the output gets new files."));
    add(list, group,
        setting("--flip-green-all", options.flip_green, FlipGreen::all,
                "Invert the green channel of every normal map, whichever way it points."))
        .excludes = {"--flip-green"};
    add(list, group,
        flag("--fix-maps", options.mend_maps,
             "Rewrite normal maps whose encoding is not that of glTF, as detected by check: two channels, exchanged "
             "channels, x in alpha, colors (sRGB), object space. They become PNGs, also from KTX2 and DDS. Height maps "
             "are kept, because their strength is unknown (see tspace height-to-normal)."))
        .old_names = {"--mend-maps"};
    add(list, group,
        flag("--convert-maps", options.convert_maps,
             "Rewrite normal maps for the computed tangents, so that the shading does not change. Maps and materials "
             "shared by several primitives are copied where they need different ones. Images beside a .gltf are not "
             "changed; the output gets new files."))
        .excludes = {"--flip-green", "--flip-green-all", "--fix-maps", "--repair"};
    add(list, group,
        setting("--no-images", options.images, false,
                "Do not read the pixels of normal maps; --repair reads them where most signs are inverted. Inverted "
                "signs are then kept, since the maps may be inverted too."))
        .excludes = {"--flip-green", "--flip-green-all", "--fix-maps", "--convert-maps"};
    add(list, group, compressMapsOption());
}

void addOtherOptions(OptionList& list, GenerateOptions& options) {
    Option& weighting = add(list, "Normals",
                            choice("--normals", "NAME", kWeightings, options.normals.weighting,
                                   "Method for missing normals (or all, with --overwrite-normals): flat, uniform, "
                                   "area, angle, angle-area, max or best. Default: flat, as glTF specifies; the "
                                   "smoothing groups of an OBJ file, with angle weights, if it has any."));
    weighting.default_text.clear();
    add(list, "Normals",
        numberOrAuto(
            "--crease", "DEG", "a number of degrees", options.normals.crease_angle_deg, NormalOptions::crease_auto, 180,
            "Crease angle for computed normals: sharper edges stay hard. In degrees, 0 to 180; 180: no hard edges. "
            "auto: an angle chosen per mesh, which the report states. Without --normals it implies angle weights."));
    add(list, "Normals",
        numberOrAuto("--denoise", "FACTOR", "a number", options.normals.denoise, NormalOptions::denoise_auto, 4,
                     "Denoising for --normals best on noisy positions, such as scans: uses a larger neighborhood, so "
                     "that noise is not shaded. Vertices do not move. auto: as much as is measured, and none where "
                     "that is shape; 0 to 4: this multiple of the measured noise, even where it looks like shape."));
    add(list, "Normals",
        numberOrAuto("--weld-distance", "DISTANCE", "a distance", options.normals.weld_distance,
                     NormalOptions::weld_auto, 1000000000,
                     "Weld distance, in the unit of positions before node transforms: positions that differ by at most "
                     "this in each coordinate count as one when normals are computed and triangles are turned. 0: only "
                     "equal positions. auto: twice the float spacing at the largest coordinate of the mesh. Tangents "
                     "are always computed on the unwelded positions."));
    add(list, "Normals",
        flag("--normals-per-primitive", options.normals_per_primitive,
             "Compute the normals of each primitive only from its own triangles. By default normals are smooth across "
             "the border of two primitives of a mesh that share edges; --crease applies there too."));
    add(list, "Normals",
        flag("--overwrite-normals", options.overwrite_normals,
             "Recompute existing normals and add missing ones in every primitive, by --normals and --crease. Without "
             "--normals: with angle weights. Existing tangents are recomputed too, because they would not fit the new "
             "normals."))
        .excludes = {"--convert-maps"};
    add(list, "Normals",
        choice("--morph-normals", "WHICH", kMorphNormals, options.morph_normals,
               "Normal deltas of morph targets. keep: keep existing ones; missing: add them to targets without any; "
               "all: recompute them for all targets. The normal rotates as the surrounding surface does."));
    add(list, "Repair",
        flag("--fix-winding", options.mend_winding,
             "Turn triangles whose winding disagrees with their neighbors, and parts that are inside out, before "
             "anything else. The outside is given by existing normals where they agree; otherwise by the volume, the "
             "inside or the majority."))
        .old_names = {"--mend-winding"};
    add(list, "Repair",
        setting("--no-sanitize", options.sanitize, false,
                "Write the raw result of the method, even where it is not finite, zero, not unit, parallel to the "
                "normal, or of mixed sign within a face. By default such tangents are repaired and counted."));
    add(list, "Repair",
        flag("--orthogonalize", options.sanitize_options.orthogonalize_all,
             "Also make every valid tangent unit and orthogonal to its normal. The result then no longer matches bakes "
             "exactly where normals are not unit."));
    addRunning(list, options.execution, "Number of threads; 0: one per core. Every number gives identical output.",
               options.file);
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
    const Method method = options.tangents.method;
    if (options.tangents.frame == FrameShape::symmetric && method == Method::mikktspace)
        return "--frame symmetric is not for --method mikktspace";
    if (options.tangents.frame == FrameShape::symmetric && method == Method::basis)
        return "--frame symmetric is not for --method basis";
    if (options.faces == Faces::quads && method != Method::mikktspace)
        return "--faces quads is only for --method mikktspace";
    if (options.existing == ExistingTangents::repair && !given.has("--faces")) options.faces = Faces::automatic;
    if (given.has("--normals")) {
        options.use_smoothing_groups = false;
    } else if (given.has("--crease") || options.overwrite_normals) {
        options.normals.weighting = NormalWeighting::angle;
    }
    if (given.has("--refine")) options.normals.refine = options.tangents.refine;
    return {};
}

}  // namespace tspace::options
