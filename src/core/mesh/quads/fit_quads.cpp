// SPDX-License-Identifier: MIT
// Pairs are chosen by evidence: what each would explain, seen in meshes where it is a pair and where it is not.
#include "core/mesh/quads/fit_quads.h"

#include <algorithm>
#include <utility>

#include "core/base/angle.h"
#include "core/mesh/surface/uv_votes.h"
#include "tspace/tangents.h"

namespace tspace {

namespace {

/// The part of the corners left unexplained by triangles that quads must explain to win. Chosen pairs explain up to 6 %
/// of them in meshes of other makers, and over 70 % where the quads are the real ones.
constexpr double kExplainedPart = 0.4;
/// And this share of all corners.
constexpr double kExplainedShare = 0.01;
/// Faces that explain less than half of the corners are not those that the tangents were made on.
constexpr double kMakerShare = 0.5;
/// Where the first two choices of pairs explain less than this share, no other will explain half.
constexpr double kHopelessShare = 0.25;

/// The corners that a pair explains depend on its neighbours, so pairs are chosen again while that explains more.
constexpr int kRounds = 4;

double shareOf(std::uint64_t count, std::uint64_t total) {
    return total == 0 ? 0 : static_cast<double>(count) / static_cast<double>(total);
}

/// How far each stored tangent is from the computed one, in degrees.
std::vector<float> distances(const MeshView& triangles, std::span<const Vec4> stored, std::span<const Vec4> computed) {
    std::vector<float> degrees(computed.size(), 180);
    for (std::size_t c = 0; c < computed.size(); ++c) {
        const Vec3 a = xyz(stored[triangles.indices[c]]), b = xyz(computed[c]);
        if (!isFinite(a) || !isFinite(b) || a == Vec3{} || b == Vec3{}) continue;
        degrees[c] = static_cast<float>(angleBetween(toDouble(a), toDouble(b)) * (180 / kPi));
    }
    return degrees;
}

class Fitter {
  public:
    Fitter(const MeshView& triangles, std::span<const Vec4> stored, double tolerance_deg,
           const QuadCandidates& candidates, const Execution& execution)
        : triangles_(triangles),
          stored_(stored),
          tolerance_deg_(tolerance_deg),
          candidates_(candidates),
          execution_(execution),
          votes_(uvVotes(triangles)),
          alone_(candidates.triangleCount()),
          paired_(candidates.triangleCount(), 0),
          best_kinds_(candidates.triangleCount(), PairKind::quad) {}

    void takeTriangles(std::span<const Vec4> tangents) {
        const std::vector<float> degrees = distances(triangles_, stored_, tangents);
        for (std::size_t t = 0; t < alone_.size(); ++t) alone_[t] = fitOf(degrees, t);
        fit_.near_on_triangles = fit_.near_on_quads = countNear(degrees);
    }

    [[nodiscard]] bool canWin() const {
        return fit_.corner_count != fit_.near_on_triangles &&
               shareOf(fit_.corner_count - fit_.near_on_triangles, fit_.corner_count) >= kExplainedShare;
    }

    [[nodiscard]] bool isHopeless() const { return shareOf(fit_.near_on_quads, fit_.corner_count) < kHopelessShare; }

    /// Computes with these pairs, remembers what each explains, and keeps the best faces.
    Result<Done> tryPairs(const QuadPairs& pairs) {
        QuadFaces faces = facesOfPairs(candidates_, pairs);
        Result<std::vector<Vec4>> tangents = tangentsOnFaces(triangles_, faces, execution_);
        if (!tangents) return std::move(tangents).error();
        const std::vector<float> degrees = distances(triangles_, stored_, *tangents);
        for (std::size_t t = 0; t < pairs.size(); ++t) {
            if (pairs[t] == PairKind::none) {
                alone_[t] = fitOf(degrees, t);
                continue;
            }
            const float fit = fitOf(degrees, t) + fitOf(degrees, t + 1);
            if (fit > paired_[t]) best_kinds_[t] = pairs[t];
            paired_[t] = best_kinds_[t] == pairs[t] ? fit : std::max(paired_[t], fit);
            ++t;
        }
        const std::uint64_t near = countNear(degrees);
        if (near <= fit_.near_on_quads) return Done{};
        fit_.near_on_quads = near;
        fit_.faces = std::move(faces);
        fit_.tangents = *std::move(tangents);
        return Done{};
    }

    /// The pairs that explain most by what is known. A pair that changes nothing is taken: quads are what is looked for.
    [[nodiscard]] QuadPairs bestPairs() const {
        constexpr float kTie = 1e-3F;
        std::vector<float> gains(paired_.size(), 0);
        for (std::size_t t = 0; t + 1 < gains.size(); ++t) {
            if (candidates_.has(t)) gains[t] = paired_[t] - alone_[t] - alone_[t + 1] + kTie;
        }
        QuadPairs pairs = choosePairs(candidates_, gains);
        for (std::size_t t = 0; t < pairs.size(); ++t) {
            if (pairs[t] != PairKind::none) pairs[t] = best_kinds_[t];
        }
        return pairs;
    }

    QuadFit& fit() { return fit_; }

  private:
    /// How well the triangle's corners are explained: most for equal tangents, at least half for near ones.
    [[nodiscard]] float fitOf(const std::vector<float>& degrees, std::size_t t) const {
        if (votes_[t] == 0) return 0;
        float sum = 0;
        for (std::size_t c = 3 * t; c < 3 * t + 3; ++c)
            sum += (isNear(degrees[c]) ? 0.5F : 0.0F) + 0.5F / (1 + 10 * degrees[c]);
        return sum;
    }

    [[nodiscard]] bool isNear(float degrees) const { return degrees <= tolerance_deg_; }

    std::uint64_t countNear(const std::vector<float>& degrees) {
        std::uint64_t near = 0;
        fit_.corner_count = 0;
        for (std::size_t c = 0; c < degrees.size(); ++c) {
            if (votes_[c / 3] == 0) continue;
            ++fit_.corner_count;
            near += isNear(degrees[c]) ? 1 : 0;
        }
        return near;
    }

    const MeshView& triangles_;
    std::span<const Vec4> stored_;
    double tolerance_deg_;
    const QuadCandidates& candidates_;
    const Execution& execution_;
    std::vector<std::uint8_t> votes_;
    std::vector<float> alone_, paired_;  ///< what was explained, when last computed, at a triangle and at a pair
    QuadPairs best_kinds_;               ///< how the pair was begun when it explained more
    QuadFit fit_ = {};
};

/// Some pairs of which none is one of these.
QuadPairs otherPairs(const QuadCandidates& candidates, const QuadPairs& pairs) {
    std::vector<float> gains(pairs.size());
    for (std::size_t t = 0; t < pairs.size(); ++t) gains[t] = pairs[t] == PairKind::none ? 1.0F : 0.0F;
    return choosePairs(candidates, gains);
}

QuadPairs turnedPairs(QuadPairs pairs) {
    for (PairKind& kind : pairs) kind = kind == PairKind::none ? kind : PairKind::turned;
    return pairs;
}

}  // namespace

bool quadsWin(std::uint64_t corner_count, std::uint64_t near_on_triangles, std::uint64_t near_on_quads) {
    if (near_on_quads <= near_on_triangles) return false;
    const std::uint64_t gained = near_on_quads - near_on_triangles;
    return shareOf(near_on_quads, corner_count) >= kMakerShare && shareOf(gained, corner_count) >= kExplainedShare &&
           shareOf(gained, corner_count - near_on_triangles) >= kExplainedPart;
}

Result<std::vector<Vec4>> tangentsOnFaces(const MeshView& triangles, const QuadFaces& faces,
                                          const Execution& execution) {
    std::vector<std::uint32_t> indices(faces.corners.size());
    for (std::size_t c = 0; c < indices.size(); ++c) indices[c] = triangles.indices[faces.corners[c]];
    MeshView mesh = triangles;
    mesh.indices = IndexView(std::span<const std::uint32_t>(indices));
    mesh.face_sizes = faces.sizes;
    std::vector<Vec4> on_faces(indices.size());
    const Result<TangentReport> made =
        generateTangents(mesh, {.convention = conventions::opengl}, {.tangents = on_faces}, execution);
    if (!made) return made.error();
    std::vector<Vec4> tangents(faces.face_corners.size());
    for (std::size_t c = 0; c < tangents.size(); ++c) tangents[c] = on_faces[faces.face_corners[c]];
    return tangents;
}

Result<QuadFit> fitQuads(const MeshView& triangles, std::span<const Vec4> stored, const Execution& execution,
                         double tolerance_deg, std::span<const Vec4> on_triangles) {
    const QuadCandidates candidates(triangles, stored);
    if (candidates.count() == 0) return QuadFit{};
    Fitter fitter(triangles, stored, tolerance_deg, candidates, execution);
    std::vector<Vec4> computed;
    if (on_triangles.empty()) {
        computed.resize(triangles.cornerCount());
        const Result<TangentReport> made =
            generateTangents(triangles, {.convention = conventions::opengl}, {.tangents = computed}, execution);
        if (!made) return made.error();
        on_triangles = computed;
    }
    fitter.takeTriangles(on_triangles);
    if (!fitter.canWin()) return std::move(fitter.fit());
    const QuadPairs by_shape = pairsByShape(triangles, candidates);
    if (Result<Done> done = fitter.tryPairs(by_shape); !done) return std::move(done).error();
    if (hasTies(triangles, candidates, by_shape)) {
        if (Result<Done> done = fitter.tryPairs(turnedPairs(by_shape)); !done) return std::move(done).error();
    }
    if (Result<Done> done = fitter.tryPairs(otherPairs(candidates, by_shape)); !done) return std::move(done).error();
    for (int round = 0; round < kRounds && !fitter.isHopeless(); ++round) {
        const std::uint64_t before = fitter.fit().near_on_quads;
        if (Result<Done> done = fitter.tryPairs(fitter.bestPairs()); !done) return std::move(done).error();
        if (round > 0 && fitter.fit().near_on_quads == before) break;
    }
    return std::move(fitter.fit());
}

}  // namespace tspace
