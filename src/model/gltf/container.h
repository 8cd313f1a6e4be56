// SPDX-License-Identifier: MIT
// Files of a glTF model: the binary container (GLB), and .gltf with its buffers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/gltf/document.h"
#include "model/io/atomic_output.h"
#include "model/io/file_io.h"
#include "model/io/path.h"

namespace tspace::gltf {

// Binary container of glTF 2.0: a header and chunks.

struct GlbChunks {
    std::span<const std::uint8_t> json;  ///< points into the file's bytes
    std::optional<std::span<const std::uint8_t>> bin;
    std::vector<ExtraChunk> extra;
    std::size_t ignored_bytes = 0;  ///< bytes after the length that the header declares
};

/// Returns whether the bytes start with the magic number of GLB.
bool isGlb(std::span<const std::uint8_t> file);

/// Splits a GLB into its chunks. Fails with invalidFile (with a byte offset) or unsupportedFile (other versions).
GlbChunks readGlb(std::span<const std::uint8_t> file);

/// Bytes before and after BIN: `head` contains the header, the JSON chunk and the header of the BIN chunk; `tail`
/// contains everything after the BIN data. A large BIN is therefore not copied. Fails with cannotWrite if the file
/// would exceed 4 GiB.
struct GlbFrame {
    Bytes head;
    Bytes tail;
};
GlbFrame frameGlb(const std::string& json, std::optional<std::size_t> bin_bytes, std::span<const ExtraChunk> extra);

// Conversion of the container (.glb or .gltf), and writing of documents.

/// Destination of the document.
struct OutputTarget {
    Path path = {};
    Container container = Container::glb;
    bool in_place = false;       ///< the output replaces the input
    bool same_folder = false;    ///< output is in the input's folder: referenced files need not be copied
    bool embeds_images = false;  ///< a .gltf becomes a .glb, which embeds its images
};

/// Determines the target by isGlbOutput(). Fails with unsupportedFile for names that neither are GLB names nor end in
/// .gltf, and with invalidOption for a .gltf that is written to a stream.
OutputTarget outputTarget(const Document& document, const Path& path, bool is_stream);

/// Prepares the document for its output: .gltf to .glb joins all buffers in BIN; .glb to .gltf assigns a file name to
/// BIN. Marks the buffers that the output owns. `will_edit`: new data will be added.
void convertContainer(Document& document, const OutputTarget& target, bool will_edit,
                      std::vector<std::string>& warnings);

/// Embeds images in BIN if a .gltf becomes a .glb. Must be called after convertContainer; embedded images have no URI
/// afterwards.
void embedImagesInGlb(Document& document, const OutputTarget& target, std::vector<std::string>& warnings);

/// Returns whether a buffer or image of the document references this file (a path relative to the model's folder).
bool referencesFile(const Document& document, const std::string& name);

/// Returns a name for a buffer file of the output that no URI of the document uses: "<stem><ending>", with a number
/// before the extension if necessary.
std::string freeFileName(const Document& document, const OutputTarget& target, const std::string& ending);

/// Returns the buffer files that may be written next to a model; none unless its name ends in .gltf.
std::vector<std::string> bufferFilesOf(const std::string& path);

/// Writes the model, the buffers that the output owns, and copies of the other referenced files if the folder changes.
void writeDocument(Document& document, const OutputTarget& target, AtomicOutput& output,
                   std::vector<std::string>& warnings, const Execution& execution);

/// Writes the input's bytes unchanged, with copies of the referenced files like writeDocument.
void writeUnchanged(const Document& document, const OutputTarget& target, AtomicOutput& output,
                    std::vector<std::string>& warnings);

}  // namespace tspace::gltf
