// SPDX-License-Identifier: MIT
// Converts the frames of a pool to elements of accessors.
#include "commands/generate/pool_elements.h"

#include <algorithm>
#include <utility>

#include "core/mesh/pools/unit_lattice.h"
#include "model/gltf/vertex_numbers.h"

namespace tspace::gltf {
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

bool isReplaced(const std::string& name, std::ptrdiff_t target, const PoolPlan& pool, const PoolFrames& frames) {
    if (name == "_BITANGENT") return target == kBase && !frames.bitangents.empty();
    if (name == "TANGENT") return !frames.tangents.empty();
    const bool is_new = target != kBase && !pool.morph_normals.empty() && pool.morph_normals[std::size_t(target)];
    return name == "NORMAL" && (frames.normals_generated || is_new);
}

/// Returns the attributes that are not replaced, including those of morph targets; key: accessor.
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
                        [&](std::size_t number) { return mayReferenceVertices(document, primitives[number]); });
        if (names_vertices) {
            elements.sources = frames.source_vertices;
            elements.corners = frames.indices;
        }
        elements.carried = carriedAttributes(primitives, pool, frames);
        // Old vertices keep their indices and come before the new ones.
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
    data.makeNow();  // expands the elements, so that zeros can be omitted in a sparse accessor
    return data;
}

}  // namespace tspace::gltf
