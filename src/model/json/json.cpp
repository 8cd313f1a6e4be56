// SPDX-License-Identifier: MIT
// JSON values: memory, members and comparison.
#include "model/json/json.h"

#include <algorithm>

namespace tspace {

// Not inline: reports construct hundreds of members.
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

void Json::failKind() { throw JsonError("a JSON value is not of the kind that is asked for"); }

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
    if (found == nullptr) throw JsonError("a JSON object has no member '" + std::string(key) + "'");
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

}  // namespace tspace
