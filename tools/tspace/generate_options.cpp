// SPDX-License-Identifier: MIT
// The options of tspace generate: every flag, its meaning, its unit and its default stand here and nowhere else.
#include "generate_options.h"

#include <map>

#include "common_options.h"

namespace tspace::tool {
namespace {

const std::map<std::string, Method> kMethods = {
    {"mikktspace", Method::mikktspace}, {"lengyel", Method::lengyel}, {"uniform", Method::uniform},
    {"angle", Method::angle},           {"area", Method::area},       {"flat", Method::flat},
    {"basis", Method::basis},           {"fast", Method::fast},       {"best", Method::best},
};
const std::map<std::string, Pairing> kPairings = {
    {"reference", Pairing::reference},
    {"corrected", Pairing::corrected},
};
const std::map<std::string, FrameShape> kFrames = {
    {"gram-schmidt", FrameShape::gramSchmidt},
    {"symmetric", FrameShape::symmetric},
};
const std::map<std::string, NormalWeighting> kWeightings = {
    {"flat", NormalWeighting::flat}, {"uniform", NormalWeighting::uniform},
    {"area", NormalWeighting::area}, {"angle", NormalWeighting::angle},
    {"max", NormalWeighting::max},   {"angle-area", NormalWeighting::angleArea},
    {"best", NormalWeighting::best},
};
const std::map<std::string, TextureTransform> kTextureTransforms = {
    {"apply", TextureTransform::apply},
    {"ignore", TextureTransform::ignore},
};
const std::map<std::string, Compression> kCompressions = {
    {"keep", Compression::keep},
    {"none", Compression::none},
    {"meshopt", Compression::meshopt},
    {"draco", Compression::draco},
};
const std::map<std::string, VectorFormat> kFormats = {
    {"float", VectorFormat::float32},
    {"snorm16", VectorFormat::snorm16},
    {"snorm8", VectorFormat::snorm8},
};
const std::map<std::string, Container> kContainers = {
    {"glb", Container::glb},
    {"gltf", Container::gltf},
};

void addOutputOptions(CLI::App* command, GenerateArguments& arguments, RawGenerate& raw) {
    const char* group = "Input and output";
    addInputs(command, arguments.inputs);
    command
        ->add_option("-o,--output", arguments.output,
                     "Where to write: a file that ends in .glb or .gltf, or a folder. With several inputs, or a "
                     "folder as input, it is a folder: it is made if it is not there, and files keep their paths "
                     "relative to the input folder. Where a.glb and a.obj would both become a.glb, the later one "
                     "becomes "
                     "a.obj.glb.")
        ->type_name("OUT")
        ->group(group);
    command
        ->add_flag("--in-place", arguments.in_place,
                   "Write over the input files. Each is replaced only when its result is complete.")
        ->group(group);
    command
        ->add_option("--container", raw.container,
                     "File format of outputs whose name does not say it: glb or gltf. Default: that of the input; "
                     "glb for OBJ.")
        ->type_name("FORMAT")
        ->check(oneOf(kContainers))
        ->group(group);
    command
        ->add_option("--compress", raw.compression,
                     "How geometry is packed. keep: what came in compressed goes out compressed the same way; none: "
                     "everything is unpacked; meshopt: EXT_meshopt_compression, which changes no value; draco: "
                     "KHR_draco_mesh_compression, which rounds positions, normals and UVs that were not in it before.")
        ->type_name("HOW")
        ->check(oneOf(kCompressions))
        ->default_str("keep")
        ->group(group);
    addAllowExternal(command, arguments.options.file.allow_external);
}

/// Which primitives get tangents, and what becomes of those that are there.
void addSelection(CLI::App* command, GenerateOptions& options, RawGenerate& raw) {
    const char* group = "Tangents";
    CLI::Option* all = command->add_flag("--all", options.all, "Also for primitives whose material needs no tangents.");
    all->group(group);
    CLI::Option* missing = command->add_flag("--only-missing", raw.only_missing,
                                             "Add tangents where there are none and keep those that are there. "
                                             "This is the default.");
    missing->group(group);
    CLI::Option* overwrite =
        command->add_flag("--overwrite", raw.overwrite, "Compute tangents anew where they are there.");
    overwrite->excludes(missing)->group(group);
    command
        ->add_flag("--repair", raw.repair,
                   "Add tangents where there are none, keep good ones, and compute anew where they are wrong: not "
                   "finite, not unit, not orthogonal to the normal, of a wrong sign, or not along the UVs.")
        ->excludes(missing)
        ->excludes(overwrite)
        ->group(group);
    command
        ->add_flag("--strip", options.strip,
                   "Take tangents away where no material needs them, and their data with them.")
        ->excludes(all)
        ->group(group);
}

void addTangentOptions(CLI::App* command, bool& bitangents, RawGenerate& raw) {
    const char* group = "Tangents";
    command
        ->add_option("--texture-transform", raw.texture_transform,
                     "For textures with KHR_texture_transform. apply: tangents follow the transformed UVs, as viewers "
                     "want that use tangents as they are; ignore: those before, for viewers that turn tangents "
                     "themselves.")
        ->type_name("READING")
        ->check(oneOf(kTextureTransforms))
        ->default_str("apply")
        ->group(group);
    command
        ->add_option(
            "--method", raw.method,
            "How tangents are computed. mikktspace: bit for bit what bakers and engines use; lengyel: one "
            "per vertex, no splits; uniform, angle, area: plain weighted means; fast, best: more accurate, for maps "
            "that were not baked; flat: one per face; basis: from the normals alone, without UVs.")
        ->type_name("NAME")
        ->check(oneOf(kMethods))
        ->default_str("mikktspace")
        ->group(group);
    command
        ->add_option("--pairing", raw.pairing,
                     "For mikktspace. reference: neighbours as the reference implementation finds them, with its "
                     "known defect; corrected: without it, so that the order of faces does not matter.")
        ->type_name("NAME")
        ->check(oneOf(kPairings))
        ->default_str("reference")
        ->group(group);
    command
        ->add_option("--threshold", raw.threshold_deg,
                     "For mikktspace: faces whose tangents differ by this angle or more are not averaged. In "
                     "degrees, 0 to 360. 180 is what every baker uses.")
        ->type_name("DEG")
        ->check(degrees(360))
        ->default_str("180")
        ->group(group);
    command
        ->add_option("--frame", raw.frame,
                     "What the tangent is where UVs are sheared. gram-schmidt: the direction of dP/du; symmetric: half "
                     "of the way to the direction perpendicular to dP/dv. Not for mikktspace and basis.")
        ->type_name("NAME")
        ->check(oneOf(kFrames))
        ->default_str("gram-schmidt")
        ->group(group);
    command
        ->add_flag(
            "--bitangents", bitangents,
            "Also write the direction of dP/dv, which is not cross(N, T) where UVs are sheared, as the attribute "
            "_BITANGENT: for shaders that read it. Only where tangents are computed; morph targets get no deltas "
            "of it.")
        ->group(group);
    command
        ->add_option("--convention", raw.convention,
                     "Whose sign is stored: gltf, opengl, directx, unreal, unity, blender or godot. "
                     "Positions, UVs and "
                     "normals stay as they are. Any other than gltf is only for readers that expect it.")
        ->type_name("NAME")
        ->check(conventionName())
        ->default_str("gltf")
        ->group(group);
}

void addOtherOptions(CLI::App* command, GenerateArguments& arguments, RawGenerate& raw) {
    GenerateOptions& options = arguments.options;
    command
        ->add_option(
            "--format", raw.format,
            "Numbers of the tangents and normals that are written: float, snorm16 (half the size) or snorm8 (a "
            "quarter). The sign stays exact. The last two declare KHR_mesh_quantization.")
        ->type_name("NUMBERS")
        ->check(oneOf(kFormats))
        ->default_str("float")
        ->group("Tangents");
    command
        ->add_option(
            "--normals", raw.normals,
            "How normals are made where they are missing: flat, uniform, area, angle, angle-area, max or best. "
            "Default: flat, as glTF asks for; for OBJ files with smoothing groups those decide, with angle "
            "weights.")
        ->type_name("NAME")
        ->check(oneOf(kWeightings))
        ->group("Normals");
    command
        ->add_option("--crease", raw.crease_deg,
                     "For missing normals: edges sharper than this stay hard. In degrees, 0 to 180; 180 makes none "
                     "hard. Given without --normals it takes the weights of angle.")
        ->type_name("DEG")
        ->check(degrees(180))
        ->default_str("180")
        ->group("Normals");
    command
        ->add_flag("!--no-sanitize", options.sanitize,
                   "Write what the method gives, even where it is not finite, zero, not unit, parallel to the "
                   "normal, or of mixed sign inside a face. By default such tangents are mended and counted.")
        ->group("Repair");
    command
        ->add_flag("--orthogonalize", options.sanitize_options.orthogonalize_all,
                   "Also make every sound tangent unit and orthogonal to its normal. The result then no longer "
                   "matches bakes exactly where normals are not unit.")
        ->group("Repair");
    addThreads(command, options.tangents.execution);
    addMemoryLimit(command, options.file);
}

}  // namespace

std::string finishGenerate(const RawGenerate& raw, const CLI::App* command, GenerateArguments& arguments) {
    if (raw.frame == "symmetric" && (raw.method == "mikktspace" || raw.method == "basis"))
        return "--frame symmetric is not for --method " + raw.method;
    GenerateOptions& options = arguments.options;
    if (raw.overwrite) options.existing = ExistingTangents::replace;
    if (raw.repair) options.existing = ExistingTangents::repair;
    options.texture_transform = kTextureTransforms.at(raw.texture_transform);
    options.tangents.method = kMethods.at(raw.method);
    options.tangents.pairing = kPairings.at(raw.pairing);
    options.tangents.frame = kFrames.at(raw.frame);
    options.tangents.angular_threshold_deg = raw.threshold_deg;
    options.tangents.convention = *findConvention(raw.convention.c_str());
    options.normals.crease_angle_deg = raw.crease_deg;
    if (command->count("--normals") != 0) {
        options.normals.weighting = kWeightings.at(raw.normals);
        options.use_smoothing_groups = false;
    } else if (command->count("--crease") != 0) {
        options.normals.weighting = NormalWeighting::angle;
    }
    options.normals.execution = options.tangents.execution;
    options.sanitize_options.execution = options.tangents.execution;
    options.compression = kCompressions.at(raw.compression);
    options.format = kFormats.at(raw.format);
    arguments.option_text = resultOptions(command);
    if (!raw.container.empty()) arguments.container = kContainers.at(raw.container);
    return {};
}

CLI::App* addGenerate(CLI::App& app, GenerateArguments& arguments, RawGenerate& raw) {
    CLI::App* command = app.add_subcommand(
        "generate",
        "tspace generate - add the tangents that normal maps need\n\n"
        "Usage: tspace generate IN... -o OUT [OPTION...]\n\n"
        "Reads model files, adds tangents where a material needs them (a normal map, clearcoat normal map or "
        "anisotropy) and none are there, makes missing normals first, and writes glTF. Vertices are split "
        "where "
        "their corners disagree, and all their attributes, skin weights and morph targets go along. "
        "Morph targets that move the surface get tangent deltas. "
        "Everything else "
        "in a file stays as it is. A failed run leaves the old output untouched.\n");
    command->footer(
        "Examples:\n"
        "  tspace generate helmet.glb -o out/helmet.glb\n"
        "  tspace generate --all --overwrite models/ -o out/\n"
        "  tspace generate scan.obj -o scan.glb --all --normals angle --crease 60\n"
        "  tspace generate --json *.glb -o out/ > report.json\n"
        "  tspace generate models/ -o out/ --jobs 8 --manifest done.jsonl --resume\n\n" +
        std::string(kExitCodes));
    addOutputOptions(command, arguments, raw);
    addSelection(command, arguments.options, raw);
    addTangentOptions(command, arguments.options.bitangents, raw);
    addOtherOptions(command, arguments, raw);
    addBatch(command, arguments.batch, true);
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

}  // namespace tspace::tool
