// SPDX-License-Identifier: MIT
// Extensions that name vertices by number, where vertices get new numbers or more of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "model/gltf/document.h"
#include "model/gltf/editor.h"
#include "model/gltf/primitive_reader.h"

namespace tspace::gltf {

/// Whether a primitive has an extension, or its mesh has one, that may name its vertices.
bool mayNameVertices(const Document& document, const Primitive& primitive);

/// The vertices of primitives that draw the same triangles, as they are now.
struct NewVertices {
    std::span<const std::uint32_t> sources;  ///< the old vertex that each was
    std::span<const std::uint32_t> corners;  ///< three of them per triangle
    std::size_t old_count = 0;
};

/// Carries over what is known: edges of CESIUM_primitive_outline stay edges of triangles, and feature ids of
/// EXT_mesh_features that are numbers of vertices become an attribute. Other extensions stay as they are, and a warning
/// names them.
class VertexNumbers {
  public:
    VertexNumbers(Document& document, Editor& editor) : document_(document), editor_(editor) {}

    /// All that have these very vertices and triangles. Their attributes are those of the new vertices already.
    void carry(std::span<const Primitive* const> primitives, const NewVertices& vertices);
    /// Sentences about what could not be carried over.
    [[nodiscard]] std::vector<std::string> warnings() const;

  private:
    void carryOutline(std::span<const Primitive* const> primitives, const NewVertices& vertices);
    void carryFeatureIds(std::span<const Primitive* const> primitives, const NewVertices& vertices);
    void noteOthers(const Primitive& primitive);
    [[nodiscard]] std::size_t outlineUses(std::size_t accessor) const;
    Json* extensionOf(const Primitive& primitive, const char* name);

    Document& document_;
    Editor& editor_;
    std::map<std::string, std::size_t> left_ = {};  ///< primitives by the extension that was not carried over
};

}  // namespace tspace::gltf
