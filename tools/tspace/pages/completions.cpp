// SPDX-License-Identifier: MIT
// Writes shell completions for bash, zsh and fish: commands, options, and option values.
#include <fmt/core.h>

#include <algorithm>

#include "pages/pages.h"

namespace tspace::tool {
namespace {

std::string joined(const std::vector<std::string>& words, const char* between) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

std::vector<std::string> allNames(const std::vector<Option>& options) {
    std::vector<std::string> names;
    for (const Option& option : options) names.insert(names.end(), option.names.begin(), option.names.end());
    return names;
}

std::vector<std::string> commandNames(const ToolTable& tool) {
    std::vector<std::string> names;
    for (const Command& command : tool.commands) names.push_back(command.name);
    return names;
}

/// Quotes a text with single quotes for bash and zsh.
std::string shellQuoted(const std::string& text) { return fmt::format("'{}'", replaced(text, "'", "'\\''")); }

std::string bashValues(const Option& option) {
    const std::string words = shellQuoted(joined(option.choices, " "));
    if (option.is_list) return "_tspace_words \"${cur%\"${cur##*,}\"}\" " + words + " \"${cur##*,}\"";
    if (!option.choices.empty()) return "_tspace_words '' " + words + " \"$cur\"";
    return option.is_file ? "_tspace_files" : ":";
}

/// Returns the cases of "COMMAND OPTION" for bash: the values that may follow the option.
std::string bashCases(const Command& command) {
    std::string cases, operand = "_tspace_files";
    for (const Option& option : command.options) {
        if (option.names.empty() && !option.choices.empty()) operand = bashValues(option);
        if (option.value.empty() || option.names.empty()) continue;
        std::vector<std::string> patterns;
        for (const std::string& name : option.names) patterns.push_back("'" + command.name + " " + name + "'");
        cases += "        " + joined(patterns, " | ") + ") " + bashValues(option) + " ;;\n";
    }
    const std::string names = shellQuoted(joined(allNames(command.options), " "));
    cases += "        '" + command.name + " '*)\n            if [[ $cur == -* ]]; then _tspace_words '' " + names +
             " \"$cur\"; else " + operand + "; fi ;;\n";
    return cases;
}

/// Escapes a text for the part in [] of a specification of _arguments.
std::string zshText(const std::string& text) {
    return replaced(replaced(replaced(text, "[", "\\["), "]", "\\]"), ":", "\\:");
}

std::string zshValue(const Option& option) {
    std::string action;
    if (option.is_list) {
        action = "{_values -s , " + option.value + " " + joined(option.choices, " ") + "}";
    } else if (!option.choices.empty()) {
        action = "(" + joined(option.choices, " ") + ")";
    } else if (option.is_file) {
        action = "_files";
    }
    return ":" + option.value + ":" + action;
}

std::string zshArguments(const std::vector<Option>& options) {
    std::string specs;
    for (const Option& option : options) {
        if (option.names.empty()) {
            const std::string place = option.is_repeatable ? "*" : "";
            specs += " \\\n                " + shellQuoted(place + zshValue(option));
            continue;
        }
        std::vector<std::string> others = option.names;
        others.insert(others.end(), option.excludes.begin(), option.excludes.end());
        for (const std::string& name : option.names) {
            const char* behind = option.value.empty() ? "" : name.starts_with("--") ? "=" : "+";
            std::string spec = option.is_repeatable ? "*" : fmt::format("({})", joined(others, " "));
            spec += name + behind + "[" + zshText(firstSentence(option.help)) + "]";
            if (!option.value.empty()) spec += zshValue(option);
            specs += " \\\n                " + shellQuoted(spec);
        }
    }
    return specs;
}

std::string fishQuoted(const std::string& text) {
    return "'" + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + "'";
}

std::string fishOption(const std::string& condition, const Option& option) {
    std::string line = "complete -c tspace -n " + fishQuoted(condition);
    for (const std::string& name : option.names) {
        const bool is_long = name.starts_with("--");
        line += (is_long ? " -l " : " -s ") + name.substr(is_long ? 2 : 1);
    }
    if (!option.choices.empty()) {
        line += " -x -a " + fishQuoted(joined(option.choices, " "));
    } else if (!option.value.empty()) {
        line += option.is_file ? " -r -F" : " -x";
    }
    return line + " -d " + fishQuoted(firstSentence(option.help)) + "\n";
}

}  // namespace

std::string replaced(std::string text, const std::string& mark, const std::string& by) {
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + by.size()))
        text.replace(at, mark.size(), by);
    return text;
}

std::string firstSentence(const std::string& help) {
    const std::size_t end = std::min(help.find(". "), help.find(": "));
    std::string sentence = help.substr(0, end);
    if (sentence.ends_with('.')) sentence.pop_back();
    return sentence;
}

std::string bashCompletion(const ToolTable& tool) {
    std::string cases;
    for (const Command& command : tool.commands) cases += bashCases(command);
    std::vector<std::string> first = commandNames(tool);
    for (const std::string& name : allNames(tool.options)) first.push_back(name);
    return R"(# Completion of tspace for bash. Generated from the tool's table of options.

# _tspace_words PREFIX WORDS BEGINNING
_tspace_words() { mapfile -t COMPREPLY < <(compgen -P "$1" -W "$2" -- "$3"); }

_tspace_files() {
    mapfile -t COMPREPLY < <(compgen -f -- "$cur")
    compopt -o filenames 2>/dev/null
}

_tspace() {
    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]}
    # --name=VALUE arrives as three words.
    if [[ $cur == = ]]; then
        cur=
    elif [[ $prev == = ]]; then
        prev=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        _tspace_words '' )" +
           shellQuoted(joined(first, " ")) + R"( "$cur"
        return
    fi
    case "${COMP_WORDS[1]} $prev" in
)" + cases +
           R"(    esac
}

complete -F _tspace tspace
)";
}

std::string zshCompletion(const ToolTable& tool) {
    std::string commands, cases;
    for (const Command& command : tool.commands) {
        commands += "        " + shellQuoted(command.name + ":" + zshText(command.summary)) + "\n";
        cases += "        " + command.name + ")\n            _arguments -s -S" + zshArguments(command.options) + "\n" +
                 "            ;;\n";
    }
    return "#compdef tspace\n# Completion of tspace for zsh. Generated from the tool's table of options.\n\n_tspace() "
           "{\n    local -a commands\n    commands=(\n" +
           commands +
           "    )\n    if ((CURRENT == 2)); then\n        _alternative 'commands:command:{_describe command commands}' "
           "'options:option:(" +
           joined(allNames(tool.options), " ") +
           ")'\n        return\n    fi\n    local command=$words[2]\n    shift words\n    ((CURRENT--))\n"
           "    case $command in\n" +
           cases + "    esac\n}\n\n_tspace \"$@\"\n";
}

std::string fishCompletion(const ToolTable& tool) {
    std::string script = "# Completion of tspace for fish. Generated from the tool's table of options.\n\n";
    for (const Command& command : tool.commands) {
        script += "complete -c tspace -n __fish_use_subcommand -f -a " + command.name + " -d " +
                  fishQuoted(command.summary) + "\n";
    }
    for (const Option& option : tool.options) script += fishOption("__fish_use_subcommand", option);
    for (const Command& command : tool.commands) {
        const std::string condition = "__fish_seen_subcommand_from " + command.name;
        for (const Option& option : command.options) {
            if (!option.names.empty()) {
                script += fishOption(condition, option);
            } else if (!option.choices.empty()) {
                script += "complete -c tspace -n " + fishQuoted(condition) + " -f -a " +
                          fishQuoted(joined(option.choices, " ")) + "\n";
            }
        }
    }
    return script;
}

}  // namespace tspace::tool
