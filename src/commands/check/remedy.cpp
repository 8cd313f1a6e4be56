// SPDX-License-Identifier: MIT
// Commands of remedies, and remedies as text.
#include "commands/check/remedy.h"

#include <algorithm>

namespace tspace {

std::string commandLine(const RemedyCommand& command) {
    std::string line = "tspace " + command.verb;
    for (const std::string& input : command.inputs) line += " " + input;
    for (const RemedyOption& option : command.options) {
        line += (option.name.size() == 1 ? " -" : " --") + option.name;
        if (!option.value.empty()) line += " " + option.value;
    }
    return line;
}

RemedyCommand toCommand(std::string_view words) {
    RemedyCommand command;
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(' '), words.size());
        std::string word(words.substr(0, end));
        words.remove_prefix(std::min(end + 1, words.size()));
        const bool is_placeholder = word[0] >= 'A' && word[0] <= 'Z';
        if (is_placeholder) command.placeholders.push_back(word);
        if (command.verb.empty()) {
            command.verb = std::move(word);
        } else if (word[0] == '-') {
            command.options.push_back({word.substr(word.find_first_not_of('-')), {}});
        } else if (command.options.empty()) {
            command.inputs.push_back(std::move(word));
        } else {
            command.options.back().value = std::move(word);
        }
    }
    return command;
}

RemedyCommand withOption(RemedyCommand command, std::string name, std::string value) {
    command.options.push_back({std::move(name), std::move(value)});
    return command;
}

void setRemedy(Finding& finding, Remedy remedy) {
    finding.remedy = std::move(remedy.text);
    finding.commands = std::move(remedy.commands);
}

void formatRemedies(std::span<Finding> findings) {
    constexpr std::string_view kPlace = "{}";
    for (Finding& finding : findings) {
        std::size_t at = 0;
        for (const RemedyCommand& command : finding.commands) {
            at = finding.remedy.find(kPlace, at);
            if (at == std::string::npos) break;
            const std::string line = commandLine(command);
            finding.remedy.replace(at, kPlace.size(), line);
            at += line.size();
        }
    }
}

}  // namespace tspace
