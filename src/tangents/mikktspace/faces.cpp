// SPDX-License-Identifier: MIT
// Step 1: cutting faces into triangles. Triangles stay, quads are cut along the diagonal that MikkTSpace
// takes, n-gons by the rule of triangulate.h.
#include "tangents/mikktspace/faces.h"

#include <algorithm>

#include "core/face_walk.h"
#include "core/polygon.h"
#include "core/vec_math.h"
#include "tangents/mikktspace/grouped_plan.h"

namespace tspace::mikk {

namespace {

bool isUsed(std::uint32_t size, Ngons ngons) {
    return size == 3 || size == 4 || (size > 4 && ngons == Ngons::triangulate);
}

bool allTriangles(const MeshView& mesh) {
    if (mesh.face_sizes.empty()) return mesh.face_size == 3;
    return std::all_of(mesh.face_sizes.begin(), mesh.face_sizes.end(),
                       [](std::uint32_t n) { return n == 3; });
}

/// The reference's choice of diagonal, on the face's own data: the shorter one in UV space; when equal (or
/// NaN) 1-3 only if it is strictly shorter in space.
bool cutsAlong13(const MeshView& mesh, std::size_t corner) {
    Vec3 p[4];
    Vec2 uv[4];
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t vertex = mesh.indices[corner + k];
        p[k] = mesh.positions[vertex];
        uv[k] = mesh.uvs[vertex];
    }
    const Vec2 a = uv[2] - uv[0], b = uv[3] - uv[1];
    const float length_a = a.x * a.x + a.y * a.y, length_b = b.x * b.x + b.y * b.y;
    if (length_a < length_b) return false;
    if (length_b < length_a) return true;
    const Vec3 c = p[2] - p[0], d = p[3] - p[1];
    return dot(d, d) < dot(c, c);
}

class Cutter {
  public:
    Cutter(const MeshView& mesh, const Allocator* allocator, std::uint32_t largest, TriangleList& list)
        : mesh_(mesh),
          list_(list),
          positions_(allocator, largest),
          uvs_(allocator, largest),
          triangles_(allocator, largest == 0 ? 0 : 3 * (std::size_t{largest} - 2)) {}

    void cut(std::size_t face, std::size_t corner, std::uint32_t size) {
        if (size == 3) {
            add(face, corner, 0, 1, 2);
        } else if (size == 4) {
            if (cutsAlong13(mesh_, corner)) {
                add(face, corner, 0, 1, 3);
                add(face, corner, 1, 2, 3);
            } else {
                add(face, corner, 0, 1, 2);
                add(face, corner, 0, 2, 3);
            }
        } else {
            for (std::uint32_t k = 0; k < size; ++k) {
                const std::uint32_t vertex = mesh_.indices[corner + k];
                positions_[k] = mesh_.positions[vertex];
                uvs_[k] = mesh_.uvs[vertex];
            }
            cutPolygon(positions_.data(), uvs_.data(), size, triangles_.data(), scratch_);
            for (std::size_t i = 0; i < 3 * (std::size_t{size} - 2); i += 3) {
                add(face, corner, triangles_[i], triangles_[i + 1], triangles_[i + 2]);
            }
        }
    }

  private:
    void add(std::size_t face, std::size_t corner, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto first = static_cast<std::uint32_t>(corner);
        std::uint32_t* to = list_.corners.data() + 3 * written_;
        to[0] = first + a;
        to[1] = first + b;
        to[2] = first + c;
        list_.faces[written_++] = static_cast<std::uint32_t>(face);
    }

    const MeshView& mesh_;
    TriangleList& list_;
    Buffer<Vec3> positions_;
    Buffer<Vec2> uvs_;
    Buffer<std::uint32_t> triangles_;
    PolygonScratch scratch_;
    std::size_t written_ = 0;
};

}  // namespace

std::uint64_t countTriangles(const MeshView& mesh, Ngons ngons) {
    if (mesh.face_sizes.empty())
        return isUsed(mesh.face_size, ngons) ? std::uint64_t{mesh.faceCount()} * (mesh.face_size - 2) : 0;
    std::uint64_t count = 0;
    for (const std::uint32_t size : mesh.face_sizes) count += isUsed(size, ngons) ? size - 2 : 0;
    return count;
}

TriangleList cutFaces(const MeshView& mesh, Ngons ngons, const Allocator* allocator) {
    TriangleList list;
    list.count = countTriangles(mesh, ngons);
    if (allTriangles(mesh)) return list;
    std::uint64_t skipped = 0;
    std::uint32_t largest = 0;  // of the faces that need cutPolygon
    forEachFace(mesh, [&](std::size_t, std::size_t, std::uint32_t size) {
        if (!isUsed(size, ngons)) {
            skipped += size;
            ++list.skipped_face_count;
        } else if (size > 4) {
            largest = std::max(largest, size);
        }
    });
    list.corners = Buffer<std::uint32_t>(allocator, 3 * list.count);
    list.faces = Buffer<std::uint32_t>(allocator, list.count);
    list.skipped_corners = Buffer<std::uint32_t>(allocator, skipped);
    Cutter cutter(mesh, allocator, largest, list);
    std::size_t skip = 0;
    forEachFace(mesh, [&](std::size_t face, std::size_t corner, std::uint32_t size) {
        if (isUsed(size, ngons)) {
            cutter.cut(face, corner, size);
        } else {
            for (std::uint32_t k = 0; k < size; ++k) {
                list.skipped_corners[skip++] = static_cast<std::uint32_t>(corner + k);
            }
        }
    });
    return list;
}

}  // namespace tspace::mikk
