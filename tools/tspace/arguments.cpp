// SPDX-License-Identifier: MIT
// The command line: the commands, and the options of all but generate (generate_options.cpp).
#include "arguments.h"

#include <CLI/CLI.hpp>
#include <map>

#include "common_options.h"
#include "console.h"
#include "generate_options.h"
#include "help.h"
#include "jobs.h"

namespace tspace::tool {
namespace {

const std::map<std::string, Severity> kSeverities = {
    {"note", Severity::note},
    {"warning", Severity::warning},
    {"error", Severity::error},
};

CLI::App* addDiff(CLI::App& app, DiffArguments& arguments) {
    CLI::App* command = app.add_subcommand(
        "diff",
        "tspace diff - compare the frames of two models\n\n"
        "Usage: tspace diff A B [OPTION...]\n\n"
        "Pairs the primitives and triangles of two models that show the same surface, also when vertices are split, "
        "merged or in another order, and prints the angles between their tangents (T), normals (N) and rebuilt "
        "bitangents (B), signs that differ, and the worst places. Changes nothing.\n");
    command->footer(
        "Examples:\n"
        "  tspace diff before.glb after.glb\n"
        "  tspace diff mine.glb theirs.gltf --tolerance 0.5 --json > diff.json\n\n" +
        std::string(kExitCodes));
    const char* group = "Input and output";
    command->add_option("A", arguments.a, "A model file.")->type_name("A")->required()->group(group);
    command->add_option("B", arguments.b, "Another one.")->type_name("B")->required()->group(group);
    addAllowExternal(command, arguments.options.file.allow_external);
    command
        ->add_option(
            "--tolerance", arguments.tolerance_deg,
            "Exit with 1 when an angle is above this, a sign differs, or a triangle has no partner. In degrees, 0 "
            "to 180.")
        ->type_name("DEG")
        ->check(degrees(180))
        ->default_str("1")
        ->group("Comparing");
    command->add_option("--worst", arguments.options.worst_count, "How many of the worst places are listed.")
        ->type_name("N")
        ->check(CLI::Range(0U, 10000U).description(""))
        ->default_str("8")
        ->group("Comparing");
    addMemoryLimit(command, arguments.options.file);
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

CLI::App* addIdentify(CLI::App& app, IdentifyArguments& arguments) {
    CLI::App* command = app.add_subcommand(
        "identify",
        "tspace identify - say which method made the tangents of a model\n\n"
        "Usage: tspace identify IN... [OPTION...]\n\n"
        "Runs every method on the model's own positions, normals and UVs, along every UV set, and says how many of the "
        "stored tangents each one explains, and whether the signs are those that glTF wants or all inverted. Changes "
        "nothing.\n");
    command->footer(
        "Examples:\n"
        "  tspace identify helmet.glb\n"
        "  tspace identify --json models/ > methods.json\n\n" +
        std::string(kExitCodes));
    addInputs(command, arguments.inputs);
    addAllowExternal(command, arguments.options.file.allow_external);
    command
        ->add_option("--tolerance", arguments.options.tolerance_deg,
                     "Tangents nearer than this count as the same. In degrees, 0 to 180.")
        ->type_name("DEG")
        ->check(degrees(180))
        ->default_str("1")
        ->group("Comparing");
    addThreads(command, arguments.options.execution);
    addMemoryLimit(command, arguments.options.file);
    addBatch(command, arguments.batch, false);
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
    addMemoryLimit(command, arguments.file);
    addBatch(command, arguments.batch, false);
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

/// What CLI11 writes into before it is turned into CheckArguments.
struct RawCheck {
    std::string fail_on = "error";
    std::string convention = "gltf";
};

void addCheckOptions(CLI::App* command, CheckArguments& arguments, RawCheck& raw) {
    CheckOptions& options = arguments.options;
    const char* group = "Checking";
    command
        ->add_option("--fail-on", raw.fail_on,
                     "Exit with code 1 when there is a finding of this severity or above: note, warning or error.")
        ->type_name("LEVEL")
        ->check(oneOf(kSeverities))
        ->default_str("error")
        ->group(group);
    command
        ->add_option("--angle", options.direction_deg,
                     "How far a tangent may lie outside the directions that the triangles around it give. In degrees, "
                     "0 to 180.")
        ->type_name("DEG")
        ->check(degrees(180))
        ->default_str("10")
        ->group(group);
    command
        ->add_option("--convention", raw.convention,
                     "Whose signs are right: gltf, opengl, directx, unreal, unity, blender or godot, as for generate.")
        ->type_name("NAME")
        ->check(conventionName())
        ->default_str("gltf")
        ->group(group);
    command->add_flag("!--no-images", options.images, "Do not look at the pixels of normal maps.")->group(group);
    command
        ->add_option("--threads", options.execution.thread_count,
                     "Number of threads for each file; 0: as many as there are cores.")
        ->type_name("N")
        ->check(CLI::Range(0U, 1024U).description(""))
        ->default_str("0")
        ->group("Running");
}

CLI::App* addCheck(CLI::App& app, CheckArguments& arguments, RawCheck& raw) {
    CLI::App* command = app.add_subcommand(
        "check",
        "tspace check - find what is wrong with normals, tangents and UVs\n\n"
        "Usage: tspace check IN... [OPTION...]\n\n"
        "Compares tangents with the UVs that the material's textures are read with: signs, directions, seams, UV "
        "sets, texture transforms; also values that are not finite or not unit, normals, morph targets, and normal "
        "maps whose green points down. Every finding says how to mend it. An error surely renders wrong; a warning "
        "renders wrong in some renderers, in a small part, or only perhaps; a note is worth knowing. Changes "
        "nothing.\n");
    command->footer(
        "Examples:\n"
        "  tspace check helmet.glb\n"
        "  tspace check --fail-on warning --jobs 0 models/\n"
        "  tspace check --json models/ > findings.json\n\n" +
        std::string(kExitCodes));
    addInputs(command, arguments.inputs);
    addAllowExternal(command, arguments.options.file.allow_external);
    addCheckOptions(command, arguments, raw);
    addMemoryLimit(command, arguments.options.file);
    addBatch(command, arguments.batch, false);
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
    DiffArguments diff;
    IdentifyArguments identify;
    InspectArguments inspect;
    RawGenerate raw;
    const CLI::App* generate_command = addGenerate(app, generate, raw);
    const CLI::App* diff_command = addDiff(app, diff);
    const CLI::App* identify_command = addIdentify(app, identify);
    addInspect(app, inspect);
    CheckArguments check;
    RawCheck raw_check;
    const CLI::App* check_command = addCheck(app, check, raw_check);
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
        if (chosen.empty() && argc > 1 && argv[1][0] != '-')
            return printUsageError("there is no command '" + std::string(argv[1]) + "' (see tspace --help)");
        return printUsageError(std::string(error.what()) + " (see tspace " +
                               (chosen.empty() ? "" : chosen.front()->get_name() + " ") + "--help)");
    }
    for (FileOptions* file :
         {&generate.options.file, &diff.options.file, &identify.options.file, &inspect.file, &check.options.file})
        file->importer = importerPath();
    if (generate_command->parsed()) {
        const std::string wrong = finishGenerate(raw, generate_command, generate);
        if (!wrong.empty()) return printUsageError(wrong + " (see tspace generate --help)");
        return generate;
    }
    if (check_command->parsed()) {
        check.fail_on = kSeverities.at(raw_check.fail_on);
        check.options.convention = *findConvention(raw_check.convention.c_str());
        return check;
    }
    if (diff_command->parsed()) return diff;
    if (identify_command->parsed()) return identify;
    return inspect;
}

}  // namespace tspace::tool
