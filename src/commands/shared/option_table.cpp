// SPDX-License-Identifier: MIT
// Common kinds of options, and options as JSON.
#include "commands/shared/option_table.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "model/io/path.h"
#include "model/json/json.h"

namespace tspace::options {
namespace {

constexpr const char* kDigits = "0123456789";

/// Formats a number with as few digits as necessary.
std::string plainText(double number) {
    const std::string text = Json(number).dump();
    return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

std::string givePart(const Option& option, const std::string& value) {
    const auto& choices = option.choices;
    std::string wrong;
    if (!choices.empty() && std::find(choices.begin(), choices.end(), value) == choices.end()) {
        constexpr std::size_t kMaxListed = 12;
        wrong = option.take(value);  // may return why a name is invalid
        if (wrong.empty()) {
            wrong =
                choices.size() <= kMaxListed ? "must be one of " + joined(choices) : "is not a known " + option.value;
            wrong += didYouMean(value, choices);
        }
    } else {
        wrong = option.take(value);
    }
    return wrong.empty() ? "" : option.name() + " " + (value.empty() ? "''" : value) + ": " + wrong;
}

}  // namespace

// Accepts no spaces, hexadecimal digits or names such as "inf". The decimal separator is a point in every locale.
bool parseReal(const std::string& text, double& number) {
    std::size_t at = 0;
    const auto take = [&](const char* these, std::size_t most) {
        const std::size_t begin = at;
        at = std::min({text.find_first_not_of(these, at), begin + most, text.size()});
        return text.substr(begin, at - begin);
    };
    const std::string sign = take("+-", 1);
    take("0", text.size());
    const bool has_zeros = at > sign.size();
    const std::string whole = take(kDigits, text.size());
    const std::string part = take(".", 1).empty() ? "" : take(kDigits, text.size());
    if (!has_zeros && whole.empty() && part.empty()) return false;
    const std::string exponent = text.substr(at);
    if (exponent.find_first_not_of("0123456789+-eE") != std::string::npos) return false;
    JsonError error;
    const std::optional<Json> read = Json::read(
        (sign == "-" ? "-" : "") + (whole.empty() ? "0" : whole) + (part.empty() ? "" : "." + part) + exponent, error);
    if (read) number = read->get<double>();
    return read.has_value();
}

bool parseNumber(const std::string& text, std::uint64_t& number) {
    constexpr std::size_t kMaxDigits = 19;  // maximum number of digits of an integer below 2^63
    if (text.empty() || text.size() > kMaxDigits || text.find_first_not_of(kDigits) != std::string::npos) return false;
    number = std::strtoull(text.c_str(), nullptr, 10);
    return true;
}

bool Given::has(const std::string& name) const {
    return std::any_of(items.begin(), items.end(), [&](const Item& item) { return item.option->name() == name; });
}

Option& add(OptionList& list, const char* group, Option option) {
    option.group = group;
    list.push_back(std::move(option));
    return list.back();
}

std::string giveValue(const Option& option, const std::string& value, Given& given) {
    if (!option.is_repeatable && given.has(option.name()))
        return option.value.empty() ? "" : option.name() + " is given twice";
    given.items.push_back({&option, value});
    std::size_t begin = 0;
    std::string wrong;
    while (wrong.empty() && begin <= value.size()) {
        const std::size_t end = option.is_list ? std::min(value.find(',', begin), value.size()) : value.size();
        wrong = givePart(option, value.substr(begin, end - begin));
        begin = end + 1;
    }
    return wrong;
}

std::string checkTogether(const OptionList& list, const Given& given) {
    for (const Option& option : list) {
        if (!given.has(option.name())) {
            if (option.is_required) return option.name() + " is missing";
            continue;
        }
        for (const std::string& other : option.excludes) {
            if (given.has(other)) return option.name() + " and " + other + " cannot be used together";
        }
        if (!option.needs.empty() && !given.has(option.needs)) return option.name() + " needs " + option.needs;
    }
    return {};
}

bool Option::isNamed(const std::string& given) const {
    const auto has = [&](const std::vector<std::string>& list) {
        return std::find(list.begin(), list.end(), given) != list.end();
    };
    return has(names) || has(old_names);
}

const Option* findOption(const OptionList& list, const std::string& name) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const Option& option) { return option.isNamed(name); });
    return found != list.end() ? &*found : nullptr;
}

std::string unknownOption(const OptionList& list, const std::string& name) {
    std::vector<std::string> names;
    for (const Option& option : list) names.insert(names.end(), option.names.rbegin(), option.names.rend());
    return "unknown option '" + name + "'" + didYouMean(name, names);
}

Option option(const char* names, const char* value_name, Take take, HelpText help) {
    Option made{.value = value_name, .help = std::move(help), .take = std::move(take)};
    const std::string all = names;
    for (std::size_t begin = 0; begin < all.size();) {
        const std::size_t end = std::min(all.find(", ", begin), all.size());
        made.names.push_back(all.substr(begin, end - begin));
        begin = end + 2;
    }
    return made;
}

Option numberOrAuto(const char* names, const char* value_name, const char* noun, float& target, float automatic,
                    int most, HelpText help) {
    const float default_value = target;
    const auto take = [&target, noun, automatic, most](const std::string& given) -> std::string {
        double number = 0;
        if (given == "auto") {
            target = automatic;
        } else if (parseReal(given, number) && number >= 0 && number <= most) {
            target = static_cast<float>(number);
        } else {
            return std::string("must be ") + noun + " from 0 to " + std::to_string(most) + ", or auto";
        }
        return {};
    };
    Option made = option(names, value_name, take, std::move(help));
    made.default_text = default_value == automatic ? "auto" : std::to_string(static_cast<int>(default_value));
    return made;
}

Option text(const char* names, const char* value_name, std::string& target, HelpText help) {
    const auto take = [&target](const std::string& given) {
        target = given;
        return std::string();
    };
    return option(names, value_name, take, std::move(help));
}

Option fileOption(const char* names, const char* value_name, std::string& target, HelpText help, InputKind reads) {
    Option made = text(names, value_name, target, std::move(help));
    made.is_file = true;
    made.reads = reads;
    return made;
}

Option htmlOutput(const char* names, const char* value_name, std::string& target, HelpText help) {
    const auto take = [&target](const std::string& given) -> std::string {
        const std::string extension = lowerExtension(given);
        const bool is_page = extension == ".html" || extension == ".htm";
        if (given.empty() || !(extension.empty() || is_page)) return "must end in .html or .htm, or have no extension";
        target = given;
        return {};
    };
    Option made = option(names, value_name, take, std::move(help));
    made.is_file = true;
    return made;
}

Option numberOption(const char* names, std::uint64_t default_value, unsigned most,
                    std::function<void(std::uint64_t)> store, HelpText help) {
    const auto take = [most, store = std::move(store)](const std::string& given) -> std::string {
        std::uint64_t count = 0;
        if (!parseNumber(given, count) || count > most) return "must be an integer from 0 to " + std::to_string(most);
        store(count);
        return {};
    };
    Option made = option(names, "N", take, std::move(help));
    made.default_text = std::to_string(default_value);
    return made;
}

Option degreesOption(const char* names, double default_value, int most, std::function<void(double)> store,
                     HelpText help) {
    const auto take = [most, store = std::move(store)](const std::string& given) -> std::string {
        double angle = 0;
        if (!parseReal(given, angle) || angle < 0 || angle > most)
            return "must be a number of degrees from 0 to " + std::to_string(most);
        store(angle);
        return {};
    };
    Option made = option(names, "DEG", take, std::move(help));
    made.default_text = plainText(default_value);
    return made;
}

namespace {

std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool is_equal = a[i - 1] == b[j - 1];
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (is_equal ? 0 : 1)});
            const bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (is_swap) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
        before_last = last;
        last = row;
    }
    return last[b.size()];
}

}  // namespace

std::string nearestName(const std::string& word, const std::vector<std::string>& names) {
    // Only words of these lengths are matched: almost any shorter word is one typing error away from another (for
    // example, "-q" is not a misspelled "-h").
    constexpr std::size_t kShortest = 3, kLongest = 64;
    if (word.size() < kShortest || word.size() > kLongest) return {};
    // One typing error per three letters is allowed, so that short words that differ do not match.
    const std::size_t most = word.size() / 3;
    std::size_t least = 2 * most + 2;
    std::string nearest;
    for (const std::string& name : names) {
        std::size_t distance = 2 * editDistance(word, name);
        // A longer name that starts with the word ranks below names within the maximum distance.
        if (name.starts_with(word)) distance = std::min(distance, 2 * most + 1);
        if (distance < least) {
            least = distance;
            nearest = name;
        }
    }
    return nearest;
}

std::string didYouMean(const std::string& word, const std::vector<std::string>& names) {
    const std::string nearest = nearestName(word, names);
    return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

// Members of a JSON object as option values.

namespace {

/// Returns a value as a word of a command line; lists are separated by commas. Empty if it is neither a string nor a
/// number.
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
    if (!root->is_object()) return "the options must be a JSON object";
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
