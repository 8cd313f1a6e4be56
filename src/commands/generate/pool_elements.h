// SPDX-License-Identifier: MIT
// The frames of a pool as elements of accessors: all that can be made without changing the document, and so by several
// threads.
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

/// A reference of a primitive to an accessor.
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
    std::string warning = {};  ///< about what frames were made from; may be empty
    std::size_t vertex_count = 0;
    bool was_split = false;
    bool normals_generated = false, bitangents_generated = false;
    /// After a split: what else the vertices have, by accessor, so that what was shared stays shared; and the index
    /// list of each geometry.
    std::map<std::size_t, CarriedElements> carried = {};
    std::vector<ElementData> indices = {};
    /// After a split, where an extension may name vertices (vertex_numbers.h): the old vertex that each was, and the corners
    /// of each geometry.
    std::vector<std::uint32_t> sources = {};
    std::vector<std::vector<std::uint32_t>> corners = {};
    ElementData normals = {}, tangents = {}, bitangents = {};
    bool has_tangent_deltas = false;       ///< `morphs` has those of tangents
    std::vector<MorphFrames> morphs = {};  ///< as in PoolFrames
    std::uint64_t differing_count = 0;
};

struct PackingRule {
    VectorFormat format = VectorFormat::float32;
    bool is_welded = false;  ///< old vertices are missing or reordered
};

PoolElements packFrames(const Document& document, std::span<const Primitive> primitives, const PoolPlan& pool,
                        PoolFrames&& frames, const PackingRule& rule);

/// Offsets as elements, one for each vertex.
ElementData offsetElements(const VertexOffsets& offsets, std::size_t vertex_count);

}  // namespace tspace::gltf
