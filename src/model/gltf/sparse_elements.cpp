// SPDX-License-Identifier: MIT
#include "model/gltf/sparse_elements.h"

#include <algorithm>
#include <cstring>

namespace tspace::gltf {

namespace {

/// What the member `sparse` and two buffer views take in the JSON, roughly.
constexpr std::size_t kJsonBytes = 256;

}  // namespace

void makeSparseWhereSmaller(ElementData& data) {
    const std::size_t size = data.element_bytes;
    std::vector<std::uint32_t> places;
    for (std::size_t i = 0; i < data.count; ++i) {
        const std::uint8_t* const element = data.bytes.data() + i * size;
        if (std::any_of(element, element + size, [](std::uint8_t byte) { return byte != 0; })) {
            places.push_back(static_cast<std::uint32_t>(i));
        }
    }
    const std::size_t sparse_bytes = places.empty() ? 0 : places.size() * (size + sizeof(std::uint32_t)) + kJsonBytes;
    if (2 * places.size() > data.count || sparse_bytes >= data.bytes.size()) return;
    Bytes kept(places.size() * size);
    for (std::size_t i = 0; i < places.size(); ++i) {
        std::memcpy(kept.data() + i * size, data.bytes.data() + places[i] * size, size);
    }
    data.bytes = std::move(kept);
    data.places = std::move(places);
}

}  // namespace tspace::gltf
