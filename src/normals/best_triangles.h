// SPDX-License-Identifier: MIT
// NormalWeighting::best where every point has one normal: triangles without hard edges.
#pragma once

#include "core/add_row.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "core/range_lists.h"
#include "normals/best_sums.h"
#include "tspace/normals.h"

namespace tspace::smooth {

/// A source without means. `factor` is normalFactor(convention).
BestSource bestSource(const TriangleGroups& triangles, const StridedSpan<const Vec3>& positions, double factor);

/// Adds what a round wrote for a corner, kRows of four floats; both aligned to 16 bytes. The last one of kFitRows has
/// maxima.
template <std::size_t kRows>
void addRows(float* sums, const float* rows) {
    constexpr std::size_t kLast = 4 * (kRows == kFitRows ? kRows - 1 : kRows);
    for (std::size_t i = 0; i < kLast; i += 4) addRow(sums + i, rows + i);
    for (std::size_t i = kLast; i < 4 * kRows; ++i) sums[i] = rows[i] > sums[i] ? rows[i] : sums[i];
}

/// From the means by angle * area to the normals of `best`, in place.
///
/// positions  of the pose, one per vertex
/// points     the point of each vertex; empty when each is its own
/// normals    eight floats per point: the unit mean, and a fourth number whose sign bit is set where it vanished;
///            such points, and those whose mean by `max` vanishes, stay as they are
///
/// Then options.refine steps.
/// Scratch memory: 32 bytes per vertex, up to 1 MB per task, and what RangeLists takes. Linear. Throws OutOfMemory.
void refineTriangles(const MeshView& mesh, const StridedSpan<const Vec3>& positions,
                     const Buffer<std::uint32_t>& points, const NormalOptions& options, float* normals,
                     Parallel& parallel);

}  // namespace tspace::smooth
