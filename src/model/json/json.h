// SPDX-License-Identifier: MIT
// JSON as a tree of values. Objects keep the order of their members; numbers keep their type (signed, unsigned, real)
// and therefore their formatting. The rest of the program uses only this interface: the library that parses and formats
// text is used by json.cpp only, because its header takes seconds to compile.
// Member functions are named like those of the standard containers.
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

/// Thrown if text is not JSON, or a value does not have the requested type.
class JsonError : public std::exception {
  public:
    JsonError() = default;
    explicit JsonError(std::string text) : message(std::move(text)) {}
    [[nodiscard]] const char* what() const noexcept override { return message.c_str(); }

    std::string message = {};
    std::optional<std::size_t> byte = {};      ///< offset of a syntax error
    std::optional<std::string> repeated = {};  ///< name of a duplicate member
};

/// Called before memory is allocated for values; may throw.
class JsonMemory {
  public:
    virtual void take(std::size_t bytes) = 0;

  protected:
    ~JsonMemory() = default;
};

/// Handling of invalid UTF-8 when text is written.
enum class BadUtf8 {
    refuse,   ///< throws JsonError
    replace,  ///< writes U+FFFD instead
};

/// Maximum nesting depth of objects and arrays. Deeper text is rejected, so no later step can exhaust the stack.
inline constexpr std::size_t kMaxJsonDepth = 256;

/// JSON value. Must not be changed while another thread reads it. Member lookup is linear, since objects are small.
class Json {
  public:
    struct Member;
    template <class Child>
    class Members;
    /// True for containers and C arrays, except text and paths.
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
    /// Creates an array with the elements of a container.
    template <class T>
    requires isList<T> Json(const T& values) : Json(array()) {
        for (const auto& value : values) push_back(value);
    }
    /// Creates an object if each entry is an array of a string and one more value, otherwise an array.
    Json(std::initializer_list<Json> values);
    Json(const Json& other);
    Json(Json&& other) noexcept : kind_(std::exchange(other.kind_, Kind::null)), value_(other.value_) {}
    Json& operator=(Json other) noexcept;
    ~Json();

    static Json array() { return Json(Kind::array); }
    static Json array(std::initializer_list<Json> values);
    static Json object() { return Json(Kind::object); }
    /// Creates an object from braces without copying values.
    static Json object(std::initializer_list<Member> members);

    /// Parses text. Throws JsonError for syntax errors, numbers beyond the range of double, duplicate members, and
    /// excessive nesting. `memory` may be null.
    static Json parse(std::string_view text, JsonMemory* memory = nullptr);
    /// Parses text without exceptions: returns nullopt on failure, and sets `error` to the reason.
    static std::optional<Json> read(std::string_view text, JsonError& error, JsonMemory* memory = nullptr);
    /// Formats the value. `indent`: characters per level; -1: everything on one line.
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

    /// Converts the value. T: bool, a number type or std::string. Throws JsonError if the value has a different type.
    /// An integer beyond T's range becomes T's largest or smallest value, which is not a valid index of anything.
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
    /// Returns the string. Throws JsonError if the value is not a string.
    [[nodiscard]] const std::string& text() const {
        expect(Kind::text);
        return *value_.text;
    }

    // Access to the children of arrays and objects. Other values have no children.

    [[nodiscard]] std::size_t size() const { return is_structured() ? value_.children->values.size() : 0; }
    [[nodiscard]] bool empty() const { return size() == 0; }
    [[nodiscard]] Json* begin() { return is_structured() ? value_.children->values.data() : nullptr; }
    [[nodiscard]] Json* end() { return begin() + size(); }
    [[nodiscard]] const Json* begin() const { return is_structured() ? value_.children->values.data() : nullptr; }
    [[nodiscard]] const Json* end() const { return begin() + size(); }
    /// Return the first and the last child, which must exist.
    [[nodiscard]] const Json& front() const { return *begin(); }
    [[nodiscard]] Json& back() { return *(end() - 1); }
    /// Returns a range over name and value of each member of an object: for (const auto& [name, value] : json.items()).
    [[nodiscard]] Members<Json> items();
    [[nodiscard]] Members<const Json> items() const;

    /// Returns null if the value is not an object, or has no such member.
    [[nodiscard]] const Json* find(std::string_view key) const;
    [[nodiscard]] bool contains(std::string_view key) const { return find(key) != nullptr; }
    /// Returns a member. Throws JsonError if it does not exist.
    [[nodiscard]] const Json& at(std::string_view key) const;
    [[nodiscard]] const Json& operator[](std::string_view key) const { return at(key); }
    [[nodiscard]] const Json& operator[](const char* key) const { return at(key); }
    /// Returns a member, which is created as null if it does not exist; this invalidates references to other members.
    /// Null becomes an object.
    Json& operator[](std::string_view key);
    Json& operator[](const char* key) { return (*this)[std::string_view(key)]; }
    /// Removes a member if it exists.
    void erase(std::string_view key);
    void erase(const char* key) { erase(std::string_view(key)); }

    /// Returns an element of an array; the index must be in range.
    template <class Index>
    requires std::is_integral_v<Index>
    [[nodiscard]] const Json& operator[](Index index) const {
        expect(Kind::array);
        return value_.children->values[static_cast<std::size_t>(index)];
    }
    /// Returns an element for editing. Null becomes an array; a shorter array is padded with null.
    template <class Index>
    requires std::is_integral_v<Index>
    [[nodiscard]] Json& operator[](Index index) { return element(static_cast<std::size_t>(index)); }
    template <class Index>
    requires std::is_integral_v<Index>
    void erase(Index index) { eraseElement(static_cast<std::size_t>(index)); }
    /// Appends an element. Null becomes an array.
    void push_back(Json value);

    /// Compares numbers by value. Objects are equal only if their members have the same order.
    friend bool operator==(const Json& a, const Json& b) { return a.isEqual(b); }
    /// Orders numbers; values of other types are unordered.
    friend std::partial_ordering operator<=>(const Json& a, const Json& b) { return a.compare(b); }

  private:
    friend class JsonBuilder;  // defined in json.cpp
    friend class JsonWriter;

    enum class Kind : std::uint8_t { null, boolean, integer, natural, real, text, array, object };
    struct Children {
        std::vector<Json> values = {};
        std::vector<std::string> names = {};  ///< names of an object's members, parallel to the values
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

/// Member of an object under construction.
struct Json::Member {
    const char* name;
    mutable Json value;  ///< moved from by the constructor
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
