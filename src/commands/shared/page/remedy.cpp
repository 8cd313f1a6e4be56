// SPDX-License-Identifier: MIT
#include "commands/shared/page/remedy.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "commands/generate/generate_model.h"
#include "commands/shared/request.h"

namespace tspace {

namespace {

constexpr std::string_view kCommand = "tspace generate";

/// The word that begins at `at`, without what ends a sentence.
std::string_view wordAt(std::string_view text, std::size_t at) {
    const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_", at);
    return text.substr(at, std::min(end, text.size()) - at);
}

}  // namespace

std::optional<RemedyCommand> commandIn(const std::string& remedy) {
    const std::string_view text = remedy;
    const std::size_t begin = text.find(kCommand);
    if (begin == std::string_view::npos) return {};
    RemedyCommand command;
    GenerateOptions result;
    const options::OptionList list = options::generateOptions(result);
    options::Given given;
    bool is_whole = true;
    std::size_t end = begin + kCommand.size();
    const auto nextWord = [&] { return end < text.size() && text[end] == ' ' ? wordAt(text, end + 1) : ""; };
    for (std::string_view word = nextWord(); word.starts_with("--"); word = nextWord()) {
        end += 1 + word.size();
        const options::Option* option = options::findOption(list, std::string(word));
        std::string value;
        if (option != nullptr && !option->value.empty()) {
            value = nextWord();
            end += value.empty() ? 0 : 1 + value.size();
            is_whole = is_whole && !value.empty();
        }
        is_whole = is_whole && option != nullptr && options::giveValue(*option, value, given).empty();
    }
    command.text = text.substr(begin, end - begin);
    is_whole = is_whole && options::checkTogether(list, given).empty() && options::finish(given, result).empty();
    if (is_whole) command.options = result;
    return command;
}

DrawnScene mendedScene(const std::string& input, const FileOptions& file, GenerateOptions options) {
    options.file = file;
    return generateModel(input, options, true).model.drawnScene(true);
}

}  // namespace tspace
