// SPDX-License-Identifier: MIT
// Extensions that name vertices by number, after vertices were renumbered or split.
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

/// Whether a primitive or its mesh has an extension that may name vertices.
bool mayNameVertices(const Document& document, const Primitive& primitive);

/// The new vertices of primitives that share vertices and triangles.
struct NewVertices {
    std::span<const std::uint32_t> sources;  ///< the old number of each vertex
    std::span<const std::uint32_t> corners;  ///< three of them per triangle
    std::size_t old_count = 0;
};

/// Carries known extensions over: edges of CESIUM_primitive_outline are renumbered, and feature ids of EXT_mesh_features
/// that are numbers of vertices become an attribute. Other extensions stay as they are, and a warning names them.
class VertexNumbers {
  public:
    VertexNumbers(Document& document, Editor& editor) : document_(document), editor_(editor) {}

    /// `primitives`: all that share these vertices and triangles. Their attributes must be those of the new vertices.
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
    std::map<std::string, std::size_t> left_ = {};  ///< count of primitives, by extension that was not carried over
};

}  // namespace tspace::gltf
