// SPDX-License-Identifier: MIT
// From the command line to the arguments of one command.
#include "arguments.h"

#include <algorithm>
#include <span>

#include "commands/shared/nearest_name.h"
#include "console.h"
#include "help.h"
#include "jobs.h"
#include "options.h"
#include "read_command_line.h"

namespace tspace::tool {
namespace {

ExitCode print(const std::string& page) { return printResult(page) ? ExitCode::done : ExitCode::cannotReadOrWrite; }

const Command* findCommand(const ToolTable& tool, const std::string& name) {
    const auto found = std::find_if(tool.commands.begin(), tool.commands.end(),
                                    [&](const Command& command) { return command.name == name; });
    return found != tool.commands.end() ? &*found : nullptr;
}

/// What stands in the place of a command and is none.
ExitCode runWithoutCommand(const ToolTable& tool, const std::string& word) {
    if (word == "-h" || word == "--help") return print(helpPage(tool));
    if (word == "-V" || word == "--version") return print("tspace " TSPACE_VERSION "\n" + leftOut());
    const char* see = " (see tspace --help)";
    std::vector<std::string> names;
    if (!word.starts_with('-')) {
        for (const Command& command : tool.commands) names.push_back(command.name);
        return printUsageError("there is no command '" + word + "'" + didYouMean(word, names) + see);
    }
    for (const Option& option : tool.options) names.insert(names.end(), option.names.begin(), option.names.end());
    const std::string nearest = didYouMean(word, names);
    return printUsageError("a command comes first, not '" + word + "'" + nearest + see);
}

ExitCode runHelp(const ToolTable& tool, const std::string& topic) {
    return print(topic.empty() ? helpPage(tool) : helpPage(*findCommand(tool, topic)));
}

}  // namespace

Arguments parseArguments(int argc, char** argv) {
    AllArguments all;
    for (FileOptions* file :
         {&all.generate.options.file, &all.diff.request.options.file, &all.identify.options.file, &all.inspect.file,
          &all.check.request.options.file, &all.render.options.file, &all.convert_map.options.file,
          &all.height_to_normal.options.file, &all.bake.options.file, &all.map_error.options.file}) {
        file->importer = importerPath();
    }
    const ToolTable tool = toolTable(all);
    if (argc < 2) return printUsageError("a command is missing (see tspace --help)");
    const Command* command = findCommand(tool, argv[1]);
    if (command == nullptr) return runWithoutCommand(tool, argv[1]);
    Given given;
    const std::span<const char* const> arguments(argv + 2, static_cast<std::size_t>(argc - 2));
    const std::string wrong = readCommandLine(*command, arguments, given);
    if (!wrong.empty()) return printUsageError(wrong + " (see tspace " + command->name + " --help)");
    if (given.has("--help")) return print(helpPage(*command));
    if (command->name == "generate") return std::move(all.generate);
    if (command->name == "inspect") return std::move(all.inspect);
    if (command->name == "check") return std::move(all.check);
    if (command->name == "diff") return std::move(all.diff);
    if (command->name == "identify") return std::move(all.identify);
    if (command->name == "flip-green") return std::move(all.flip_green);
    if (command->name == "render") return std::move(all.render);
    if (command->name == "convert-map") return std::move(all.convert_map);
    if (command->name == "height-to-normal") return std::move(all.height_to_normal);
    if (command->name == "view") return std::move(all.view);
    if (command->name == "bake") return std::move(all.bake);
    if (command->name == "map-error") return std::move(all.map_error);
    return runHelp(tool, all.help_topic);
}

}  // namespace tspace::tool
