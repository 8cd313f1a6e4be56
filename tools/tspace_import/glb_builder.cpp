// SPDX-License-Identifier: MIT
// Views, accessors, and the frame around them.
#include "glb_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tspace::import {

namespace {

constexpr unsigned kU16 = 5123, kU32 = 5125, kF32 = 5126;
constexpr unsigned kIndexTarget = 34963;

template <class T>
std::span<const std::uint8_t> bytesOf(std::span<const T> values) {
    return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size_bytes()};
}

void append32(std::vector<std::uint8_t>& out, std::uint64_t value) {
    for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

}  // namespace

GlbBuilder::GlbBuilder() { json_["asset"] = {{"version", "2.0"}}; }

std::size_t GlbBuilder::append(const char* array, Json entry) {
    json_[array].push_back(std::move(entry));
    return json_[array].size() - 1;
}

std::size_t GlbBuilder::addView(std::span<const std::uint8_t> bytes, unsigned target) {
    bin_.resize((bin_.size() + 3) / 4 * 4, 0);
    Json view = {{"buffer", 0}, {"byteOffset", bin_.size()}, {"byteLength", bytes.size()}};
    if (target != 0) view["target"] = target;
    bin_.insert(bin_.end(), bytes.begin(), bytes.end());
    return append("bufferViews", std::move(view));
}

std::size_t GlbBuilder::addAccessor(std::size_t view, unsigned component, std::size_t count, const std::string& type) {
    return append("accessors", {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
}

std::size_t GlbBuilder::addFloats(std::span<const float> values, std::size_t components, const std::string& type,
                                  unsigned target, bool bounds) {
    const std::size_t accessor = addAccessor(addView(bytesOf(values), target), kF32, values.size() / components, type);
    if (!bounds) return accessor;
    Json low = Json::array(), high = Json::array();
    for (std::size_t k = 0; k < components; ++k) {
        float least = std::numeric_limits<float>::infinity(), most = -least;
        for (std::size_t i = k; i < values.size(); i += components) {
            least = std::min(least, values[i]);
            most = std::max(most, values[i]);
        }
        low.push_back(least);
        high.push_back(most);
    }
    json_["accessors"][accessor]["min"] = std::move(low);
    json_["accessors"][accessor]["max"] = std::move(high);
    return accessor;
}

std::size_t GlbBuilder::addShorts(std::span<const std::uint16_t> values, std::size_t components,
                                  const std::string& type) {
    return addAccessor(addView(bytesOf(values), 34962), kU16, values.size() / components, type);
}

std::size_t GlbBuilder::addIndices(std::span<const std::uint32_t> indices, std::size_t vertex_count) {
    if (vertex_count > 0xffff)
        return addAccessor(addView(bytesOf(indices), kIndexTarget), kU32, indices.size(), "SCALAR");
    const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
    return addAccessor(addView(bytesOf(std::span<const std::uint16_t>(narrow)), kIndexTarget), kU16, indices.size(),
                       "SCALAR");
}

std::vector<std::uint8_t> GlbBuilder::finish() {
    bin_.resize((bin_.size() + 3) / 4 * 4, 0);
    if (!bin_.empty()) json_["buffers"] = Json::array({Json{{"byteLength", bin_.size()}}});
    std::string text = json_.dump(-1, ' ', BadUtf8::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t total = 12 + 8 + text.size() + (bin_.empty() ? 0 : 8 + bin_.size());
    if (total > 0xffffffffu) throw std::length_error("the model does not fit into the 4 GiB of a GLB");
    std::vector<std::uint8_t> glb;
    glb.reserve(static_cast<std::size_t>(total));
    append32(glb, 0x46546c67);  // "glTF"
    append32(glb, 2);
    append32(glb, total);
    append32(glb, text.size());
    append32(glb, 0x4e4f534a);  // "JSON"
    glb.insert(glb.end(), text.begin(), text.end());
    if (bin_.empty()) return glb;
    append32(glb, bin_.size());
    append32(glb, 0x004e4942);  // "BIN"
    glb.insert(glb.end(), bin_.begin(), bin_.end());
    return glb;
}

}  // namespace tspace::import
