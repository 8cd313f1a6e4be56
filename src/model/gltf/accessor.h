// SPDX-License-Identifier: MIT
// Accessors: typed views of the bytes of a buffer. Everything is checked before anything is allocated or
// read.
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

/// A range of a buffer, already checked against the buffer's declared length.
struct BufferView {
    std::size_t buffer = 0;
    std::size_t begin = 0;
    std::size_t byte_count = 0;
    std::size_t stride = 0;  ///< 0: tightly packed
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
    std::size_t component_count = 1;  ///< 1 for SCALAR, 9 for MAT3; 0: a type that this program does not know
    std::size_t element_bytes = 4;    ///< with the padding of small matrix columns; 0 for an unknown type
    std::size_t data_bytes = 4;       ///< without the padding behind the last column, which need not be there
    bool normalized = false;
    std::size_t count = 0;
    std::optional<std::size_t> view = {};  ///< absent: all zero (before `sparse`)
    std::size_t byte_offset = 0;           ///< in the view
    std::size_t stride = 0;                ///< from element to element; never 0 where the type is known
    std::optional<SparsePart> sparse = {};

    [[nodiscard]] std::string place() const { return "/accessors/" + std::to_string(index); }
    [[nodiscard]] bool isFloatVec(std::size_t components) const {
        return component == ComponentType::f32 && component_count == components && !normalized && type[0] == 'V';
    }
};

/// Reads and checks entry `index` of /accessors. Fails with invalidFile; unsupportedFile beyond kMaxCorners
/// elements.
Accessor readAccessor(const Document& document, std::size_t index);

/// Quantization step of an integer accessor; 0 for floats.
double stepOf(const Accessor& accessor);

/// True when copyElements finds the data that it needs.
bool hasData(const Document& document, const Accessor& accessor);

/// Elements where they lie: data_bytes each, `stride` apart, at any address.
struct ElementView {
    const std::uint8_t* data = nullptr;
    std::size_t stride = 0;
};

/// Returns nothing if elements have to be assembled: zero or sparse elements, or an incomplete last one. Fails like
/// copyElements.
std::optional<ElementView> viewElements(const Document& document, const Accessor& accessor);

/// All elements, tightly packed (element_bytes each), sparse values put in. Fails where a buffer has no data,
/// and for an unknown type.
Bytes copyElements(const Document& document, const Accessor& accessor);

/// Elements as floats: normalised integers by the rule of the specification, others by value.
/// Fails with invalidFile at `place` when the accessor has another number of components.
std::vector<Vec2> decodeVec2(const Document& document, const Accessor& accessor, const std::string& place);
std::vector<Vec3> decodeVec3(const Document& document, const Accessor& accessor, const std::string& place);
std::vector<Vec4> decodeVec4(const Document& document, const Accessor& accessor, const std::string& place);

/// u8, u16 or u32 scalars. Each must be smaller than `vertex_count`, which also excludes primitive restart
/// values.
std::vector<std::uint32_t> decodeIndices(const Document& document, const Accessor& accessor, std::size_t vertex_count,
                                         const std::string& place);

/// body(size), where size is a constant for the usual ones: copies of single elements are then moves, not calls.
template <class Body>
void withElementSize(std::size_t bytes, Body&& body) {
    switch (bytes) {
        case 2:
            return body(std::integral_constant<std::size_t, 2>{});
        case 4:
            return body(std::integral_constant<std::size_t, 4>{});
        case 8:
            return body(std::integral_constant<std::size_t, 8>{});
        case 12:
            return body(std::integral_constant<std::size_t, 12>{});
        case 16:
            return body(std::integral_constant<std::size_t, 16>{});
        default:
            return body(bytes);
    }
}

/// "float3", "snorm16x3", "uint8": for people.
std::string formatName(const Accessor& accessor);

}  // namespace tspace::gltf
