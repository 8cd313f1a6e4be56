// SPDX-License-Identifier: MIT
// The codec of EXT_meshopt_compression and KHR_meshopt_compression, by the library meshoptimizer. Knows no JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "model/io/file_io.h"

namespace tspace::gltf {

/// What the elements are: rows of vertex data, three indices per triangle, or any row of indices.
enum class MeshoptMode { attributes, triangles, indices };

/// A transform after decoding: expands vectors that are stored with fewer bits.
enum class MeshoptFilter { none, octahedral, quaternion, exponential, color };

struct MeshoptCoding {
    MeshoptMode mode = MeshoptMode::attributes;
    MeshoptFilter filter = MeshoptFilter::none;
    bool is_khr = false;  ///< KHR_meshopt_compression: a newer vertex codec and one more filter
    std::size_t count = 0, stride = 0;

    [[nodiscard]] std::uint64_t byteCount() const { return std::uint64_t{count} * stride; }
};

/// Why this build cannot decode it; empty when it can. One sentence.
std::string meshoptMissing(bool is_khr);

/// The most bytes that one byte of compressed data can stand for.
std::uint64_t meshoptRatio(bool is_khr);

/// The fault of a coding whose data has `byte_count` bytes, as a sentence; empty when it is valid. For a valid coding
/// byteCount() cannot overflow and is at most meshoptRatio times `byte_count`.
std::string meshoptFault(const MeshoptCoding& coding, std::size_t byte_count);

/// Decodes to coding.byteCount() bytes, and applies the filter. False when the data is broken.
bool decodeMeshopt(const MeshoptCoding& coding, std::span<const std::uint8_t> data, std::span<std::uint8_t> to);

/// Encodes rows as they are before the filter. Decoding gives the same bytes: where the triangle codec would rotate
/// corners, `coding.mode` becomes `indices`. False when the library cannot encode them.
bool encodeMeshopt(MeshoptCoding& coding, std::span<const std::uint8_t> rows, Bytes& data);

}  // namespace tspace::gltf
