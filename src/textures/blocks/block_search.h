// SPDX-License-Identifier: MIT
// Search for the best encoding of one channel of a 4 x 4 block while everything else is fixed: the endpoints and codes
// with the least filtered error. Eight palettes are evaluated in parallel lanes.
//
// The error of a block is e'He + 2 g'e, with e the errors of its texels, H the mixing of texels by the bilinear filter
// (nine numbers per texel), and g the contribution of the errors of surrounding texels and of the other channel. Steps
// for each palette: choose the best code for one texel after the other, given its neighbors (iterated conditional
// modes); fit the origin and step of the palette by least squares in H and round them to the format; choose the codes
// again.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "maps/texels/eight_lanes.h"

namespace tspace {

/// Returns the slot of texel i of a block in a 6 x 6 grid: the block and a border of one texel.
constexpr std::size_t slotOf(std::size_t i) { return (i / 4 + 1) * 6 + i % 4 + 1; }
/// Offsets from a slot to the 3 x 3 slots around it, row by row, in the grid of slotOf.
inline constexpr std::array<int, 9> kAround = {-7, -6, -5, -1, 0, 1, 5, 6, 7};

using Stencil = std::array<float, 9>;

struct ChannelBlock {
    std::array<bool, 16> is_used = {};   ///< false: the texel lies beyond the edge of the image
    std::array<float, 16> targets = {};  ///< target of each texel, in steps of the format, 0 to `most`
    /// Rows of H. They contain entries for texels outside the block too, but the errors of these texels are fixed, so
    /// they contribute to `pull` only.
    std::array<Stencil, 16> mix = {};
    std::array<float, 16> own_parts = {};  ///< for each row of H: the sum of its entries for texels inside the block
    std::array<float, 16> pull = {};       ///< vector g of each texel
};

/// Palette of a block: its values are origin + step * c, where c is the number that a code represents.
struct Palette {
    float origin = 0, step = 0;
    float kind = 0;  ///< BC4: number of steps between the endpoints; EAC: index of the modifier table

    bool operator==(const Palette&) const = default;
};

struct FittedChannel {
    Palette palette = {};
    std::array<float, 16> codes = {};   ///< number c that each texel's code represents
    std::array<float, 16> errors = {};  ///< error of each texel: value - target
};

struct SearchEffort {
    bool all_starts = true;  ///< true: start with palettes of all kinds; false: only of the most common kind
    int start_fits = 1;      ///< number of least-squares fits per start
    float near_range = 0;    ///< blocks whose range is below this try all palettes within the range; in units of 1/255
    /// Blocks with few distinct values try all palettes whose endpoints are near the extremes.
    bool few_values = false;
    int sweeps = 1;
    bool tries_neighbors = false;  ///< true: also try the neighbors of the best palette
};

template <class Format>
class BlockSearch {
  public:
    BlockSearch(const Format& format, const ChannelBlock& block) : format_(format), block_(block) {}

    /// Returns the best encoding if the error of each texel counts by itself, independently of its neighbors.
    FittedChannel bestIndependent(const SearchEffort& effort) {
        constexpr std::size_t kDescents = 3;
        chooseStarts(block_.targets, effort, kDescents);
        const std::array<Palette, 7> first = starts_;
        for (std::size_t i = 0, count = start_count_; i < count; ++i) descend(first[i]);
        Lanes lanes;
        for (std::size_t lane = 0; lane < 8; ++lane) lanes.setPalette(lane, starts_[0]);
        const typename Format::Values values = format_.valuesOf(lanes.origin, lanes.step, lanes.kind);
        FittedChannel fitted{.palette = starts_[0]};
        for (std::size_t i = 0; i < 16; ++i) {
            if (!block_.is_used[i]) continue;
            const auto [code, value] = values.nearest(block_.targets[i]);
            fitted.codes[i] = code[0];
            fitted.errors[i] = value[0] - block_.targets[i];
        }
        return fitted;
    }

    /// Returns an encoding with a smaller error than `from`, or `from`.
    FittedChannel improved(const FittedChannel& from, const SearchEffort& effort) {
        std::array<float, 16> wanted = relaxed(from);
        chooseStarts(wanted, effort, 7);
        Lanes lanes;
        lanes.setPalette(0, from.palette);
        for (std::size_t lane = 1; lane < 8; ++lane) lanes.setPalette(lane, starts_[std::min(lane, start_count_) - 1]);
        for (std::size_t i = 0; i < 16; ++i) {
            if (!block_.is_used[i]) continue;
            Eight& error = lanes.errors[slotOf(i)];
            error = wanted[i] - block_.targets[i];
            error.set(0, from.errors[i]);
        }
        best_ = from;
        least_ = kMost;
        chooseCodes(lanes, effort.sweeps);
        keepBest(lanes);
        fitPalettes(lanes);
        chooseCodes(lanes, effort.sweeps);
        keepBest(lanes);
        if (effort.tries_neighbors) tryNeighbors();
        return best_;
    }

  private:
    static constexpr float kMost = 3e38F;

    struct Lanes {
        std::array<Eight, 36> errors = {};
        std::array<Eight, 16> codes = {};
        Eight origin = {}, step = {}, kind = {};

        void setPalette(std::size_t lane, const Palette& palette) {
            origin.set(lane, palette.origin);
            step.set(lane, palette.step);
            kind.set(lane, palette.kind);
        }
        [[nodiscard]] Palette palette(std::size_t lane) const { return {origin[lane], step[lane], kind[lane]}; }
    };

    /// Returns the values that the texels would have without quantization.
    std::array<float, 16> relaxed(const FittedChannel& from) const {
        constexpr int kSweeps = 2;
        std::array<float, 36> errors{};
        for (std::size_t i = 0; i < 16; ++i) errors[slotOf(i)] = block_.is_used[i] ? from.errors[i] : 0;
        for (int sweep = 0; sweep < kSweeps; ++sweep) {
            for (std::size_t i = 0; i < 16; ++i) {
                if (block_.is_used[i]) errors[slotOf(i)] = -pullAt(i, &errors[slotOf(i)]) / block_.mix[i][4];
            }
        }
        std::array<float, 16> values{};
        for (std::size_t i = 0; i < 16; ++i)
            values[i] = std::clamp(block_.targets[i] + errors[slotOf(i)], 0.0F, format_.most());
        return values;
    }

    /// Returns the part of the gradient at texel i that the other texels contribute.
    template <class Number>
    Number pullAt(std::size_t i, const Number* error) const {
        const Stencil& mix = block_.mix[i];
        const auto of = [&](std::size_t k) { return mix[k] * error[kAround[k]]; };
        return ((block_.pull[i] + of(0)) + (of(1) + of(2))) + ((of(5) + of(6)) + (of(7) + of(8))) + of(3);
    }

    void chooseCodes(Lanes& lanes, int sweeps) const {
        const typename Format::Values values = format_.valuesOf(lanes.origin, lanes.step, lanes.kind);
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            for (std::size_t i = 0; i < 16; ++i) {
                if (!block_.is_used[i]) continue;
                Eight* const error = &lanes.errors[slotOf(i)];
                const float target = block_.targets[i];
                const auto [code, value] = values.nearest(target - pullAt(i, error) * (1 / block_.mix[i][4]));
                lanes.codes[i] = code;
                *error = value - target;
            }
        }
    }

    /// Fits the origin and step to the codes by least squares, rounds them, and updates the errors.
    void fitPalettes(Lanes& lanes) const {
        std::array<Eight, 36> codes{};
        for (std::size_t i = 0; i < 16; ++i) {
            if (block_.is_used[i]) codes[slotOf(i)] = lanes.codes[i];
        }
        Eight ones, mixed, squares, side, code_side;
        for (std::size_t i = 0; i < 16; ++i) {
            if (!block_.is_used[i]) continue;
            const Stencil& mix = block_.mix[i];
            const std::size_t slot = slotOf(i);
            Eight gradient = pullAt(i, &lanes.errors[slot]) + mix[4] * lanes.errors[slot], sum = mix[4] * codes[slot];
            for (std::size_t k = 0; k < 9; ++k) {
                if (k != 4) sum = sum + mix[k] * (&codes[slot])[kAround[k]];
            }
            ones = ones + block_.own_parts[i];
            mixed = mixed + sum;
            squares = squares + codes[slot] * sum;
            side = side + gradient;
            code_side = code_side + codes[slot] * gradient;
        }
        const Eight determinant = ones * squares - mixed * mixed, least = 1e-5F * (ones * squares);
        const Eight scale = whereLess(least, determinant, 1.0F / larger(determinant, 1e-20F), 0.0F);
        const Eight step_by = scale * (mixed * side - ones * code_side);
        const Eight origin_by = whereLess(least, determinant, scale * (mixed * code_side - squares * side),
                                          -1.0F * (side / larger(ones, 1e-20F)));
        format_.round(lanes.origin + origin_by, lanes.step + step_by, mixed / larger(ones, 1e-20F), lanes.kind,
                      lanes.origin, lanes.step);
        updateErrors(lanes);
    }

    void updateErrors(Lanes& lanes) const {
        for (std::size_t i = 0; i < 16; ++i) {
            if (!block_.is_used[i]) continue;
            const Eight value = format_.value(lanes.origin, lanes.step, lanes.codes[i]);
            lanes.errors[slotOf(i)] = value - block_.targets[i];
        }
    }

    void keepBest(const Lanes& lanes) {
        Eight total;
        for (std::size_t i = 0; i < 16; ++i) {
            if (!block_.is_used[i]) continue;
            const Stencil& mix = block_.mix[i];
            const Eight* const error = &lanes.errors[slotOf(i)];
            const Eight next = (mix[5] * error[1] + mix[6] * error[5]) + (mix[7] * error[6] + mix[8] * error[7]);
            total = total + *error * (2 * block_.pull[i] + mix[4] * *error + 2.0F * next);
        }
        std::size_t best = 8;
        for (std::size_t lane = 0; lane < 8; ++lane) {
            if (total[lane] < least_) {
                least_ = total[lane];
                best = lane;
            }
        }
        if (best == 8) return;
        best_.palette = lanes.palette(best);
        for (std::size_t i = 0; i < 16; ++i) {
            if (!block_.is_used[i]) continue;
            best_.codes[i] = lanes.codes[i][best];
            best_.errors[i] = lanes.errors[slotOf(i)][best];
        }
    }

    void tryNeighbors() {
        constexpr int kMostRounds = 4, kSweeps = 2;
        for (int round = 0; round < kMostRounds; ++round) {
            const float before = least_;
            Lanes lanes;
            for (std::size_t lane = 0; lane < 8; ++lane)
                lanes.setPalette(lane, format_.neighbor(best_.palette, lane, 1));
            for (std::size_t i = 0; i < 16; ++i) {
                if (block_.is_used[i]) lanes.errors[slotOf(i)] = best_.errors[i];
            }
            chooseCodes(lanes, kSweeps);
            keepBest(lanes);
            if (!(least_ < before)) break;
        }
    }

    // Finds start palettes: those that are best if texels are fitted independently.

    void chooseStarts(const std::array<float, 16>& values, const SearchEffort& effort, std::size_t wanted) {
        start_count_ = 0;
        wanted_starts_ = wanted;
        float least = kMost, most = -kMost;
        for (std::size_t i = 0; i < 16; ++i) {
            if (!block_.is_used[i]) continue;
            least = std::min(least, values[i]);
            most = std::max(most, values[i]);
        }
        const auto tryPalettes = [&](Eight origin, Eight step, const Eight& kind, int fits) {
            for (int fit = 0; fit < fits; ++fit) fitIndependently(values, origin, step, kind);
            addStarts(values, origin, step, kind);
        };
        format_.forStarts(least, most, effort.all_starts,
                          [&](const Eight& origin, const Eight& step, const Eight& kind) {
                              tryPalettes(origin, step, kind, effort.start_fits);
                          });
        if (most - least < effort.near_range * format_.stepsOfByte()) {
            format_.forNear(least, most, [&](const Eight& origin, const Eight& step, const Eight& kind) {
                tryPalettes(origin, step, kind, 0);
            });
        } else if (effort.few_values) {
            tryFewValues(values, least, most);
        }
    }

    /// Tries palettes for blocks with few distinct values, for example next to the edge of a flat area. Palettes that
    /// represent all of these values exactly exist, but descent does not find them.
    void tryFewValues(const std::array<float, 16>& values, float least, float most) {
        constexpr std::size_t kFew = 4;
        std::array<float, 16> sorted{};
        std::size_t count = 0;
        for (std::size_t i = 0; i < 16; ++i) {
            if (block_.is_used[i]) sorted[count++] = values[i];
        }
        std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count));
        std::array<float, kFew> means{}, weights{};
        std::size_t groups = 0;
        float scatter = 0;  // sum of squared deviations of the values from the means of their groups
        for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
            float sum = 0;
            for (end = begin; end < count && (end == begin || sorted[end] - sorted[end - 1] < format_.stepsOfByte());
                 ++end)
                sum += sorted[end];
            if (groups == kFew) return;
            weights[groups] = static_cast<float>(end - begin);
            means[groups] = sum / weights[groups];
            for (std::size_t i = begin; i < end; ++i)
                scatter += (sorted[i] - means[groups]) * (sorted[i] - means[groups]);
            ++groups;
        }
        format_.forPairs(least, most, [&](const Eight& origin, const Eight& step, const Eight& kind) {
            const typename Format::Values palettes = format_.valuesOf(origin, step, kind);
            Eight total = scatter;
            for (std::size_t i = 0; i < groups; ++i) {
                const Eight off = palettes.nearest(means[i]).value - means[i];
                total = total + weights[i] * (off * off);
            }
            for (std::size_t lane = 0; lane < 8; ++lane) addStart({origin[lane], step[lane], kind[lane]}, total[lane]);
        });
    }

    /// Moves from a start to better neighboring palettes, two steps away and then one step, until none is better.
    void descend(Palette from) {
        constexpr int kMostRounds = 16;
        for (const float by : {2.0F, 1.0F}) {
            for (int round = 0; round < kMostRounds; ++round) {
                Eight origin, step, kind;
                for (std::size_t lane = 0; lane < 8; ++lane) {
                    const Palette near = format_.neighbor(from, lane, by);
                    origin.set(lane, near.origin);
                    step.set(lane, near.step);
                    kind.set(lane, near.kind);
                }
                const Palette best = starts_[0];
                addStarts(block_.targets, origin, step, kind);
                if (starts_[0] == best) break;
                from = starts_[0];
            }
        }
    }

    /// Fits palettes to the texels independently by least squares, and rounds them.
    void fitIndependently(const std::array<float, 16>& values, Eight& origin, Eight& step, const Eight& kind) const {
        const typename Format::Values palettes = format_.valuesOf(origin, step, kind);
        Eight count, sum, squares, side, code_side;
        for (std::size_t i = 0; i < 16; ++i) {
            if (!block_.is_used[i]) continue;
            const Eight code = palettes.nearest(values[i]).code;
            count = count + 1.0F;
            sum = sum + code;
            squares = squares + code * code;
            side = side + values[i];
            code_side = code_side + code * values[i];
        }
        const Eight determinant = count * squares - sum * sum, least = 1e-4F * (count * squares);
        const Eight scale = 1.0F / larger(determinant, 1e-20F);
        const Eight new_step = whereLess(least, determinant, scale * (count * code_side - sum * side), step);
        const Eight new_origin = (side - new_step * sum) / larger(count, 1.0F);
        format_.round(new_origin, new_step, sum / larger(count, 1.0F), kind, origin, step);
    }

    void addStarts(const std::array<float, 16>& values, const Eight& origin, const Eight& step, const Eight& kind) {
        const typename Format::Values palettes = format_.valuesOf(origin, step, kind);
        Eight total;
        for (std::size_t i = 0; i < 16; ++i) {
            if (!block_.is_used[i]) continue;
            const Eight off = palettes.nearest(values[i]).value - values[i];
            total = total + off * off;
        }
        for (std::size_t lane = 0; lane < 8; ++lane) addStart({origin[lane], step[lane], kind[lane]}, total[lane]);
    }

    /// Inserts a start, sorted by error; among equal errors the earlier start comes first.
    void addStart(const Palette& palette, float error) {
        if (start_count_ == wanted_starts_ && !(error < start_errors_[start_count_ - 1])) return;
        std::size_t at = start_count_;
        while (at > 0 && error < start_errors_[at - 1]) --at;
        // Equal palettes have equal errors, so only starts with the same error are compared.
        for (std::size_t i = at; i > 0 && start_errors_[i - 1] == error; --i) {
            if (starts_[i - 1] == palette) return;
        }
        if (start_count_ < wanted_starts_) ++start_count_;
        for (std::size_t i = start_count_ - 1; i > at; --i) {
            starts_[i] = starts_[i - 1];
            start_errors_[i] = start_errors_[i - 1];
        }
        starts_[at] = palette;
        start_errors_[at] = error;
    }

    const Format& format_;
    const ChannelBlock& block_;
    std::array<Palette, 7> starts_ = {};
    std::array<float, 7> start_errors_ = {};
    std::size_t start_count_ = 0, wanted_starts_ = 0;
    FittedChannel best_ = {};
    float least_ = kMost;
};

}  // namespace tspace
