// SPDX-License-Identifier: MIT
// Mesh data of the caller, as spans over arrays that are neither copied nor owned.
//
// Terms: a *face* is a triangle, quad or n-gon; a *corner* is one (face, local vertex) pair, numbered face after face;
// a *vertex* is one entry of the vertex arrays.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "tspace/result.h"
#include "tspace/span.h"

namespace tspace {

/// Type of an index; the value is its size in bytes.
enum class IndexType : std::uint32_t {
    none = 0,
    u8 = 1,
    u16 = 2,
    u32 = 4,
    /// for MeshView::normal_indices and uv_indices: corner c uses entry c, without an index list in memory
    corners = 8,
};

/// Tightly packed indices, one per corner. With IndexType::none, corner c uses vertex c.
struct IndexView {
    const void* data = nullptr;
    std::size_t count = 0;
    IndexType type = IndexType::none;

    constexpr IndexView() = default;
    constexpr IndexView(const void* d, std::size_t n, IndexType t) : data(d), count(n), type(t) {}
    /// Views any contiguous container of 8-, 16- or 32-bit unsigned integers (array, std::vector, std::span); implicit.
    template <class Container>
    requires std::is_constructible_v < std::span<const std::uint8_t>,
    const Container& > || std::is_constructible_v<std::span<const std::uint16_t>, const Container&> ||
        std::is_constructible_v<std::span<const std::uint32_t>, const Container&> constexpr IndexView(
            const Container& list)
        : IndexView(std::data(list), std::size(list), static_cast<IndexType>(sizeof(*std::data(list)))) {}

    /// Returns the vertex of corner c. Not checked.
    [[nodiscard]] std::uint32_t operator[](std::size_t c) const {
        switch (type) {
            case IndexType::u8: return static_cast<const std::uint8_t*>(data)[c];
            case IndexType::u16: return static_cast<const std::uint16_t*>(data)[c];
            case IndexType::u32: return static_cast<const std::uint32_t*>(data)[c];
            case IndexType::none:
            case IndexType::corners: break;
        }
        return static_cast<std::uint32_t>(c);
    }
};

/// A mesh. Positions are always required; each function lists the other attributes that it uses. Positions are floats:
/// for doubles far from the origin (meters of a map), first subtract an offset in double precision, such as the center
/// of the model, and move it to the model's transform; normals and tangents do not depend on it.
struct MeshView {
    StridedSpan<const Vec3> positions = {};  ///< one per vertex
    StridedSpan<const Vec3> normals =
        {};  ///< one per vertex, used as given (see TangentOptions::normalize_normals), or empty
    StridedSpan<const Vec2> uvs = {};  ///< one per vertex, or empty
    IndexView indices = {};            ///< one per corner, or IndexType::none: every corner has its own vertex
    /// Number of corners of each face. Empty: all faces have `face_size` corners. Faces with 0, 1 or 2 corners are
    /// allowed and ignored.
    std::span<const std::uint32_t> face_sizes = {};
    std::uint32_t face_size = 3;  ///< number of corners of every face if face_sizes is empty; at least 1
    /// Indices per corner into `normals` and `uvs`, which then may have any number of entries, as in FBX, USD, OBJ and
    /// Houdini. IndexType::none: these attributes have one entry per vertex and use `indices`. IndexType::corners: they
    /// have one entry per corner. Corners are welded, as with a single index list, if their three indices are equal,
    /// and for IndexType::corners if the bits of the entries are equal.
    IndexView normal_indices = {};
    IndexView uv_indices = {};

    [[nodiscard]] std::size_t vertexCount() const { return positions.count; }
    /// Returns the number of corners: the length of results. Not checked: call validate() for that.
    [[nodiscard]] std::size_t cornerCount() const {
        return indices.type == IndexType::none ? positions.count : indices.count;
    }
    /// Returns the number of faces. Not checked.
    [[nodiscard]] std::size_t faceCount() const {
        if (!face_sizes.empty()) return face_sizes.size();
        return face_size == 0 ? 0 : cornerCount() / face_size;
    }
    /// Returns whether normals or UVs have their own index list.
    [[nodiscard]] bool hasOwnLists() const {
        return normal_indices.type != IndexType::none || uv_indices.type != IndexType::none;
    }
};

/// Maximum number of corners (and so of vertices and indices) of a mesh: corner IDs are 32-bit with room for flags.
inline constexpr std::size_t kMaxCorners = 0x7fffffff;

/// Checks all preconditions of other functions: pointers against counts, equal lengths of vertex arrays, strides,
/// alignment, index ranges, face sizes that add up to the corners (or a corner count that is a multiple of
/// `face_size`), sizes within kMaxCorners. Does not check the values of floats: any value is allowed.
///
/// Every function that takes a MeshView calls this first; call it directly only to get the error early.
/// Reads every index once; allocates only for an error's message. Thread-safe.
/// Errors: nullData, countMismatch, indexOutOfRange, strideTooSmall, misaligned, tooLarge, invalidOption.
Result<Done> validate(const MeshView& mesh);

// Triangulation of quads and n-gons by a documented rule, so that bakers and renderers agree.

/// Triangles of a polygon mesh, as corners of the original mesh (not vertices), so that per-corner results still apply.
struct Triangulation {
    std::vector<std::uint32_t> corners = {};  ///< three per triangle; winding is preserved
    std::vector<std::uint32_t> faces = {};    ///< one per triangle: its original face
};

/// Triangulates every face with 4 or more corners.
///
/// Quads: the diagonal that MikkTSpace chooses: the shorter one in UV space; if equal (or without UVs), 1-3 only if it
/// is strictly shorter in space, otherwise 0-2.
/// n-gons: ear clipping in the plane of Newell's normal. The ear with the shortest diagonal is clipped first (squared
/// length in space; ties by the diagonal in UV space, then by the coordinates of its end points). The result depends on
/// the polygon's geometry, not on its first vertex. If no ear is left (polygon not simple), the shortest diagonal is
/// cut. Above 1024 corners ears are not tested for emptiness.
/// Faces with fewer than 3 corners produce no triangles. Triangles are in face order.
/// Errors: those of validate(); outOfMemory. O(corners) for triangles and quads, at most O(n^2) for an n-gon.
Result<Triangulation> triangulate(const MeshView& mesh);

/// Faces that tangents are computed on. glTF has only triangles, but Blender and many bakers compute MikkTSpace on the
/// original quads, partly along other diagonals; see docs/concepts/quads.md.
enum class Faces : std::uint32_t {
    triangles = 0,  ///< the triangles of the file
    quads = 1,      ///< two consecutive triangles that share an edge are a quad, if they look like one
    /// Quads if the file's own tangents indicate them, or if it has none and was written by Blender; otherwise
    /// triangles.
    automatic = 2,
};
/// Returns "triangles", "quads" or "auto".
const char* facesName(Faces faces);

}  // namespace tspace
