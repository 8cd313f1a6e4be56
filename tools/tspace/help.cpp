// SPDX-License-Identifier: MIT
// Pages from the table of options.
#include "help.h"

#include <algorithm>
#include <sstream>

namespace tspace::tool {
namespace {

constexpr std::size_t kPageWidth = 80;

/// Lines that are empty or start with a space are kept as they are.
void appendWrapped(std::string& out, const std::string& line, std::size_t indent) {
    const std::string margin(indent, ' ');
    if (line.empty() || line.front() == ' ') {
        out += line.empty() ? "\n" : margin + line + "\n";
        return;
    }
    std::istringstream words(line);
    std::string word;
    std::string current;
    while (words >> word) {
        if (!current.empty() && indent + current.size() + 1 + word.size() > kPageWidth) {
            out += margin + current + "\n";
            current.clear();
        }
        current += (current.empty() ? "" : " ") + word;
    }
    out += margin + current + "\n";
}

/// Breaks text into lines of the page, each indented by `indent` spaces.
std::string wrapText(const std::string& text, std::size_t indent) {
    std::string out;
    std::istringstream lines(text);
    std::string line;
    while (std::getline(lines, line)) appendWrapped(out, line, indent);
    return out;
}

std::string optionsText(const std::vector<Option>& options) {
    std::string page;
    for (const auto& [heading, members] : optionsByGroup(options)) {
        page += "\n" + heading + ":\n";
        for (const Option* option : members) {
            const std::string value = option->default_text.empty() ? "" : " Default: " + option->default_text + ".";
            page += "  " + optionHead(*option) + "\n" + wrapText(option->help + value, 8);
        }
    }
    return page;
}

}  // namespace

std::string leftOut() {
    const std::string parts = TSPACE_LEFT_OUT;
    return parts.empty() ? "" : "Built without: " + parts + ".\n";
}

const char* const kExitCodes =
    "Exit codes:\n"
    "  0  done\n"
    "  1  findings: a comparing or checking command found something\n"
    "  2  wrong usage\n"
    "  3  bad input: a file is broken, not supported, or leads outside its folder\n"
    "  4  cannot read or write a file\n"
    "  5  out of memory, or an internal error\n"
    "Of several files the worst decides. Every error is one line on stderr.\n";

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
    std::string page = wrapText(std::string("tspace - ") + kToolSummary, 0) + "\nUsage: tspace COMMAND [OPTION...]\n";
    page += "\nCommands:\n";
    for (const Command& command : tool.commands) page += "  " + command.name + "\n" + wrapText(command.summary, 8);
    page += optionsText(tool.options) + "\ntspace help COMMAND says more about a command.\n\n";
    page += wrapText(kExitCodes, 0);
    if (const std::string parts = leftOut(); !parts.empty()) page += "\n" + wrapText(parts, 0);
    return page;
}

std::string helpPage(const Command& command) {
    std::string page = wrapText("tspace " + command.name + " - " + command.summary, 0);
    page += "\nUsage: " + usageLine(command) + "\n\n" + wrapText(command.description, 0);
    page += optionsText(command.options) + "\nExamples:\n";
    for (const std::string& example : command.examples) page += "  " + example + "\n";
    return page + "\n" + wrapText(kExitCodes, 0);
}

}  // namespace tspace::tool
