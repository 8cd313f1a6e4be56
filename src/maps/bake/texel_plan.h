// SPDX-License-Identifier: MIT
// Cells between texel centres: smooth ones, where the map follows from the vectors wanted at the centres, and others, which
// need rays: at creases of the low poly, edges and small detail of the high poly, and the rims of charts.
#pragma once

#include "core/base/parallel.h"
#include "maps/bake/traced_texels.h"
#include "maps/layout/texel_triangles.h"
#include "maps/solve/solve_texels.h"

namespace tspace {

/// The square between the centres of four texels, by its upper left one.
enum class TexelCell : std::uint8_t {
    outside,  ///< contains no part of a triangle
    smooth,   ///< targets between the centers follow from those at the centers
    asked,    ///< smooth, but sampled by rays too, for the cells beside it
    rough     ///< rays determine the targets
};

struct TexelPlan {
    std::uint32_t width = 0, height = 0;
    Buffer<TexelCell> cells = {};
    Buffer<TexelRole> roles = {};
};

/// Rows of an image whose system is solved at once: `count` from `first` on, after the last row of the image the first one.
struct TexelWindow {
    std::uint32_t first = 0, count = 0, height = 0;

    /// Row of the image, relative to the window; `count` or more: it is outside.
    [[nodiscard]] std::uint32_t local(std::uint32_t y) const { return y >= first ? y - first : y + height - first; }
    [[nodiscard]] std::uint32_t inImage(std::uint32_t local) const { return (first + local) % height; }
    /// Whether both rows of the cells below a row are there.
    [[nodiscard]] bool hasCells(std::uint32_t y) const { return isWhole() || local(y) + 1 < count; }
    [[nodiscard]] bool isWhole() const { return count == height; }
};

/// Density of samples between texel centers.
struct CellSampling {
    /// A cell is smooth where the vectors of four texels in a row are that near to a parabola, in radians. A crease between
    /// two of them is then wrong by a quarter of it at most.
    float tolerance = 2e-5F;
    std::uint32_t points = 3;  ///< points of a texel in a row, in cells that are not smooth
};

/// Rays per cell. For 16 bits, as many as such texels can resolve; fewer in maps of more than 1024 x 1024 texels, whose
/// texels are small beside the detail, and take most of the time. For 8 bits, whose rounding is far larger, always
/// fewer.
CellSampling samplingOf(const BakeOptions& options);

/// How long vectors of real numbers shall be: below 1, so that no channel of a texel around has to be more.
inline constexpr float kWantedLength = 0.98F;

/// `all_unknown`: all texels that are read are unknown, and no cell is asked; else those of rough cells are, and other cells
/// that share a texel with them are asked. Memory: 5 bytes a texel while it runs, 2 stay.
TexelPlan planTexels(const TracedTexels& traced, const TexelTriangles& triangles, float tolerance, bool all_unknown,
                     Parallel& parallel, const Allocator* allocator);

/// Texels from what is wanted at their centres. Those of which all cells are smooth become the least squares of the filtered map:
/// against a parabola, of second difference c, the chord between texels is off by c/12 in the mean.
Buffer<Vec3> sharpenedTexels(const TexelPlan& plan, std::span<const Vec3> wanted, Parallel& parallel,
                             const Allocator* allocator);

}  // namespace tspace
