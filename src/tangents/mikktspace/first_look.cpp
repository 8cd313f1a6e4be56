// SPDX-License-Identifier: MIT
// Whether one pass over a mesh is worth it.
#include <algorithm>

#include "core/vec_math.h"
#include "tangents/mikktspace/one_pass.h"

namespace tspace::mikk {

namespace {

/// A sixth of the triangles is enough, since each has three nodes. Measured: meshes with 16 % and more
/// (Ghost.glb, obliterated, crangeract, rancid_geometry) take 8 to 40 % less time without the pass, those
/// with about 10 % (tangeract, Market_495k.glb, doomcone) as long, others more. Where triangles are few,
/// setting up a second look costs as much as the pass: one of them is enough.
constexpr std::size_t kShare = 6;
constexpr std::size_t kTiny = 64, kSmall = 1024, kSmallSample = 16, kSample = 256;  // triangles

class Sampler {
  public:
    Sampler(const MeshView& mesh, const TriangleList& triangles) : mesh_(mesh), triangles_(triangles) {}

    bool run() const {
        const std::size_t count = triangles_.count;
        const std::size_t size = std::min(count, count < kSmall ? kSmallSample : kSample);
        std::size_t found = 0;
        const std::size_t enough = count < kTiny ? 1 : (size + kShare - 1) / kShare;
        for (std::size_t i = 0; i < size && found < enough; ++i) found += makesComplex(count * i / size) ? 1 : 0;
        return found == enough && size != 0;
    }

  private:
    enum class Kind { plain, flat, sheared };

    /// Sheared: dP/du and dP/dv lie less than 45 degrees from a common line (compare kTurnsLeft).
    [[nodiscard]] Kind kindOf(std::size_t triangle) const {
        const auto vertex = [&](std::size_t k) { return mesh_.indices[triangles_.corner(3 * triangle + k)]; };
        const std::uint32_t v[3] = {vertex(0), vertex(1), vertex(2)};
        const Vec2 a = mesh_.uvs[v[1]] - mesh_.uvs[v[0]], b = mesh_.uvs[v[2]] - mesh_.uvs[v[0]];
        if (a.x * b.y == a.y * b.x) return Kind::flat;
        const Vec3 d = mesh_.positions[v[1]] - mesh_.positions[v[0]], e = mesh_.positions[v[2]] - mesh_.positions[v[0]];
        const Vec3 s = b.y * d - a.y * e, t = a.x * e - b.x * d;
        const float along = dot(s, t);
        return along * along > 0.5f * dot(s, s) * dot(t, t) ? Kind::sheared : Kind::plain;
    }

    /// Triangles without UV area make no node complex among themselves.
    [[nodiscard]] bool makesComplex(std::size_t t) const {
        const Kind kind = kindOf(t);
        if (kind != Kind::flat) return kind == Kind::sheared;
        return (t > 0 && kindOf(t - 1) != Kind::flat) || (t + 1 < triangles_.count && kindOf(t + 1) != Kind::flat);
    }

    const MeshView& mesh_;
    const TriangleList& triangles_;
};

}  // namespace

bool mostNodesSeemComplex(const MeshView& mesh, const TriangleList& triangles) {
    return Sampler(mesh, triangles).run();
}

}  // namespace tspace::mikk
