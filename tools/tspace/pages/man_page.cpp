// SPDX-License-Identifier: MIT
// Writes man pages.
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "help.h"
#include "pages/pages.h"

namespace tspace::tool {
namespace {

/// Escapes dashes, which roff would otherwise turn into hyphens that cannot be copied.
std::string escaped(const std::string& text) { return replaced(replaced(text, "\\", "\\e"), "-", "\\-"); }

std::string upperCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
    return text;
}

/// Wraps text to short lines, with a line break after each sentence, which roff needs for spacing. A line must not
/// start with a dot, which would be a request.
std::string filled(const std::string& text) {
    constexpr std::size_t kWidth = 76;
    std::string out, line;
    const auto flush = [&] {
        if (line.empty()) return;
        out += (line.front() == '.' || line.front() == '\'' ? "\\&" : "") + line + "\n";
        line.clear();
    };
    std::istringstream words(escaped(text));
    for (std::string word; words >> word;) {
        if (!line.empty() && line.size() + 1 + word.size() > kWidth) flush();
        line += (line.empty() ? "" : " ") + word;
        if (word.ends_with('.') && word != "IN...") flush();
    }
    flush();
    return out;
}

std::string title(const std::string& name, const std::string& date) {
    return ".\\\" Generated from the tool's table of options.\n.TH " + upperCase(escaped(name)) + " 1 " + date +
           " \"tspace " TSPACE_VERSION "\" \"tspace\"\n";
}

std::string nameSection(const std::string& name, const std::string& summary) {
    return ".SH NAME\n" + escaped(name) + " \\- " + escaped(summary) + "\n";
}

/// Returns ".TP" and the head of the paragraph: names in bold, values in italics.
std::string head(const Option& option) {
    std::string names;
    for (const std::string& name : option.names)
        names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", escaped(name));
    if (!option.value.empty()) names += fmt::format("{}\\fI{}\\fR", names.empty() ? "" : " ", escaped(option.value));
    return ".TP\n" + names + "\n";
}

std::string optionSections(const std::vector<Option>& options) {
    std::string page;
    for (const auto& [heading, members] : optionsByGroup(options)) {
        page += ".SH " + upperCase(heading) + "\n";
        for (const Option* option : members) {
            page += head(*option) + filled(option->help);
            if (!option->default_text.empty()) page += filled("Default: " + option->default_text + ".");
        }
    }
    return page;
}

std::string exitStatus() {
    std::string page = ".SH EXIT STATUS\n";
    std::istringstream lines(kExitCodes);
    std::string line;
    std::getline(lines, line);  // the heading
    while (std::getline(lines, line)) {
        if (line.starts_with("  ")) {
            page += ".TP\n.B " + line.substr(2, 1) + "\n" + filled(line.substr(5));
        } else {
            page += ".PP\n" + filled(line);
        }
    }
    return page;
}

std::string seeAlso(const ToolTable& tool, const std::string& own_name) {
    std::vector<std::string> names = {"tspace"};
    for (const Command& command : tool.commands) names.push_back("tspace-" + command.name);
    names.erase(std::remove(names.begin(), names.end(), own_name), names.end());
    std::string page = ".SH SEE ALSO\n";
    for (const std::string& name : names)
        page += ".BR " + escaped(name) + " (1)" + (name == names.back() ? "" : ",") + "\n";
    return page;
}

}  // namespace

std::string manPage(const ToolTable& tool, const std::string& date) {
    std::string page = title("tspace", date) + nameSection("tspace", kToolSummary);
    page += ".SH SYNOPSIS\n.B tspace\n\\fICOMMAND\\fR [\\fIOPTION\\fR...]\n.SH COMMANDS\n";
    for (const Command& command : tool.commands)
        page += ".TP\n.BR tspace\\-" + escaped(command.name) + " (1)\n" + filled(command.summary);
    return page + optionSections(tool.options) + exitStatus() + seeAlso(tool, "tspace");
}

std::string manPage(const ToolTable& tool, const Command& command, const std::string& date) {
    const std::string name = "tspace-" + command.name;
    std::string page = title(name, date) + nameSection(name, command.summary);
    page += ".SH SYNOPSIS\n.B tspace " + escaped(command.name) + "\n" + escaped(command.operands) +
            " [\\fIOPTION\\fR...]\n.SH DESCRIPTION\n" + filled(command.description);
    page += optionSections(command.options) + ".SH EXAMPLES\n.EX\n";
    for (const std::string& example : command.examples) page += escaped(example) + "\n";
    return page + ".EE\n" + exitStatus() + seeAlso(tool, name);
}

}  // namespace tspace::tool
