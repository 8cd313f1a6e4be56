// SPDX-License-Identifier: MIT
// Changes to accessors, buffer views and buffers of a document. Array entries are never removed or
// renumbered, because unknown extensions may point at them; entries that lose their last use are re-used.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "model/gltf/accessor.h"
#include "model/gltf/document.h"
#include "model/gltf/document_builder.h"
#include "model/gltf/gather_elements.h"
#include "model/gltf/meshopt_views.h"
#include "model/gltf/references.h"

namespace tspace::gltf {

class Editor {
  public:
    /// `new_file_name` is the name of the buffer file that new data goes into when there is no better place.
    Editor(Document& document, std::string new_file_name);

    /// Number of references to an accessor in the document.
    [[nodiscard]] std::size_t accessorUses(std::size_t accessor) const { return accessor_uses_[accessor]; }
    /// Moves one primitive's use from `from` (if any) to `to`.
    void moveUse(std::optional<std::size_t> from, std::size_t to);

    /// Drops one primitive's use of an accessor. After the last use the data is freed; its entry stays as one zero, and
    /// the entry of an unused view as one byte.
    void release(std::size_t accessor);

    /// True when the accessor's elements may be overwritten where they are: not sparse, in an own buffer, and
    /// no other accessor, image or extension sees these bytes.
    [[nodiscard]] bool canOverwrite(const Accessor& accessor) const;
    /// Elements of the accessor's own format. Bounds of floats are brought up to date where the accessor has them; of
    /// others they are removed.
    void overwrite(const Accessor& accessor, const Bytes& elements);

    /// Makes an accessor for `data`, whose bytes it takes. `replaces`: an accessor that nothing else uses; its entry is
    /// re-used. Returns its index.
    std::size_t store(ElementData&& data, std::optional<std::size_t> replaces);

    /// Stores bytes in a view without a target and returns its index; `replaces`: a view that only the caller uses.
    std::size_t storeBlob(Bytes data, std::optional<std::size_t> replaces);
    /// Drops one reference to a view.
    void letGoOfView(std::size_t view);
    /// Removes the meshopt extension of a view, whose plain bytes are then stored in the file.
    void unpackView(std::size_t view);
    /// Has the first `byte_count` bytes of a plain view encoded by EXT_meshopt_compression; zeros follow where it has
    /// fewer.
    void packView(std::size_t view, std::size_t byte_count, std::size_t stride, bool is_indices);

    /// Adds the extension to extensionsUsed and extensionsRequired.
    void require(const char* extension);

    /// JSON of a primitive or accessor, for editing.
    Json& primitive(std::size_t mesh, std::size_t index);
    Json& accessor(std::size_t index);

    /// Encodes views and Draco primitives that changed, cuts out freed bytes, and updates lengths. Call once, after all
    /// edits.
    void finish();

    [[nodiscard]] bool changed() const { return changed_; }
    /// Notes a change that the caller made to the document.
    void touch() { changed_ = true; }

  private:
    /// How elements are stored: in the data of Draco primitives; or the meshopt extension of their view, and the
    /// decoded buffer that the view lies in.
    struct Form {
        bool is_draco = false;
        const char* meshopt = nullptr;
        std::optional<std::size_t> decoded_buffer = {};
    };
    [[nodiscard]] Form formLike(std::optional<std::size_t> accessor) const;
    std::size_t targetBuffer();
    std::size_t appendBytes(std::size_t buffer, Bytes bytes, std::size_t element_bytes, std::size_t stride);
    /// These move the bytes out of `data`; its description stays.
    std::size_t storeView(ElementData& data, const Form& form);
    Json storeSparse(ElementData& data);
    std::size_t newView();
    std::size_t fallbackBuffer();
    /// Drops one reference to a view and frees its bytes from `begin` to `end`. A view without references is spare.
    void letGo(std::size_t view, std::size_t begin, std::size_t end);
    void letGoOf(const Accessor& old);
    void shrinkView(std::size_t view);

    Document& document_;
    std::string new_file_name_;
    std::optional<std::size_t> target_buffer_, fallback_buffer_;
    std::vector<std::size_t> accessor_uses_;
    std::vector<std::size_t> view_uses_;
    std::vector<Extent> extents_;  ///< extents before any edit
    std::vector<ByteRange> vacated_;
    std::vector<std::size_t> spare_views_;             ///< entries that nothing uses any more
    std::map<std::size_t, MeshoptRequest> to_encode_;  ///< by view
    std::set<std::size_t> changed_accessors_;
    bool changed_ = false;
};

}  // namespace tspace::gltf
