// SPDX-License-Identifier: MIT
#include "maps/bake/solve_strips.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "maps/solve/choose_lengths.h"
#include "maps/solve/solve_texels.h"

namespace tspace {
namespace {

constexpr unsigned kIntegerRounds = 3;
/// Number of solved rows above a strip that stay fixed. Only one of them influences the strip; with two, strips begin
/// at even rows, so that integers are chosen in the same order as for a whole map: every second row, then the others.
constexpr std::uint32_t kRowsStay = 2;

/// Strip: rows of the map that are solved, and the rows of their system (`window`). The window also contains
/// kRowsAround rows below the strip, which are solved and discarded, and one fixed row after them. Rows above the strip
/// are fixed; above the first strip they are treated like the rows below.
struct Strip {
    std::uint32_t first = 0, end = 0;
    TexelWindow window = {};
};

std::vector<Strip> stripsOf(std::uint32_t height, std::uint32_t rows) {
    if (height <= rows + 2 * (kRowsAround + 1)) return {{0, height, {0, height, height}}};
    std::vector<Strip> strips;
    for (std::uint32_t first = 0; first < height; first += rows) {
        const std::uint32_t end = std::min(first + rows, height);
        const std::uint32_t above = first == 0 ? kRowsAround : kRowsStay, below = end == height ? 1 : kRowsAround + 1;
        strips.push_back({first, end, {(first + height - above) % height, above + (end - first) + below, height}});
    }
    return strips;
}

class Solving {
  public:
    Solving(const MapSurfaces& surfaces, const TexelPlan& plan, std::uint32_t points, const BakeOptions& options,
            const MapWork& work, TracedTexels& traced)
        : surfaces_(surfaces), plan_(plan), options_(options), work_(work), traced_(traced),
          bands_(uvTriangles(surfaces.low().uvs, options), options.width, options.height, points, points / 2),
          points_{bands_, points},
          texels_(sharpenedTexels(plan, {traced.wanted.data(), traced.wanted.size()}, work.parallel, work.allocator)) {}

    void run(std::uint32_t strip_rows) {
        if (options_.bits != 8 && !options_.reading.two_channels) {
            for (Vec3& texel : texels_) texel = kWantedLength * texel;
        }
        const std::vector<Strip> strips = stripsOf(options_.height, strip_rows);
        // Half of the progress steps of a strip are for tracing rays, the others for solving its system.
        for (const Strip& strip : strips) steps_.total += 2 * bandsOf(strip.window).size();
        first_row_ = rowsFrom(0, 1);
        for (const Strip& strip : strips) solve(strip);
        traced_.wanted = std::move(texels_);
    }

  private:
    void solve(const Strip& strip) {
        const TexelWindow& window = strip.window;
        const std::size_t width = plan_.width, size = width * window.count;
        Buffer<TexelRole> roles(work_.allocator, size);
        Buffer<Vec3> texels(work_.allocator, size);
        for (std::uint32_t row = 0; row < window.count; ++row) {
            const std::size_t from = window.inImage(row) * width, to = row * width;
            std::copy_n(plan_.roles.begin() + from, width, roles.begin() + to);
            std::copy_n(texels_.begin() + from, width, texels.begin() + to);
        }
        if (!window.isWhole()) {
            const auto fix = [&](TexelRole& role) { role = role == TexelRole::excluded ? role : TexelRole::fixed; };
            std::for_each_n(roles.begin(), width * (strip.first == 0 ? 1 : kRowsStay), fix);
            std::for_each_n(roles.end() - width, width, fix);
        }
        TexelSystem system(work_.allocator, options_.width, window.count, {roles.data(), roles.size()});
        traceBetween(surfaces_, traced_, plan_, window, points_, options_, work_, steps_, system);
        const std::uint64_t bands = bandsOf(window).size();
        StepCallback report_step;
        if (work_.progress) {
            report_step = [&](std::uint64_t done, std::uint64_t total) {
                work_.progress("solving", steps_.before + done * bands / total, steps_.total);
            };
        }
        const std::span<Vec3> found(texels.data(), texels.size());
        if (options_.bits == 8) {
            addSmooth(strip, found, system);
            IntegerChoice choice = integerChoice(options_.lengths);
            choice.is_two_channel = options_.reading.two_channels;
            chooseIntegers(system, choice, found, kIntegerRounds, work_.parallel, work_.allocator, report_step);
        } else {
            solveTexels(system, found, work_.parallel, work_.allocator, report_step);
        }
        steps_.before += bands;
        rows_above_ = rowsFrom(strip.end - kRowsStay, kRowsStay);
        std::copy_n(texels.begin() + window.local(strip.first) * width, (strip.end - strip.first) * width,
                    texels_.begin() + strip.first * width);
    }

    /// Adds the equations of smooth cells, whose target is the initial texels; neighboring strips solve the shared rows
    /// as well.
    void addSmooth(const Strip& strip, std::span<Vec3> texels, TexelSystem& system) {
        const std::size_t width = plan_.width, last = texels.size() - width;
        const std::vector<Vec3> top(texels.begin(), texels.begin() + kRowsStay * width),
            bottom(texels.begin() + last, texels.end());
        if (strip.first > 0) std::copy(rows_above_.begin(), rows_above_.end(), texels.begin());
        if (!strip.window.isWhole() && strip.end == plan_.height)
            std::copy(first_row_.begin(), first_row_.end(), texels.begin() + last);
        addSmoothCells(plan_, strip.window, texels, points_.n, options_, work_.parallel, system);
        std::copy(top.begin(), top.end(), texels.begin());
        std::copy(bottom.begin(), bottom.end(), texels.begin() + last);
    }

    [[nodiscard]] std::vector<Vec3> rowsFrom(std::uint32_t y, std::uint32_t count) const {
        const Vec3* const from = texels_.begin() + std::size_t{y} * plan_.width;
        return {from, from + std::size_t{count} * plan_.width};
    }

    const MapSurfaces& surfaces_;
    const TexelPlan& plan_;
    const BakeOptions& options_;
    const MapWork& work_;
    TracedTexels& traced_;
    SampleBands bands_;
    PointsBetween points_;
    /// initial texels; after a strip is solved, its rows contain the result
    Buffer<Vec3> texels_;
    /// rows of the initial texels: the first row of the map, and the rows above the strip
    std::vector<Vec3> first_row_ = {}, rows_above_ = {};
    ProgressSteps steps_ = {};
};

}  // namespace

void solveInStrips(const MapSurfaces& surfaces, const TexelPlan& plan, std::uint32_t points, const BakeOptions& options,
                   const MapWork& work, TracedTexels& traced, std::uint32_t strip_rows) {
    Solving(surfaces, plan, points, options, work, traced).run(strip_rows);
}

}  // namespace tspace
