// SPDX-License-Identifier: MIT
// Classification of the cells between texel centers. In smooth cells the map follows from the target vectors at the
// centers; other cells need rays: at creases of the low poly, edges and small detail of the high poly, and rims of
// charts.
#pragma once

#include "core/base/parallel.h"
#include "maps/bake/traced_texels.h"
#include "maps/layout/texel_triangles.h"
#include "maps/solve/solve_texels.h"

namespace tspace {

/// Square between the centers of four texels, identified by its upper left texel.
enum class TexelCell : std::uint8_t {
    outside,  ///< contains no part of a triangle
    smooth,   ///< targets between the centers follow from the targets at the centers
    sampled,  ///< smooth, but sampled by rays because an adjacent cell is rough
    rough     ///< rays determine the targets between the centers
};

struct TexelPlan {
    std::uint32_t width = 0, height = 0;
    Buffer<TexelCell> cells = {};
    Buffer<TexelRole> roles = {};
};

/// Rows of an image whose system is solved at once: `count` rows from `first` on, where the first row of the image
/// follows the last.
struct TexelWindow {
    std::uint32_t first = 0, count = 0, height = 0;

    /// Returns the row of the image relative to the window; a value of `count` or more means that it is outside the
    /// window.
    [[nodiscard]] std::uint32_t local(std::uint32_t y) const { return y >= first ? y - first : y + height - first; }
    [[nodiscard]] std::uint32_t inImage(std::uint32_t local) const { return (first + local) % height; }
    /// Returns whether the window contains both rows of the cells below row y.
    [[nodiscard]] bool hasCells(std::uint32_t y) const { return isWhole() || local(y) + 1 < count; }
    [[nodiscard]] bool isWhole() const { return count == height; }
};

/// Density of the samples between texel centers.
struct CellSampling {
    /// Maximum deviation from a parabola of the vectors of four texels in a row, in radians, for a cell to be smooth. A
    /// crease between two texels then causes an error of at most a quarter of this value.
    float tolerance = 2e-5F;
    std::uint32_t points = 3;  ///< number of points per texel and axis in cells that are not smooth
};

/// Returns the density of samples. For 8 bits it is low, because the rounding error is far larger than the error of
/// sampling. For 16 bits it is as high as the precision of the texels justifies, but lower for maps of more than 1024 x
/// 1024 texels: their texels are small relative to the detail, and they take most of the time.
CellSampling samplingOf(const BakeOptions& options);

/// Length of target vectors if texels are solved as real numbers, not as integers. It is below 1, so that texels can be
/// longer than their target while all channels stay within -1 to 1.
inline constexpr float kWantedLength = 0.98F;

/// Classifies all cells. `all_unknown`: if true, all texels that are read are unknown, and no cell is `sampled`;
/// otherwise the texels of rough cells are unknown, and other cells that share a texel with them are `sampled`. Memory:
/// 5 bytes per texel temporarily, 2 permanently.
TexelPlan planTexels(const TracedTexels& traced, const TexelTriangles& triangles, float tolerance, bool all_unknown,
                     Parallel& parallel, const Allocator* allocator);

/// Computes texels from the target vectors at their centers. Texels in smooth cells become the least-squares solution
/// for the filtered map: the chord between texels deviates from a parabola of second difference c by c/12 on average.
Buffer<Vec3> sharpenedTexels(const TexelPlan& plan, std::span<const Vec3> wanted, Parallel& parallel,
                             const Allocator* allocator);

}  // namespace tspace
