// SPDX-License-Identifier: MIT
// Candidates are found triangle by triangle; which of them become quads is a choice of most gain along each run.
#include "core/mesh/quads/quad_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/unit.h"
#include "core/base/vec_math.h"

namespace tspace {

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// Vertices that are one corner of a quad.
class SameVertex {
  public:
    SameVertex(const MeshView& mesh, std::span<const Vec4> tangents) : mesh_(mesh), tangents_(tangents) {}
    bool operator()(std::uint32_t a, std::uint32_t b) const {
        if (a == b) return true;
        return mesh_.positions[a] == mesh_.positions[b] &&
               (mesh_.normals.empty() || mesh_.normals[a] == mesh_.normals[b]) &&
               (mesh_.uvs.empty() || mesh_.uvs[a] == mesh_.uvs[b]) &&
               (tangents_.empty() || tangents_[a] == tangents_[b]);
    }

  private:
    const MeshView& mesh_;
    std::span<const Vec4> tangents_;
};

Corners verticesOf(const MeshView& mesh, std::size_t triangle) {
    return {mesh.indices[3 * triangle], mesh.indices[3 * triangle + 1], mesh.indices[3 * triangle + 2]};
}

/// Unit, or zero where the triangle has no area.
DVec3 normalOf(const MeshView& mesh, const Corners& v) {
    const DVec3 a = toDouble(mesh.positions[v[0]]);
    DVec3 normal = cross(toDouble(mesh.positions[v[1]]) - a, toDouble(mesh.positions[v[2]]) - a);
    return normalize(normal) ? normal : DVec3{};
}

std::uint8_t seamOf(const MeshView& mesh, const SameVertex& same, const Corners& a, const Corners& b) {
    std::uint8_t seam = 0;
    for (unsigned i = 0; i < 3; ++i) {
        for (unsigned k = 0; k < 3; ++k) {
            if (!same(a[i], b[(k + 1) % 3]) || !same(a[(i + 1) % 3], b[k])) continue;
            if (seam != 0) return 0;  // the same triangle from both sides, or one without area
            seam = static_cast<std::uint8_t>(1 + 3 * i + k);
        }
    }
    if (seam == 0) return 0;
    // Triangles without area fold nowhere.
    return dot(normalOf(mesh, a), normalOf(mesh, b)) < 0 ? std::uint8_t{0} : seam;
}

/// 1 for a rectangle, 0 where all corners are straight or gone.
double squareness(const MeshView& mesh, const std::uint32_t quad[4]) {
    std::array<DVec3, 4> edges;
    for (unsigned k = 0; k < 4; ++k) {
        edges[k] =
            toDouble(mesh.positions[mesh.indices[quad[(k + 1) % 4]]]) - toDouble(mesh.positions[mesh.indices[quad[k]]]);
        if (!normalize(edges[k])) return 0;
    }
    double sum = 0;
    for (unsigned k = 0; k < 4; ++k) sum += std::fabs(dot(edges[k], edges[(k + 1) % 4]));
    return 1 - sum / 4;
}

}  // namespace

QuadCandidates::QuadCandidates(const MeshView& triangles, std::span<const Vec4> tangents) {
    const std::size_t count = triangles.cornerCount() / 3;
    seams_.assign(count, 0);
    const SameVertex same(triangles, tangents);
    for (std::size_t t = 0; t + 1 < count; ++t) {
        seams_[t] = seamOf(triangles, same, verticesOf(triangles, t), verticesOf(triangles, t + 1));
        count_ += seams_[t] != 0;
    }
}

void QuadCandidates::cornersOf(std::size_t t, bool is_turned, std::uint32_t quad[4]) const {
    const std::size_t first = 3 * t, second = first + 3, i = patternOf(t) / 3, k = patternOf(t) % 3;
    const std::array<std::size_t, 4> corners = {first + (i + 1) % 3, first + (i + 2) % 3, first + i,
                                                second + (k + 2) % 3};
    for (unsigned n = 0; n < 4; ++n) quad[n] = static_cast<std::uint32_t>(corners[(n + (is_turned ? 1 : 0)) % 4]);
}

QuadPairs choosePairs(const QuadCandidates& candidates, std::span<const float> gains) {
    const std::size_t count = candidates.triangleCount();
    QuadPairs pairs(count, PairKind::none);
    if (count < 2) return pairs;
    // From the end, so that of equal sums the earlier pair is taken: most[t] is what triangles t and later can gain.
    std::vector<double> most(count + 1, 0);
    for (std::size_t t = count - 1; t-- > 0;) {
        most[t] = most[t + 1];
        if (candidates.has(t) && gains[t] > 0) most[t] = std::max(most[t], gains[t] + most[t + 2]);
    }
    for (std::size_t t = 0; t + 1 < count; ++t) {
        if (!candidates.has(t) || !(gains[t] > 0) || gains[t] + most[t + 2] < most[t]) continue;
        pairs[t++] = PairKind::quad;
    }
    return pairs;
}

QuadPairs pairsByShape(const MeshView& triangles, const QuadCandidates& candidates) {
    std::array<std::size_t, 9> pattern_counts = {};
    for (std::size_t t = 0; t < candidates.triangleCount(); ++t) {
        if (candidates.has(t)) ++pattern_counts[candidates.patternOf(t)];
    }
    const auto most = static_cast<double>(*std::max_element(pattern_counts.begin(), pattern_counts.end()));
    std::vector<float> gains(candidates.triangleCount(), 0);
    for (std::size_t t = 0; t < gains.size(); ++t) {
        if (!candidates.has(t)) continue;
        std::uint32_t quad[4];
        candidates.cornersOf(t, false, quad);
        const double usual = static_cast<double>(pattern_counts[candidates.patternOf(t)]) / most;
        gains[t] = static_cast<float>(1 + usual + squareness(triangles, quad));
    }
    return choosePairs(candidates, gains);
}

bool hasTies(const MeshView& triangles, const QuadCandidates& candidates, const QuadPairs& pairs) {
    for (std::size_t t = 0; t < pairs.size(); ++t) {
        if (pairs[t] == PairKind::none) continue;
        std::array<std::uint32_t, 4> quad;
        candidates.cornersOf(t, false, quad.data());
        for (std::uint32_t& corner : quad) corner = triangles.indices[corner];
        const auto uv = [&](unsigned k) { return triangles.uvs[quad[k]]; };
        const auto position = [&](unsigned k) { return triangles.positions[quad[k]]; };
        const Vec2 a = uv(2) - uv(0), b = uv(3) - uv(1);
        const Vec3 c = position(2) - position(0), d = position(3) - position(1);
        if (a.x * a.x + a.y * a.y == b.x * b.x + b.y * b.y && dot(c, c) == dot(d, d)) return true;
    }
    return false;
}

QuadFaces facesOfPairs(const QuadCandidates& candidates, const QuadPairs& pairs) {
    QuadFaces faces;
    const std::size_t count = candidates.triangleCount();
    faces.face_corners.resize(3 * count);
    faces.corners.reserve(3 * count);
    const auto add = [&](std::size_t corner) {
        faces.face_corners[corner] = static_cast<std::uint32_t>(faces.corners.size());
        faces.corners.push_back(static_cast<std::uint32_t>(corner));
    };
    for (std::size_t t = 0; t < count; ++t) {
        if (pairs[t] == PairKind::none) {
            for (std::size_t k = 0; k < 3; ++k) add(3 * t + k);
            faces.sizes.push_back(3);
            continue;
        }
        std::array<std::uint32_t, 4> quad;
        candidates.cornersOf(t, pairs[t] == PairKind::turned, quad.data());
        for (const std::uint32_t corner : quad) add(corner);
        // The other triangle's ends of the diagonal.
        const std::size_t i = candidates.patternOf(t) / 3, k = candidates.patternOf(t) % 3, second = 3 * (t + 1);
        faces.face_corners[second + k] = faces.face_corners[3 * t + (i + 1) % 3];
        faces.face_corners[second + (k + 1) % 3] = faces.face_corners[3 * t + i];
        faces.sizes.push_back(4);
        ++faces.quad_count;
        ++t;
    }
    return faces;
}

}  // namespace tspace
