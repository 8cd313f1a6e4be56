// SPDX-License-Identifier: MIT
// Updates extensions that reference vertices by index after vertices were renumbered or split.
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

/// Returns whether a primitive or its mesh has an extension that may reference vertices.
bool mayReferenceVertices(const Document& document, const Primitive& primitive);

/// New vertices of primitives that share vertices and triangles.
struct NewVertices {
    std::span<const std::uint32_t> sources;  ///< old index of each vertex
    std::span<const std::uint32_t> corners;  ///< three new vertices per triangle
    std::size_t old_count = 0;
};

/// Updates known extensions: edges of CESIUM_primitive_outline are renumbered, and implicit feature IDs of
/// EXT_mesh_features (vertex indices) become an attribute. Other extensions are left unchanged, with a warning that
/// names them.
class VertexNumbers {
  public:
    VertexNumbers(Document& document, Editor& editor) : document_(document), editor_(editor) {}

    /// Updates the extensions of `primitives`: all primitives that share these vertices and triangles. Their attributes
    /// must already be those of the new vertices.
    void carry(std::span<const Primitive* const> primitives, const NewVertices& vertices);
    /// Returns sentences about extensions that could not be updated.
    [[nodiscard]] std::vector<std::string> warnings() const;

  private:
    void carryOutline(std::span<const Primitive* const> primitives, const NewVertices& vertices);
    void carryFeatureIds(std::span<const Primitive* const> primitives, const NewVertices& vertices);
    void noteOthers(const Primitive& primitive);
    [[nodiscard]] std::size_t outlineUses(std::size_t accessor) const;
    Json* extensionOf(const Primitive& primitive, const char* name);

    Document& document_;
    Editor& editor_;
    std::map<std::string, std::size_t> left_ = {};  ///< number of primitives per extension that was not updated
};

}  // namespace tspace::gltf
