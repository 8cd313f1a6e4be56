// SPDX-License-Identifier: MIT
// Copies of an accessor's elements in new numbers, to be stored anew.
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

/// Elements for a new or replaced accessor, tightly packed.
struct ElementData {
    ComponentType component = ComponentType::f32;
    std::string type = "SCALAR";
    bool normalized = false;
    std::size_t count = 0;
    std::size_t element_bytes = 4;
    Bytes bytes = {};
    std::shared_ptr<const ByteMaker> later = {};  ///< makes the elements when they are written; `bytes` is then empty
    unsigned target = kVertexTarget;
    /// The accessor whose compression the new elements get.
    std::optional<std::size_t> like = {};
    bool in_draco = false;  ///< they lie in data of a Draco primitive, which the caller stores
    /// The elements before meshopt's `filter`, in rows of a multiple of 4 bytes; empty: only `bytes` exist.
    Bytes unfiltered = {};
    MeshoptFilter filter = MeshoptFilter::none;
    /// If set, `bytes` holds only the elements at these ascending indices, and all others of the `count` are zero: they are
    /// stored as a sparse accessor.
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

/// Index lists as elements. u8 and u16 keep their width while every vertex fits below the primitive restart value.
ElementData indexElements(std::vector<std::uint32_t>&& indices, ComponentType narrowest, std::size_t vertex_count);
/// The index list of a primitive in place of its old one: no narrower, and with bounds if that has some.
ElementData newIndices(const Document& document, const Primitive& primitive, std::vector<std::uint32_t>&& indices,
                       std::size_t vertex_count);

}  // namespace tspace::gltf
