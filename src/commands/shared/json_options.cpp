// SPDX-License-Identifier: MIT
// Members of a JSON object as values of options.
#include "commands/shared/json_options.h"

#include <algorithm>

#include "model/json/json.h"

namespace tspace::options {
namespace {

/// A value as it stands on a command line; of a list, with commas. Empty where it is neither text nor a number.
std::string wordOf(const Json& value, bool is_list) {
    if (value.is_string()) return value.text();
    if (value.is_number()) return value.dump();
    std::string words;
    if (!is_list || !value.is_array()) return words;
    for (const Json& part : value) {
        if (!words.empty()) words += ',';
        words += wordOf(part, false);
    }
    return words;
}

std::string giveMember(const Option& option, const Json& value, Given& given) {
    if (value.is_null()) return {};
    if (option.value.empty()) {
        if (!value.is_boolean()) return option.name() + " must be true or false";
        return value.get<bool>() ? giveValue(option, "", given) : "";
    }
    const bool has_word = value.is_string() || value.is_number() || (option.is_list && value.is_array());
    if (!has_word) return option.name() + " needs a value: " + option.value;
    return giveValue(option, wordOf(value, option.is_list), given);
}

}  // namespace

std::string readJsonOptions(const OptionList& list, std::string_view text, Given& given) {
    if (text.empty()) return {};
    JsonError error;
    const std::optional<Json> root = Json::read(text, error);
    if (!root) {
        return "the options cannot be read: " + error.message +
               (error.byte ? " (at byte " + std::to_string(*error.byte) + ")" : "");
    }
    if (!root->is_object()) return "the options are not a JSON object";
    for (const auto& [name, value] : root->items()) {
        const std::string long_name = std::string("--").append(name);
        const Option* option = findOption(list, long_name);
        const std::string wrong =
            option == nullptr ? unknownOption(list, long_name) : giveMember(*option, value, given);
        if (!wrong.empty()) return wrong;
    }
    return checkTogether(list, given);
}

}  // namespace tspace::options
