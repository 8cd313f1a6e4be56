// SPDX-License-Identifier: MIT
// JSON of a glTF file: errors with their JSON pointers, and checked access.
#include "model/gltf/json_access.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "model/io/file_error.h"

namespace tspace::gltf {
namespace {

[[noreturn]] void failJson(std::string message, std::string place) {
    failFile(ErrorCode::invalidFile, std::move(message), std::move(place));
}

[[noreturn]] void failMissing(const char* key, const std::string& place) {
    failJson(std::string("the member '") + key + "' is missing", place);
}

/// Charges the memory of values to the budget of the file.
class BudgetMemory final : public JsonMemory {
  public:
    explicit BudgetMemory(MemoryBudget& budget) : budget_(budget) {}
    void take(std::size_t bytes) override { budget_.take(bytes, {}); }

  private:
    MemoryBudget& budget_;
};

Json parseText(std::string_view text, MemoryBudget* budget) {
    std::optional<BudgetMemory> memory;
    if (budget != nullptr) memory.emplace(*budget);
    JsonError error;
    std::optional<Json> root = Json::read(text, error, memory ? &*memory : nullptr);
    if (root) return std::move(*root);
    if (error.repeated)
        failJson("the JSON contains the member " + inQuotes(*error.repeated) + " twice in one object", {});
    failJson(error.message, error.byte ? "JSON byte " + std::to_string(*error.byte) : std::string());
}

JsonStyle styleOf(std::string_view text) {
    JsonStyle style;
    style.final_newline = !text.empty() && text.back() == '\n';
    const std::size_t open = text.find('{');
    const std::size_t line = open == std::string_view::npos ? open : text.find_first_not_of(" \r", open + 1);
    if (line == std::string_view::npos || text[line] != '\n') return style;
    const std::size_t first = text.find_first_not_of(" \t", line + 1);
    const std::size_t width = first == std::string_view::npos ? 0 : first - line - 1;
    style.indent_char = width > 0 && text[line + 1] == '\t' ? '\t' : ' ';
    style.indent = static_cast<int>(std::min<std::size_t>(width, 16));
    return style;
}

/// Reads 64 bits even if size_t has 32, so that large numbers are compared instead of truncated.
std::optional<std::uint64_t> wholeNumber(const Json& value) {
    if (value.is_number_integer()) {
        // Parsed numbers are unsigned; numbers that tspace wrote may be signed.
        if (!value.is_number_unsigned() && value.get<std::int64_t>() < 0) return {};
        return value.get<std::uint64_t>();
    }
    if (!value.is_number_float()) return {};
    // Numbers such as 5.0 are integers too. Beyond 2^53 a double cannot represent every integer.
    const double number = value.get<double>();
    if (!(number >= 0 && number <= 9007199254740992.0) || number != std::floor(number)) return {};
    return static_cast<std::uint64_t>(number);
}

}  // namespace

ParsedJson parseJson(std::span<const std::uint8_t> bytes, MemoryBudget* budget) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    ParsedJson result{parseText(text, budget), styleOf(text)};
    if (!result.root.is_object()) failJson("the top level of the JSON is not an object", {});
    return result;
}

std::string writeJson(const Json& root, const JsonStyle& style) {
    std::string text = root.dump(style.indent, style.indent_char, BadUtf8::replace);
    if (style.final_newline) text += '\n';
    return text;
}

const Json* findMember(const Json& object, const char* key) { return object.find(key); }

std::uint64_t readWhole(const Json& object, const char* key, const std::string& place,
                        std::optional<std::uint64_t> fallback) {
    const Json* value = findMember(object, key);
    if (value == nullptr) {
        if (fallback) return *fallback;
        failMissing(key, place);
    }
    const auto number = wholeNumber(*value);
    if (!number) failJson(std::string("'") + key + "' is not a non-negative integer", join(place, key));
    return *number;
}

std::size_t readSize(const Json& object, const char* key, const std::string& place,
                     std::optional<std::size_t> fallback) {
    constexpr std::uint64_t kMax = std::numeric_limits<std::size_t>::max();
    const std::uint64_t number = readWhole(object, key, place, fallback);
    if (number > kMax) {
        failJson(std::string("'") + key + "' is " + std::to_string(number) + "; the maximum of this build is " +
                     std::to_string(kMax),
                 join(place, key));
    }
    return static_cast<std::size_t>(number);
}

std::size_t toIndex(const Json& value, const std::string& place, std::size_t limit, const char* what) {
    const auto number = wholeNumber(value);
    if (!number) failJson(std::string("the index of the ") + what + " is not a non-negative integer", place);
    if (*number >= limit) {
        failJson(std::string("there is no ") + what + " " + std::to_string(*number) + "; the file has " +
                     std::to_string(limit),
                 place);
    }
    return static_cast<std::size_t>(*number);
}

std::optional<std::size_t> readIndex(const Json& object, const char* key, const std::string& place, std::size_t limit,
                                     const char* what) {
    const Json* value = findMember(object, key);
    if (value == nullptr) return {};
    return toIndex(*value, join(place, key), limit, what);
}

double readNumber(const Json& object, const char* key, const std::string& place, double fallback) {
    const Json* value = findMember(object, key);
    if (value == nullptr) return fallback;
    if (!value->is_number()) failJson(std::string("'") + key + "' is not a number", join(place, key));
    return value->get<double>();
}

void readNumbers(const Json& object, const char* key, const std::string& place, std::span<double> numbers) {
    const Json* value = findMember(object, key);
    if (value == nullptr) return;
    bool are_numbers = value->is_array() && value->size() == numbers.size();
    for (std::size_t i = 0; are_numbers && i < numbers.size(); ++i) are_numbers = (*value)[i].is_number();
    if (!are_numbers) {
        failJson(std::string("'") + key + "' is not an array of " + std::to_string(numbers.size()) + " numbers",
                 join(place, key));
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = (*value)[i].get<double>();
}

std::string readString(const Json& object, const char* key, const std::string& place, const std::string& fallback) {
    const Json* value = findMember(object, key);
    if (value == nullptr) return fallback;
    if (!value->is_string()) failJson(std::string("'") + key + "' is not a string", join(place, key));
    return value->get<std::string>();
}

bool readBool(const Json& object, const char* key, const std::string& place, bool fallback) {
    const Json* value = findMember(object, key);
    if (value == nullptr) return fallback;
    if (!value->is_boolean()) failJson(std::string("'") + key + "' is not true or false", join(place, key));
    return value->get<bool>();
}

const Json& readArray(const Json& object, const char* key, const std::string& place, bool of_objects) {
    static const Json empty = Json::array();
    const Json* value = findMember(object, key);
    if (value == nullptr) return empty;
    if (!value->is_array()) failJson(std::string("'") + key + "' is not an array", join(place, key));
    for (std::size_t i = 0; of_objects && i < value->size(); ++i) {
        if (!(*value)[i].is_object())
            failJson(std::string("an entry of '") + key + "' is not an object", join(join(place, key), i));
    }
    return *value;
}

const Json* readObject(const Json& object, const char* key, const std::string& place) {
    const Json* value = findMember(object, key);
    if (value != nullptr && !value->is_object())
        failJson(std::string("'") + key + "' is not an object", join(place, key));
    return value;
}

std::size_t requireIndex(const Json& object, const char* key, const std::string& place, std::size_t limit,
                         const char* what) {
    const auto index = readIndex(object, key, place, limit, what);
    if (!index) failMissing(key, place);
    return *index;
}

const Json& requireObject(const Json& object, const char* key, const std::string& place) {
    const Json* value = readObject(object, key, place);
    if (value == nullptr) failMissing(key, place);
    return *value;
}

void eraseExtension(Json& object, const char* name) {
    object["extensions"].erase(name);
    if (object["extensions"].empty()) object.erase("extensions");
}

const Json* findExtension(const Json& object, const char* name) {
    const Json* extensions = findMember(object, "extensions");
    return extensions == nullptr ? nullptr : findMember(*extensions, name);
}

std::string join(const std::string& place, const std::string& key) {
    std::string result = place + '/';
    for (const char c : key) {
        if (c == '~') {
            result += "~0";
        } else if (c == '/') {
            result += "~1";
        } else {
            result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
        }
    }
    return result;
}

std::string join(const std::string& place, std::size_t index) { return place + '/' + std::to_string(index); }

}  // namespace tspace::gltf
