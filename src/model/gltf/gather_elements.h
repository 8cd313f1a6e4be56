// SPDX-License-Identifier: MIT
// Copies of an accessor's elements in new numbers, to be stored anew.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/pools/primitive.h"
#include "model/gltf/editor.h"
#include "model/gltf/generate_plan.h"
#include "model/io/atomic_output.h"

namespace tspace::gltf {

/// The old vertex of each new one: the first `kept` keep their numbers, the others are `copies`.
struct SplitSources {
    std::size_t kept = 0;
    std::shared_ptr<const std::vector<std::uint32_t>> copies = {};

    [[nodiscard]] std::size_t size() const { return kept + copies->size(); }
};

/// Elements of split vertices, copied when they are written.
class GatheredBytes final : public ByteMaker {
  public:
    /// Elements at `data`, `stride` apart. They must outlive this and stay as they are.
    GatheredBytes(const std::uint8_t* data, std::size_t stride, std::size_t element_bytes, SplitSources sources)
        : data_(data), stride_(stride), element_bytes_(element_bytes), sources_(std::move(sources)) {}

    [[nodiscard]] std::size_t size() const override { return sources_.size() * element_bytes_; }
    void make(std::size_t begin, std::span<std::uint8_t> to) const override;

  private:
    [[nodiscard]] const std::uint8_t* at(std::size_t element) const {
        return data_ + stride_ * (element < sources_.kept ? element : (*sources_.copies)[element - sources_.kept]);
    }

    const std::uint8_t* data_;
    std::size_t stride_, element_bytes_;
    SplitSources sources_;
};

/// Element i is a copy of old element sources[i]. Bounds stay, because copies change none; the elements are to be
/// stored in the form that the accessor's have.
ElementData gatherElements(const Document& document, const Accessor& accessor, std::span<const std::uint32_t> sources);

/// gatherElements for split vertices. Elements that lie in the model file's own bytes are copied when they are written.
ElementData gatherSplit(const Document& document, const Accessor& accessor, const SplitSources& sources);

/// Brings min and max of float vectors up to date, where there are any; both go when an element is not finite, because
/// JSON has no such number.
void renewBounds(ElementData& data);

/// Keeps only the elements that are not zero, with their places, where most are zero and the file becomes smaller.
void makeSparseWhereSmaller(ElementData& data);

// The frames of a pool as elements of accessors: all that can be made without changing the document, and so by several
// threads.

inline constexpr std::ptrdiff_t kBase = -1;  ///< in place of a morph target: the attributes themselves

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
    std::vector<MorphFrames> morphs = {};  ///< as in PoolFrames, like the next one
    std::uint64_t differing_count = 0;
};

struct PackingRule {
    VectorFormat format = VectorFormat::float32;
    bool is_welded = false;  ///< not all old vertices are there, or not in their order
};

PoolElements packFrames(const Document& document, std::span<const Primitive> primitives, const PoolPlan& pool,
                        PoolFrames&& frames, const PackingRule& rule);

/// Numbers of vertices. u8 and u16 keep their width while every vertex fits below the primitive restart value.
/// The same, as a primitive has its old list: no narrower, and with bounds if that has some.
ElementData newIndices(const Document& document, const Primitive& primitive, std::vector<std::uint32_t>&& indices,
                       std::size_t vertex_count);
ElementData indexElements(std::vector<std::uint32_t>&& indices, ComponentType narrowest, std::size_t vertex_count);

/// Offsets as elements, one for each vertex.
ElementData offsetElements(const VertexOffsets& offsets, std::size_t vertex_count);

}  // namespace tspace::gltf
