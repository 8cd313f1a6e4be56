// SPDX-License-Identifier: MIT
// The primitives of a glTF file: what they consist of, and their geometry as triangles.
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

/// "triangle strip", for people.
const char* modeName(Mode mode);

inline bool hasTriangles(Mode mode) { return mode >= Mode::triangles; }

/// Attribute name -> accessor, in the order of the file.
using AttributeList = std::vector<std::pair<std::string, std::size_t>>;

std::optional<std::size_t> findAttribute(const AttributeList& list, const std::string& name);

/// Whether a morph target can change frames.
inline bool movesFrames(const AttributeList& target) {
    return findAttribute(target, "POSITION").has_value() || findAttribute(target, "NORMAL").has_value();
}

/// A TANGENT that no reader can take for one.
struct UnreadableTangents {
    std::ptrdiff_t target = -1;  ///< index of the morph target; -1: the base primitive
    std::size_t accessor = 0;
    std::string why = {};  ///< "they do not have 4 components"
};

/// An attribute, other than TANGENT, of a type or a number of elements that it cannot have.
struct AttributeFault {
    std::string name = {};
    std::ptrdiff_t target = -1;  ///< morph target that has the attribute; -1: the primitive itself
    std::size_t accessor = 0;
    std::string why = {};  ///< "they do not have 3 components"
    AttributeRepair repair = AttributeRepair::remove;
    std::size_t new_count = 0;  ///< components after AttributeRepair::resize
};

struct Primitive {
    std::uint32_t mesh = 0;
    std::uint32_t index = 0;  ///< in its mesh
    std::string mesh_name = {};
    Mode mode = Mode::triangles;
    std::optional<std::size_t> indices = {};  ///< accessor
    std::optional<std::size_t> material = {};
    AttributeList attributes = {};
    std::vector<AttributeList> targets = {};
    /// Attributes of packed frames that have not one element per vertex; not among `attributes`.
    AttributeList miscounted = {};
    /// Neither among `attributes` nor in `targets`: they count as missing.
    std::vector<UnreadableTangents> unreadable_tangents = {};
    /// Null: none has to be scaled. Primitives with one NORMAL share them.
    std::shared_ptr<const NormalScales> normal_scales = {};
    /// Neither among `attributes` nor in `targets`: they count as missing.
    std::vector<AttributeFault> attribute_faults = {};
    std::size_t vertex_count = 0;
    std::size_t corner_count = 0;  ///< entries of the index list, or vertices

    /// JSON pointer.
    [[nodiscard]] std::string place() const {
        return "/meshes/" + std::to_string(mesh) + "/primitives/" + std::to_string(index);
    }
    /// The accessor of an attribute, if there.
    [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const {
        return findAttribute(attributes, name);
    }
    [[nodiscard]] std::size_t triangleCount() const;
    /// Whether a command can repair all of `attribute_faults`. Otherwise it repairs none of them.
    [[nodiscard]] bool canRepairFaults() const;
};

/// The accessors of the attributes and morph targets, in one order: primitives with one key share all vertices.
std::string vertexKey(const Primitive& primitive);

/// Numbers the vertex lists of a file by the first primitive that uses each. Primitives are given in file order.
class VertexLists {
  public:
    std::uint32_t numberOf(const Primitive& primitive) {
        return numbers_.try_emplace(vertexKey(primitive), count_++).first->second;
    }

  private:
    std::map<std::string, std::uint32_t> numbers_ = {};
    std::uint32_t count_ = 0;  ///< primitives that were given
};

/// All primitives in file order. Attributes that have not one readable element per vertex are set apart, in
/// `miscounted`, `unreadable_tangents` and `attribute_faults`. Looks at the lengths of all normals.
std::vector<Primitive> readPrimitives(const Document& document);

/// Three vertices per triangle in file order; strips and fans as the specification cuts them. Incomplete
/// triangles at the end are left out. Every index is checked.
std::vector<std::uint32_t> readTriangleCorners(const Document& document, const Primitive& primitive);

/// Adds a warning to the document where normals are scaled: at how many vertices of which primitives. Replaces an earlier one.
void warnOfScaledNormals(Document& document, std::span<const Primitive> primitives);

/// One attribute as floats. The attribute must be there. Normals have length 1: see NormalScales.
std::vector<Vec2> readUvs(const Document& document, const Primitive& primitive, std::size_t uv_set);
std::vector<Vec3> readVec3(const Document& document, const Primitive& primitive, const char* attribute);
std::vector<Vec4> readTangents(const Document& document, const Primitive& primitive);
/// Return an attribute without a copy, or nothing if the elements are not plain floats with one stride. Valid while the document's
/// bytes do not move or change. They return nothing for normals that have to be scaled.
std::optional<StridedSpan<const Vec2>> lendUvs(const Document& document, const Primitive& primitive,
                                               std::size_t uv_set);
std::optional<StridedSpan<const Vec3>> lendVec3(const Document& document, const Primitive& primitive,
                                                const char* attribute);
/// Offsets of morph target `target`; empty where it does not move the attribute. Those of normals are scaled as the normals
/// are.
std::vector<Vec3> readOffsets(const Document& document, const Primitive& primitive, std::size_t target,
                              const char* attribute);

/// Multiplies normals, or offsets of normals, by the scales of the primitive.
void scaleNormals(const Primitive& primitive, std::vector<Vec3>& normals);

}  // namespace tspace::gltf
