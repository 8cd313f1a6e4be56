// SPDX-License-Identifier: MIT
// Accessors: typed views of the bytes of a buffer. Everything is checked before memory is allocated or read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "model/gltf/codecs/codecs.h"
#include "model/gltf/document.h"
#include "tspace/span.h"

namespace tspace::gltf {

/// Range of a buffer, checked against the buffer's declared length.
struct BufferView {
    std::size_t buffer = 0;
    std::size_t begin = 0;
    std::size_t byte_count = 0;
    std::size_t stride = 0;  ///< distance between elements; 0: tightly packed
};
BufferView readBufferView(const Document& document, std::size_t index);

struct SparsePart {
    std::size_t count = 0;
    ComponentType index_type = ComponentType::u32;
    std::size_t index_view = 0, index_offset = 0;
    std::size_t value_view = 0, value_offset = 0;
};

struct Accessor {
    std::size_t index = 0;
    ComponentType component = ComponentType::f32;
    std::string type = {};            ///< "SCALAR", "VEC3", ...
    std::size_t component_count = 1;  ///< 1 for SCALAR, 9 for MAT3; 0: unknown type
    /// size of an element in bytes, with the padding of small matrix columns; 0 for an unknown type
    std::size_t element_bytes = 4;
    /// size of an element in bytes, without the padding after the last column, which may be missing
    std::size_t data_bytes = 4;
    bool normalized = false;
    std::size_t count = 0;
    std::optional<std::size_t> view = {};  ///< absent: all zero (before `sparse` is applied)
    std::size_t byte_offset = 0;           ///< relative to the view
    std::size_t stride = 0;                ///< distance between elements; never 0 if the type is known
    std::optional<SparsePart> sparse = {};

    [[nodiscard]] std::string place() const { return "/accessors/" + std::to_string(index); }
};

/// Reads and checks entry `index` of /accessors. Fails with invalidFile, or with unsupportedFile above kMaxCorners
/// elements.
Accessor readAccessor(const Document& document, std::size_t index);

/// Returns the quantization step of an integer accessor; 0 for floats.
double stepOf(const Accessor& accessor);

/// Returns whether the data that copyElements needs is available.
bool hasData(const Document& document, const Accessor& accessor);

/// View of elements in the bytes of a buffer: data_bytes each, `stride` apart, at any alignment.
struct ElementView {
    const std::uint8_t* data = nullptr;
    std::size_t stride = 0;
};

/// Returns the elements without copying them, or nullopt if they have to be assembled: zero or sparse elements, or an
/// incomplete last element. Fails like copyElements.
std::optional<ElementView> viewElements(const Document& document, const Accessor& accessor);

/// Returns all elements, tightly packed (element_bytes each), with sparse values applied. Fails if a buffer has no
/// data, and for an unknown type.
Bytes copyElements(const Document& document, const Accessor& accessor);

/// Decode elements as floats: normalized integers with the formulas of the specification, other integers as their
/// value. Fail with invalidFile at `place` if the accessor has a different number of components.
std::vector<Vec2> decodeVec2(const Document& document, const Accessor& accessor, const std::string& place);
std::vector<Vec3> decodeVec3(const Document& document, const Accessor& accessor, const std::string& place);
std::vector<Vec4> decodeVec4(const Document& document, const Accessor& accessor, const std::string& place);

/// Decodes u8, u16 or u32 scalars. Each must be less than `vertex_count`, which also excludes primitive restart values.
std::vector<std::uint32_t> decodeIndices(const Document& document, const Accessor& accessor, std::size_t vertex_count,
                                         const std::string& place);

/// Calls body(size), with a constant for common sizes, so that copies of single elements compile to moves instead of
/// calls.
template <class Body>
void withElementSize(std::size_t bytes, Body&& body) {
    switch (bytes) {
        case 2: return body(std::integral_constant<std::size_t, 2>{});
        case 4: return body(std::integral_constant<std::size_t, 4>{});
        case 8: return body(std::integral_constant<std::size_t, 8>{});
        case 12: return body(std::integral_constant<std::size_t, 12>{});
        case 16: return body(std::integral_constant<std::size_t, 16>{});
        default: return body(bytes);
    }
}

/// Returns a readable name of the format: "float3", "snorm16x3", "uint8".
std::string formatName(const Accessor& accessor);

}  // namespace tspace::gltf
