// SPDX-License-Identifier: MIT
// Edits accessors, buffer views and buffers of a document. Array entries are never removed or renumbered, because
// unknown extensions may reference them; entries without uses are reused.
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
    /// `new_file_name`: name of the buffer file for new data if no existing buffer can hold it.
    Editor(Document& document, std::string new_file_name);

    /// Returns the number of references to an accessor in the document.
    [[nodiscard]] std::size_t accessorUses(std::size_t accessor) const { return accessor_uses_[accessor]; }
    /// Moves one primitive's use from `from` (if any) to `to`.
    void moveUse(std::optional<std::size_t> from, std::size_t to);

    /// Drops one primitive's use of an accessor. After the last use the data is freed; the accessor entry remains with
    /// a single zero, and an unused view entry with one byte.
    void release(std::size_t accessor);

    /// Returns whether the accessor's elements may be overwritten in place: it is not sparse, is in a buffer that the
    /// output owns, and shares no bytes with another accessor, image or extension.
    [[nodiscard]] bool canOverwrite(const Accessor& accessor) const;
    /// Overwrites elements, given in the accessor's format. Existing bounds of floats are updated; bounds of other
    /// types are removed.
    void overwrite(const Accessor& accessor, const Bytes& elements);

    /// Creates an accessor for `data`, whose bytes are moved. `replaces`: an accessor without other uses, whose entry
    /// is reused. Returns the index.
    std::size_t store(ElementData&& data, std::optional<std::size_t> replaces);

    /// Stores bytes in a view without a target and returns its index; `replaces`: a view that only the caller uses.
    std::size_t storeBlob(Bytes data, std::optional<std::size_t> replaces);
    /// Drops one reference to a view.
    void releaseView(std::size_t view);
    /// Removes the meshopt extension of a view; the file then stores its decoded bytes.
    void unpackView(std::size_t view);
    /// Requests meshopt encoding (EXT_meshopt_compression) of the first `byte_count` bytes of an uncompressed view,
    /// padded with zeros if it is shorter.
    void packView(std::size_t view, std::size_t byte_count, std::size_t stride, bool is_indices);

    /// Adds the extension to extensionsUsed and extensionsRequired.
    void require(const char* extension);

    /// Returns the JSON of a primitive or accessor, for editing.
    Json& primitive(std::size_t mesh, std::size_t index);
    Json& accessor(std::size_t index);

    /// Encodes changed views and Draco primitives, removes freed bytes, and updates lengths. Must be called once, after
    /// all edits.
    void finish();

    [[nodiscard]] bool changed() const { return changed_; }
    /// Marks the document as changed by the caller.
    void touch() { changed_ = true; }

  private:
    /// Storage form of elements: data of Draco primitives, or the meshopt extension of their view together with the
    /// decoded buffer of that view.
    struct Form {
        bool is_draco = false;
        const char* meshopt = nullptr;
        std::optional<std::size_t> decoded_buffer = {};
    };
    [[nodiscard]] Form formLike(std::optional<std::size_t> accessor) const;
    std::size_t targetBuffer();
    std::size_t appendBytes(std::size_t buffer, Bytes bytes, std::size_t element_bytes, std::size_t stride);
    /// Store elements, moving the bytes out of `data`; its description stays valid.
    std::size_t storeView(ElementData& data, const Form& form);
    Json storeSparse(ElementData& data);
    std::size_t newView();
    std::size_t fallbackBuffer();
    /// Drops one reference to a view and frees its bytes from `begin` to `end`. A view without references becomes
    /// spare.
    void releaseRange(std::size_t view, std::size_t begin, std::size_t end);
    void freeAccessorData(const Accessor& old);
    void shrinkView(std::size_t view);

    Document& document_;
    std::string new_file_name_;
    std::optional<std::size_t> target_buffer_, fallback_buffer_;
    std::vector<std::size_t> accessor_uses_;
    std::vector<std::size_t> view_uses_;
    std::vector<Extent> extents_;  ///< extents before any edit
    std::vector<ByteRange> vacated_;
    std::vector<std::size_t> spare_views_;             ///< indices of views without uses, which are reused
    std::map<std::size_t, MeshoptRequest> to_encode_;  ///< views to encode with meshopt; key: view index
    std::set<std::size_t> changed_accessors_;
    bool changed_ = false;
};

}  // namespace tspace::gltf
