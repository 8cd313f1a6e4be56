// SPDX-License-Identifier: MIT
// Parsing of hostile JSON into a DOM, and checked access to it.
#include "asset/gltf/json.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "asset/file_error.h"

namespace tspace::gltf {

namespace {

[[noreturn]] void failJson(std::string message, std::string place) {
    failFile(ErrorCode::invalidFile, std::move(message), std::move(place));
}

/// Builds the DOM from parser events. The library's own builder searches an ordered object for every new
/// member, which is quadratic; here members are appended, and repeated ones are found once, when the object
/// closes.
class Builder {
  public:
    Builder(Json& root, MemoryBudget* budget) : root_(root), budget_(budget) {}

    bool null() { return put(nullptr); }
    bool boolean(bool value) { return put(value); }
    bool number_integer(Json::number_integer_t value) { return put(value); }
    bool number_unsigned(Json::number_unsigned_t value) { return put(value); }
    bool number_float(Json::number_float_t value, const Json::string_t&) { return put(value); }
    bool string(Json::string_t& value) {
        take(kBlockBytes + value.size());
        return put(std::move(value));
    }
    bool binary(Json::binary_t&) { return false; }
    bool start_object(std::size_t) { return open(Json::object()); }
    bool start_array(std::size_t) { return open(Json::array()); }
    bool key(Json::string_t& name) {
        Members& object = members(*stack_.back());
        takeGrowth(object);
        object.emplace_back(std::move(name), nullptr);
        return true;
    }
    bool end_object() {
        checkRepeated(members(*stack_.back()));
        stack_.pop_back();
        return true;
    }
    bool end_array() {
        stack_.pop_back();
        return true;
    }
    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& failure) {
        const bool range = failure.id == 406;
        failJson(range ? "the JSON has a number that is too large" : "the JSON has a syntax error",
                 "JSON byte " + std::to_string(position));
    }

  private:
    using Members = Json::object_t::Container;
    static Members& members(Json& object) { return object.get_ref<Json::object_t&>(); }

    template <class Value>
    bool put(Value&& value) {
        slot() = std::forward<Value>(value);
        return true;
    }
    bool open(Json&& container) {
        if (stack_.size() >= kMaxJsonDepth) {
            failJson("the JSON is nested deeper than " + std::to_string(kMaxJsonDepth) + " levels", {});
        }
        take(kBlockBytes);
        Json& place = slot();
        place = std::move(container);
        stack_.push_back(&place);
        return true;
    }
    Json& slot() {
        if (stack_.empty()) return root_;
        Json& parent = *stack_.back();
        if (parent.is_object()) return members(parent).back().second;
        auto& elements = parent.get_ref<Json::array_t&>();
        takeGrowth(elements);
        elements.emplace_back(nullptr);
        return elements.back();
    }

    /// A small block of the heap: a string, or the head of an array or object.
    static constexpr std::size_t kBlockBytes = 64;

    void take(std::size_t bytes) {
        if (budget_ != nullptr) budget_->take(bytes, {});
    }
    /// Before an element is added. The old memory of long lists is not always of use to others, and the parser's
    /// library copies them once more when it lets go of them: hence three times. That of short ones serves the next.
    template <class List>
    void takeGrowth(const List& list) {
        if (list.size() < list.capacity()) return;
        constexpr std::size_t kShortBytes = 1024, kAround = 32;
        const std::size_t more = std::max<std::size_t>(list.size(), 1) * sizeof(typename List::value_type);
        take(more < kShortBytes ? more + kAround : 3 * more);
    }
    void checkRepeated(const Members& object) {
        names_.clear();
        for (const auto& [name, value] : object) {
            if (!names_.insert(name).second)
                failJson("the JSON has the member " + inQuotes(name) + " twice in one object", {});
        }
    }

    Json& root_;
    MemoryBudget* budget_;
    std::vector<Json*> stack_;
    std::unordered_set<std::string_view> names_;
};

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

std::optional<std::size_t> wholeNumber(const Json& value) {
    if (value.is_number_integer()) {
        // Parsed numbers are unsigned; those that this program wrote may be signed.
        if (!value.is_number_unsigned() && value.get<std::int64_t>() < 0) return {};
        return value.get<std::uint64_t>();
    }
    if (!value.is_number_float()) return {};
    // 5.0 is a whole number too; beyond 2^53 a double cannot say which one.
    const double number = value.get<double>();
    if (!(number >= 0 && number <= 9007199254740992.0) || number != std::floor(number)) return {};
    return static_cast<std::size_t>(number);
}

}  // namespace

ParsedJson parseJson(std::span<const std::uint8_t> text, MemoryBudget* budget) {
    ParsedJson result;
    const auto* begin = reinterpret_cast<const char*>(text.data());
    Builder builder(result.root, budget);
    Json::sax_parse(begin, begin + text.size(), &builder);
    if (!result.root.is_object()) failJson("the JSON is not an object", {});
    result.style = styleOf({begin, text.size()});
    return result;
}

std::string writeJson(const Json& root, const JsonStyle& style) {
    std::string text = root.dump(style.indent, style.indent_char);
    if (style.final_newline) text += '\n';
    return text;
}

const Json* findMember(const Json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

std::size_t readSize(const Json& object, const char* key, const std::string& place,
                     std::optional<std::size_t> fallback) {
    const Json* value = findMember(object, key);
    if (value == nullptr) {
        if (fallback) return *fallback;
        failJson(std::string("the member '") + key + "' is missing", place);
    }
    const auto number = wholeNumber(*value);
    if (!number) failJson(std::string("'") + key + "' is not a whole number of 0 or more", join(place, key));
    return *number;
}

std::size_t toIndex(const Json& value, const std::string& place, std::size_t limit, const char* what) {
    const auto number = wholeNumber(value);
    if (!number) failJson(std::string("the index of the ") + what + " is not a whole number of 0 or more", place);
    if (*number >= limit) {
        failJson(std::string("there is no ") + what + " " + std::to_string(*number) + "; the file has " +
                     std::to_string(limit),
                 place);
    }
    return *number;
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
        if (!(*value)[i].is_object()) {
            failJson(std::string("an entry of '") + key + "' is not an object", join(join(place, key), i));
        }
    }
    return *value;
}

const Json* readObject(const Json& object, const char* key, const std::string& place) {
    const Json* value = findMember(object, key);
    if (value != nullptr && !value->is_object())
        failJson(std::string("'") + key + "' is not an object", join(place, key));
    return value;
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
