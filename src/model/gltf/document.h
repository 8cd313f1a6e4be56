// SPDX-License-Identifier: MIT
// A glTF file as it is edited: its JSON, its buffers, and helpers to read the JSON.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/gltf/buffer_bytes.h"
#include "model/gltf/codecs/codecs.h"
#include "model/io/file_io.h"
#include "model/io/memory_budget.h"
#include "model/io/path.h"
#include "model/io/uri.h"
#include "model/json/json.h"
#include "tspace/asset.h"

namespace tspace::gltf {

// The JSON of a glTF file: reading and writing of its text, and checked access that says where a value is wrong.

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

// A glTF file in memory: its JSON, the bytes of its buffers, and how it was stored. Functions throw
// FileError.

/// A chunk that is neither JSON nor BIN. Kept byte for byte.
struct ExtraChunk {
    std::uint32_t type = 0;
    Bytes bytes = {};
};

enum class Container { glb, gltf };

/// Where the bytes of a buffer came from.
enum class BufferSource {
    bin,  ///< the BIN chunk
    dataUri,
    file,
    absent,   ///< none: the fallback buffer of a compression extension, or data that an extension provides
    decoded,  ///< decoded views of a fallback buffer without data; never written
};

struct Buffer {
    BufferSource source = BufferSource::absent;
    BufferBytes bytes = {};  ///< exactly `byteLength` of them, unless absent
    Path path = {};          ///< the file, for BufferSource::file
    /// The output stores these bytes itself (BIN, data URI, a file named after the output), so they may be
    /// edited. Other files belong to the input and are never changed.
    bool own = false;
    bool edited = false;  ///< the bytes differ from those that were read

    /// False where no file holds these bytes.
    [[nodiscard]] bool hasStoredBytes() const {
        return source != BufferSource::absent && source != BufferSource::decoded;
    }
};

struct Document {
    Path path = {};
    NamedFiles files = {};  ///< files that the model names
    Container container = Container::gltf;
    Bytes file_bytes = {};  ///< the model file as it was read; BIN lies in it, and is edited there
    Json json = {};
    JsonStyle style = {};
    std::vector<Buffer> buffers = {};  ///< one per entry of /buffers
    /// Views in a decoded buffer that no extension fills.
    std::set<std::size_t> views_without_data = {};
    /// Elements of accessors, tightly packed, that lie in the data of Draco primitives and in no buffer view.
    std::map<std::size_t, Bytes> elements = {};
    /// Accessors of Draco primitives that this build cannot decode.
    std::set<std::size_t> hidden_accessors = {};
    /// How the values of a Draco attribute were rounded; by view and Draco id.
    std::map<std::pair<std::size_t, std::uint32_t>, DracoRounding> draco_roundings = {};
    std::vector<ExtraChunk> extra_chunks = {};
    std::uint64_t input_bytes = 0;              ///< the model file and its buffer files
    std::vector<std::string> input_files = {};  ///< what was read beside the model file
    bool imported = false;                      ///< made from a file of another format: `file_bytes` is not that file
    bool may_hide_tangents = false;             ///< the original may have tangents that the importer did not read
    std::string source_generator = {};          ///< the program that made the original; may be empty
    std::array<double, 3> coordinate_offset{};  ///< subtracted from its coordinates by the importer
    bool keeps_far_coordinates = false;  ///< floats do not hold them, and FileOptions::keep_coordinates was given
    FileOptions options = {};
    /// Images that are written beside the output, by the path that their URIs stand for.
    std::map<std::string, Bytes> new_files = {};
    std::vector<std::string> warnings = {};                                   ///< from reading
    std::shared_ptr<MemoryBudget> memory = std::make_shared<MemoryBudget>();  ///< what it may still take
};

/// Reads a .glb or .gltf (told apart by content) from its bytes, and its buffers. Checks asset.version, buffers, buffer views
/// and accessors (types, ranges), and that no URI of a buffer leads out of the folder, which is that of `path`. Images are
/// not read; a URI of one that may not be followed gets a warning.
Document parseDocument(Bytes file_bytes, const Path& path, const FileOptions& options);

/// Fails with unsupportedFile when a required extension hides the geometry and this build cannot decode it. Adds one
/// warning for each other required extension that this program does not know; their data survives untouched.
void checkRequiredExtensions(Document& document);

/// "glb", "gltf", or the extension of a file of another format ("fbx"), for reports.
std::string formatOf(const Document& document);

/// The program that made the file, as asset.generator says; may be empty.
std::string generatorOf(const Document& document);

/// Array of the root, whose entries are objects; only the names that loading checks ("meshes", "accessors");
/// empty when absent.
const Json& rootArray(const Document& document, const char* name);

/// The array for editing. Made when absent, which invalidates references to other members of the root.
Json& editableRootArray(Document& document, const char* name);

/// Names the extension in extensionsUsed and extensionsRequired, where it is not named yet.
void requireExtension(Document& document, const char* name);

/// Removes the name from both lists, and lists that become empty.
void dropExtension(Document& document, const char* name);

}  // namespace tspace::gltf
