// SPDX-License-Identifier: MIT
// JSON as a tree of values. Objects keep the order of their members; numbers keep their kind (signed, unsigned, real)
// and with it their spelling. This is all that the rest of the program sees of JSON: the library that reads and spells
// the text is used by json.cpp alone, because its header takes seconds to compile.
// Members are named as those of the standard containers.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace tspace {

/// Thrown where text is not JSON, or a value is not of the kind that is asked for.
class JsonError : public std::exception {
  public:
    JsonError() = default;
    explicit JsonError(std::string text) : message(std::move(text)) {}
    [[nodiscard]] const char* what() const noexcept override { return message.c_str(); }

    std::string message = {};
    std::optional<std::size_t> byte = {};      ///< offset of a syntax error
    std::optional<std::string> repeated = {};  ///< the name of a repeated member
};

/// Called before memory is allocated for values; may throw.
class JsonMemory {
  public:
    virtual void take(std::size_t bytes) = 0;

  protected:
    ~JsonMemory() = default;
};

/// Handling of invalid UTF-8 by the writer.
enum class BadUtf8 {
    refuse,   ///< throws JsonError
    replace,  ///< writes U+FFFD
};

/// Objects and arrays of a text may be nested this deep. Deeper ones are refused, so no later step can run out of
/// stack.
inline constexpr std::size_t kMaxJsonDepth = 256;

/// A value. Not safe to change while another thread reads it. Look-up of a member is linear, as objects are small.
class Json {
  public:
    struct Member;
    template <class Child>
    class Members;
    /// A container or a C array, but neither text nor a path.
    template <class T>
    static constexpr bool isList = requires(const T& values) {
        std::begin(values) != std::end(values);
    }
    &&!std::is_convertible_v<const T&, std::string_view> && !std::is_convertible_v<const T&, std::string> &&
        !std::is_same_v<T, Json>;

    Json() noexcept : kind_(Kind::null) {}
    Json(std::nullptr_t) noexcept : Json() {}
    template <class T>
    requires std::is_integral_v<T> Json(T value)
    noexcept : kind_(kindOfInteger<T>()) {
        if constexpr (std::is_same_v<T, bool>) {
            value_.boolean = value;
        } else if constexpr (std::is_signed_v<T>) {
            value_.integer = value;
        } else {
            value_.natural = value;
        }
    }
    Json(double value) noexcept : kind_(Kind::real) { value_.real = value; }
    Json(float value) noexcept : Json(static_cast<double>(value)) {}
    Json(const char* text);
    Json(std::string_view text);
    Json(std::string text);
    /// An array of what is in a container.
    template <class T>
    requires isList<T> Json(const T& values) : Json(array()) {
        for (const auto& value : values) push_back(value);
    }
    /// An object where each entry is an array of a string and something else, otherwise an array.
    Json(std::initializer_list<Json> values);
    Json(const Json& other);
    Json(Json&& other) noexcept : kind_(std::exchange(other.kind_, Kind::null)), value_(other.value_) {}
    Json& operator=(Json other) noexcept;
    ~Json();

    static Json array() { return Json(Kind::array); }
    static Json array(std::initializer_list<Json> values);
    static Json object() { return Json(Kind::object); }
    /// Builds an object from braces without copies of values.
    static Json object(std::initializer_list<Member> members);

    /// Throws JsonError: syntax, numbers that no double can hold, repeated members, nesting. `memory` may be null.
    static Json parse(std::string_view text, JsonMemory* memory = nullptr);
    /// Does not throw: returns nothing on failure, and `error` says why.
    static std::optional<Json> read(std::string_view text, JsonError& error, JsonMemory* memory = nullptr);
    /// `indent`: characters per level; -1: all on one line.
    [[nodiscard]] std::string dump(int indent = -1, char indent_char = ' ', BadUtf8 bad = BadUtf8::refuse) const;

    [[nodiscard]] bool is_null() const { return kind_ == Kind::null; }
    [[nodiscard]] bool is_boolean() const { return kind_ == Kind::boolean; }
    [[nodiscard]] bool is_number() const { return is_number_integer() || is_number_float(); }
    [[nodiscard]] bool is_number_integer() const { return kind_ == Kind::integer || kind_ == Kind::natural; }
    [[nodiscard]] bool is_number_unsigned() const { return kind_ == Kind::natural; }
    [[nodiscard]] bool is_number_float() const { return kind_ == Kind::real; }
    [[nodiscard]] bool is_string() const { return kind_ == Kind::text; }
    [[nodiscard]] bool is_array() const { return kind_ == Kind::array; }
    [[nodiscard]] bool is_object() const { return kind_ == Kind::object; }
    [[nodiscard]] bool is_structured() const { return kind_ >= Kind::array; }

    /// T: bool, a number (which is converted) or std::string. Throws JsonError where this is something else. A whole
    /// number beyond T's becomes T's largest or smallest, which is no index of anything.
    template <class T>
    [[nodiscard]] T get() const {
        if constexpr (std::is_same_v<T, bool>) {
            expect(Kind::boolean);
            return value_.boolean;
        } else if constexpr (std::is_same_v<T, std::string>) {
            return text();
        } else {
            static_assert(std::is_arithmetic_v<T>);
            if (kind_ == Kind::integer) return within<T>(value_.integer);
            if (kind_ == Kind::natural) return within<T>(value_.natural);
            expect(Kind::real);
            return static_cast<T>(value_.real);
        }
    }
    /// Throws JsonError where this is no string.
    [[nodiscard]] const std::string& text() const {
        expect(Kind::text);
        return *value_.text;
    }

    // Arrays and objects. Everything else has no children.

    [[nodiscard]] std::size_t size() const { return is_structured() ? value_.children->values.size() : 0; }
    [[nodiscard]] bool empty() const { return size() == 0; }
    [[nodiscard]] Json* begin() { return is_structured() ? value_.children->values.data() : nullptr; }
    [[nodiscard]] Json* end() { return begin() + size(); }
    [[nodiscard]] const Json* begin() const { return is_structured() ? value_.children->values.data() : nullptr; }
    [[nodiscard]] const Json* end() const { return begin() + size(); }
    /// The first and the last child; there must be one.
    [[nodiscard]] const Json& front() const { return *begin(); }
    [[nodiscard]] Json& back() { return *(end() - 1); }
    /// Name and value of each member of an object: for (const auto& [name, value] : json.items()).
    [[nodiscard]] Members<Json> items();
    [[nodiscard]] Members<const Json> items() const;

    /// Null where this is no object, or has no such member.
    [[nodiscard]] const Json* find(std::string_view key) const;
    [[nodiscard]] bool contains(std::string_view key) const { return find(key) != nullptr; }
    /// Throws JsonError where it is not there.
    [[nodiscard]] const Json& at(std::string_view key) const;
    [[nodiscard]] const Json& operator[](std::string_view key) const { return at(key); }
    [[nodiscard]] const Json& operator[](const char* key) const { return at(key); }
    /// A member, made (null) where it is not there; it moves the others. Null becomes an object.
    Json& operator[](std::string_view key);
    Json& operator[](const char* key) { return (*this)[std::string_view(key)]; }
    /// Does nothing where it is not there.
    void erase(std::string_view key);
    void erase(const char* key) { erase(std::string_view(key)); }

    /// An element of an array, which must have so many.
    template <class Index>
    requires std::is_integral_v<Index>
    [[nodiscard]] const Json& operator[](Index index) const {
        expect(Kind::array);
        return value_.children->values[static_cast<std::size_t>(index)];
    }
    /// The element for editing. Null becomes an array; a shorter array is padded with null.
    template <class Index>
    requires std::is_integral_v<Index>
    [[nodiscard]] Json& operator[](Index index) { return element(static_cast<std::size_t>(index)); }
    template <class Index>
    requires std::is_integral_v<Index>
    void erase(Index index) { eraseElement(static_cast<std::size_t>(index)); }
    /// Null becomes an array.
    void push_back(Json value);

    /// Numbers are equal by value, objects where the order is the same too.
    friend bool operator==(const Json& a, const Json& b) { return a.isEqual(b); }
    /// Orders numbers; other values are unordered.
    friend std::partial_ordering operator<=>(const Json& a, const Json& b) { return a.compare(b); }

  private:
    friend class JsonBuilder;  // json.cpp
    friend class JsonWriter;

    enum class Kind : std::uint8_t { null, boolean, integer, natural, real, text, array, object };
    struct Children {
        std::vector<Json> values = {};
        std::vector<std::string> names = {};  ///< names of an object's members, one for each value
    };
    union Value {
        bool boolean;
        std::int64_t integer;
        std::uint64_t natural;
        double real;
        std::string* text;
        Children* children;
    };

    explicit Json(Kind structured) : kind_(structured) { value_.children = new Children; }
    template <class T>
    static constexpr Kind kindOfInteger() {
        return std::is_same_v<T, bool> ? Kind::boolean : std::is_signed_v<T> ? Kind::integer : Kind::natural;
    }
    template <class T, class Integer>
    static constexpr T within(Integer value) {
        if constexpr (std::is_integral_v<T>) {
            if (std::cmp_greater(value, std::numeric_limits<T>::max())) return std::numeric_limits<T>::max();
            if (std::cmp_less(value, std::numeric_limits<T>::min())) return std::numeric_limits<T>::min();
        }
        return static_cast<T>(value);
    }
    void expect(Kind kind) const {
        if (kind_ != kind) failKind();
    }
    [[noreturn]] static void failKind();
    void become(Kind structured);
    [[nodiscard]] Json& element(std::size_t index);
    void eraseElement(std::size_t index);
    [[nodiscard]] bool isEqual(const Json& other) const;
    [[nodiscard]] std::partial_ordering compare(const Json& other) const;

    Kind kind_;
    Value value_ = {};
};

/// A member of an object that is being made.
struct Json::Member {
    const char* name;
    mutable Json value;  ///< is moved from
};

/// Members of an object: `key` and `value` of each, in order.
template <class Child>
class Json::Members {
  public:
    struct Member {
        const std::string& key;
        Child& value;
    };
    class Iterator {
      public:
        Iterator(const std::string* key, Child* value) : key_(key), value_(value) {}
        Member operator*() const { return {*key_, *value_}; }
        Iterator& operator++() {
            ++key_;
            ++value_;
            return *this;
        }
        bool operator!=(const Iterator& other) const { return key_ != other.key_; }

      private:
        const std::string* key_;
        Child* value_;
    };

    Members(const std::string* keys, Child* values, std::size_t count) : keys_(keys), values_(values), count_(count) {}
    [[nodiscard]] Iterator begin() const { return {keys_, values_}; }
    [[nodiscard]] Iterator end() const { return {keys_ + count_, values_ + count_}; }

  private:
    const std::string* keys_;
    Child* values_;
    std::size_t count_;
};

}  // namespace tspace
