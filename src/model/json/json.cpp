// SPDX-License-Identifier: MIT
// Implements JSON values: memory, members and comparison.
#include "model/json/json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "model/json/json.h"

namespace tspace {

// These constructors are not inline, because reports construct hundreds of members.
Json::Json(const char* text) : Json(std::string(text)) {}
Json::Json(std::string_view text) : Json(std::string(text)) {}
Json::Json(std::string text) : kind_(Kind::text) { value_.text = new std::string(std::move(text)); }

Json::Json(std::initializer_list<Json> values) : Json(array(values)) {
    const auto isMember = [](const Json& value) {
        return value.is_array() && value.size() == 2 && value[0].is_string();
    };
    if (!std::all_of(begin(), end(), isMember)) return;
    Children& children = *value_.children;
    for (Json& member : children.values) {
        children.names.push_back(std::move(*member[0].value_.text));
        member = Json(std::move(member[1]));
    }
    kind_ = Kind::object;
}

Json::Json(const Json& other) : kind_(other.kind_), value_(other.value_) {
    if (is_string()) value_.text = new std::string(*other.value_.text);
    if (is_structured()) value_.children = new Children(*other.value_.children);
}

Json Json::array(std::initializer_list<Json> values) {
    Json result(Kind::array);
    result.value_.children->values = values;
    return result;
}

Json Json::object(std::initializer_list<Member> members) {
    Json result(Kind::object);
    Children& children = *result.value_.children;
    for (const Member& member : members) {
        children.names.emplace_back(member.name);
        children.values.push_back(std::move(member.value));
    }
    return result;
}

Json& Json::operator=(Json other) noexcept {
    std::swap(kind_, other.kind_);
    std::swap(value_, other.value_);
    return *this;
}

Json::~Json() {
    if (is_string()) delete value_.text;
    if (is_structured()) delete value_.children;
}

void Json::failKind() { throw JsonError("a JSON value does not have the requested type"); }

void Json::become(Kind structured) {
    if (is_null()) *this = Json(structured);
    expect(structured);
}

Json::Members<Json> Json::items() {
    expect(Kind::object);
    return {value_.children->names.data(), begin(), size()};
}

Json::Members<const Json> Json::items() const {
    expect(Kind::object);
    return {value_.children->names.data(), begin(), size()};
}

const Json* Json::find(std::string_view key) const {
    if (!is_object()) return nullptr;
    const std::vector<std::string>& names = value_.children->names;
    const auto found = std::find(names.begin(), names.end(), key);
    return found == names.end() ? nullptr : begin() + (found - names.begin());
}

const Json& Json::at(std::string_view key) const {
    const Json* found = find(key);
    if (found == nullptr) throw JsonError("a JSON object lacks the member '" + std::string(key) + "'");
    return *found;
}

Json& Json::operator[](std::string_view key) {
    become(Kind::object);
    if (const Json* found = find(key)) return const_cast<Json&>(*found);
    value_.children->names.emplace_back(key);
    return value_.children->values.emplace_back();
}

void Json::erase(std::string_view key) {
    const Json* found = find(key);
    if (found == nullptr) return;
    Children& children = *value_.children;
    const auto index = found - begin();
    children.names.erase(children.names.begin() + index);
    children.values.erase(children.values.begin() + index);
}

Json& Json::element(std::size_t index) {
    become(Kind::array);
    std::vector<Json>& values = value_.children->values;
    if (index >= values.size()) values.resize(index + 1);
    return values[index];
}

void Json::eraseElement(std::size_t index) {
    expect(Kind::array);
    value_.children->values.erase(value_.children->values.begin() + static_cast<std::ptrdiff_t>(index));
}

void Json::push_back(Json value) {
    become(Kind::array);
    value_.children->values.push_back(std::move(value));
}

bool Json::isEqual(const Json& other) const {
    if (is_number() && other.is_number()) return compare(other) == 0;
    if (kind_ != other.kind_) return false;
    if (is_boolean()) return value_.boolean == other.value_.boolean;
    if (is_string()) return *value_.text == *other.value_.text;
    return !is_structured() || (value_.children->names == other.value_.children->names &&
                                value_.children->values == other.value_.children->values);
}

std::partial_ordering Json::compare(const Json& other) const {
    if (!is_number() || !other.is_number()) return std::partial_ordering::unordered;
    if (is_number_float() || other.is_number_float()) return get<double>() <=> other.get<double>();
    const bool is_negative = kind_ == Kind::integer && value_.integer < 0;
    const bool is_other_negative = other.kind_ == Kind::integer && other.value_.integer < 0;
    if (is_negative != is_other_negative) return is_other_negative <=> is_negative;
    if (is_negative) return value_.integer <=> other.value_.integer;
    return get<std::uint64_t>() <=> other.get<std::uint64_t>();
}

// JSON as text. nlohmann's library parses text, and formats numbers and special characters; no other file includes it.

namespace {
using Library = nlohmann::json;
}

/// Builds values from the parser's events. Members are appended, and duplicates are detected once per object, when it
/// closes: a search per member would be quadratic.
class JsonBuilder {
  public:
    /// The event functions return false after setting `error`.
    JsonBuilder(Json& root, JsonError& error, JsonMemory* memory) : root_(root), error_(error), memory_(memory) {}

    bool null() { return put(nullptr); }
    bool boolean(bool value) { return put(value); }
    bool number_integer(Library::number_integer_t value) { return put(value); }
    bool number_unsigned(Library::number_unsigned_t value) { return put(value); }
    bool number_float(Library::number_float_t value, const std::string&) { return put(value); }
    bool string(std::string& value) {
        take(kBlockBytes + value.size());
        return put(std::move(value));
    }
    bool binary(Library::binary_t&) { return false; }
    bool start_object(std::size_t) { return open(Json::Kind::object); }
    bool start_array(std::size_t) { return open(Json::Kind::array); }
    bool key(std::string& name) {
        std::vector<std::string>& names = stack_.back()->value_.children->names;
        takeGrowth(names);
        names.push_back(std::move(name));
        return true;
    }
    bool end_object() {
        const std::string* repeated = findRepeated(stack_.back()->value_.children->names);
        if (repeated != nullptr) {
            error_ = JsonError("the JSON contains a member twice in one object");
            error_.repeated = *repeated;
            return false;
        }
        stack_.pop_back();
        return true;
    }
    bool end_array() {
        stack_.pop_back();
        return true;
    }
    bool parse_error(std::size_t position, const std::string&, const Library::exception& failure) {
        const bool is_range = failure.id == 406;
        error_ = JsonError(is_range ? "the JSON contains a number that is too large" : "the JSON has a syntax error");
        error_.byte = position;
        return false;
    }

  private:
    /// Cost of a small heap block: a string, or the header of an array or object.
    static constexpr std::size_t kBlockBytes = 64;

    bool put(Json value) {
        slot() = std::move(value);
        return true;
    }
    bool open(Json::Kind structured) {
        if (stack_.size() >= kMaxJsonDepth) {
            error_ = JsonError("the JSON is nested deeper than " + std::to_string(kMaxJsonDepth) + " levels");
            return false;
        }
        take(kBlockBytes);
        Json& place = slot();
        place = Json(structured);
        stack_.push_back(&place);
        return true;
    }
    /// Returns the place for the next value. In an object, its name has already been appended.
    Json& slot() {
        if (stack_.empty()) return root_;
        std::vector<Json>& values = stack_.back()->value_.children->values;
        takeGrowth(values);
        return values.emplace_back();
    }

    void take(std::size_t bytes) {
        if (memory_ != nullptr) memory_->take(bytes);
    }
    /// Charges the growth of a list before an element is added. Long lists count twice, because the allocator may not
    /// reuse their old block; blocks of short lists are reused.
    template <class List>
    void takeGrowth(const List& list) {
        if (list.size() < list.capacity()) return;
        constexpr std::size_t kShortBytes = 1024, kAround = 32;
        const std::size_t more = std::max<std::size_t>(list.size(), 1) * sizeof(typename List::value_type);
        take(more < kShortBytes ? more + kAround : 2 * more);
    }
    const std::string* findRepeated(const std::vector<std::string>& names) {
        seen_.clear();
        for (const std::string& name : names) {
            if (!seen_.insert(name).second) return &name;
        }
        return nullptr;
    }

    Json& root_;
    JsonError& error_;
    JsonMemory* memory_;
    std::vector<Json*> stack_;
    std::unordered_set<std::string_view> seen_;
};

class JsonWriter {
  public:
    JsonWriter(std::string& text, int indent, char indent_char, BadUtf8 bad)
        : text_(text), indent_(indent), indent_char_(indent_char), bad_(bad) {}

    void write(const Json& value) {
        switch (value.kind_) {
            case Json::Kind::null: text_ += "null"; break;
            case Json::Kind::boolean: text_ += value.value_.boolean ? "true" : "false"; break;
            case Json::Kind::integer: text_ += std::to_string(value.value_.integer); break;
            case Json::Kind::natural: text_ += std::to_string(value.value_.natural); break;
            case Json::Kind::real: text_ += Library(value.value_.real).dump(); break;
            case Json::Kind::text: writeString(*value.value_.text); break;
            case Json::Kind::array:
            case Json::Kind::object: writeChildren(value); break;
        }
    }

  private:
    void writeChildren(const Json& parent) {
        const char* brackets = parent.is_object() ? "{}" : "[]";
        text_ += brackets[0];
        ++depth_;
        for (std::size_t i = 0; i < parent.size(); ++i) {
            if (i > 0) text_ += ',';
            breakLine();
            if (parent.is_object()) {
                writeString(parent.value_.children->names[i]);
                text_ += indent_ < 0 ? ":" : ": ";
            }
            write(parent.begin()[i]);
        }
        --depth_;
        if (!parent.empty()) breakLine();
        text_ += brackets[1];
    }
    void breakLine() {
        if (indent_ >= 0) text_.append("\n").append(depth_ * static_cast<std::size_t>(indent_), indent_char_);
    }
    void writeString(const std::string& value) {
        const bool is_plain = std::all_of(value.begin(), value.end(), [](char c) {
            return static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7f && c != '"' &&
                   c != '\\';
        });
        if (is_plain) {
            text_.append("\"").append(value).append("\"");
        } else {
            text_ += Library(value).dump(
                -1, ' ', false,
                bad_ == BadUtf8::replace ? Library::error_handler_t::replace : Library::error_handler_t::strict);
        }
    }

    std::string& text_;
    const int indent_;
    const char indent_char_;
    const BadUtf8 bad_;
    std::size_t depth_ = 0;
};

std::optional<Json> Json::read(std::string_view text, JsonError& error, JsonMemory* memory) {
    Json root;
    JsonBuilder builder(root, error, memory);
    if (!Library::sax_parse(text.data(), text.data() + text.size(), &builder)) return {};
    return root;
}

Json Json::parse(std::string_view text, JsonMemory* memory) {
    JsonError error;
    std::optional<Json> root = read(text, error, memory);
    if (!root) throw error;
    return std::move(*root);
}

std::string Json::dump(int indent, char indent_char, BadUtf8 bad) const {
    std::string text;
    try {
        JsonWriter(text, indent, indent_char, bad).write(*this);
    } catch (const Library::exception& failure) {
        throw JsonError(failure.what());
    }
    return text;
}

}  // namespace tspace
