// SPDX-License-Identifier: MIT
// Copies of elements, made immediately or when they are written, and sparse storage.
#include "model/gltf/gather_elements.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/numbers.h"

namespace tspace::gltf {
namespace {

/// Returns the accessor's description without its elements.
ElementData describe(const Document& document, const Accessor& accessor, std::size_t count) {
    ElementData data;
    data.component = accessor.component;
    data.type = accessor.type;
    data.normalized = accessor.normalized;
    data.like = accessor.index;
    data.filter = filterOf(document, accessor);
    data.count = count;
    data.element_bytes = accessor.element_bytes;
    // Copied elements have the same bounds as their sources.
    const Json& object = rootArray(document, "accessors")[accessor.index];
    if (const Json* low = findMember(object, "min")) data.min = *low;
    if (const Json* high = findMember(object, "max")) data.max = *high;
    return data;
}

/// Returns whether the bytes are part of the model file (in BIN). These bytes live until the end of the run, and
/// Editor::overwrite generates lazy pieces before it changes them.
bool isInModelFile(const Document& document, const std::uint8_t* data) {
    const std::uint8_t *begin = document.file_bytes.data(), *end = begin + document.file_bytes.size();
    return !std::less<>{}(data, begin) && std::less<>{}(data, end);
}

}  // namespace

void GatheredBytes::make(std::size_t begin, std::span<std::uint8_t> to) const {
    if (to.empty()) return;
    std::size_t element = begin / element_bytes_;
    std::uint8_t* out = to.data();
    if (const std::size_t skipped = begin % element_bytes_; skipped != 0) {
        const std::size_t count = std::min(element_bytes_ - skipped, to.size());
        std::memcpy(out, at(element++) + skipped, count);
        out += count;
    }
    const auto left = [&] { return static_cast<std::size_t>(to.data() + to.size() - out); };
    withElementSize(element_bytes_, [&](auto size) {
        const std::size_t end = element + left() / size, end_of_kept = std::min(end, sources_.kept);
        for (; element < end_of_kept; ++element, out += size) std::memcpy(out, data_ + element * stride_, size);
        const std::uint32_t* copies = sources_.copies->data();
        for (; element < end; ++element, out += size)
            std::memcpy(out, data_ + copies[element - sources_.kept] * stride_, size);
    });
    if (left() != 0) std::memcpy(out, at(element), left());
}

ElementData gatherSplit(const Document& document, const Accessor& accessor, const SplitSources& sources) {
    const std::optional<ElementView> old = viewElements(document, accessor);
    if (old && isInModelFile(document, old->data) && filterOf(document, accessor) == MeshoptFilter::none) {
        ElementData data = describe(document, accessor, sources.size());
        data.later = std::make_shared<GatheredBytes>(old->data, old->stride, accessor.element_bytes, sources);
        return data;
    }
    std::vector<std::uint32_t> all(sources.kept);
    std::iota(all.begin(), all.end(), 0u);
    all.insert(all.end(), sources.copies->begin(), sources.copies->end());
    return gatherElements(document, accessor, all);
}

ElementData gatherElements(const Document& document, const Accessor& accessor, std::span<const std::uint32_t> sources) {
    Bytes packed;
    std::optional<ElementView> old = viewElements(document, accessor);
    if (!old) {
        packed = copyElements(document, accessor);
        old = {packed.data(), accessor.element_bytes};
    }
    ElementData data = describe(document, accessor, sources.size());
    data.unfiltered = gatherUnfiltered(document, accessor, sources);
    data.bytes.resize(sources.size() * accessor.element_bytes);
    withElementSize(data.element_bytes, [&](auto size) {
        std::uint8_t* const to = data.bytes.data();
        for (std::size_t i = 0; i < sources.size(); ++i)
            std::memcpy(to + i * size, old->data + sources[i] * old->stride, size);
    });
    if (accessor.sparse && !accessor.view) makeSparseWhereSmaller(data);
    return data;
}

void renewBounds(ElementData& data) {
    if (data.component != ComponentType::f32 || (data.min.is_null() && data.max.is_null())) return;
    const std::size_t components = data.element_bytes / sizeof(float);
    std::vector<double> low(components, std::numeric_limits<double>::infinity()), high(components, -low[0]);
    bool is_finite = true;
    for (std::size_t i = 0; i < data.bytes.size() / sizeof(float); ++i) {
        const auto value = loadLittleEndian<float>(data.bytes.data() + i * sizeof(float));
        is_finite = is_finite && std::isfinite(value);
        low[i % components] = std::min<double>(low[i % components], value);
        high[i % components] = std::max<double>(high[i % components], value);
    }
    if (!data.min.is_null()) data.min = is_finite ? Json(low) : Json();
    if (!data.max.is_null()) data.max = is_finite ? Json(high) : Json();
}

namespace {

/// Approximate size of the JSON for `sparse` and two buffer views.
constexpr std::size_t kJsonBytes = 256;

}  // namespace

void makeSparseWhereSmaller(ElementData& data) {
    const std::size_t size = data.element_bytes;
    std::vector<std::uint32_t> places;
    for (std::size_t i = 0; i < data.count; ++i) {
        const std::uint8_t* const element = data.bytes.data() + i * size;
        if (std::any_of(element, element + size, [](std::uint8_t byte) { return byte != 0; }))
            places.push_back(static_cast<std::uint32_t>(i));
    }
    // An accessor without a view and without sparse values is valid and all zero, but Assimp and other readers cannot
    // load it, so one element is kept.
    if (places.empty() && data.count != 0) places.push_back(0);
    const std::size_t sparse_bytes = places.size() * (size + sizeof(std::uint32_t)) + kJsonBytes;
    if (2 * places.size() > data.count || sparse_bytes >= data.bytes.size()) return;
    Bytes kept(places.size() * size);
    for (std::size_t i = 0; i < places.size(); ++i)
        std::memcpy(kept.data() + i * size, data.bytes.data() + places[i] * size, size);
    data.bytes = std::move(kept);
    data.places = std::move(places);
}

// Conversion of index lists to elements.

namespace {

template <class Index>
Bytes narrow(const std::vector<std::uint32_t>& indices) {
    Bytes bytes(indices.size() * sizeof(Index));
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const auto index = static_cast<Index>(indices[i]);
        storeLittleEndian(index, bytes.data() + i * sizeof index);
    }
    return bytes;
}

}  // namespace

ElementData newIndices(const Document& document, const Primitive& first, std::vector<std::uint32_t>&& indices,
                       std::size_t vertex_count) {
    ComponentType narrowest = ComponentType::u16;
    bool has_bounds = false;
    if (first.indices) {
        narrowest = readAccessor(document, *first.indices).component;
        const Json& old = rootArray(document, "accessors")[*first.indices];
        has_bounds = old.contains("min") || old.contains("max");
    }
    Json low, high;
    if (has_bounds) {
        const auto [least, most] = std::minmax_element(indices.begin(), indices.end());
        low = Json::array({*least});
        high = Json::array({*most});
    }
    ElementData data = indexElements(std::move(indices), narrowest, vertex_count);
    data.min = std::move(low);
    data.max = std::move(high);
    return data;
}

ElementData indexElements(std::vector<std::uint32_t>&& indices, ComponentType narrowest, std::size_t vertex_count) {
    ElementData data;
    data.target = kIndexTarget;
    data.component = narrowest;
    if (data.component == ComponentType::u8 && vertex_count > 255) data.component = ComponentType::u16;
    if (data.component == ComponentType::u16 && vertex_count > 65535) data.component = ComponentType::u32;
    data.count = indices.size();
    data.element_bytes = bytesOf(data.component);
    if (data.element_bytes == 1) {
        data.bytes = narrow<std::uint8_t>(indices);
    } else if (data.element_bytes == 2) {
        data.bytes = narrow<std::uint16_t>(indices);
    } else {
        data.later = std::make_shared<KeptBytes<std::uint32_t>>(std::move(indices));
    }
    return data;
}

}  // namespace tspace::gltf
