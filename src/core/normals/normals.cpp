// SPDX-License-Identifier: MIT
// Mean normals: selection of the algorithm (averageNormals), and the rounds of `best` (smooth::refine).
#include <cstring>
#include <utility>

#include "core/base/border.h"
#include "core/base/parallel.h"
#include "core/base/range_lists.h"
#include "core/normals/face_terms.h"
#include "core/normals/normals_call.h"

namespace tspace {

NormalReport averageNormals(const NormalsCall& call) {
    const bool is_usual = call.are_triangles && call.mesh.vertexCount() != 0 && call.options.crease_angle_deg >= 180 &&
                          call.options.smoothing_groups.empty() && call.weighting != NormalWeighting::max;
    return is_usual ? smoothTriangles(call) : smoothFaces(call);
}

}  // namespace tspace

namespace tspace::smooth {

// Computes NormalWeighting::best: rounds of sums at groups of corners that share a normal.

namespace {

static_assert(kBestTriangles == SumRound::kTriangles && kBestGroup == SumRound::kGroups);

/// Vectors of a block of groups, as four floats each, starting with group `first`.
struct Fours {
    alignas(64) float floats[4 * SumRound::kGroups] = {};

    Fours(const Vec3* from, std::size_t first, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) std::memcpy(floats + 4 * i, from + first + i, sizeof(Vec3));
    }
};

class BestRound final : public SumRound {
  public:
    /// `to`: output, one normal per group. It must not be an array whose values this pass uses.
    BestRound(const BestKernel& kernel, const BestSource& source, StridedSpan<Vec3> to)
        : SumRound(kernel.row_count, kernel.row_count == kFitRows), kernel_(kernel), source_(source), to_(to) {}

    void add(const std::uint32_t* vertices, const std::uint32_t* groups, std::size_t count,
             float* rows) const override {
        kernel_.add(source_, vertices, groups, count, rows);
    }
    void finish(float* sums, const std::uint32_t*, std::size_t first, std::size_t count) const override {
        kernel_.finish(sums, Fours(source_.robust, first, count).floats, Fours(source_.sharp, first, count).floats,
                       kGroups);
        for (std::size_t i = 0; i < count; ++i) std::memcpy(&to_[first + i].x, sums + 4 * row_count * i, sizeof(Vec3));
    }

  private:
    const BestKernel& kernel_;
    const BestSource& source_;
    StridedSpan<Vec3> to_;
};

}  // namespace

void refine(const NormalsCall& call, const TriangleGroups& triangles, std::size_t adding_corners,
            StridedSpan<Vec3> normals, Buffer<Vec3> sharp) {
    const std::size_t count = normals.count;
    const auto forGroups = [&](const auto& body) {
        call.parallel.forRanges(count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) body(i);
        });
    };
    const bool has_sharp = !sharp.empty();
    if (!has_sharp) sharp = Buffer<Vec3>(call.allocator, count + kPaddingVectors, Vec3{});
    Buffer<Vec3> robust(call.allocator, count + kPaddingVectors, Vec3{});
    forGroups([&](std::size_t i) { robust[i] = normals[i]; });

    const BestKernels kernels = bestKernelsFor(call.options.execution.simd);
    BestSource source{.faces = call.source(call.posed, false, false),
                      .scale = inputScale(call.items, call.posed.positions, {}).positions};
    source.robust = robust.data();
    source.sharp = sharp.data();
    SumRounds rounds(triangles, adding_corners, count, kFitRows, call.allocator, call.parallel);
    const auto run = [&](const BestKernel& kernel, StridedSpan<Vec3> to) { rounds.run(BestRound(kernel, source, to)); };

    if (!has_sharp) run(kernels.sharp, {sharp.data(), count});
    run(kernels.fit, normals);
    // Groups without both means take no part in the refinement steps.
    forGroups(
        [&](std::size_t i) { robust[i] = robust[i] == Vec3{} || sharp[i] == Vec3{} ? Vec3{} : Vec3{normals[i]}; });
    for (unsigned step = 0; step < call.options.refine; ++step) {
        source.robust = robust.data();
        run(kernels.step, {sharp.data(), count});
        std::swap(robust, sharp);
    }
    forGroups([&](std::size_t i) {
        if (robust[i] != Vec3{}) normals[i] = robust[i];
    });
}

}  // namespace tspace::smooth
