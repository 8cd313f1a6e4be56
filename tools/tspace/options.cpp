// SPDX-License-Identifier: MIT
// The options of the commands that only read; those of check and generate have files of their own.
#include "options.h"

#include "common_options.h"

namespace tspace::tool {
namespace {

Command helpCommand(std::string& topic, const std::vector<Command>& others) {
    Command command{
        .name = "help",
        .summary = "print what a command does, and its options",
        .operands = "[COMMAND]",
        .description = "Prints the page of a command, as its --help does; without one, the list of commands.",
        .examples = {"tspace help", "tspace help generate"},
    };
    Option about = text("", "COMMAND", topic, "The command that the page is about.");
    for (const Command& other : others) about.choices.push_back(other.name);
    about.choices.push_back(command.name);
    command.add("Input and output", about);
    command.add("Reporting", helpOption());
    return command;
}

}  // namespace

Command inspectCommand(InspectArguments& arguments) {
    Command command{
        .name = "inspect",
        .summary = "say what is in model files",
        .operands = "IN...",
        .description =
            "Per primitive: triangles, vertices, attributes, UV sets, material, whether it needs tangents and why, "
            "triangles without UV area, and islands of the UV map that are mirrored. Changes nothing.",
        .examples = {"tspace inspect helmet.glb", "tspace inspect --json models/ > models.json"},
    };
    addInputs(command, arguments.inputs);
    command.add(inspectOptions(arguments.file));
    addBatch(command, arguments.batch, false);
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

Command diffCommand(DiffArguments& arguments) {
    Command command{
        .name = "diff",
        .summary = "compare the frames of two models",
        .operands = "A B",
        .description =
            "Pairs the primitives and triangles of two models that show the same surface, also when vertices are "
            "split, merged or in another order, and prints the angles between their tangents (T), normals (N) and "
            "rebuilt bitangents (B), signs that differ, and the worst places. Changes nothing.",
        .examples = {"tspace diff before.glb after.glb",
                     "tspace diff mine.glb theirs.gltf --tolerance 0.5 --json > diff.json",
                     "tspace diff --html report.html before.glb after.glb"},
    };
    command.add(kInputAndOutput, operand("A", arguments.a, "A model file."));
    command.add(kInputAndOutput, operand("B", arguments.b, "Another one."));
    command.add(diffOptions(arguments.request));
    command
        .add(kReporting,
             text("--html", "FILE", arguments.html,
                  "Write the comparison to this file as a page for people, with a heat map of the angles and "
                  "pictures of the worst places. It needs no other file."))
        .is_file = true;
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

Command identifyCommand(IdentifyArguments& arguments) {
    Command command{
        .name = "identify",
        .summary = "say which method made the tangents of a model",
        .operands = "IN...",
        .description =
            "Runs every method on the model's own positions, normals and UVs, along every UV set, and says how many of "
            "the stored tangents each one explains, and whether the signs are those that glTF wants or all inverted. "
            "Changes nothing.",
        .examples = {"tspace identify helmet.glb", "tspace identify --json models/ > methods.json"},
    };
    addInputs(command, arguments.inputs);
    command.add(identifyOptions(arguments.options));
    addBatch(command, arguments.batch, false);
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

ToolTable toolTable(AllArguments& arguments) {
    ToolTable tool;
    for (Execution* execution :
         {&arguments.generate.options.execution, &arguments.check.request.options.execution,
          &arguments.identify.options.execution, &arguments.render.options.execution,
          &arguments.convert_map.options.execution, &arguments.height_to_normal.options.execution,
          &arguments.bake.options.execution, &arguments.map_error.options.execution}) {
        execution->thread_count = kAllThreads;
    }
    tool.commands = {generateCommand(arguments.generate),
                     diffCommand(arguments.diff),
                     identifyCommand(arguments.identify),
                     inspectCommand(arguments.inspect),
                     checkCommand(arguments.check),
                     flipGreenCommand(arguments.flip_green),
                     renderCommand(arguments.render),
                     convertMapCommand(arguments.convert_map),
                     heightToNormalCommand(arguments.height_to_normal),
                     viewCommand(arguments.view),
                     bakeCommand(arguments.bake),
                     mapErrorCommand(arguments.map_error)};
    tool.commands.push_back(helpCommand(arguments.help_topic, tool.commands));
    Option help = helpOption();
    help.group = "Options";
    Option version = option("-V, --version", "", help.take, "Print the version.");
    version.group = "Options";
    tool.options = {help, version};
    return tool;
}

}  // namespace tspace::tool
