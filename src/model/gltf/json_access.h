// SPDX-License-Identifier: MIT
// JSON of a glTF file: parsing, writing, and checked access with error locations.
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

/// Formatting of the original text, so that an edited file looks like the original.
struct JsonStyle {
    int indent = -1;  ///< characters per level; -1: everything on one line
    char indent_char = ' ';
    bool final_newline = false;
};

struct ParsedJson {
    Json root;
    JsonStyle style;
};

/// Parses JSON. Fails with invalidFile for syntax errors, numbers beyond the range of double, duplicate members, and
/// excessive nesting. The memory of the values is charged to `budget`, which may be null.
ParsedJson parseJson(std::span<const std::uint8_t> text, MemoryBudget* budget = nullptr);

/// Writes JSON. Bytes that are not UTF-8, as in names from OBJ files, become U+FFFD.
std::string writeJson(const Json& root, const JsonStyle& style);

// Access functions. `place` is the JSON pointer of `object`. All fail with invalidFile at the member's own pointer if
// its type is wrong.

/// Returns the member, or null if `object` is not an object or has no such member.
const Json* findMember(const Json& object, const char* key);

/// Reads a nonnegative integer. If it is absent, returns `fallback`, or fails without one.
std::uint64_t readWhole(const Json& object, const char* key, const std::string& place,
                        std::optional<std::uint64_t> fallback = {});

/// Reads a count of items in memory like readWhole. Also fails for numbers beyond size_t (32 bits in WebAssembly),
/// because such data cannot be in memory.
std::size_t readSize(const Json& object, const char* key, const std::string& place,
                     std::optional<std::size_t> fallback = {});

/// Reads an index into an array of `limit` entries; nullopt if absent. `what` is the name of an entry ("accessor").
std::optional<std::size_t> readIndex(const Json& object, const char* key, const std::string& place, std::size_t limit,
                                     const char* what);

/// Converts a value that was already looked up to an index, with the checks of readIndex.
std::size_t toIndex(const Json& value, const std::string& place, std::size_t limit, const char* what);

double readNumber(const Json& object, const char* key, const std::string& place, double fallback);
/// Reads an array of exactly numbers.size() numbers; they are unchanged if the member is absent.
void readNumbers(const Json& object, const char* key, const std::string& place, std::span<double> numbers);
std::string readString(const Json& object, const char* key, const std::string& place, const std::string& fallback = {});
bool readBool(const Json& object, const char* key, const std::string& place, bool fallback);

/// Returns an array member, or an empty array if absent. With `of_objects`, every entry must be an object.
const Json& readArray(const Json& object, const char* key, const std::string& place, bool of_objects = true);

/// Returns an object member, or null if absent.
const Json* readObject(const Json& object, const char* key, const std::string& place);

/// Return a member that must exist, and fail if it does not.
std::size_t requireIndex(const Json& object, const char* key, const std::string& place, std::size_t limit,
                         const char* what);
const Json& requireObject(const Json& object, const char* key, const std::string& place);
/// Removes an extension, and the member "extensions" if it becomes empty.
void eraseExtension(Json& object, const char* name);
/// Returns object.extensions.<name>, or null.
const Json* findExtension(const Json& object, const char* name);

/// Appends a key or index to a JSON pointer, escaping ~ and /.
std::string join(const std::string& place, const std::string& key);
std::string join(const std::string& place, std::size_t index);

}  // namespace tspace::gltf
