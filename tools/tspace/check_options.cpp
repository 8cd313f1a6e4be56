// SPDX-License-Identifier: MIT
// The options of tspace check that are about command lines.
#include "common_options.h"
#include "options.h"

namespace tspace::tool {
namespace {

constexpr Named<Color> kColors[] = {
    {"auto", Color::automatic},
    {"always", Color::always},
    {"never", Color::never},
};

void addCheckReporting(Command& command, CheckArguments& arguments) {
    Option& sarif = command.add(kReporting, text("--sarif", "FILE", arguments.sarif,
                                                 "Write the findings to this file as SARIF 2.1.0, which CI systems "
                                                 "show beside the code; '-': to stdout, in place of the text."));
    sarif.is_file = true;
    command
        .add(kReporting, text("--html", "FILE", arguments.html,
                              "Write the findings to this file as a page for people, with pictures of their places, "
                              "before and after. It needs no other file."))
        .is_file = true;
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
                     "tspace check --quiet --sarif findings.sarif models/",
                     "tspace check --html report.html helmet.glb"},
        .finish = [&arguments](const Given&) -> std::string {
            return arguments.json && arguments.sarif == "-" ? "--json and --sarif - both want stdout" : "";
        },
    };
    addInputs(command, arguments.inputs);
    command.add(checkOptions(arguments.request));
    addBatch(command, arguments.batch, false);
    addCheckReporting(command, arguments);
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

}  // namespace tspace::tool
