// SPDX-License-Identifier: MIT
#include "maps/bake/texel_plan.h"

#include <algorithm>
#include <array>

namespace tspace {
namespace {

constexpr std::size_t kRowsOfPlan = 16;

class Planning {
  public:
    Planning(const TracedTexels& traced, const TexelTriangles& triangles, float tolerance, Parallel& parallel,
             const Allocator* allocator)
        : traced_(traced), triangles_(triangles), width_(triangles.shape.width), height_(triangles.shape.height),
          tolerance_(tolerance), parallel_(parallel), allocator_(allocator) {}

    TexelPlan run(bool all_unknown) {
        const std::size_t count = std::size_t{width_} * height_;
        TexelPlan plan{width_, height_, Buffer<TexelCell>(allocator_, count, TexelCell::outside),
                       Buffer<TexelRole>(allocator_, count, TexelRole::excluded)};
        Buffer<std::uint8_t> straight(allocator_, count, std::uint8_t{0});
        forTexels([&](const Around& at) { straight[at.own()] = straightAt(at); });
        forTexels([&](const Around& at) { plan.cells[at.own()] = cellAt(at, straight); });
        if (all_unknown) {
            forTexels([&](const Around& at) {
                if (isRead(at.own())) plan.roles[at.own()] = TexelRole::unknown;
            });
            return plan;
        }
        const auto is = [&](std::size_t cell, TexelCell what) { return plan.cells[cell] == what; };
        Buffer<bool> unknown(allocator_, count, false);
        forTexels([&](const Around& at) {
            for (const std::size_t cell : at.cells()) unknown[at.own()] |= is(cell, TexelCell::rough);
        });
        forTexels([&](const Around& at) {
            if (!is(at.own(), TexelCell::smooth)) return;
            for (const std::size_t corner : at.corners()) {
                if (unknown[corner]) plan.cells[at.own()] = TexelCell::sampled;
            }
        });
        forTexels([&](const Around& at) {
            TexelRole& role = plan.roles[at.own()];
            for (const std::size_t cell : at.cells()) {
                if (is(cell, TexelCell::sampled)) role = TexelRole::fixed;
            }
            if (unknown[at.own()]) role = TexelRole::unknown;
        });
        return plan;
    }

  private:
    /// The 4 x 4 texels around a texel, from one column left of it and one row above it to two columns right and two
    /// rows below, with the wrap mode applied.
    struct Around {
        std::array<std::size_t, 4> columns = {}, rows = {};
        /// true: the texel is at the edge of an image that does not repeat, so some of its neighbors do not exist.
        bool is_at_edge = false;

        [[nodiscard]] std::size_t at(std::size_t x, std::size_t y) const { return rows[y] + columns[x]; }
        [[nodiscard]] std::size_t own() const { return at(1, 1); }
        /// Returns the four texels of the cell whose upper left corner is this texel.
        [[nodiscard]] std::array<std::size_t, 4> corners() const { return {at(1, 1), at(2, 1), at(1, 2), at(2, 2)}; }
        /// Returns the cells that have the texel as a corner.
        [[nodiscard]] std::array<std::size_t, 4> cells() const { return {at(0, 0), at(1, 0), at(0, 1), at(1, 1)}; }
    };

    static bool isEdge(std::size_t at, std::uint32_t size, TextureWrap wrap) {
        return wrap != TextureWrap::repeat && (at == 0 || at + 1 == size);
    }
    static std::size_t next(std::size_t at, std::size_t i, std::uint32_t size, TextureWrap wrap) {
        return wrappedTexel(static_cast<std::int64_t>(at + i) - 1, size, wrap);
    }

    template <class Body>
    void forTexels(const Body& body) {
        const TextureShape& shape = triangles_.shape;
        parallel_.forRanges(height_, kRowsOfPlan, [&](std::size_t begin, std::size_t end) {
            for (std::size_t y = begin; y < end; ++y) {
                Around around;
                for (std::size_t i = 0; i < 4; ++i) around.rows[i] = width_ * next(y, i, height_, shape.wrap_v);
                const bool is_edge_row = isEdge(y, height_, shape.wrap_v);
                for (std::size_t x = 0; x < width_; ++x) {
                    for (std::size_t i = 0; i < 4; ++i) around.columns[i] = next(x, i, width_, shape.wrap_u);
                    around.is_at_edge = is_edge_row || isEdge(x, width_, shape.wrap_u);
                    body(around);
                }
            }
        });
    }

    [[nodiscard]] bool isRead(std::size_t texel) const {
        return triangles_.kinds[texel] == TexelCoverage::inside || triangles_.is_read[texel];
    }

    /// Returns two flags. Bit 0: the row of four texels that starts at the left neighbor is nearly a parabola. Bit 1:
    /// the column that starts at the upper neighbor is.
    [[nodiscard]] std::uint8_t straightAt(const Around& around) const {
        const auto isNear = [&](const std::array<std::size_t, 4>& four) {
            for (const std::size_t texel : four) {
                if (traced_.origins[texel] != TexelOrigin::hit || triangles_.overlaps[texel]) return false;
            }
            const Vec3 off = (traced_.wanted[four[3]] - traced_.wanted[four[0]]) -
                             3.0F * (traced_.wanted[four[2]] - traced_.wanted[four[1]]);
            return dot(off, off) <= tolerance_ * tolerance_;
        };
        const bool row = isNear({around.at(0, 1), around.at(1, 1), around.at(2, 1), around.at(3, 1)});
        const bool column = isNear({around.at(1, 0), around.at(1, 1), around.at(1, 2), around.at(1, 3)});
        return static_cast<std::uint8_t>((row ? 1 : 0) | (column ? 2 : 0));
    }

    [[nodiscard]] TexelCell cellAt(const Around& around, const Buffer<std::uint8_t>& straight) const {
        const auto [own, right, below, other] = around.corners();
        if (!isRead(own) || !isRead(right) || !isRead(below) || !isRead(other)) return TexelCell::outside;
        const bool smooth =
            !around.is_at_edge && straight[own] == 3 && (straight[below] & 1) != 0 && (straight[right] & 2) != 0;
        return smooth ? TexelCell::smooth : TexelCell::rough;
    }

    const TracedTexels& traced_;
    const TexelTriangles& triangles_;
    std::uint32_t width_, height_;
    float tolerance_;
    Parallel& parallel_;
    const Allocator* allocator_;
};

}  // namespace

CellSampling samplingOf(const BakeOptions& options) {
    constexpr std::uint64_t kLarge = std::uint64_t{1} << 20;
    const bool is_large = std::uint64_t{options.width} * options.height > kLarge;
    // Large maps have two sample points per texel and axis, at 1/4 and 3/4 of a texel. At these points, the distance of
    // a chord from a parabola is three quarters of its maximum.
    if (options.bits == 8) return {.tolerance = 2e-3F, .points = is_large ? 2U : 3U};
    if (is_large) return {.tolerance = 6e-4F, .points = 2};
    return {};
}

TexelPlan planTexels(const TracedTexels& traced, const TexelTriangles& triangles, float tolerance, bool all_unknown,
                     Parallel& parallel, const Allocator* allocator) {
    return Planning(traced, triangles, tolerance, parallel, allocator).run(all_unknown);
}

Buffer<Vec3> sharpenedTexels(const TexelPlan& plan, std::span<const Vec3> wanted, Parallel& parallel,
                             const Allocator* allocator) {
    const std::size_t width = plan.width, height = plan.height;
    Buffer<Vec3> texels(allocator, wanted.size());
    std::copy(wanted.begin(), wanted.end(), texels.begin());
    parallel.forRanges(height, kRowsOfPlan, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            const std::size_t here = y * width, above = (y + height - 1) % height * width,
                              below = (y + 1) % height * width;
            for (std::size_t x = 0; x < width; ++x) {
                const std::size_t left = x > 0 ? x - 1 : width - 1, right = x + 1 < width ? x + 1 : 0;
                const auto isSmooth = [&](std::size_t cell) {
                    return plan.cells[cell] == TexelCell::smooth || plan.cells[cell] == TexelCell::sampled;
                };
                if (!isSmooth(here + x) || !isSmooth(here + left) || !isSmooth(above + x) || !isSmooth(above + left))
                    continue;
                const Vec3 around =
                    (wanted[here + left] + wanted[here + right]) + (wanted[above + x] + wanted[below + x]);
                texels[here + x] = wanted[here + x] - (1 / 12.0F) * (around - 4.0F * wanted[here + x]);
            }
        }
    });
    return texels;
}

}  // namespace tspace
