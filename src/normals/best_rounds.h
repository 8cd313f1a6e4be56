// SPDX-License-Identifier: MIT
// The rounds of NormalWeighting::best, over triangles or over corners.
#pragma once

#include "core/sum_rounds.h"
#include "normals/best_sums.h"
#include "tspace/normals.h"

namespace tspace::smooth {

/// One round: `sharp` gives the means by `max`, `fit` what both means say together, `step` moves that.
class BestRound final : public SumRound {
  public:
    enum class Kind { sharp, fit, step };

    /// to: the result of each group, three floats with this stride; never what the source names.
    BestRound(Kind kind, const BestKernel& kernel, const BestSource& source, void* to, std::size_t to_stride);

    void add(const std::uint32_t* vertices, const std::uint32_t* groups, std::size_t count, float* rows) const override;
    void finish(float* sums, const std::uint32_t* vertices, std::size_t first, std::size_t count) const override;

  private:
    Kind kind_;
    const BestKernel& kernel_;
    const BestSource& source_;
    std::byte* to_;
    std::size_t to_stride_;
};

/// A source without means.
BestSource bestSource(const TriangleGroups& triangles, const StridedSpan<const Vec3>& positions, Convention convention);

/// From the means by angle * area to the normals of `best`, in place, where every point has one normal.
///
/// triangles  with points as groups
/// normals    eight floats per point: the unit mean, and a fourth number whose sign bit is set where it vanished;
///            such points, and those whose mean by `max` vanishes, stay as they are
///
/// Then options.refine steps. Scratch memory: 32 bytes per point, and core/sum_rounds.h. Linear. Throws OutOfMemory.
void refineTriangles(const TriangleGroups& triangles, std::size_t point_count, const StridedSpan<const Vec3>& positions,
                     const NormalOptions& options, float* normals, Parallel& parallel);

}  // namespace tspace::smooth
