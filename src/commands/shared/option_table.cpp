// SPDX-License-Identifier: MIT
// The common kinds of options.
#include "commands/shared/option_table.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "commands/shared/nearest_name.h"
#include "model/json/json.h"

namespace tspace::options {
namespace {

constexpr const char* kDigits = "0123456789";

/// As few digits as a person would write.
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
        constexpr std::size_t kMostListed = 12;
        wrong =
            choices.size() <= kMostListed ? "must be one of " + joined(choices) : "there is no such " + option.value;
        wrong += didYouMean(value, choices);
    } else {
        wrong = option.take(value);
    }
    return wrong.empty() ? "" : option.name() + " " + (value.empty() ? "''" : value) + ": " + wrong;
}

}  // namespace

// No spaces, no hexadecimal digits, no names such as "inf"; with a point, whatever the program's locale says.
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
    constexpr std::size_t kMostDigits = 19;  // of any number below 2^63
    if (text.empty() || text.size() > kMostDigits || text.find_first_not_of(kDigits) != std::string::npos) return false;
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
            if (given.has(other)) return option.name() + " and " + other + " exclude each other";
        }
        if (!option.needs.empty() && !given.has(option.needs)) return option.name() + " needs " + option.needs;
    }
    return {};
}

const Option* findOption(const OptionList& list, const std::string& name) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const Option& option) { return option.name() == name; });
    return found != list.end() ? &*found : nullptr;
}

std::string unknownOption(const OptionList& list, const std::string& name) {
    std::vector<std::string> names;
    for (const Option& option : list) names.insert(names.end(), option.names.rbegin(), option.names.rend());
    return "there is no option '" + name + "'" + didYouMean(name, names);
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

Option text(const char* names, const char* value_name, std::string& target, HelpText help) {
    const auto take = [&target](const std::string& given) {
        target = given;
        return std::string();
    };
    return option(names, value_name, take, std::move(help));
}

Option numberOption(const char* names, std::uint64_t default_value, unsigned most,
                    std::function<void(std::uint64_t)> store, HelpText help) {
    const auto take = [most, store = std::move(store)](const std::string& given) -> std::string {
        std::uint64_t count = 0;
        if (!parseNumber(given, count) || count > most)
            return "must be a whole number from 0 to " + std::to_string(most);
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

}  // namespace tspace::options
