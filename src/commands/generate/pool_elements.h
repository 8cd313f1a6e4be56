// SPDX-License-Identifier: MIT
// Frames of a pool as elements of accessors: everything that can be prepared without changing the document, and
// therefore in parallel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "commands/generate/edit_attributes.h"
#include "commands/generate/generate_plan.h"
#include "core/mesh/pools/primitive.h"
#include "model/gltf/gather_elements.h"

namespace tspace::gltf {

/// A primitive's reference to an accessor.
struct AttributeSlot {
    std::size_t primitive = 0;
    std::ptrdiff_t target = kBase;
    std::string name = {};
};

struct CarriedElements {
    std::vector<AttributeSlot> users = {};
    ElementData data = {};
};

struct PoolElements {
    std::string warning = {};  ///< warning about the input of the computation, or empty
    std::size_t vertex_count = 0;
    bool was_split = false;
    bool normals_generated = false, bitangents_generated = false;
    /// Set after a split: the other attributes of the vertices (key: accessor, so that shared accessors stay shared),
    /// and the index list of each geometry.
    std::map<std::size_t, CarriedElements> carried = {};
    std::vector<ElementData> indices = {};
    /// The old index of each vertex, and the corners of each geometry. Set after a split if an extension may contain
    /// vertex indices (see vertex_numbers.h).
    std::vector<std::uint32_t> sources = {};
    std::vector<std::vector<std::uint32_t>> corners = {};
    ElementData normals = {}, tangents = {}, bitangents = {};
    bool has_tangent_deltas = false;       ///< `morphs` contains tangent deltas
    std::vector<MorphFrames> morphs = {};  ///< offsets of each morph target, see PoolFrames
    std::uint64_t differing_count = 0;
};

struct PackingRule {
    VectorFormat format = VectorFormat::float32;
    bool is_welded = false;  ///< vertices were merged, so old vertices are missing or reordered
};

PoolElements packFrames(const Document& document, std::span<const Primitive> primitives, const PoolPlan& pool,
                        PoolFrames&& frames, const PackingRule& rule);

/// Returns offsets as elements, one for each vertex.
ElementData offsetElements(const VertexOffsets& offsets, std::size_t vertex_count);

}  // namespace tspace::gltf
