// SPDX-License-Identifier: MIT
// The JSON of a glTF file: reading and writing of its text, and checked access that says where a value is wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "model/io/memory_budget.h"
#include "model/json/json.h"

namespace tspace::gltf {

using tspace::Json;

/// How the text was laid out, so that an edited file looks like the one that was read.
struct JsonStyle {
    int indent = -1;  ///< characters per level; -1: all on one line
    char indent_char = ' ';
    bool final_newline = false;
};

struct ParsedJson {
    Json root;
    JsonStyle style;
};

/// Fails with invalidFile: syntax, numbers that no double can hold, repeated members, nesting. What the values take is
/// asked for in `budget`, which may be null.
ParsedJson parseJson(std::span<const std::uint8_t> text, MemoryBudget* budget = nullptr);

/// Bytes that are not UTF-8, as names of OBJ may have, become U+FFFD.
std::string writeJson(const Json& root, const JsonStyle& style);

// Access. `place` is the JSON pointer of `object`. All fail with invalidFile at the member's own pointer when
// the type is wrong.

/// Null when `object` is not an object or has no such member.
const Json* findMember(const Json& object, const char* key);

/// A whole number that is not negative; absent: `fallback`, or a failure when there is none.
std::uint64_t readWhole(const Json& object, const char* key, const std::string& place,
                        std::optional<std::uint64_t> fallback = {});

/// readWhole for counts of things in memory. Fails for numbers beyond size_t (32 bits in WebAssembly): such data cannot
/// exist there.
std::size_t readSize(const Json& object, const char* key, const std::string& place,
                     std::optional<std::size_t> fallback = {});

/// An index into an array of `limit` entries, or nothing when absent. `what` names an entry ("accessor").
std::optional<std::size_t> readIndex(const Json& object, const char* key, const std::string& place, std::size_t limit,
                                     const char* what);

/// readIndex for a value that was looked up already.
std::size_t toIndex(const Json& value, const std::string& place, std::size_t limit, const char* what);

double readNumber(const Json& object, const char* key, const std::string& place, double fallback);
/// An array of as many numbers as `numbers` has; they stay as they are when the member is absent.
void readNumbers(const Json& object, const char* key, const std::string& place, std::span<double> numbers);
std::string readString(const Json& object, const char* key, const std::string& place, const std::string& fallback = {});
bool readBool(const Json& object, const char* key, const std::string& place, bool fallback);

/// An array member; an empty array when absent. Every entry of it is an object where `of_objects`.
const Json& readArray(const Json& object, const char* key, const std::string& place, bool of_objects = true);

/// An object member, or null when absent.
const Json* readObject(const Json& object, const char* key, const std::string& place);

/// object.extensions.<name>, or null.
const Json* findExtension(const Json& object, const char* name);

/// A JSON pointer one step further. Escapes ~ and /.
std::string join(const std::string& place, const std::string& key);
std::string join(const std::string& place, std::size_t index);

}  // namespace tspace::gltf
