// SPDX-License-Identifier: MIT
// glTF file in memory: its JSON, the bytes of its buffers, and how it was stored. Functions throw FileError.
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

/// Chunk that is neither JSON nor BIN; preserved unchanged.
struct ExtraChunk {
    std::uint32_t type = 0;
    Bytes bytes = {};
};

enum class Container { glb, gltf };

/// Source of the bytes of a buffer.
enum class BufferSource {
    bin,  ///< the BIN chunk of the GLB
    dataUri,
    file,
    absent,   ///< no bytes: fallback buffer of a compression extension, or data that an extension provides
    decoded,  ///< decoded views of a fallback buffer without data; never written
};

struct Buffer {
    BufferSource source = BufferSource::absent;
    BufferBytes bytes = {};  ///< exactly `byteLength` bytes, unless absent
    Path path = {};          ///< path of the file, for BufferSource::file
    /// The output stores these bytes itself (BIN, data URI, or a file named after the output), so they may be edited.
    /// Other files belong to the input and are never changed.
    bool own = false;
    bool edited = false;  ///< the bytes differ from those read

    /// Returns whether a file contains these bytes.
    [[nodiscard]] bool hasStoredBytes() const {
        return source != BufferSource::absent && source != BufferSource::decoded;
    }
};

/// Warning about normals whose length is not 1 (see NormalScales and InvalidNormals).
struct NormalsWarning {
    std::size_t number = 0;  ///< index in Document::warnings
    std::string facts = {};  ///< first sentence, without the period: how many normals, where, and their lengths
};

struct Document {
    Path path = {};
    NamedFiles files = {};  ///< files that the model references
    Container container = Container::gltf;
    Bytes file_bytes = {};  ///< the model file as read; BIN is part of it, and is edited in place
    Json json = {};
    JsonStyle style = {};
    std::vector<Buffer> buffers = {};  ///< one per entry of /buffers
    /// Views in a decoded buffer that no extension provides data for.
    std::set<std::size_t> views_without_data = {};
    /// Elements of accessors, tightly packed, that are stored in the data of Draco primitives and in no buffer view.
    std::map<std::size_t, Bytes> elements = {};
    /// Accessors of Draco primitives that this build cannot decode.
    std::set<std::size_t> hidden_accessors = {};
    /// Quantization of Draco attributes, keyed by view and Draco ID.
    std::map<std::pair<std::size_t, std::uint32_t>, DracoRounding> draco_roundings = {};
    std::vector<ExtraChunk> extra_chunks = {};
    std::uint64_t input_bytes = 0;              ///< size of the model file and its buffer files
    std::vector<std::string> input_files = {};  ///< files that were read in addition to the model file
    /// The document was converted from another format; `file_bytes` is not the original file.
    bool imported = false;
    bool may_hide_tangents = false;             ///< the original may have tangents that the importer did not read
    std::string source_generator = {};          ///< program that wrote the original; may be empty
    std::array<double, 3> coordinate_offset{};  ///< offset that the importer subtracted from the coordinates
    /// The coordinates exceed float precision, and FileOptions::keep_coordinates was set.
    bool keeps_far_coordinates = false;
    FileOptions options = {};
    /// Images that are written next to the output, keyed by the path of their URI.
    std::map<std::string, Bytes> new_files = {};
    std::vector<std::string> warnings = {};  ///< warnings from reading the file
    /// Describe one of the warnings each.
    std::optional<NormalsWarning> scaled_normals = {}, invalid_normals = {};
    std::shared_ptr<MemoryBudget> memory = std::make_shared<MemoryBudget>();  ///< remaining memory budget
};

/// Returns "glb", "gltf", or the file extension of another format ("fbx"), for reports.
std::string formatOf(const Document& document);

/// Returns the program that wrote the file according to asset.generator; may be empty.
std::string generatorOf(const Document& document);

/// Returns an array of the root whose entries are objects; only for names that loading checks ("meshes", "accessors").
/// Empty if absent.
const Json& rootArray(const Document& document, const char* name);

/// Returns the array for editing. Creates it if absent, which invalidates references to other members of the root.
Json& editableRootArray(Document& document, const char* name);

/// Adds the extension to extensionsUsed and extensionsRequired unless they contain it.
void requireExtension(Document& document, const char* name);

/// Removes the extension from both lists, and removes lists that become empty.
void dropExtension(Document& document, const char* name);

}  // namespace tspace::gltf
