// SPDX-License-Identifier: MIT
// The faces of a mesh by their corners, and their normals.
#pragma once

#include <cstdint>

#include "core/base/memory.h"
#include "core/base/range_lists.h"
#include "core/base/vec_math.h"
#include "tspace/mesh.h"

namespace tspace {

/// Faces of one size need no table; otherwise 4 bytes per corner and face.
class Faces {
  public:
    Faces(const MeshView& mesh, const Allocator* allocator);

    /// The face of a corner, the first corner of a face, and the one after its last.
    [[nodiscard]] std::uint32_t of(std::uint32_t corner) const {
        return size_ == 3 ? corner / 3 : size_ != 0 ? corner / size_ : corner_faces_[corner];
    }
    [[nodiscard]] std::uint32_t first(std::uint32_t face) const {
        return size_ != 0 ? face * size_ : first_corners_[face];
    }
    [[nodiscard]] std::uint32_t past(std::uint32_t face) const { return first(face + 1); }
    struct Around {
        std::uint32_t corners[3];  ///< a corner, the one after it on the border of its face and the one before
    };
    [[nodiscard]] Around around(std::uint32_t corner) const {
        const std::uint32_t face = of(corner), begin = first(face), end = past(face);
        return {{corner, corner + 1 == end ? begin : corner + 1, (corner == begin ? end : corner) - 1}};
    }
    [[nodiscard]] std::uint32_t next(std::uint32_t corner) const { return around(corner).corners[1]; }
    [[nodiscard]] std::uint32_t previous(std::uint32_t corner) const { return around(corner).corners[2]; }
    /// Faces of fewer than 3 corners are ignored everywhere.
    [[nodiscard]] bool isUsed(std::uint32_t face) const { return past(face) - first(face) >= 3; }
    [[nodiscard]] std::uint64_t usedCount() const { return used_count_; }

  private:
    std::uint32_t size_ = 0;  ///< of every face; 0: they differ
    std::uint64_t used_count_ = 0;
    Buffer<std::uint32_t> first_corners_, corner_faces_;
};

/// What is listed by points: triangles, or for other faces each corner for itself.
class PointItems final : public TriangleGroups {
  public:
    /// `points`: of each vertex; empty when each is its own.
    PointItems(const MeshView& mesh, const Faces& faces, const Buffer<std::uint32_t>& points,
               const Allocator* allocator);

    static bool areTriangles(const MeshView& mesh) { return mesh.face_sizes.empty() && mesh.face_size == 3; }

    [[nodiscard]] std::uint32_t pointOf(std::uint32_t corner) const {
        const std::uint32_t vertex = mesh_.indices[corner];
        return points_.empty() ? vertex : points_[vertex];
    }
    /// A corner comes with the next and the previous one, and its own point three times; those of faces with fewer than
    /// 3 corners have none.
    void read(std::size_t first, std::size_t size, std::uint32_t* vertices, std::uint32_t* points) const override;
    void readSome(const std::uint32_t* numbers, std::size_t size, std::uint32_t* vertices,
                  std::uint32_t* points) const override;
    [[nodiscard]] const std::uint32_t* inPlace(std::size_t first, std::size_t) const override;

  private:
    template <class NumberOf>
    void readEach(NumberOf numberOf, std::size_t size, std::uint32_t* vertices, std::uint32_t* points) const;

    enum Block : std::uint8_t { unknown, own, shared };  // own: each vertex is its own point

    const MeshView& mesh_;
    const Faces& faces_;
    const Buffer<std::uint32_t>& points_;
    const std::uint32_t* in_place_;  ///< the indices; null where they are not triangles of 32-bit numbers
    /// Of blocks, when somebody has asked. Nearly all are `own` where triangles lie close together, and comparing once
    /// is cheaper than looking points up in each pass.
    mutable Buffer<std::uint8_t> blocks_;
};

/// The normal of a face times `size`, and `size`: zeros if it is degenerate.
struct FaceRow {
    double x, y, z, size;

    [[nodiscard]] bool isDegenerate() const { return size == 0; }
    [[nodiscard]] DVec3 unit() const { return (1 / size) * DVec3{x, y, z}; }
};

/// By Newell's sum over the corners from `first` to before `past`. size: its length, twice the area, if that is a
/// weight, else 1. `factor` is normalFactor(convention).
FaceRow faceRow(const MeshView& mesh, std::uint32_t first, std::uint32_t past, double factor, bool by_area);

}  // namespace tspace
