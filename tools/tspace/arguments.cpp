// SPDX-License-Identifier: MIT
// The command line: every flag, its meaning, its unit and its default stand here and nowhere else.
#include "arguments.h"

#include <CLI/CLI.hpp>
#include <map>

#include "console.h"
#include "help.h"

namespace tspace::tool {
namespace {

constexpr const char* kExitCodes =
    "Exit codes:\n"
    "  0  done\n"
    "  2  wrong usage\n"
    "  3  bad input: a file is broken, not supported, or leads outside its folder\n"
    "  4  cannot read or write a file\n"
    "  5  internal error\n"
    "Of several files the worst decides. Every error is one line on stderr.\n";

const std::map<std::string, Method> kMethods = {
    {"mikktspace", Method::mikktspace}, {"lengyel", Method::lengyel}, {"uniform", Method::uniform},
    {"angle", Method::angle},           {"area", Method::area},       {"flat", Method::flat},
    {"basis", Method::basis},
};
const std::map<std::string, Pairing> kPairings = {
    {"reference", Pairing::reference},
    {"corrected", Pairing::corrected},
};
const std::map<std::string, NormalWeighting> kWeightings = {
    {"flat", NormalWeighting::flat}, {"uniform", NormalWeighting::uniform},
    {"area", NormalWeighting::area}, {"angle", NormalWeighting::angle},
    {"max", NormalWeighting::max},   {"angle-area", NormalWeighting::angleArea},
};
const std::map<std::string, Container> kContainers = {
    {"glb", Container::glb},
    {"gltf", Container::gltf},
};

/// What CLI11 writes into before it is checked and turned into GenerateArguments.
struct RawGenerate {
    std::string method = "mikktspace";
    std::string pairing = "reference";
    std::string normals = {};
    std::string convention = "gltf";
    std::string container = {};
    float crease_deg = 180.0f;
    float threshold_deg = 180.0f;
    bool only_missing = false;
};

template <class Value>
CLI::Validator oneOf(const std::map<std::string, Value>& choices) {
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) names.push_back(name);
    return CLI::IsMember(names).description("");
}

CLI::Validator degrees(double most) {
    return CLI::Validator(
        [most](std::string& text) -> std::string {
            double value = 0;
            // Written so that NaN fails too.
            if (CLI::detail::lexical_cast(text, value) && value >= 0 && value <= most) return {};
            return "must be a number of degrees from 0 to " + std::to_string(static_cast<int>(most));
        },
        "");
}

CLI::Validator conventionName() {
    return CLI::Validator(
        [](std::string& text) -> std::string {
            return findConvention(text.c_str()) != nullptr ? "" : "no such convention: " + text;
        },
        "");
}

void addInputs(CLI::App* command, std::vector<std::string>& inputs) {
    command
        ->add_option("IN", inputs,
                     "Model files (.glb, .gltf, .obj) and folders. Of a folder all model files in "
                     "it and below are taken.")
        ->type_name("IN...")
        ->required()
        ->group("Input and output");
}

void addReporting(CLI::App* command, bool& json, bool& quiet) {
    const char* group = "Reporting";
    command->add_flag("--json", json, "Print the result as JSON on stdout (schema: docs/json.md).")
        ->group(group);
    command->add_flag("-q,--quiet", quiet, "Print nothing but errors, and the JSON if asked for.")
        ->group(group);
}

void addAllowExternal(CLI::App* command, bool& allow_external) {
    command
        ->add_flag(
            "--allow-external", allow_external,
            "Also follow paths in a model that lead outside its own folder. By default absolute paths, paths "
            "with '..' and URLs are refused.")
        ->group("Input and output");
}

void addOutputOptions(CLI::App* command, GenerateArguments& arguments, RawGenerate& raw) {
    const char* group = "Input and output";
    addInputs(command, arguments.inputs);
    command
        ->add_option(
            "-o,--output", arguments.output,
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
        ->add_option(
            "--container", raw.container,
            "File format of outputs whose name does not say it: glb or gltf. Default: that of the input; "
            "glb for OBJ.")
        ->type_name("FORMAT")
        ->check(oneOf(kContainers))
        ->group(group);
    addAllowExternal(command, arguments.options.file.allow_external);
}

void addTangentOptions(CLI::App* command, GenerateArguments& arguments, RawGenerate& raw) {
    GenerateOptions& options = arguments.options;
    const char* group = "Tangents";
    command->add_flag("--all", options.all, "Also for primitives whose material needs no tangents.")
        ->group(group);
    CLI::Option* missing =
        command->add_flag("--only-missing", raw.only_missing,
                          "Add tangents where there are none and keep those that are there. "
                          "This is the default.");
    missing->group(group);
    command->add_flag("--overwrite", options.overwrite, "Compute tangents anew where they are there.")
        ->excludes(missing)
        ->group(group);
    command
        ->add_option(
            "--method", raw.method,
            "How tangents are computed. mikktspace: bit for bit what bakers and engines use; lengyel: one "
            "per vertex, no splits; uniform, angle, area: plain weighted means; flat: one per face; basis: "
            "from the normals alone, without UVs.")
        ->type_name("NAME")
        ->check(oneOf(kMethods))
        ->default_str("mikktspace")
        ->group(group);
    command
        ->add_option(
            "--pairing", raw.pairing,
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
            "--normals", raw.normals,
            "How normals are made where they are missing: flat, uniform, area, angle, angle-area or max. "
            "Default: flat, as glTF asks for; for OBJ files with smoothing groups those decide, with angle "
            "weights.")
        ->type_name("NAME")
        ->check(oneOf(kWeightings))
        ->group("Normals");
    command
        ->add_option(
            "--crease", raw.crease_deg,
            "For missing normals: edges sharper than this stay hard. In degrees, 0 to 180; 180 makes none "
            "hard. Given without --normals it takes the weights of angle.")
        ->type_name("DEG")
        ->check(degrees(180))
        ->default_str("180")
        ->group("Normals");
    command
        ->add_flag(
            "!--no-sanitize", options.sanitize,
            "Write what the method gives, even where it is not finite, zero, not unit, parallel to the "
            "normal, or of mixed sign inside a face. By default such tangents are mended and counted.")
        ->group("Repair");
    command
        ->add_flag(
            "--orthogonalize", options.sanitize_options.orthogonalize_all,
            "Also make every sound tangent unit and orthogonal to its normal. The result then no longer "
            "matches bakes exactly where normals are not unit.")
        ->group("Repair");
    command
        ->add_option("--threads", options.tangents.execution.thread_count,
                     "Number of threads; 0: as many as there are cores. Changes no bit of the result.")
        ->type_name("N")
        ->check(CLI::Range(0U, 1024U).description(""))
        ->default_str("0")
        ->group("Running");
}

void finish(const RawGenerate& raw, const CLI::App* command, GenerateArguments& arguments) {
    GenerateOptions& options = arguments.options;
    options.tangents.method = kMethods.at(raw.method);
    options.tangents.pairing = kPairings.at(raw.pairing);
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
    if (!raw.container.empty()) arguments.container = kContainers.at(raw.container);
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
        "Everything else "
        "in a file stays as it is. A failed run leaves the old output untouched.\n");
    command->footer(
        "Examples:\n"
        "  tspace generate helmet.glb -o out/helmet.glb\n"
        "  tspace generate --all --overwrite models/ -o out/\n"
        "  tspace generate scan.obj -o scan.glb --all --normals angle --crease 60\n"
        "  tspace generate --json *.glb -o out/ > report.json\n\n" +
        std::string(kExitCodes));
    addOutputOptions(command, arguments, raw);
    addTangentOptions(command, arguments, raw);
    addOtherOptions(command, arguments, raw);
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

CLI::App* addInspect(CLI::App& app, InspectArguments& arguments) {
    CLI::App* command = app.add_subcommand(
        "inspect",
        "tspace inspect - say what is in model files\n\n"
        "Usage: tspace inspect IN... [OPTION...]\n\n"
        "Per primitive: triangles, vertices, attributes, UV sets, material, whether it needs tangents and "
        "why, "
        "triangles without UV area, and islands of the UV map that are mirrored. Changes nothing.\n");
    command->footer(
        "Examples:\n"
        "  tspace inspect helmet.glb\n"
        "  tspace inspect --json models/ > models.json\n\n" +
        std::string(kExitCodes));
    addInputs(command, arguments.inputs);
    addAllowExternal(command, arguments.file.allow_external);
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

}  // namespace

Arguments parseArguments(int argc, char** argv) {
    CLI::App app(
        "tspace - exact tangent frames for the normal maps of 3D models\n\n"
        "Usage: tspace COMMAND [OPTION...]\n");
    app.formatter(std::make_shared<HelpFormatter>());
    app.set_help_flag("-h,--help", "Print this page.");
    app.set_version_flag("--version", "tspace " TSPACE_VERSION, "Print the version.");
    app.footer("tspace COMMAND --help says more about a command.\n\n" + std::string(kExitCodes));
    app.require_subcommand(1);

    GenerateArguments generate;
    InspectArguments inspect;
    RawGenerate raw;
    const CLI::App* generate_command = addGenerate(app, generate, raw);
    addInspect(app, inspect);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        const auto chosen = app.get_subcommands();
        const std::string page = chosen.empty() ? app.help() : chosen.front()->help();
        return printResult(page) ? ExitCode::done : ExitCode::cannotReadOrWrite;
    } catch (const CLI::CallForVersion& version) {
        return printResult(std::string(version.what()) + "\n") ? ExitCode::done : ExitCode::cannotReadOrWrite;
    } catch (const CLI::ParseError& error) {
        const auto chosen = app.get_subcommands();
        return printUsageError(std::string(error.what()) + " (see tspace " +
                               (chosen.empty() ? "" : chosen.front()->get_name() + " ") + "--help)");
    }
    if (generate_command->parsed()) {
        finish(raw, generate_command, generate);
        return generate;
    }
    return inspect;
}

}  // namespace tspace::tool
