// SPDX-License-Identifier: MIT
// The binary container of glTF 2.0: a header and chunks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/io/file_io.h"

namespace tspace::gltf {

/// A chunk that is neither JSON nor BIN. Kept byte for byte.
struct ExtraChunk {
    std::uint32_t type = 0;
    Bytes bytes = {};
};

struct GlbChunks {
    std::span<const std::uint8_t> json;  ///< into the file's bytes
    std::optional<std::span<const std::uint8_t>> bin;
    std::vector<ExtraChunk> extra;
    std::size_t ignored_bytes = 0;  ///< behind the length that the header states
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

}  // namespace tspace::gltf
