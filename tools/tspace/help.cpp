// SPDX-License-Identifier: MIT
// Help pages, generated from the table of options.
#include "help.h"

#include <algorithm>

#include "commands/shared/text.h"

namespace tspace::tool {
namespace {

std::string optionsText(const std::vector<Option>& options) {
    std::string page;
    for (const auto& [heading, members] : optionsByGroup(options)) {
        page += "\n" + heading + ":\n";
        for (const Option* option : members) {
            const std::string value = option->default_text.empty() ? "" : " Default: " + option->default_text + ".";
            page += "  " + optionHead(*option) + "\n        " + option->help + value + "\n";
        }
    }
    return page;
}

}  // namespace

std::string missingFeatures() {
    const std::string parts = TSPACE_LEFT_OUT;
    return parts.empty() ? "" : "Built without: " + parts + ".\n";
}

const char* const kExitCodes =
    "Exit codes:\n  0  success\n  1  findings or differences, for these commands: check (see --fail-on), bake (such as "
    "many rays without a hit), finish (remaining errors, or findings of bake) and diff\n  2  wrong usage: an option or "
    "argument is missing or invalid\n  3  invalid input: a file is damaged, not supported, or references a path "
    "outside its folder\n  4  a file cannot be read or written\n  5  out of memory, or an internal error\nWith several "
    "files, the exit code is the highest of all files. Every error is one line on stderr.\n";

std::string usageLine(const Command& command) {
    return "tspace " + command.name + " " + command.operands + " [OPTION...]";
}

std::string optionHead(const Option& option) {
    std::string names;
    for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + name;
    if (option.value.empty()) return names;
    return names.empty() ? option.value : names + " " + option.value;
}

std::vector<std::pair<std::string, std::vector<const Option*>>> optionsByGroup(const std::vector<Option>& options) {
    std::vector<std::pair<std::string, std::vector<const Option*>>> groups;
    for (const Option& option : options) {
        auto group =
            std::find_if(groups.begin(), groups.end(), [&](const auto& known) { return known.first == option.group; });
        if (group == groups.end()) group = groups.insert(group, {option.group, {}});
        group->second.push_back(&option);
    }
    return groups;
}

std::string helpPage(const ToolTable& tool) {
    std::string page = std::string("tspace - ") + kToolSummary + "\n\nUsage: tspace COMMAND [OPTION...]\n\nCommands:\n";
    for (const Command& command : tool.commands) {
        // The help omits `view` if its page is not installed. Man pages list it, because the page may be installed
        // later.
        if (command.name == "view" && !hasViewPage()) continue;
        page += "  " + command.name + "\n        " + command.summary + "\n";
    }
    page += optionsText(tool.options) + "\nRun 'tspace help COMMAND' for the options of a command.\n\n" + kExitCodes;
    if (const std::string parts = missingFeatures(); !parts.empty()) page += "\n" + parts;
    return page;
}

std::string helpPage(const Command& command) {
    std::string page = "tspace " + command.name + " - " + command.summary + "\n\nUsage: " + usageLine(command) +
                       "\n\n" + command.description + "\n";
    page += optionsText(command.options) + "\nExamples:\n";
    for (const std::string& example : command.examples) page += "  " + report::unbroken(example) + "\n";
    return page + "\n" + kExitCodes;
}

}  // namespace tspace::tool
