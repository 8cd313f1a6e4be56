// SPDX-License-Identifier: MIT
// Builds the buffer views and accessors of a new glTF document.
#include "model/gltf/document_builder.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "core/base/numbers.h"

namespace tspace::gltf {

std::size_t DocumentBuilder::append(const char* array, Json entry) {
    Json& entries = json_[array];
    entries.push_back(std::move(entry));
    return entries.size() - 1;
}

std::size_t DocumentBuilder::addView(std::span<const std::byte> numbers, std::size_t number_bytes, unsigned target) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4, 0);
    Json view = {{"buffer", 0U}, {"byteOffset", bytes_.size()}, {"byteLength", numbers.size()}};
    if (target != kNoTarget) view["target"] = target;
    const auto* const first = reinterpret_cast<const std::uint8_t*>(numbers.data());
    bytes_.insert(bytes_.end(), first, first + numbers.size());
    convertLittleEndian(std::span<std::uint8_t>(bytes_).last(numbers.size()), number_bytes);
    return append("bufferViews", std::move(view));
}

std::size_t DocumentBuilder::addAccessor(std::size_t view, ComponentType component, std::size_t count,
                                         const std::string& type) {
    return append("accessors", {{"bufferView", view},
                                {"componentType", static_cast<std::uint32_t>(component)},
                                {"count", count},
                                {"type", type}});
}

std::size_t DocumentBuilder::addFloatBytes(std::span<const std::byte> floats, std::size_t count,
                                           const std::string& type, unsigned target, bool bounds) {
    const std::size_t index = addAccessor(addView(floats, sizeof(float), target), ComponentType::f32, count, type);
    if (!bounds || count == 0) return index;
    Json low = Json::array(), high = Json::array();
    const std::size_t stride = floats.size() / count;
    for (std::size_t k = 0; k < stride; k += sizeof(float)) {
        float least = std::numeric_limits<float>::infinity(), most = -least;
        for (std::size_t at = k; at < floats.size(); at += stride) {
            float value = 0;
            std::memcpy(&value, floats.data() + at, sizeof value);
            least = std::min(least, value);
            most = std::max(most, value);
        }
        low.push_back(least);
        high.push_back(most);
    }
    json_["accessors"][index]["min"] = std::move(low);
    json_["accessors"][index]["max"] = std::move(high);
    return index;
}

std::size_t DocumentBuilder::addIndices(std::span<const std::uint32_t> indices, std::size_t vertex_count) {
    const bool is_short = vertex_count <= 65535;
    std::vector<std::uint16_t> narrow;
    if (is_short) narrow.assign(indices.begin(), indices.end());
    const std::size_t view = is_short ? addView(std::as_bytes(std::span(narrow)), 2, kIndexTarget)
                                      : addView(std::as_bytes(indices), 4, kIndexTarget);
    return addAccessor(view, is_short ? ComponentType::u16 : ComponentType::u32, indices.size(), "SCALAR");
}

}  // namespace tspace::gltf
