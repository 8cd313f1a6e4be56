// SPDX-License-Identifier: MIT
// The files of a glTF model: the binary container (GLB), and .gltf with its buffers.
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

// The binary container of glTF 2.0: a header and chunks.

struct GlbChunks {
    std::span<const std::uint8_t> json;  ///< into the file's bytes
    std::optional<std::span<const std::uint8_t>> bin;
    std::vector<ExtraChunk> extra;
    std::size_t ignored_bytes = 0;  ///< bytes beyond the length that the header states
};

/// True when the bytes start with the magic word of GLB.
bool isGlb(std::span<const std::uint8_t> file);

/// Fails with invalidFile (place: byte offset) or unsupportedFile (other versions).
GlbChunks readGlb(std::span<const std::uint8_t> file);

/// Header, JSON chunk and the head of the BIN chunk in `head`; what follows the BIN bytes in `tail`. So a
/// large BIN need not be copied. Fails with cannotWrite when the file would pass 4 GiB.
struct GlbFrame {
    Bytes head;
    Bytes tail;
};
GlbFrame frameGlb(const std::string& json, std::optional<std::size_t> bin_bytes, std::span<const ExtraChunk> extra);

// Changing how a document is stored (.glb or .gltf), and writing it out.

/// Destination of the document.
struct OutputTarget {
    Path path = {};
    Container container = Container::glb;
    bool in_place = false;         ///< the output is the input
    bool same_folder = false;      ///< output is in the input's folder: referenced files need not be copied
    bool takes_images_in = false;  ///< .gltf to .glb
};

/// Decides by isGlbOutput(). Fails with unsupportedFile for names that are neither a GLB's nor end in .gltf, and with
/// invalidOption for a .gltf that goes to a stream.
OutputTarget outputTarget(const Document& document, const Path& path, bool is_stream);

/// Prepares the document for its output: .gltf to .glb joins all buffers in BIN; .glb to .gltf gives BIN a file name.
/// Marks the buffers that the output owns. `will_edit`: new data is to be expected.
void convertContainer(Document& document, const OutputTarget& target, bool will_edit,
                      std::vector<std::string>& warnings);

/// Embeds images in BIN where a .gltf becomes a .glb. Call after convertContainer; images have no URIs afterwards.
void takeImagesIn(Document& document, const OutputTarget& target, std::vector<std::string>& warnings);

/// Whether a buffer or an image of the document names this file, a path from the model's folder.
bool namesFile(const Document& document, const std::string& name);

/// Name for a buffer file of the output that no URI of the document has: "<stem><ending>".
std::string freeFileName(const Document& document, const OutputTarget& target, const std::string& ending);

/// Buffer files that a model may get beside it; none unless its name ends in .gltf.
std::vector<std::string> bufferFilesOf(const std::string& path);

/// Writes model, own buffers, and copies of the other files it names when the folder is another one.
void writeDocument(Document& document, const OutputTarget& target, AtomicOutput& output,
                   std::vector<std::string>& warnings, const Execution& execution);

/// Writes the input's own bytes, with copies of the files it names as above.
void writeUnchanged(const Document& document, const OutputTarget& target, AtomicOutput& output,
                    std::vector<std::string>& warnings);

}  // namespace tspace::gltf
