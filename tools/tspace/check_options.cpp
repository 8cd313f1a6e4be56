// SPDX-License-Identifier: MIT
// The options of tspace check.
#include "common_options.h"
#include "options.h"

namespace tspace::tool {
namespace {

constexpr Named<Severity> kSeverities[] = {
    {"note", Severity::note},
    {"warning", Severity::warning},
    {"error", Severity::error},
};
constexpr Named<Color> kColors[] = {
    {"auto", Color::automatic},
    {"always", Color::always},
    {"never", Color::never},
};

/// One code, or several with commas between them.
Option ignoreOption(std::vector<FindingCode>& ignored) {
    const auto take = [&ignored](const std::string& name) {
        for (std::uint32_t code = 0; code < kFindingCodeCount; ++code) {
            if (name == findingName(static_cast<FindingCode>(code))) ignored.push_back(static_cast<FindingCode>(code));
        }
        return std::string();
    };
    Option made =
        option("--ignore", "CODE", take,
               "Leave out findings of this code, such as tangentsUnused: they are not shown, and do not count "
               "for the exit code. Several with commas between them, or several times.");
    for (std::uint32_t code = 0; code < kFindingCodeCount; ++code)
        made.choices.emplace_back(findingName(static_cast<FindingCode>(code)));
    made.is_repeatable = made.is_list = true;
    return made;
}

void addChecking(Command& command, CheckArguments& arguments) {
    const char* group = "Checking";
    CheckOptions& options = arguments.options;
    command.add(group, choice("--fail-on", "LEVEL", kSeverities, arguments.fail_on,
                              "Exit with code 1 when there is a finding of this severity or above: note, warning or "
                              "error."));
    command.add(group, choice("--severity", "LEVEL", kSeverities, arguments.least_severity,
                              "Leave out findings below this severity: note, warning or error. They are not shown, and "
                              "do not count for the exit code."));
    command.add(group, ignoreOption(arguments.ignored));
    command.add(group, degrees("--angle", options.direction_deg, 180,
                               "How far a tangent may lie outside the directions that the triangles around it give. In "
                               "degrees, 0 to 180."));
    command.add(group, choice("--convention", "NAME", kConventions, options.convention,
                              "Whose signs are right: gltf, opengl, directx, unreal, unity, blender or godot, as for "
                              "generate."));
    command.add(group, choice("--faces", "FACES", kFaces, options.faces,
                              "What tangents are compared with. auto: triangles, and quads where the tangents fit "
                              "clearly better to those, as Blender's do; triangles, quads: only those."));
    command.add(group, setting("--no-images", options.images, false, "Do not look at the pixels of normal maps."));
}

void addCheckReporting(Command& command, CheckArguments& arguments) {
    Option& sarif = command.add(kReporting, text("--sarif", "FILE", arguments.sarif,
                                                 "Write the findings to this file as SARIF 2.1.0, which CI systems "
                                                 "show beside the code; '-': to stdout, in place of the text."));
    sarif.is_file = true;
    command.add(kReporting, choice("--color", "WHEN", kColors, arguments.color,
                                   "Colour severities: always, never, or auto: on a terminal, unless the environment "
                                   "variable NO_COLOR is set."));
}

}  // namespace

Command checkCommand(CheckArguments& arguments) {
    Command command{
        .name = "check",
        .summary = "find what is wrong with normals, tangents and UVs",
        .operands = "IN...",
        .description =
            "Compares tangents with the UVs that the material's textures are read with: signs, directions, seams, UV "
            "sets, texture transforms; also values that are not finite or not unit, normals, morph targets, and normal "
            "maps whose green points down. Every finding says how to mend it. An error surely renders wrong; a warning "
            "renders wrong in some renderers, in a small part, or only perhaps; a note is worth knowing. Changes "
            "nothing.",
        .examples = {"tspace check helmet.glb", "tspace check --fail-on warning --jobs 0 models/",
                     "tspace check --json models/ > findings.json",
                     "tspace check --quiet --sarif findings.sarif models/"},
        .finish = [&arguments](const Given&) -> std::string {
            return arguments.json && arguments.sarif == "-" ? "--json and --sarif - both want stdout" : "";
        },
    };
    CheckOptions& options = arguments.options;
    addInputs(command, arguments.inputs);
    addAllowExternal(command, options.file);
    addChecking(command, arguments);
    addThreads(command, options.execution, "Number of threads for each file; 0: as many as there are cores.");
    addLimits(command, options.file);
    addBatch(command, arguments.batch, false);
    addCheckReporting(command, arguments);
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

}  // namespace tspace::tool
