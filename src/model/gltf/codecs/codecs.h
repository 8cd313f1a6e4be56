// SPDX-License-Identifier: MIT
// Interface of the geometry codecs Draco and meshopt (KHR_draco_mesh_compression, EXT_meshopt_compression). Independent
// of JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/io/file_io.h"

namespace tspace::gltf {

// Component types of accessors.

enum class ComponentType : std::uint32_t { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

/// Returns the size of a component: 1, 2 or 4 bytes.
std::size_t bytesOf(ComponentType type);
inline bool isUnsigned(ComponentType type) {
    return type == ComponentType::u8 || type == ComponentType::u16 || type == ComponentType::u32;
}

// Codec of KHR_draco_mesh_compression, using the library Draco. Independent of JSON.

/// Quantization grid of the values of an attribute.
struct DracoRounding {
    int bits = 0;  ///< bits per component; 0: values are stored exactly
    bool is_octahedral = false;
    std::vector<float> origin = {};  ///< minimum of each component, then the common extent; empty: to be computed
    float range = 0;
};

/// Attribute kind for Draco; determines how its values are predicted.
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

/// Upper limits of a mesh, checked before memory is allocated. The limits have 64 bits, because a file may declare more
/// than a 32-bit size_t can hold.
struct DracoLimits {
    std::uint64_t corner_count = 0, point_count = 0, bytes = 0;
};

/// Returns why this build cannot decode or encode Draco data, in one sentence, or an empty string if it can.
std::string dracoMissing();

/// Decodes the triangles and the attributes of `mesh`. The caller sets id, component and component_count of each
/// requested attribute; the function sets the rest. Returns a description of the fault in the data, or an empty string.
std::string decodeDraco(std::span<const std::uint8_t> data, const DracoLimits& limits, DracoMesh& mesh);

/// Encodes points and triangles in their order, and sets the attribute IDs. `exact`: an attribute whose values would
/// change is stored without quantization. Returns false if the library cannot encode the mesh.
bool encodeDraco(DracoMesh& mesh, bool exact, Bytes& data);

// Codec functions that call the library, like dracoMissing and decodeDraco. WebAssembly modules replace these functions
// (bindings/js/wasm).

/// Returns the fault of a Draco header as a sentence, or an empty string if it is valid.
std::string dracoHeaderFault(std::span<const std::uint8_t> data);
/// Returns whether data with a valid header uses the Edgebreaker method; otherwise it is sequential.
bool isEdgebreaker(std::span<const std::uint8_t> data);

/// Encodes points and triangles in their order, quantizes attributes as requested, and sets their IDs. Returns false if
/// the library cannot encode the mesh.
bool encodeDracoUnchecked(DracoMesh& mesh, Bytes& data);

// Codec of EXT_meshopt_compression and KHR_meshopt_compression, using the library meshoptimizer. Independent of JSON.

/// Kind of the elements: rows of vertex data, three indices per triangle, or a sequence of indices.
enum class MeshoptMode { attributes, triangles, indices };

/// Filter applied after decoding: expands vectors that are stored with fewer bits.
enum class MeshoptFilter { none, octahedral, quaternion, exponential, color };

struct MeshoptCoding {
    MeshoptMode mode = MeshoptMode::attributes;
    MeshoptFilter filter = MeshoptFilter::none;
    bool is_khr = false;  ///< KHR_meshopt_compression: newer vertex codec and one additional filter
    std::size_t count = 0, stride = 0;

    [[nodiscard]] std::uint64_t byteCount() const { return std::uint64_t{count} * stride; }
};

/// Returns why this build cannot decode the extension, in one sentence, or an empty string if it can.
std::string meshoptMissing(bool is_khr);

/// Returns the maximum compression ratio: decoded bytes per byte of compressed data.
std::uint64_t meshoptRatio(bool is_khr);

/// Returns the fault of a coding with `byte_count` bytes of data as a sentence, or an empty string if it is valid. For
/// a valid coding byteCount() cannot overflow and is at most meshoptRatio times `byte_count`.
std::string meshoptFault(const MeshoptCoding& coding, std::size_t byte_count);

/// Decodes to coding.byteCount() bytes, and applies the filter. Returns false if the data is malformed.
bool decodeMeshopt(const MeshoptCoding& coding, std::span<const std::uint8_t> data, std::span<std::uint8_t> to);

/// Encodes rows in the form before the filter. Decoding restores the same bytes: if the triangle codec would rotate
/// corners, `coding.mode` becomes `indices`. Returns false if the library cannot encode the rows.
bool encodeMeshopt(MeshoptCoding& coding, std::span<const std::uint8_t> rows, Bytes& data);

// Codec functions that call the library, like meshoptMissing and decodeMeshopt. WebAssembly modules replace these
// functions (bindings/js/wasm).

/// Encodes rows in the mode of `coding`. Returns an empty array if the library cannot encode them.
Bytes encodeUnchecked(const MeshoptCoding& coding, std::span<const std::uint8_t> rows);

}  // namespace tspace::gltf
