// SPDX-License-Identifier: MIT
// Table of all commands, and the command help.
#include "command_table.h"

#include <memory>

#include "common_options.h"
#include "console.h"
#include "core/base/ascii.h"
#include "depfile.h"
#include "help.h"
#include "input_kinds.h"
#include "model/io/path.h"

namespace tspace::tool {
namespace {

#ifdef TSPACE_TOOL_IMAGES
constexpr bool kHasImages = true;
#else
constexpr bool kHasImages = false;
#endif
#ifdef TSPACE_TOOL_BAKING
constexpr bool kHasBaking = true;
#else
constexpr bool kHasBaking = false;
#endif

struct Entry {
    const char* name;
    Command (*make)();
    bool is_available = true;  ///< false: not available in this build, and not listed; if started, it prints the reason
};
Command helpCommand();
constexpr Entry kCommands[] = {
    {"generate", generateCommand},
    {"diff", diffCommand},
    {"identify", identifyCommand},
    {"inspect", inspectCommand},
    {"check", checkCommand},
    {"flip-green", flipGreenCommand},
    {"render", renderCommand, kHasImages},
    {"convert-map", convertMapCommand},
    {"height-to-normal", heightToNormalCommand, kHasImages},
    {"compress-map", compressMapCommand},
    {"view", viewCommand},
    {"bake", bakeCommand, kHasBaking},
    {"finish", finishCommand},
    {"map-error", mapErrorCommand, kHasBaking},
    {"help", helpCommand},
};

/// A common wrong command name, and the command line to suggest.
struct Synonym {
    const char* word;
    const char* command_line;
};
constexpr Synonym kSynonyms[] = {
    {"add", "generate IN -o OUT"},
    {"compare", "diff A B"},
    {"convert", "convert-map IN -o OUT"},
    {"fix", "generate --repair IN -o OUT"},
    {"flip", "flip-green IN -o OUT"},
    {"info", "inspect IN"},
    {"lint", "check IN"},
    {"repair", "generate --repair IN -o OUT"},
    {"tangents", "generate IN -o OUT"},
    {"validate", "check IN"},
    {"version", "--version"},
};

Command commandOf(const Entry& entry) {
    Command command = entry.make();
    command.name = entry.name;
    addDepfile(command);
    return command;
}

Command helpCommand() {
    const auto topic = std::make_shared<std::string>();
    Command command{
        .summary = "print the help of a command",
        .operands = "[COMMAND]",
        .description =
            "Prints the help page of a command, as its option --help does. Without a command, prints the list of "
            "commands.",
        .examples = {"tspace help", "tspace help generate"},
    };
    Option about = text("", "COMMAND", *topic, "Name of the command.");
    for (const Entry& entry : kCommands) {
        if (entry.is_available) about.choices.emplace_back(entry.name);
    }
    command.add("Input and output", about);
    command.add("Reporting", helpOption());
    command.run = [topic] {
        return printPage(topic->empty() ? helpPage(toolTable()) : helpPage(*findCommand(*topic)));
    };
    return command;
}

}  // namespace

ToolTable toolTable() {
    ToolTable tool;
    for (const Entry& entry : kCommands) {
        if (entry.is_available) tool.commands.push_back(commandOf(entry));
    }
    Option help = helpOption();
    help.group = "Options";
    Option version = option("-V, --version", "", help.take, "Print the version.");
    version.group = "Options";
    tool.options = {help, version};
    return tool;
}

std::string unknownCommand(const std::string& word) {
    const std::string known = lowerAscii(word);
    const std::string unknown = "unknown command '" + word + "'";
    for (const Synonym& synonym : kSynonyms)
        if (known == synonym.word) return unknown + "; use tspace " + synonym.command_line;
    if (isModelName(word) || isImageName(word)) return unknown + "; use tspace check IN to examine a file";
    std::vector<std::string> names;
    for (const Entry& entry : kCommands)
        if (entry.is_available) names.emplace_back(entry.name);
    return unknown + didYouMean(known, names);
}

std::optional<Command> findCommand(const std::string& name) {
    for (const Entry& entry : kCommands)
        if (name == entry.name) return commandOf(entry);
    return std::nullopt;
}

}  // namespace tspace::tool
