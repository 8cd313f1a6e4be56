// SPDX-License-Identifier: MIT
// Validation and decoding of accessors (glTF 2.0 specification, section 3.6.2; KHR_mesh_quantization).
#include "model/gltf/accessor.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/base/numbers.h"
#include "model/gltf/compression_extensions.h"
#include "model/io/file_error.h"
#include "tspace/mesh.h"

namespace tspace::gltf {
namespace {

/// Maximum number of elements of accessors without a buffer view. Such elements are all zero and take no space in the
/// file, so the file size does not limit them.
constexpr std::size_t kMaxZeroElements = std::size_t{1} << 24;

[[noreturn]] void failAt(std::string message, std::string place) {
    failFile(ErrorCode::invalidFile, std::move(message), std::move(place));
}

/// Properties of a component type.
struct Component {
    const char *name = "", *normalized_name = "";  ///< as in formatName
    std::size_t byte_count = 0;
    float largest = 0;  ///< value that normalized integers decode to 1
};
constexpr std::uint32_t kFirstType = 5120;
constexpr std::array<Component, 7> kComponents = {{{"int8", "snorm8", 1, 127},
                                                   {"uint8", "unorm8", 1, 255},
                                                   {"int16", "snorm16", 2, 32767},
                                                   {"uint16", "unorm16", 2, 65535},
                                                   {},  // does not exist
                                                   {"uint32", "unorm32", 4, 4294967295.0f},
                                                   {"float", "float", 4, 1}}};

const Component& propertiesOf(ComponentType type) { return kComponents[static_cast<std::uint32_t>(type) - kFirstType]; }

ComponentType readComponentType(const Json& object, const std::string& place) {
    const std::uint64_t value = readWhole(object, "componentType", place);
    const bool is_in_table = value >= kFirstType && value - kFirstType < kComponents.size();
    if (!is_in_table || kComponents[value - kFirstType].byte_count == 0)
        failAt("the component type " + std::to_string(value) + " does not exist", join(place, "componentType"));
    return static_cast<ComponentType>(value);
}

struct Shape {
    const char* name;
    std::size_t columns, rows;
};
constexpr std::array<Shape, 7> kShapes = {
    {{"SCALAR", 1, 1}, {"VEC2", 1, 2}, {"VEC3", 1, 3}, {"VEC4", 1, 4}, {"MAT2", 2, 2}, {"MAT3", 3, 3}, {"MAT4", 4, 4}}};

void setShape(Accessor& accessor, const Json& object, const std::string& place) {
    const std::string name = readString(object, "type", place);
    for (const Shape& shape : kShapes) {
        if (name != shape.name) continue;
        accessor.type = name;
        accessor.component_count = shape.columns * shape.rows;
        const std::size_t column = shape.rows * bytesOf(accessor.component);
        // Columns of matrices start at multiples of 4 bytes.
        const std::size_t column_stride = shape.columns == 1 ? column : (column + 3) / 4 * 4;
        accessor.element_bytes = column_stride * shape.columns;
        accessor.data_bytes = column_stride * (shape.columns - 1) + column;
        return;
    }
    if (name.empty()) failAt("the member 'type' is missing", join(place, "type"));
    // Unknown types are an error only when elements are read.
    accessor.type = name;
    accessor.component_count = accessor.element_bytes = accessor.data_bytes = 0;
}

/// Checks that `count` elements of `element_bytes` (not 0), `stride` apart, starting at `offset`, lie inside the view.
/// No sum can overflow.
void checkRange(const BufferView& view, std::size_t offset, std::size_t count, std::size_t stride,
                std::size_t element_bytes, const std::string& place) {
    if (count == 0) return;
    const bool fits = offset <= view.byte_count && element_bytes <= view.byte_count - offset &&
                      count - 1 <= (view.byte_count - offset - element_bytes) / stride;
    if (!fits) {
        failAt("the accessor's " + std::to_string(count) + " elements extend beyond its buffer view of " +
                   std::to_string(view.byte_count) + " bytes",
               place);
    }
}

std::size_t viewIndex(const Document& document, const Json& object, const std::string& place) {
    return requireIndex(object, "bufferView", place, rootArray(document, "bufferViews").size(), "buffer view");
}

SparsePart readSparse(const Document& document, const Json& object, const Accessor& accessor,
                      const std::string& place) {
    SparsePart sparse;
    sparse.count = readSize(object, "count", place);
    if (sparse.count > accessor.count)
        failAt("the accessor has more sparse elements than elements", join(place, "count"));
    const Json* indices = readObject(object, "indices", place);
    const Json* values = readObject(object, "values", place);
    if (indices == nullptr || values == nullptr)
        failAt("the members 'indices' or 'values' of 'sparse' are missing", place);
    const std::string index_place = join(place, "indices"), value_place = join(place, "values");
    sparse.index_type = readComponentType(*indices, index_place);
    if (!isUnsigned(sparse.index_type))
        failAt("sparse indices must have an unsigned integer component type", join(index_place, "componentType"));
    sparse.index_view = viewIndex(document, *indices, index_place);
    sparse.index_offset = readSize(*indices, "byteOffset", index_place, 0);
    sparse.value_view = viewIndex(document, *values, value_place);
    sparse.value_offset = readSize(*values, "byteOffset", value_place, 0);
    const std::size_t index_bytes = bytesOf(sparse.index_type);
    checkRange(readBufferView(document, sparse.index_view), sparse.index_offset, sparse.count, index_bytes, index_bytes,
               index_place);
    if (accessor.component_count > 0) {
        checkRange(readBufferView(document, sparse.value_view), sparse.value_offset, sparse.count,
                   accessor.element_bytes, accessor.data_bytes, value_place);
    }
    return sparse;
}

bool viewHasData(const Document& document, std::size_t index) {
    const BufferView range = readBufferView(document, index);
    return range.byte_count == 0 || (document.buffers[range.buffer].source != BufferSource::absent &&
                                     document.views_without_data.count(index) == 0);
}

/// Returns `count` bytes of a view, starting at `offset`. The caller must have checked the range against the declared
/// length. Fails if the data is absent.
const std::uint8_t* viewBytes(const Document& document, std::size_t index, std::size_t offset, std::size_t count) {
    const BufferView view = readBufferView(document, index);
    const Buffer& buffer = document.buffers[view.buffer];
    if (!viewHasData(document, index)) {
        const char* extension = meshoptExtension(rootArray(document, "bufferViews")[index]);
        failFile(ErrorCode::unsupportedFile,
                 extension == nullptr ? "the buffer of the buffer view has no data"
                                      : std::string("the buffer view is compressed with ") + extension + ": " +
                                            meshoptMissing(extension == kKhrMeshopt),
                 join("/bufferViews", index));
    }
    return buffer.bytes.range(view.begin + offset, count).data();
}

std::uint32_t unsignedAt(const std::uint8_t* bytes, ComponentType type) {
    switch (type) {
        case ComponentType::u8: return bytes[0];
        case ComponentType::u16: return static_cast<std::uint32_t>(bytes[0] | bytes[1] << 8);
        default: break;
    }
    return loadLittleEndian<std::uint32_t>(bytes);
}

void applySparse(const Document& document, const Accessor& accessor, std::uint8_t* elements) {
    const SparsePart& sparse = *accessor.sparse;
    if (sparse.count == 0) return;
    const std::uint8_t* indices =
        viewBytes(document, sparse.index_view, sparse.index_offset, sparse.count * bytesOf(sparse.index_type));
    const std::uint8_t* values = viewBytes(document, sparse.value_view, sparse.value_offset,
                                           (sparse.count - 1) * accessor.element_bytes + accessor.data_bytes);
    for (std::size_t i = 0; i < sparse.count; ++i) {
        const std::uint32_t at = unsignedAt(indices + i * bytesOf(sparse.index_type), sparse.index_type);
        if (at >= accessor.count)
            failAt("the sparse index " + std::to_string(at) + " is out of range", accessor.place() + "/sparse/indices");
        std::memcpy(elements + at * accessor.element_bytes, values + i * accessor.element_bytes, accessor.data_bytes);
    }
}

/// Returns the address of the elements; null if they are all zero. Fails if their data is not available, if there are
/// too many zero elements, and for unknown types.
const std::uint8_t* elementSource(const Document& document, const Accessor& accessor) {
    if (accessor.component_count == 0)
        failAt("the accessor type " + inQuotes(accessor.type) + " does not exist", join(accessor.place(), "type"));
    if (const auto decoded = document.elements.find(accessor.index); decoded != document.elements.end())
        return decoded->second.data();
    if (document.hidden_accessors.count(accessor.index) != 0) {
        failFile(ErrorCode::unsupportedFile, "the data of the accessor is compressed with Draco: " + dracoMissing(),
                 accessor.place());
    }
    if (!accessor.view && accessor.count > kMaxZeroElements) {
        failFile(ErrorCode::unsupportedFile,
                 "the accessor has no data, but declares " + std::to_string(accessor.count) + " elements",
                 join(accessor.place(), "count"));
    }
    if (!accessor.view || accessor.count == 0) return nullptr;
    return viewBytes(document, *accessor.view, accessor.byte_offset,
                     (accessor.count - 1) * accessor.stride + accessor.data_bytes);
}

/// Copies strided elements to a tightly packed array.
void pack(const Accessor& accessor, const std::uint8_t* source, std::uint8_t* elements) {
    if (accessor.stride == accessor.element_bytes) {
        std::memcpy(elements, source, (accessor.count - 1) * accessor.element_bytes + accessor.data_bytes);
        return;
    }
    withElementSize(accessor.data_bytes, [&](auto size) {
        for (std::size_t i = 0; i < accessor.count; ++i)
            std::memcpy(elements + i * accessor.element_bytes, source + i * accessor.stride, size);
    });
}

/// Converts indices of one type to 32 bits; returns the largest index.
template <class Index>
std::uint32_t widen(const ElementView& elements, std::span<std::uint32_t> numbers) {
    const auto widenFrom = [&](auto stride) {
        std::uint32_t largest = 0;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const auto index = loadLittleEndian<Index>(elements.data + i * stride);
            numbers[i] = index;
            largest = std::max<std::uint32_t>(largest, index);
        }
        return largest;
    };
    constexpr std::integral_constant<std::size_t, sizeof(Index)> kTight;
    return elements.stride == kTight ? widenFrom(kTight) : widenFrom(elements.stride);
}

/// Decodes a component to float with the formulas of the specification, such as f = max(c / 127, -1); if not
/// normalized, returns the integer value.
float componentAt(const std::uint8_t* bytes, ComponentType type, bool normalized) {
    float value = 0;
    switch (type) {
        case ComponentType::i8: value = static_cast<float>(loadLittleEndian<std::int8_t>(bytes)); break;
        case ComponentType::u8: value = static_cast<float>(bytes[0]); break;
        case ComponentType::i16: value = static_cast<float>(loadLittleEndian<std::int16_t>(bytes)); break;
        case ComponentType::u16: value = static_cast<float>(loadLittleEndian<std::uint16_t>(bytes)); break;
        case ComponentType::u32: return static_cast<float>(loadLittleEndian<std::uint32_t>(bytes));
        case ComponentType::f32: return loadLittleEndian<float>(bytes);
    }
    return normalized ? std::max(value / propertiesOf(type).largest, -1.0f) : value;
}

template <class Vec>
std::vector<Vec> decodeVec(const Document& document, const Accessor& accessor, const std::string& place) {
    constexpr std::size_t components = sizeof(Vec) / sizeof(float);
    if (accessor.component_count != components || accessor.type[0] != 'V') {
        failAt("the accessor is " + formatName(accessor) + ", but the attribute must have " +
                   std::to_string(components) + " components",
               place);
    }
    if (accessor.component == ComponentType::f32) {
        const std::uint8_t* source = elementSource(document, accessor);
        std::vector<Vec> result(accessor.count);
        auto* out = reinterpret_cast<std::uint8_t*>(result.data());
        if (source != nullptr) pack(accessor, source, out);
        if (accessor.sparse) applySparse(document, accessor, out);
        convertLittleEndian({out, result.size() * sizeof(Vec)}, sizeof(float));
        return result;
    }
    const Bytes elements = copyElements(document, accessor);
    std::vector<Vec> result(accessor.count);
    const std::size_t bytes = bytesOf(accessor.component);
    auto* out = reinterpret_cast<float*>(result.data());
    for (std::size_t i = 0; i < accessor.count * components; ++i)
        out[i] = componentAt(elements.data() + i * bytes, accessor.component, accessor.normalized);
    return result;
}

}  // namespace

std::size_t bytesOf(ComponentType type) { return propertiesOf(type).byte_count; }

BufferView readBufferView(const Document& document, std::size_t index) {
    const std::string place = join("/bufferViews", index);
    const Json& object = rootArray(document, "bufferViews")[index];
    BufferView view;
    view.buffer = requireIndex(object, "buffer", place, document.buffers.size(), "buffer");
    view.begin = readSize(object, "byteOffset", place, 0);
    view.byte_count = readSize(object, "byteLength", place);
    view.stride = readSize(object, "byteStride", place, 0);
    const Buffer& data = document.buffers[view.buffer];
    const std::size_t limit = data.source == BufferSource::absent
                                  ? readSize(rootArray(document, "buffers")[view.buffer], "byteLength", "/buffers")
                                  : data.bytes.size();
    if (view.begin > limit || view.byte_count > limit - view.begin)
        failAt("the buffer view extends beyond its buffer of " + std::to_string(limit) + " bytes", place);
    return view;
}

Accessor readAccessor(const Document& document, std::size_t index) {
    const std::string place = join("/accessors", index);
    const Json& object = rootArray(document, "accessors")[index];
    Accessor accessor;
    accessor.index = index;
    accessor.component = readComponentType(object, place);
    setShape(accessor, object, place);
    accessor.normalized = readBool(object, "normalized", place, false);
    const std::uint64_t count = readWhole(object, "count", place);
    accessor.view = readIndex(object, "bufferView", place, rootArray(document, "bufferViews").size(), "buffer view");
    accessor.byte_offset = readSize(object, "byteOffset", place, 0);
    accessor.stride = accessor.element_bytes;
    if (count > kMaxCorners) {
        failFile(ErrorCode::unsupportedFile,
                 "the accessor has " + std::to_string(count) + " elements; at most " + std::to_string(kMaxCorners) +
                     " are supported",
                 join(place, "count"));
    }
    accessor.count = static_cast<std::size_t>(count);
    // Decoded elements are tightly packed, regardless of the stride of their view.
    if (accessor.view && document.elements.count(index) == 0) {
        const BufferView view = readBufferView(document, *accessor.view);
        if (view.stride != 0) accessor.stride = view.stride;
        if (accessor.stride < accessor.element_bytes) {
            failAt("elements of " + std::to_string(accessor.element_bytes) + " bytes overlap at a stride of " +
                       std::to_string(accessor.stride),
                   join(join("/bufferViews", *accessor.view), "byteStride"));
        }
        if (accessor.component_count > 0)
            checkRange(view, accessor.byte_offset, accessor.count, accessor.stride, accessor.data_bytes, place);
    }
    if (const Json* sparse = readObject(object, "sparse", place))
        accessor.sparse = readSparse(document, *sparse, accessor, join(place, "sparse"));
    return accessor;
}

double stepOf(const Accessor& accessor) {
    if (accessor.component == ComponentType::f32) return 0;
    if (!accessor.normalized) return 1;
    return 1.0 / static_cast<double>(propertiesOf(accessor.component).largest);
}

bool hasData(const Document& document, const Accessor& accessor) {
    if (document.hidden_accessors.count(accessor.index) != 0) return false;
    return (!accessor.view || viewHasData(document, *accessor.view)) &&
           (!accessor.sparse ||
            (viewHasData(document, accessor.sparse->index_view) && viewHasData(document, accessor.sparse->value_view)));
}

std::optional<ElementView> viewElements(const Document& document, const Accessor& accessor) {
    const std::uint8_t* source = elementSource(document, accessor);
    if (source == nullptr || accessor.sparse || accessor.data_bytes != accessor.element_bytes) return {};
    return ElementView{source, accessor.stride};
}

Bytes copyElements(const Document& document, const Accessor& accessor) {
    const std::uint8_t* source = elementSource(document, accessor);
    // Zero-fill only if some bytes are not copied.
    const bool covers_all = source != nullptr && accessor.data_bytes == accessor.element_bytes;
    Bytes elements =
        covers_all ? Bytes(accessor.count * accessor.element_bytes) : Bytes(accessor.count * accessor.element_bytes, 0);
    if (source != nullptr) pack(accessor, source, elements.data());
    if (accessor.sparse) applySparse(document, accessor, elements.data());
    return elements;
}

std::vector<Vec2> decodeVec2(const Document& document, const Accessor& accessor, const std::string& place) {
    return decodeVec<Vec2>(document, accessor, place);
}
std::vector<Vec3> decodeVec3(const Document& document, const Accessor& accessor, const std::string& place) {
    return decodeVec<Vec3>(document, accessor, place);
}
std::vector<Vec4> decodeVec4(const Document& document, const Accessor& accessor, const std::string& place) {
    return decodeVec<Vec4>(document, accessor, place);
}

std::vector<std::uint32_t> decodeIndices(const Document& document, const Accessor& accessor, std::size_t vertex_count,
                                         const std::string& place) {
    if (!isUnsigned(accessor.component) || accessor.component_count != 1 || accessor.normalized)
        failAt("indices must be unsigned scalars, not " + formatName(accessor), place);
    Bytes packed;
    std::optional<ElementView> elements = viewElements(document, accessor);
    if (!elements) {
        packed = copyElements(document, accessor);
        elements = {packed.data(), accessor.element_bytes};
    }
    std::vector<std::uint32_t> indices(accessor.count);
    const std::size_t bytes = bytesOf(accessor.component);
    const std::uint32_t largest = bytes == 1   ? widen<std::uint8_t>(*elements, indices)
                                  : bytes == 2 ? widen<std::uint16_t>(*elements, indices)
                                               : widen<std::uint32_t>(*elements, indices);
    if (indices.empty() || largest < vertex_count) return indices;
    const auto wrong = std::find_if(indices.begin(), indices.end(), [&](std::uint32_t v) { return v >= vertex_count; });
    const std::uint32_t restart = 0xffffffffu >> (32 - 8 * bytes);  // the largest value of the index type
    failAt("index " + std::to_string(wrong - indices.begin()) + " is " + std::to_string(*wrong) +
               ", but the primitive has only " + std::to_string(vertex_count) + " vertices" +
               (*wrong == restart ? "; glTF does not allow this value as a primitive restart index" : ""),
           place);
}

std::string formatName(const Accessor& accessor) {
    const Component& component = propertiesOf(accessor.component);
    const std::string name = accessor.normalized ? component.normalized_name : component.name;
    if (accessor.component_count == 0) return name + " with an unknown accessor type";
    if (accessor.component_count == 1) return name;
    // Examples of names are "snorm16x3" and, without an x, "float3".
    return name + (accessor.component == ComponentType::f32 ? "" : "x") + std::to_string(accessor.component_count);
}

}  // namespace tspace::gltf
