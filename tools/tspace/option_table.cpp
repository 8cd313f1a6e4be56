// SPDX-License-Identifier: MIT
// Options of the common kinds.
#include "option_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace tspace::tool {
namespace {

constexpr const char* kDigits = "0123456789";

/// No spaces, no hexadecimal digits, no names such as "inf". The tool never leaves the C locale.
bool parseReal(const std::string& text, double& number) {
    if (text.empty() || text.find_first_not_of("0123456789.+-eE") != std::string::npos) return false;
    char* end = nullptr;
    number = std::strtod(text.c_str(), &end);
    return *end == '\0' && std::isfinite(number);
}

}  // namespace

bool parseNumber(const std::string& text, std::uint64_t& number) {
    constexpr std::size_t kMostDigits = 19;  // of any number below 2^63
    if (text.empty() || text.size() > kMostDigits || text.find_first_not_of(kDigits) != std::string::npos) return false;
    number = std::strtoull(text.c_str(), nullptr, 10);
    return true;
}

bool Given::has(const std::string& name) const {
    return std::any_of(items.begin(), items.end(), [&](const Item& item) { return item.option->name() == name; });
}

Option& Command::add(const char* group, Option option) {
    option.group = group;
    options.push_back(std::move(option));
    return options.back();
}

Option option(const char* names, const char* value_name, Take take, std::string help) {
    Option made{.value = value_name, .help = std::move(help), .take = std::move(take)};
    const std::string all = names;
    for (std::size_t begin = 0; begin < all.size();) {
        const std::size_t end = std::min(all.find(", ", begin), all.size());
        made.names.push_back(all.substr(begin, end - begin));
        begin = end + 2;
    }
    return made;
}

Option text(const char* names, const char* value_name, std::string& target, std::string help) {
    const auto take = [&target](const std::string& given) {
        target = given;
        return std::string();
    };
    return option(names, value_name, take, std::move(help));
}

Option operand(const char* value_name, std::string& target, std::string help) {
    Option made = text("", value_name, target, std::move(help));
    made.is_file = made.is_required = true;
    return made;
}

Option operand(const char* value_name, std::vector<std::string>& target, std::string help) {
    const auto take = [&target](const std::string& given) {
        target.push_back(given);
        return std::string();
    };
    Option made = option("", value_name, take, std::move(help));
    made.is_file = made.is_required = made.is_repeatable = true;
    return made;
}

Option numberOption(const char* names, std::uint64_t default_value, unsigned most,
                    std::function<void(std::uint64_t)> store, std::string help) {
    const auto take = [most, store = std::move(store)](const std::string& given) -> std::string {
        std::uint64_t count = 0;
        if (!parseNumber(given, count) || count > most) return fmt::format("must be a whole number from 0 to {}", most);
        store(count);
        return {};
    };
    Option made = option(names, "N", take, std::move(help));
    made.default_text = fmt::format("{}", default_value);
    return made;
}

Option degreesOption(const char* names, double default_value, int most, std::function<void(double)> store,
                     std::string help) {
    const auto take = [most, store = std::move(store)](const std::string& given) -> std::string {
        double angle = 0;
        if (!parseReal(given, angle) || angle < 0 || angle > most)
            return fmt::format("must be a number of degrees from 0 to {}", most);
        store(angle);
        return {};
    };
    Option made = option(names, "DEG", take, std::move(help));
    made.default_text = fmt::format("{}", default_value);
    return made;
}

}  // namespace tspace::tool
