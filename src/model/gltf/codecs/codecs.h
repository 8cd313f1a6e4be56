// SPDX-License-Identifier: MIT
// Geometry packed by Draco and meshopt (KHR_draco_mesh_compression, EXT_meshopt_compression): what the codecs
// ask and give. Knows no JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/io/file_io.h"

namespace tspace::gltf {

// The number formats of accessors.

enum class ComponentType : std::uint32_t { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

/// 1, 2 or 4.
std::size_t bytesOf(ComponentType type);

// The codec of KHR_draco_mesh_compression, by the library Draco. Knows no JSON.

/// The lattice that the values of an attribute lie on.
struct DracoRounding {
    int bits = 0;  ///< per component; 0: values are stored exactly
    bool is_octahedral = false;
    std::vector<float> origin =
        {};  ///< smallest value of each component, then the extent of all; empty: to be measured
    float range = 0;
};

/// Attribute kind for Draco; decides how its values are predicted.
enum class DracoKind { position, normal, color, uv, other };

struct DracoAttribute {
    std::uint32_t id = 0;
    DracoKind kind = DracoKind::other;
    ComponentType component = ComponentType::f32;
    bool normalized = false;
    std::size_t component_count = 3;
    Bytes values = {};  ///< one element per point, tightly packed
    DracoRounding rounding = {};
};

struct DracoMesh {
    std::vector<std::uint32_t> corners = {};  ///< three points per triangle
    std::size_t point_count = 0;
    std::vector<DracoAttribute> attributes = {};
};

/// Upper bounds of a mesh, checked before memory is allocated. 64 bits wide, because a file may claim more than a
/// size_t of 32 bits holds.
struct DracoLimits {
    std::uint64_t corner_count = 0, point_count = 0, bytes = 0;
};

/// Why this build cannot decode or encode; empty when it can. One sentence.
std::string dracoMissing();

/// Decodes the triangles, and the attributes of `mesh`, of which id, component and component_count say what is wanted;
/// fills the rest. Returns what is wrong with the data, or nothing.
std::string decodeDraco(std::span<const std::uint8_t> data, const DracoLimits& limits, DracoMesh& mesh);

/// Encodes points and triangles in their order, and fills the ids. `exact`: an attribute whose rounding would change a
/// value is stored without. False when the library cannot do it.
bool encodeDraco(DracoMesh& mesh, bool exact, Bytes& data);

// The functions of the codec that call the library, beside dracoMissing and decodeDraco. WebAssembly modules
// have others in their place (bindings/js/wasm).

/// The fault of a Draco header as a sentence; empty when it is valid.
std::string dracoHeaderFault(std::span<const std::uint8_t> data);
/// Whether data with a valid header uses the Edgebreaker method; else it is sequential.
bool isEdgebreaker(std::span<const std::uint8_t> data);

/// Encodes points and triangles in their order, attributes by their rounding, and fills the ids. False when the library
/// cannot do it.
bool encodeDracoAsItIs(DracoMesh& mesh, Bytes& data);

// The codec of EXT_meshopt_compression and KHR_meshopt_compression, by the library meshoptimizer. Knows no JSON.

/// Kind of the elements: rows of vertex data, three indices per triangle, or a sequence of indices.
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

// The functions of the codec that call the library, beside meshoptMissing and decodeMeshopt. WebAssembly modules have
// others in their place (bindings/js/wasm).

/// Encodes rows in the mode that `coding` says. Empty when the library cannot do it.
Bytes encodeAsItIs(const MeshoptCoding& coding, std::span<const std::uint8_t> rows);

}  // namespace tspace::gltf
