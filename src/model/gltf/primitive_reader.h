// SPDX-License-Identifier: MIT
// Primitives of a glTF file: their contents, and their geometry as triangles.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/gltf/accessor.h"
#include "model/gltf/document.h"
#include "model/scene/scene.h"
#include "tspace/span.h"

namespace tspace::gltf {

enum class Mode : std::uint32_t {
    points = 0,
    lines = 1,
    lineLoop = 2,
    lineStrip = 3,
    triangles = 4,
    triangleStrip = 5,
    triangleFan = 6
};

/// Returns a readable name of the mode, such as "triangle strip".
const char* modeName(Mode mode);

inline bool hasTriangles(Mode mode) { return mode >= Mode::triangles; }

/// Pairs of attribute name and accessor, in file order.
using AttributeList = std::vector<std::pair<std::string, std::size_t>>;

std::optional<std::size_t> findAttribute(const AttributeList& list, const std::string& name);

/// Returns whether a morph target can change frames.
inline bool movesFrames(const AttributeList& target) {
    return findAttribute(target, "POSITION").has_value() || findAttribute(target, "NORMAL").has_value();
}

/// TANGENT attribute that no reader can interpret.
struct UnreadableTangents {
    std::ptrdiff_t target = -1;  ///< index of the morph target; -1: the base primitive
    std::size_t accessor = 0;
    std::string why = {};  ///< reason, such as "they do not have 4 components"
};

/// Attribute other than TANGENT with an invalid type or number of elements.
struct AttributeFault {
    std::string name = {};
    std::ptrdiff_t target = -1;  ///< index of the morph target that has the attribute; -1: the primitive itself
    std::size_t accessor = 0;
    std::string why = {};  ///< reason, such as "they do not have 3 components"
    AttributeRepair repair = AttributeRepair::remove;
    std::size_t new_count = 0;  ///< number of components after AttributeRepair::resize
};

struct Primitive {
    std::uint32_t mesh = 0;
    std::uint32_t index = 0;  ///< index within its mesh
    std::string mesh_name = {};
    Mode mode = Mode::triangles;
    std::optional<std::size_t> indices = {};  ///< accessor of the indices
    std::optional<std::size_t> material = {};
    AttributeList attributes = {};
    std::vector<AttributeList> targets = {};
    /// Attributes of packed frames whose number of elements differs from the number of vertices; not contained in
    /// `attributes`.
    AttributeList miscounted = {};
    /// Invalid tangents; not contained in `attributes` or `targets`, and treated as missing.
    std::vector<UnreadableTangents> unreadable_tangents = {};
    /// Scales that give normals unit length; null: none needed. Primitives with the same NORMAL share them.
    std::shared_ptr<const NormalScales> normal_scales = {};
    /// Normals without a direction; null: none. Primitives with the same NORMAL share them.
    std::shared_ptr<const InvalidNormals> invalid_normals = {};
    /// Invalid attributes; not contained in `attributes` or `targets`, and treated as missing.
    std::vector<AttributeFault> attribute_faults = {};
    std::size_t vertex_count = 0;
    std::size_t corner_count = 0;  ///< number of indices; without indices, number of vertices

    /// Returns the JSON pointer.
    [[nodiscard]] std::string place() const {
        return "/meshes/" + std::to_string(mesh) + "/primitives/" + std::to_string(index);
    }
    /// Returns the accessor of an attribute, or nullopt.
    [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const {
        return findAttribute(attributes, name);
    }
    [[nodiscard]] std::size_t triangleCount() const;
    /// Returns whether a command can repair all of `attribute_faults`. Otherwise it repairs none of them.
    [[nodiscard]] bool canRepairFaults() const;
};

/// Returns the accessors of all attributes and morph targets in a canonical order: primitives with equal keys share all
/// vertices.
std::string vertexKey(const Primitive& primitive);

/// Numbers the vertex lists of a file by the first primitive that uses each. Primitives must be given in file order.
class VertexLists {
  public:
    std::uint32_t numberOf(const Primitive& primitive) {
        return numbers_.try_emplace(vertexKey(primitive), count_++).first->second;
    }

  private:
    std::map<std::string, std::uint32_t> numbers_ = {};
    std::uint32_t count_ = 0;  ///< number of primitives given so far
};

/// Reads all primitives in file order. Attributes without exactly one readable element per vertex are moved to
/// `miscounted`, `unreadable_tangents` and `attribute_faults`. Checks the lengths of all normals.
std::vector<Primitive> readPrimitives(const Document& document);

/// Returns three vertices per triangle in file order; strips and fans are split as the specification defines.
/// Incomplete triangles at the end are skipped. Every index is checked.
std::vector<std::uint32_t> readTriangleCorners(const Document& document, const Primitive& primitive);

/// Beginning of the warning about normals without a direction.
inline constexpr const char* kInvalidNormals = "normals of length 0, NaN or infinite";

/// Adds a warning to the document if normals are scaled, and one if triangles use normals without a direction, with the
/// number of vertices and the primitives. Replaces earlier warnings.
void warnOfNormals(Document& document, std::span<const Primitive> primitives);

/// Returns whether a triangle uses a normal without a direction.
bool usesInvalidNormals(const Document& document, const Primitive& primitive);

/// Read one attribute as floats. The attribute must exist. Normals have length 1: see NormalScales.
std::vector<Vec2> readUvs(const Document& document, const Primitive& primitive, std::size_t uv_set);
std::vector<Vec3> readVec3(const Document& document, const Primitive& primitive, const char* attribute);
std::vector<Vec4> readTangents(const Document& document, const Primitive& primitive);
/// Return an attribute without copying it, or nullopt if its elements are not plain floats with one stride. The result
/// is valid until the document's bytes move or change. Normals that have to be scaled are not returned.
std::optional<StridedSpan<const Vec2>> lendUvs(const Document& document, const Primitive& primitive,
                                               std::size_t uv_set);
std::optional<StridedSpan<const Vec3>> lendVec3(const Document& document, const Primitive& primitive,
                                                const char* attribute);
/// Returns the offsets of morph target `target`; empty if it does not change the attribute. Offsets of normals are
/// scaled like the normals.
std::vector<Vec3> readOffsets(const Document& document, const Primitive& primitive, std::size_t target,
                              const char* attribute);

/// Multiplies normals, or morph offsets of normals, by the normal scales of the primitive.
void scaleNormals(const Primitive& primitive, std::vector<Vec3>& normals);

}  // namespace tspace::gltf
