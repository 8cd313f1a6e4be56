// SPDX-License-Identifier: MIT
// Changes to accessors, buffer views and buffers of a document. Array entries are never removed or
// renumbered, because unknown extensions may point at them; what is replaced is re-used where nothing else
// needs it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asset/gltf/accessor.h"
#include "asset/gltf/document.h"
#include "asset/gltf/references.h"

namespace tspace::gltf {

inline constexpr unsigned kVertexTarget = 34962;  // ARRAY_BUFFER
inline constexpr unsigned kIndexTarget = 34963;   // ELEMENT_ARRAY_BUFFER

/// Elements for a new or replaced accessor, tightly packed.
struct ElementData {
    ComponentType component = ComponentType::f32;
    std::string type = "SCALAR";
    bool normalized = false;
    std::size_t count = 0;
    std::size_t element_bytes = 4;
    Bytes bytes = {};
    unsigned target = kVertexTarget;
    Json min = nullptr, max = nullptr;  ///< written unless null
};

class Editor {
  public:
    /// `new_file_name` is the name of the buffer file that new data goes into when there is no better place.
    Editor(Document& document, std::string new_file_name);

    /// How many places of the document refer to an accessor.
    [[nodiscard]] std::size_t accessorUses(std::size_t accessor) const { return accessor_uses_[accessor]; }
    /// One primitive lets go of `from` (if any) and now uses `to`.
    void moveUse(std::optional<std::size_t> from, std::size_t to);

    /// True when the accessor's elements may be overwritten where they are: not sparse, in an own buffer, and
    /// no other accessor, image or extension sees these bytes.
    [[nodiscard]] bool canOverwrite(const Accessor& accessor) const;
    /// Only for float vectors. Bounds are brought up to date where the accessor has them.
    void overwrite(const Accessor& accessor, const Bytes& elements);

    /// Makes an accessor for `data`, whose bytes it takes. `replaces`: an accessor that nothing else uses; its entry is re-used.
    /// Returns its index.
    std::size_t store(ElementData&& data, std::optional<std::size_t> replaces);

    /// JSON of a primitive or accessor, to change it.
    Json& primitive(std::size_t mesh, std::size_t index);
    Json& accessor(std::size_t index);

    /// Cuts out bytes that were left behind and brings lengths up to date. Call once, after all edits.
    void finish();

    [[nodiscard]] bool changed() const { return changed_; }

  private:
    std::size_t targetBuffer();
    std::size_t appendBytes(std::size_t buffer, Bytes bytes, std::size_t element_bytes, std::size_t stride);
    std::size_t storeView(ElementData&& data, std::optional<std::size_t> replaces);
    [[nodiscard]] bool ownsView(const Accessor& accessor) const;

    Document& document_;
    std::string new_file_name_;
    std::optional<std::size_t> target_buffer_;
    std::vector<std::size_t> accessor_uses_;
    std::vector<std::size_t> view_uses_;
    std::vector<Extent> extents_;  ///< as the document was before any edit
    std::vector<ByteRange> vacated_;
    bool changed_ = false;
};

}  // namespace tspace::gltf
