// SPDX-License-Identifier: MIT
// Copies of elements, made at once or when they are written, and sparse storage.
#include "model/gltf/gather_elements.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/numbers.h"
#include "core/mesh/pools/unit_lattice.h"
#include "model/gltf/vertex_numbers.h"

namespace tspace::gltf {

namespace {

/// The accessor's description without its elements.
ElementData describe(const Document& document, const Accessor& accessor, std::size_t count) {
    ElementData data;
    data.component = accessor.component;
    data.type = accessor.type;
    data.normalized = accessor.normalized;
    data.like = accessor.index;
    data.filter = filterOf(document, accessor);
    data.count = count;
    data.element_bytes = accessor.element_bytes;
    // Copies change no bound.
    const Json& object = rootArray(document, "accessors")[accessor.index];
    if (const Json* low = findMember(object, "min")) data.min = *low;
    if (const Json* high = findMember(object, "max")) data.max = *high;
    return data;
}

/// Whether the bytes lie in the model file (in BIN). Those live to the end of the run, and Editor::overwrite makes lazy
/// pieces before it changes them.
bool liesInModelFile(const Document& document, const std::uint8_t* data) {
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
    if (old && liesInModelFile(document, old->data) && filterOf(document, accessor) == MeshoptFilter::none) {
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

/// The bytes of JSON for `sparse` and two buffer views, roughly.
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
    // An accessor without a view and without sparse values is all zero, but Assimp and others cannot load it: it keeps one.
    if (places.empty() && data.count != 0) places.push_back(0);
    const std::size_t sparse_bytes = places.size() * (size + sizeof(std::uint32_t)) + kJsonBytes;
    if (2 * places.size() > data.count || sparse_bytes >= data.bytes.size()) return;
    Bytes kept(places.size() * size);
    for (std::size_t i = 0; i < places.size(); ++i) {
        std::memcpy(kept.data() + i * size, data.bytes.data() + places[i] * size, size);
    }
    data.bytes = std::move(kept);
    data.places = std::move(places);
}

// Packing.

namespace {

template <class Vec>
ElementData floatVectors(std::vector<Vec>&& values) {
    ElementData data;
    data.type = "VEC" + std::to_string(sizeof(Vec) / sizeof(float));
    data.count = values.size();
    data.element_bytes = sizeof(Vec);
    data.later = std::make_shared<KeptBytes<Vec>>(std::move(values));
    return data;
}

template <class Vec>
ElementData unitVectors(std::vector<Vec>&& values, VectorFormat format) {
    if (format == VectorFormat::float32) return floatVectors(std::move(values));
    constexpr std::size_t components = sizeof(Vec) / sizeof(float);
    ElementData data;
    data.component = format == VectorFormat::snorm8 ? ComponentType::i8 : ComponentType::i16;
    data.type = "VEC" + std::to_string(components);
    data.normalized = true;
    data.count = values.size();
    data.element_bytes = components * bytesOf(data.component);
    const std::vector<std::uint8_t> packed = packUnits(std::span<const Vec>(values), format);
    data.bytes.assign(packed.begin(), packed.end());
    return data;
}

template <class Index>
Bytes narrow(const std::vector<std::uint32_t>& indices) {
    Bytes bytes(indices.size() * sizeof(Index));
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const auto index = static_cast<Index>(indices[i]);
        storeLittleEndian(index, bytes.data() + i * sizeof index);
    }
    return bytes;
}

bool isReplaced(const std::string& name, std::ptrdiff_t target, const PoolPlan& pool, const PoolFrames& frames) {
    if (name == "_BITANGENT") return target == kBase && !frames.bitangents.empty();
    if (name == "TANGENT") return !frames.tangents.empty();
    const bool is_new = target != kBase && !pool.morph_normals.empty() && pool.morph_normals[std::size_t(target)];
    return name == "NORMAL" && (frames.normals_generated || is_new);
}

/// Every other attribute, and those of morph targets, by accessor.
std::map<std::size_t, CarriedElements> carriedAttributes(std::span<const Primitive> primitives, const PoolPlan& pool,
                                                         const PoolFrames& frames) {
    std::map<std::size_t, CarriedElements> carried;
    for (const std::size_t number : pool.primitives) {
        const Primitive& primitive = primitives[number];
        for (const auto& [name, accessor] : primitive.attributes) {
            if (!isReplaced(name, kBase, pool, frames)) carried[accessor].users.push_back({number, kBase, name});
        }
        for (std::size_t target = 0; target < primitive.targets.size(); ++target) {
            for (const auto& [name, accessor] : primitive.targets[target]) {
                const auto place = static_cast<std::ptrdiff_t>(target);
                if (isReplaced(name, place, pool, frames) && movesFrames(primitive.targets[target])) continue;
                carried[accessor].users.push_back({number, place, name});
            }
        }
    }
    return carried;
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

PoolElements packFrames(const Document& document, std::span<const Primitive> primitives, const PoolPlan& pool,
                        PoolFrames&& frames, const PackingRule& rule) {
    const VectorFormat format = rule.format;
    PoolElements elements;
    elements.vertex_count = frames.source_vertices.size();
    elements.was_split = rule.is_welded || frames.wasSplit(primitives[pool.primitives[0]].vertex_count);
    elements.normals_generated = frames.normals_generated;
    elements.bitangents_generated = !frames.bitangents.empty();
    elements.morphs = std::move(frames.morphs);
    elements.differing_count = frames.differing_count;
    if (pool.keeps_tangents) return elements;
    if (elements.was_split) {
        const bool names_vertices =
            std::any_of(pool.primitives.begin(), pool.primitives.end(),
                        [&](std::size_t number) { return mayNameVertices(document, primitives[number]); });
        if (names_vertices) {
            elements.sources = frames.source_vertices;
            elements.corners = frames.indices;
        }
        elements.carried = carriedAttributes(primitives, pool, frames);
        // Old vertices come first, as they were.
        SplitSources sources{.kept = rule.is_welded ? 0 : primitives[pool.primitives[0]].vertex_count};
        sources.copies = std::make_shared<const std::vector<std::uint32_t>>(
            frames.source_vertices.begin() + static_cast<std::ptrdiff_t>(sources.kept), frames.source_vertices.end());
        for (auto& [accessor, carried] : elements.carried)
            carried.data = gatherSplit(document, readAccessor(document, accessor), sources);
        for (std::size_t i = 0; i < pool.geometries.size(); ++i) {
            const Primitive& first = primitives[pool.geometries[i].primitives[0]];
            elements.indices.push_back(
                newIndices(document, first, std::move(frames.indices[i]), elements.vertex_count));
        }
    }
    if (frames.normals_generated) elements.normals = unitVectors(std::move(frames.normals), format);
    if (!frames.tangents.empty()) elements.tangents = unitVectors(std::move(frames.tangents), format);
    if (elements.bitangents_generated) elements.bitangents = unitVectors(std::move(frames.bitangents), format);
    return elements;
}

ElementData offsetElements(const VertexOffsets& offsets, std::size_t vertex_count) {
    std::vector<Vec3> dense(vertex_count);
    for (std::size_t i = 0; i < offsets.vertices.size(); ++i) dense[offsets.vertices[i]] = offsets.offsets[i];
    ElementData data = floatVectors(std::move(dense));
    data.makeNow();  // zeros among them may be left out
    return data;
}

}  // namespace tspace::gltf
