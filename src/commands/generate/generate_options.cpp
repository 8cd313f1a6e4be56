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
             "Do everything but write: say what would be written, and where something is wrong."));
    add(list, group,
        choice("--compress", "HOW", kCompressions, options.compression,
               "How geometry is packed. keep: what came in compressed goes out compressed the same way; none: "
               "everything is unpacked; meshopt: EXT_meshopt_compression, which changes no value; draco: "
               "KHR_draco_mesh_compression, which rounds positions, normals and UVs that were not in it "
               "before."));
    addKeepCoordinates(list, options.file);
    addAllowExternal(list, options.file);
}

/// Which primitives get tangents, and what becomes of those that are there.
void addSelection(OptionList& list, GenerateOptions& options) {
    const char* group = "Tangents";
    add(list, group, flag("--all", options.all, "Also for primitives whose material needs no tangents."));
    add(list, group,
        setting("--only-missing", options.existing, ExistingTangents::keep,
                "Add tangents where there are none and keep those that are there. This is the "
                "default."));
    add(list, group,
        setting("--overwrite", options.existing, ExistingTangents::replace,
                "Compute tangents anew where they are there."))
        .excludes = {"--only-missing"};
    add(list, group,
        setting("--repair", options.existing, ExistingTangents::repair,
                "Add tangents where there are none, keep good ones, and compute anew where they are wrong: "
                "not finite, not unit, not orthogonal to the normal, of a wrong sign, or not along the "
                "UVs."))
        .excludes = {"--only-missing", "--overwrite"};
    add(list, group,
        flag("--strip", options.strip, "Take tangents away where no material needs them, and their data with them."))
        .excludes = {"--all"};
}

void addTangentOptions(OptionList& list, GenerateOptions& options) {
    const char* group = "Tangents";
    TangentOptions& tangents = options.tangents;
    add(list, group,
        choice("--texture-transform", "READING", kTextureTransforms, options.texture_transform,
               "For textures with KHR_texture_transform. apply: tangents follow the transformed UVs, as "
               "viewers want that use tangents as they are; ignore: those before, for viewers that turn "
               "tangents themselves."));
    add(list, group,
        choice("--method", "NAME", kMethods, tangents.method,
               "How tangents are computed. mikktspace: bit for bit what bakers and engines use; "
               "lengyel: one per vertex, no splits; uniform, angle, area: plain weighted means; fast, "
               "best: more accurate, for maps that were not baked; flat: one per face; basis: from the "
               "normals alone, without UVs."));
    add(list, group,
        choice("--faces", "FACES", kFaces, options.faces,
               "What mikktspace is computed on. triangles: those of the file, which fit bakes of "
               "triangulated models; quads: pairs of triangles that follow each other, as Blender does "
               "before it writes triangles; auto: quads where the file's tangents show it, or where it "
               "has none, comes from Blender and its triangles are cut quads. --repair takes auto where "
               "nothing else is given. See docs/concepts/quads.md."));
    add(list, group,
        choice("--pairing", "NAME", kPairings, tangents.pairing,
               "For mikktspace. reference: neighbours as the reference implementation finds them, with "
               "its known defect; corrected: without it, so that the order of faces does not matter."));
    add(list, group,
        degrees("--threshold", tangents.angular_threshold_deg, 360,
                "For mikktspace: faces whose tangents differ by this angle or more are not averaged. In "
                "degrees, 0 to 360. 180 is what every baker uses."));
    add(list, group,
        choice("--frame", "NAME", kFrames, tangents.frame,
               "What the tangent is where UVs are sheared. gram-schmidt: the direction of dP/du; "
               "symmetric: half of the way to the direction perpendicular to dP/dv. Not for mikktspace "
               "and basis."));
    add(list, group,
        number("--refine", tangents.refine, 2,
               "For --method best and --normals best: steps after the fit, each of which makes what is "
               "interpolated along edges fit the edges better: 0, 1 or 2. Without it normals take 2 steps."));
    add(list, group,
        flag("--bitangents", options.bitangents,
             "Also write the direction of dP/dv, which is not cross(N, T) where UVs are sheared, as the "
             "attribute _BITANGENT: for shaders that read it. Only where tangents are computed; morph "
             "targets get no deltas of it."));
    add(list, group,
        choice("--convention", "NAME", kConventions, tangents.convention,
               "Whose sign is stored: gltf, opengl, directx, unreal, unity, blender or godot. Positions, UVs "
               "and normals stay as they are. Any other than gltf is only for readers that expect it."));
    add(list, group,
        choice("--format", "NUMBERS", kVectorFormats, options.format,
               "Numbers of the tangents and normals that are written: float, snorm16 (half the size) or "
               "snorm8 (a quarter). The sign stays exact. The last two declare "
               "KHR_mesh_quantization."));
}

void addPackOptions(OptionList& list, GenerateOptions& options) {
    const char* group = "Packed frames";
    add(list, group,
        choice("--pack", "FORMAT", kPackFormats, options.pack,
               "Also write the whole frame of each vertex, N, T and the sign, as an attribute of its own: "
               "_FRAME32 and so on, for engines that read it. Of every primitive that has normals and "
               "tangents in the end, old ones too. See docs/concepts/pack.md."));
    add(list, group,
        choice("--pack-drop", "WHAT", kPackDrops, options.pack_drop,
               "What to take away where frames were packed. tangents: TANGENT; all: NORMAL too, for engines "
               "that read nothing but packed frames. What morph targets add to stays. Without this, both "
               "stay."))
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
                         "keep: images come out as they went in, KTX2 and DDS too, but for normal maps that another "
                         "option writes anew: those are PNGs. Textures for engines: tspace compress-map.");
    made.choices = {"keep"};
    made.default_text = "keep";
    return made;
}

void addMapOptions(OptionList& list, GenerateOptions& options) {
    const char* group = "Normal maps";
    add(list, group,
        setting("--flip-green", options.flip_green, FlipGreen::down,
                "Invert the green channel of normal maps whose green points down throughout (as DirectX "
                "has it), as check finds them; all others stay. Images beside a .gltf stay as they are, and "
                "the output gets new ones."));
    add(list, group,
        setting("--flip-green-all", options.flip_green, FlipGreen::all,
                "Invert the green channel of every normal map, whichever way it points."))
        .excludes = {"--flip-green"};
    add(list, group,
        flag("--mend-maps", options.mend_maps,
             "Write normal maps anew that hold something else than glTF reads, as check finds them: two channels, "
             "exchanged channels, x in alpha, colors (sRGB), object space. They become PNGs, from KTX2 and DDS too. "
             "Height "
             "maps stay: their strength is not known (tspace height-to-normal)."));
    add(list, group,
        flag("--convert-maps", options.convert_maps,
             "Write normal maps anew for the tangents that are computed, so that the picture stays as it was. Maps and "
             "materials that several primitives share are copied where they need different ones. Images beside a .gltf "
             "stay as they are, and the output gets new ones."))
        .excludes = {"--flip-green", "--flip-green-all", "--mend-maps", "--repair"};
    add(list, group,
        setting("--no-images", options.images, false,
                "Do not read the pixels of normal maps, which --repair does where most signs are inverted. Such signs "
                "then stay, "
                "since the maps may be inverted too."))
        .excludes = {"--flip-green", "--flip-green-all", "--mend-maps", "--convert-maps"};
    add(list, group, compressMapsOption());
}

void addOtherOptions(OptionList& list, GenerateOptions& options) {
    Option& weighting =
        add(list, "Normals",
            choice("--normals", "NAME", kWeightings, options.normals.weighting,
                   "How normals are made where they are missing (or all, with --overwrite-normals): flat, uniform, "
                   "area, angle, angle-area, max or "
                   "best. Default: flat, as glTF asks for; for OBJ files with smoothing groups those decide, "
                   "with angle weights."));
    weighting.default_text.clear();
    add(list, "Normals",
        numberOrAuto(
            "--crease", "DEG", "a number of degrees", options.normals.crease_angle_deg, NormalOptions::crease_auto, 180,
            "For normals that are made: edges sharper than this stay hard. In degrees, 0 to 180; 180 makes none "
            "hard. auto: an angle by the mesh, which the report says. Given without --normals it takes the "
            "weights of angle."));
    add(list, "Normals",
        numberOrAuto("--denoise", "FACTOR", "a number", options.normals.denoise, NormalOptions::denoise_auto, 4,
                     "For --normals best on noisy positions, such as scans: normals by more of the surface around, so "
                     "that noise is not shaded. Vertices stay. auto: as much as is measured, and nothing where that is "
                     "shape; 0 to 4: so many times the noise that is measured, also where it looks like shape."));
    add(list, "Normals",
        numberOrAuto("--weld-distance", "DISTANCE", "a distance", options.normals.weld_distance,
                     NormalOptions::weld_auto, 1000000000,
                     "Positions that differ by no more than this in each coordinate are one, where normals "
                     "are made and triangles turned, in the unit of positions before "
                     "nodes move them. 0: only equal ones are. auto: twice the spacing of floats at the largest "
                     "coordinate of the mesh. Tangents are computed on positions as they are."));
    add(list, "Normals",
        flag("--normals-per-primitive", options.normals_per_primitive,
             "Make the normals of each primitive from its own triangles. By default they are smooth over the border of "
             "two primitives of a mesh that are one surface (they share edges); --crease holds there too."));
    add(list, "Normals",
        flag("--overwrite-normals", options.overwrite_normals,
             "Make normals anew where they are there, by --normals and --crease, and where they are missing, in every "
             "primitive. Without --normals: with the weights of angle. Tangents that are there are computed anew with "
             "them, because old ones would not fit."))
        .excludes = {"--convert-maps"};
    add(list, "Normals",
        choice("--morph-normals", "WHICH", kMorphNormals, options.morph_normals,
               "What morph targets add to normals that stay. keep: what is there; missing: targets without it get it; "
               "all: it is computed for all. The normal turns as the surface around it turns."));
    add(list, "Repair",
        flag("--mend-winding", options.mend_winding,
             "Turn triangles that are wound against their neighbours, and parts that are inside out as a whole, before "
             "anything else is done. Normals that stay say which side is out where they agree; else the volume, the "
             "inside or the majority does."));
    add(list, "Repair",
        setting("--no-sanitize", options.sanitize, false,
                "Write what the method gives, even where it is not finite, zero, not unit, parallel to the "
                "normal, or of mixed sign inside a face. By default such tangents are mended and counted."));
    add(list, "Repair",
        flag("--orthogonalize", options.sanitize_options.orthogonalize_all,
             "Also make every sound tangent unit and orthogonal to its normal. The result then no "
             "longer matches bakes exactly where normals are not unit."));
    addRunning(list, options.execution,
               "Number of threads; 0: as many as there are cores. Changes no bit of the result.", options.file);
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
