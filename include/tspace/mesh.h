// SPDX-License-Identifier: MIT
// The mesh as tspace sees it: spans over the caller's arrays. Nothing is copied or owned.
//
// Words: a *face* is a triangle, quad or n-gon; a *corner* is one (face, local vertex) pair, numbered face after
// face; a *vertex* is one entry of the vertex arrays.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "tspace/result.h"
#include "tspace/span.h"

namespace tspace {

/// Bytes of one index.
enum class IndexType : std::uint32_t {
    none = 0,
    u8 = 1,
    u16 = 2,
    u32 = 4,
    corners = 8,  ///< for MeshView::normal_indices and uv_indices: corner c uses entry c, without a list in memory
};

/// Tightly packed indices, one per corner. With IndexType::none, corner c uses vertex c.
struct IndexView {
    const void* data = nullptr;
    std::size_t count = 0;
    IndexType type = IndexType::none;

    constexpr IndexView() = default;
    constexpr IndexView(const void* d, std::size_t n, IndexType t) : data(d), count(n), type(t) {}
    /// Any contiguous container of 8-, 16- or 32-bit unsigned integers (array, std::vector, std::span); implicit.
    template <class Container>
    requires std::is_constructible_v < std::span<const std::uint8_t>,
    const Container& > || std::is_constructible_v<std::span<const std::uint16_t>, const Container&> ||
        std::is_constructible_v<std::span<const std::uint32_t>, const Container&> constexpr IndexView(
            const Container& list)
        : IndexView(std::data(list), std::size(list), static_cast<IndexType>(sizeof(*std::data(list)))) {}

    /// The vertex of corner c. Not checked.
    [[nodiscard]] std::uint32_t operator[](std::size_t c) const {
        switch (type) {
            case IndexType::u8:
                return static_cast<const std::uint8_t*>(data)[c];
            case IndexType::u16:
                return static_cast<const std::uint16_t*>(data)[c];
            case IndexType::u32:
                return static_cast<const std::uint32_t*>(data)[c];
            case IndexType::none:
            case IndexType::corners:
                break;
        }
        return static_cast<std::uint32_t>(c);
    }
};

/// A mesh. Only positions are always needed; each function says what else it uses. Positions are floats: of doubles
/// far from the origin (metres of a map) subtract an offset in double first, such as the middle of the model, and put
/// it into the model's place; normals and tangents do not depend on it.
struct MeshView {
    StridedSpan<const Vec3> positions = {};  ///< one per vertex
    StridedSpan<const Vec3> normals =
        {};  ///< one per vertex, used as given (see TangentOptions::normalize_normals), or empty
    StridedSpan<const Vec2> uvs = {};  ///< one per vertex, or empty
    IndexView indices = {};            ///< one per corner, or IndexType::none: every corner has its own vertex
    /// Corners of each face. Empty: all faces have `face_size` corners. Faces of 0, 1 or 2 corners are allowed
    /// and ignored: nothing is computed for them.
    std::span<const std::uint32_t> face_sizes = {};
    std::uint32_t face_size = 3;  ///< corners of every face when face_sizes is empty; at least 1
    /// One per corner, into `normals` and `uvs`, which then have any number of entries: FBX, USD, OBJ and Houdini keep
    /// them so. IndexType::none: these attributes have one entry per vertex, and follow `indices`. IndexType::corners:
    /// they have one entry per corner. Corners count as one vertex, as if the mesh had one list, where their three
    /// indices are equal, and for IndexType::corners where the entries have the same bits.
    IndexView normal_indices = {};
    IndexView uv_indices = {};

    [[nodiscard]] std::size_t vertexCount() const { return positions.count; }
    /// Corners of the mesh: the length of results. Not checked: call validate() for that.
    [[nodiscard]] std::size_t cornerCount() const {
        return indices.type == IndexType::none ? positions.count : indices.count;
    }
    /// Faces of the mesh, not checked either.
    [[nodiscard]] std::size_t faceCount() const {
        if (!face_sizes.empty()) return face_sizes.size();
        return face_size == 0 ? 0 : cornerCount() / face_size;
    }
    /// Whether normals or UVs have an index list of their own.
    [[nodiscard]] bool hasOwnLists() const {
        return normal_indices.type != IndexType::none || uv_indices.type != IndexType::none;
    }
};

/// Most corners (and so vertices and indices) that one mesh may have: corner ids are 32 bit with room for marks.
inline constexpr std::size_t kMaxCorners = 0x7fffffff;

/// Checks everything that later code relies on: pointers against counts, equal lengths of vertex arrays, strides,
/// alignment, every index in range, face sizes that add up to the corners (or a corner count that is a multiple
/// of `face_size`), sizes within kMaxCorners. Does not look at the values of floats: those may be anything.
///
/// Every function that takes a MeshView calls this first; call it yourself only to get the error early.
/// Reads every index once; no allocation but for an error's message. Thread-safe.
/// Errors: nullData, countMismatch, indexOutOfRange, strideTooSmall, misaligned, tooLarge, invalidOption.
Result<Done> validate(const MeshView& mesh);

// Cuts quads and n-gons into triangles by one stated rule, so that whoever bakes and whoever renders agree.

/// Triangles of a polygon mesh, as corners of the original mesh (not vertices), so that results per corner carry over.
struct Triangulation {
    std::vector<std::uint32_t> corners = {};  ///< three per triangle, winding kept
    std::vector<std::uint32_t> faces = {};    ///< one per triangle: the face it was cut from
};

/// Cuts every face with 4 or more corners.
///
/// Quads: the diagonal that MikkTSpace takes: the shorter one in UV space; if equal (or without UVs) 1-3 only when
/// it is strictly shorter in space, else 0-2.
/// n-gons: ears are clipped, the ear with the shortest diagonal first (squared length in space; ties by the diagonal
/// in UV space, then by the coordinates of its end points), ears seen in the plane of Newell's normal. The cut
/// depends on the polygon's geometry, not on the vertex it starts with. Where no ear is left (polygon not simple),
/// the shortest diagonal is cut anyway. Above 1024 corners the test that an ear is empty is left out.
/// Faces with fewer than 3 corners give nothing. Triangles come in face order.
/// Errors: those of validate(); outOfMemory. O(corners) for triangles and quads, O(n^2) at most for an n-gon.
Result<Triangulation> triangulate(const MeshView& mesh);

/// The faces that tangents are computed on. glTF has only triangles, but Blender and many bakers compute MikkTSpace on
/// the quads that these were cut from, along another diagonal in part; docs/concepts/quads.md has the whole story.
enum class Faces : std::uint32_t {
    triangles = 0,  ///< the triangles of the file
    quads = 1,      ///< two triangles that follow each other and share an edge are a quad, as far as they look like it
    /// Quads where the file's own tangents show it, or where it has none and Blender wrote it; else triangles.
    automatic = 2,
};
/// "triangles", "quads" or "auto".
const char* facesName(Faces faces);

}  // namespace tspace
