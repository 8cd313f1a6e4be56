// SPDX-License-Identifier: MIT
// The faces of a mesh by their corners, and their normals.
#pragma once

#include <cstdint>

#include "core/memory.h"
#include "core/vec_math.h"
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
    /// The corner after and before a corner on the border of its face.
    [[nodiscard]] std::uint32_t next(std::uint32_t corner) const {
        const std::uint32_t face = of(corner);
        return corner + 1 == past(face) ? first(face) : corner + 1;
    }
    [[nodiscard]] std::uint32_t previous(std::uint32_t corner) const {
        const std::uint32_t face = of(corner);
        return (corner == first(face) ? past(face) : corner) - 1;
    }
    /// Faces of fewer than 3 corners are ignored everywhere.
    [[nodiscard]] bool isUsed(std::uint32_t face) const { return past(face) - first(face) >= 3; }
    [[nodiscard]] std::uint64_t usedCount() const { return used_count_; }

  private:
    std::uint32_t size_ = 0;  ///< of every face; 0: they differ
    std::uint64_t used_count_ = 0;
    Buffer<std::uint32_t> first_corners_, corner_faces_;
};

struct FaceNormal {
    DVec3 unit;         ///< zero for a degenerate face
    double length = 0;  ///< of Newell's sum: twice the face's area; 0 for a degenerate face
};

/// Of the corners from `first` to before `past`; `factor` is normalFactor(convention).
FaceNormal faceNormal(const MeshView& mesh, std::uint32_t first, std::uint32_t past, double factor);

}  // namespace tspace
