// SPDX-License-Identifier: MIT
// Overwriting, storing and re-using of accessors and buffer views.
#include "asset/gltf/editor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "asset/uri.h"

namespace tspace::gltf {

namespace {

/// min and max of float elements; removed where one is not finite, because JSON has no such number.
void updateBounds(Json& accessor, const Bytes& elements, std::size_t components) {
    if (!accessor.contains("min") && !accessor.contains("max")) return;
    std::vector<double> low(components, std::numeric_limits<double>::infinity()), high(components, -low[0]);
    bool finite = true;
    for (std::size_t i = 0; i < elements.size() / sizeof(float); ++i) {
        float value;
        std::memcpy(&value, elements.data() + i * sizeof(float), sizeof(float));
        finite = finite && std::isfinite(value);
        low[i % components] = std::min<double>(low[i % components], value);
        high[i % components] = std::max<double>(high[i % components], value);
    }
    for (const auto& [key, values] : {std::pair{"max", &high}, std::pair{"min", &low}}) {
        if (!accessor.contains(key)) continue;
        if (finite) {
            accessor[key] = *values;
        } else {
            accessor.erase(key);
        }
    }
}

}  // namespace

Editor::Editor(Document& document, std::string new_file_name)
    : document_(document),
      new_file_name_(std::move(new_file_name)),
      accessor_uses_(countAccessorUses(document)),
      view_uses_(countViewUses(document)),
      extents_(collectExtents(document)) {}

void Editor::moveUse(std::optional<std::size_t> from, std::size_t to) {
    if (from) --accessor_uses_[*from];
    ++accessor_uses_[to];
}

bool Editor::ownsView(const Accessor& accessor) const {
    return accessor.view && !accessor.sparse && view_uses_[*accessor.view] == 1 &&
           !rootArray(document_, "bufferViews")[*accessor.view].contains("extensions");
}

bool Editor::canOverwrite(const Accessor& accessor) const {
    if (!accessor.view || accessor.sparse || accessor.count == 0) return false;
    if (rootArray(document_, "bufferViews")[*accessor.view].contains("extensions")) return false;
    const Extent own = extentOf(document_, accessor);
    if (!document_.buffers[own.buffer].own) return false;
    return std::none_of(extents_.begin(), extents_.end(), [&](const Extent& other) {
        return other.accessor != accessor.index && overlaps(own, other);
    });
}

void Editor::overwrite(const Accessor& accessor, const Bytes& elements) {
    const BufferView view = readBufferView(document_, *accessor.view);
    Buffer& buffer = document_.buffers[view.buffer];
    std::uint8_t* to = buffer.bytes
                           .range(view.begin + accessor.byte_offset,
                                  (accessor.count - 1) * accessor.stride + accessor.data_bytes)
                           .data();
    for (std::size_t i = 0; i < accessor.count; ++i) {
        std::memcpy(to + i * accessor.stride, elements.data() + i * accessor.element_bytes,
                    accessor.element_bytes);
    }
    updateBounds(document_.json["accessors"][accessor.index], elements, accessor.component_count);
    buffer.edited = true;
    changed_ = true;
}

std::size_t Editor::targetBuffer() {
    if (target_buffer_) return *target_buffer_;
    for (std::size_t i = 0; i < document_.buffers.size(); ++i) {
        if (document_.buffers[i].own) target_buffer_ = i;
    }
    // A compressed view names its buffer by number too; data appended behind does not disturb it.
    if (target_buffer_) return *target_buffer_;
    Json& buffers = editableRootArray(document_, "buffers");
    target_buffer_ = buffers.size();
    Json entry = Json::object();
    entry["byteLength"] = 0;
    Buffer buffer;
    buffer.own = true;
    if (document_.container == Container::glb) {
        buffer.source = BufferSource::bin;
    } else {
        buffer.source = BufferSource::file;
        entry["uri"] = percentEncode(new_file_name_);
        buffer.path = new_file_name_;
    }
    buffers.push_back(std::move(entry));
    document_.buffers.push_back(std::move(buffer));
    return *target_buffer_;
}

std::size_t Editor::appendBytes(std::size_t index, Bytes bytes, std::size_t element_bytes, std::size_t stride) {
    Buffer& buffer = document_.buffers[index];
    buffer.edited = true;
    if (stride == element_bytes) return buffer.bytes.append(std::move(bytes), 4);
    const std::size_t count = bytes.size() / element_bytes;
    Bytes spread(count * stride, 0);
    for (std::size_t i = 0; i < count; ++i) {
        std::memcpy(spread.data() + i * stride, bytes.data() + i * element_bytes, element_bytes);
    }
    return buffer.bytes.append(std::move(spread), 4);
}

std::size_t Editor::storeView(ElementData&& data, std::optional<std::size_t> replaces) {
    // Vertex attributes start at multiples of 4 bytes each; indices are packed.
    const std::size_t stride =
        data.target == kVertexTarget ? (data.element_bytes + 3) / 4 * 4 : data.element_bytes;
    const std::size_t buffer = targetBuffer();
    const std::size_t begin = appendBytes(buffer, std::move(data.bytes), data.element_bytes, stride);
    Json& views = editableRootArray(document_, "bufferViews");
    const std::size_t index = replaces ? *replaces : views.size();
    if (!replaces) {
        views.push_back(Json::object());
        view_uses_.push_back(1);
    }
    Json& view = views[index];
    view["buffer"] = buffer;
    view["byteOffset"] = begin;
    view["byteLength"] = data.count * stride;
    if (stride != data.element_bytes) {
        view["byteStride"] = stride;
    } else {
        view.erase("byteStride");
    }
    view["target"] = data.target;
    return index;
}

std::size_t Editor::store(ElementData&& data, std::optional<std::size_t> replaces) {
    changed_ = true;
    std::optional<std::size_t> old_view;
    if (replaces) {
        const Accessor old = readAccessor(document_, *replaces);
        if (old.view && old.count > 0) {
            const Extent extent = extentOf(document_, old);
            vacated_.push_back({extent.buffer, extent.begin, extent.end});
        }
        if (ownsView(old)) {
            old_view = old.view;
        } else {
            if (old.view) --view_uses_[*old.view];
            if (old.sparse) {
                --view_uses_[old.sparse->index_view];
                --view_uses_[old.sparse->value_view];
            }
        }
    }
    const std::size_t view = storeView(std::move(data), old_view);
    Json& accessors = editableRootArray(document_, "accessors");
    const std::size_t index = replaces ? *replaces : accessors.size();
    if (!replaces) {
        accessors.push_back(Json::object());
        accessor_uses_.push_back(0);
    }
    Json& accessor = accessors[index];
    accessor["bufferView"] = view;
    accessor.erase("byteOffset");
    accessor["componentType"] = static_cast<std::uint32_t>(data.component);
    if (data.normalized) {
        accessor["normalized"] = true;
    } else {
        accessor.erase("normalized");
    }
    accessor["count"] = data.count;
    accessor["type"] = data.type;
    for (const auto& [key, value] : {std::pair{"max", &data.max}, std::pair{"min", &data.min}}) {
        if (value->is_null()) {
            accessor.erase(key);
        } else {
            accessor[key] = *value;
        }
    }
    accessor.erase("sparse");
    return index;
}

Json& Editor::primitive(std::size_t mesh, std::size_t index) {
    return document_.json["meshes"][mesh]["primitives"][index];
}

Json& Editor::accessor(std::size_t index) { return document_.json["accessors"][index]; }

void Editor::finish() {
    if (!changed_) return;
    if (!vacated_.empty()) cutVacated(document_, vacated_);
    Json& buffers = document_.json["buffers"];
    for (std::size_t i = 0; i < document_.buffers.size(); ++i) {
        if (document_.buffers[i].edited) buffers[i]["byteLength"] = document_.buffers[i].bytes.size();
    }
}

}  // namespace tspace::gltf
