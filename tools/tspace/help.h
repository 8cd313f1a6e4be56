// SPDX-License-Identifier: MIT
// How --help looks: like a short man page, 80 columns wide. Included by arguments.cpp alone, because CLI11
// takes seconds to compile.
#pragma once

#include <CLI/CLI.hpp>
#include <sstream>
#include <string>

namespace tspace::tool {

inline constexpr std::size_t kPageWidth = 80;

/// Lines that are empty or start with a space are kept as they are.
inline void appendWrapped(std::string& out, const std::string& line, std::size_t indent, std::size_t width) {
    const std::string margin(indent, ' ');
    if (line.empty() || line.front() == ' ') {
        out += line.empty() ? "\n" : margin + line + "\n";
        return;
    }
    std::istringstream words(line);
    std::string word;
    std::string current;
    while (words >> word) {
        if (!current.empty() && indent + current.size() + 1 + word.size() > width) {
            out += margin + current + "\n";
            current.clear();
        }
        current += (current.empty() ? "" : " ") + word;
    }
    out += margin + current + "\n";
}

/// Breaks text into lines of at most `width` columns, each indented by `indent` spaces.
inline std::string wrapText(const std::string& text, std::size_t indent, std::size_t width) {
    std::string out;
    std::istringstream lines(text);
    std::string line;
    while (std::getline(lines, line)) appendWrapped(out, line, indent, width);
    return out;
}

inline std::string optionHead(const CLI::Option* option) {
    std::string names;
    for (const std::string& name : option->get_snames()) names += (names.empty() ? "-" : ", -") + name;
    for (const std::string& name : option->get_lnames()) names += (names.empty() ? "--" : ", --") + name;
    if (names.empty()) return option->get_type_name();
    if (!option->get_type_name().empty()) names += " " + option->get_type_name();
    return names;
}

inline std::string optionText(const CLI::Option* option) {
    std::string text = "  " + optionHead(option) + "\n";
    std::string description = option->get_description();
    if (!option->get_default_str().empty()) description += " Default: " + option->get_default_str() + ".";
    return text + wrapText(description, 8, kPageWidth);
}

/// A page per command: name, usage, description, options by group with their defaults, and the footer.
class HelpFormatter : public CLI::FormatterBase {
  public:
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const override {
        (void)name;  // the usage line already has it
        std::string page = wrapText(app->get_description(), 0, kPageWidth);
        const auto commands = app->get_subcommands([](const CLI::App*) { return true; });
        if (!commands.empty()) {
            page += "\nCommands:\n";
            for (const CLI::App* command : commands) {
                const std::string text = command->get_description();
                const std::size_t dash = text.find(" - ");
                page += "  " + command->get_name() + "\n" +
                        wrapText(text.substr(dash + 3, text.find('\n') - dash - 3), 8, kPageWidth);
            }
        }
        for (const std::string& group : app->get_groups()) {
            std::string options;
            for (const CLI::Option* option : app->get_options()) {
                if (option->get_group() == group) options += optionText(option);
            }
            if (!options.empty()) page += "\n" + group + ":\n" + options;
        }
        return page + "\n" + wrapText(app->get_footer(), 0, kPageWidth);
    }
};

}  // namespace tspace::tool
