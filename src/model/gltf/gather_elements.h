// SPDX-License-Identifier: MIT
// Copies of an accessor's elements in a new order, for storing as a new accessor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/gltf/accessor.h"
#include "model/gltf/document.h"
#include "model/gltf/document_builder.h"
#include "model/gltf/meshopt_views.h"
#include "model/gltf/primitive_reader.h"
#include "model/io/atomic_output.h"

namespace tspace::gltf {

/// Elements of a new or replaced accessor, tightly packed.
struct ElementData {
    ComponentType component = ComponentType::f32;
    std::string type = "SCALAR";
    bool normalized = false;
    std::size_t count = 0;
    std::size_t element_bytes = 4;
    Bytes bytes = {};
    /// Generates the elements when they are written; `bytes` is empty in this case.
    std::shared_ptr<const ByteMaker> later = {};
    unsigned target = kVertexTarget;
    /// Accessor whose compression the new elements inherit.
    std::optional<std::size_t> like = {};
    bool in_draco = false;  ///< the elements are part of a Draco primitive's data, which the caller stores
    /// Elements before meshopt's `filter` is applied, in rows of a multiple of 4 bytes; empty: only `bytes` exist.
    Bytes unfiltered = {};
    MeshoptFilter filter = MeshoptFilter::none;
    /// If set, `bytes` contains only the elements at these ascending indices, and the other elements (of `count`) are
    /// zero. The accessor is then sparse.
    std::optional<std::vector<std::uint32_t>> places = {};
    Json min = nullptr, max = nullptr;  ///< written unless null

    [[nodiscard]] std::size_t byteCount() const { return later ? later->size() : bytes.size(); }
    void makeNow() {
        if (!later) return;
        bytes = Bytes(later->size());
        later->make(0, bytes);
        later.reset();
    }
};

/// Source vertex of each new vertex: the first `kept` vertices keep their indices, the others are `copies`.
struct SplitSources {
    std::size_t kept = 0;
    std::shared_ptr<const std::vector<std::uint32_t>> copies = {};

    [[nodiscard]] std::size_t size() const { return kept + copies->size(); }
};

/// Elements of split vertices, copied when they are written.
class GatheredBytes final : public ByteMaker {
  public:
    /// Gathers elements at `data`, `stride` apart, which must outlive this object and must not change.
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

/// Returns elements where element i is a copy of old element sources[i]. Bounds are kept, because copying does not
/// change them; the elements are stored in the same form as those of the accessor.
ElementData gatherElements(const Document& document, const Accessor& accessor, std::span<const std::uint32_t> sources);

/// Gathers elements like gatherElements, for split vertices. Elements that are part of the model file's bytes are
/// copied when they are written.
ElementData gatherSplit(const Document& document, const Accessor& accessor, const SplitSources& sources);

/// Updates min and max of float vectors if they exist; removes both if an element is not finite, because JSON cannot
/// represent it.
void renewBounds(ElementData& data);

/// Keeps only the nonzero elements, with their indices, if most are zero and the file becomes smaller.
void makeSparseWhereSmaller(ElementData& data);

/// Returns index lists as elements. u8 and u16 keep their width while all vertex indices are below the primitive
/// restart value.
ElementData indexElements(std::vector<std::uint32_t>&& indices, ComponentType narrowest, std::size_t vertex_count);
/// Returns a primitive's index list as elements that replace its old accessor: with a component type that is no
/// narrower, and with bounds if the old accessor has them.
ElementData newIndices(const Document& document, const Primitive& primitive, std::vector<std::uint32_t>&& indices,
                       std::size_t vertex_count);

}  // namespace tspace::gltf
