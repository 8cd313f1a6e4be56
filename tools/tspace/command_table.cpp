// SPDX-License-Identifier: MIT
// The list of all commands, and the command help.
#include "command_table.h"

#include <algorithm>
#include <memory>

#include "common_options.h"
#include "console.h"
#include "help.h"

namespace tspace::tool {
namespace {

Command helpCommand(const std::vector<Command>& others) {
    const auto topic = std::make_shared<std::string>();
    Command command{
        .name = "help",
        .summary = "print what a command does, and its options",
        .operands = "[COMMAND]",
        .description = "Prints the page of a command, as its --help does; without one, the list of commands.",
        .examples = {"tspace help", "tspace help generate"},
    };
    Option about = text("", "COMMAND", *topic, "The command that the page is about.");
    for (const Command& other : others) about.choices.push_back(other.name);
    about.choices.push_back(command.name);
    command.add("Input and output", about);
    command.add("Reporting", helpOption());
    command.run = [topic] {
        const ToolTable tool = toolTable();
        const std::string page = topic->empty() ? helpPage(tool) : helpPage(*findCommand(tool, *topic));
        return printResult(page) ? ExitCode::done : ExitCode::cannotReadOrWrite;
    };
    return command;
}

}  // namespace

ToolTable toolTable() {
    ToolTable tool;
    for (Command (*const make)() : {generateCommand, diffCommand, identifyCommand, inspectCommand, checkCommand,
                                    flipGreenCommand, renderCommand, convertMapCommand, heightToNormalCommand,
                                    compressMapCommand, viewCommand, bakeCommand, finishCommand, mapErrorCommand}) {
        tool.commands.push_back(make());
    }
    tool.commands.push_back(helpCommand(tool.commands));
    Option help = helpOption();
    help.group = "Options";
    Option version = option("-V, --version", "", help.take, "Print the version.");
    version.group = "Options";
    tool.options = {help, version};
    return tool;
}

const Command* findCommand(const ToolTable& tool, const std::string& name) {
    const auto found = std::find_if(tool.commands.begin(), tool.commands.end(),
                                    [&](const Command& command) { return command.name == name; });
    return found != tool.commands.end() ? &*found : nullptr;
}

}  // namespace tspace::tool
