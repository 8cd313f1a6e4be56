// SPDX-License-Identifier: MIT
// A glTF file in memory: its JSON, the bytes of its buffers, and how it was stored. Functions throw FileError.
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
#include "model/gltf/json_access.h"
#include "model/io/file_io.h"
#include "model/io/memory_budget.h"
#include "model/io/named_files.h"
#include "model/io/path.h"
#include "model/io/uri.h"
#include "model/json/json.h"
#include "tspace/file_options.h"

namespace tspace::gltf {

/// A chunk that is neither JSON nor BIN. Kept byte for byte.
struct ExtraChunk {
    std::uint32_t type = 0;
    Bytes bytes = {};
};

enum class Container { glb, gltf };

/// Source of the bytes of a buffer.
enum class BufferSource {
    bin,  ///< the BIN chunk
    dataUri,
    file,
    absent,   ///< no bytes: the fallback buffer of a compression extension, or data that an extension provides
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
    std::vector<std::string> input_files = {};  ///< files that were read beside the model file
    bool imported = false;                      ///< made from a file of another format: `file_bytes` is not that file
    bool may_hide_tangents = false;             ///< the original may have tangents that the importer did not read
    std::string source_generator = {};          ///< the program that made the original; may be empty
    std::array<double, 3> coordinate_offset{};  ///< subtracted from its coordinates by the importer
    bool keeps_far_coordinates = false;  ///< floats do not hold them, and FileOptions::keep_coordinates was given
    FileOptions options = {};
    /// Images that are written beside the output, by the path that their URIs stand for.
    std::map<std::string, Bytes> new_files = {};
    std::vector<std::string> warnings = {};                                   ///< from reading
    std::shared_ptr<MemoryBudget> memory = std::make_shared<MemoryBudget>();  ///< remaining memory budget
};

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
