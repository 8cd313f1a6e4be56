// SPDX-License-Identifier: MIT
// Formats for BlockSearch with 8 bytes per channel and block: BC4 (BC5 is two of them) and EAC.
#pragma once

#include "images/textures/pack_block.h"
#include "textures/blocks/block_search.h"

namespace tspace {

struct NearestCode {
    Eight code, value;
};

/// BC4 block format. Palettes are in steps of 1 / 255 (signed: 1 / 254), with eight values between two integer
/// endpoints if the first endpoint is larger, otherwise with six. `kind`: number of steps between the endpoints, 7 or
/// 5. The extra values 0 and 1 of six-value palettes are not used: in normal maps with relief, fewer than one block in
/// a hundred would gain from them.
class Bc4Format {
  public:
    explicit Bc4Format(bool is_signed) : is_signed_(is_signed), most_(is_signed ? 254.0F : 255.0F) {}

    [[nodiscard]] float most() const { return most_; }
    [[nodiscard]] static float stepsOfByte() { return 1; }

    struct Values {
        Eight origin, step, inverse, last;

        [[nodiscard]] NearestCode nearest(const Eight& wanted) const {
            const Eight code = nearestWhole(between((wanted - origin) * inverse, 0.0F, last));
            return {code, origin + code * step};
        }
    };
    [[nodiscard]] static Values valuesOf(const Eight& origin, const Eight& step, const Eight& kind) {
        // With a step of 0, all codes have the same value.
        const Eight size = step * step, tiny = 1e-12F;
        return {origin, step, whereLess(tiny, size, 1.0F / whereLess(tiny, size, step, 1.0F), 0.0F), kind};
    }
    [[nodiscard]] static Eight value(const Eight& origin, const Eight& step, const Eight& code) {
        return origin + code * step;
    }

    /// Rounds the endpoints of palettes to integers between 0 and the maximum, in the order that the kind requires.
    void round(const Eight& origin, const Eight& step, const Eight& /*mean_code*/, const Eight& kind, Eight& new_origin,
               Eight& new_step) const {
        const Eight first = nearestWhole(between(origin, 0.0F, most_));
        const Eight last = nearestWhole(between(origin + kind * step, 0.0F, most_));
        const Eight is_full = kind - 6.0F;  // positive for palettes of eight values
        new_origin = whereLess(0.0F, is_full, larger(first, 1.0F), first);
        const Eight end = whereLess(0.0F, is_full, smaller(last, new_origin - 1.0F), larger(last, new_origin));
        new_step = (end - new_origin) / kind;
    }

    [[nodiscard]] Palette neighbor(const Palette& palette, std::size_t i, float by) const {
        constexpr float kFirst[] = {-1, -1, -1, 0, 0, 1, 1, 1}, kLast[] = {-1, 0, 1, -1, 1, -1, 0, 1};
        const bool is_full = palette.kind > 6;
        const float end = std::clamp(palette.origin + palette.kind * palette.step + by * kLast[i], 0.0F, most_);
        const float first = std::clamp(palette.origin + by * kFirst[i], is_full ? 1.0F : 0.0F, most_);
        const float last = static_cast<float>(static_cast<int>(end + 0.5F));
        const float kept = is_full ? std::min(last, first - 1) : std::max(last, first);
        return {first, (kept - first) / palette.kind, palette.kind};
    }

    /// Tries palettes whose endpoints are at the extremes and slightly inside them.
    template <class Try>
    void forStarts(float least, float most, bool all, const Try& tryPalettes) const {
        constexpr Eight::Four kParts[4][2] = {{{0, 0.05F, 0.1F, 0.16F}, {0, 0.1F, 0.05F, 0.16F}},
                                              {{0, 0.05F, 0.1F, 0.16F}, {0.1F, 0, 0.16F, 0.05F}},
                                              {{0, 0.05F, 0.05F, 0.1F}, {0.1F, 0.16F, 0, 0.16F}},
                                              {{0.05F, 0, 0.1F, 0.05F}, {0.16F, 0.1F, 0.16F, 0}}};
        const float range = most - least;
        for (int group = 0; group < (all ? 2 : 1); ++group) {
            const Eight first(kParts[2 * group][0], kParts[2 * group][1]);
            const Eight last(kParts[2 * group + 1][0], kParts[2 * group + 1][1]);
            tryRounded(most - first * range, least + last * range, 7.0F, tryPalettes);
        }
        // A few evenly spaced values are often represented better by a palette of six values than by one of eight.
        if (!all) return;
        const Eight first(kParts[0][0], kParts[0][1]), last(kParts[1][0], kParts[1][1]);
        tryRounded(least + first * range, most - last * range, 5.0F, tryPalettes);
    }

    /// Tries all pairs of integer endpoints from floor(least) - 1 to floor(most) + 2, clamped to the valid values.
    template <class Try>
    void forNear(float least, float most, const Try& tryPalettes) const {
        const int from = std::max(0, static_cast<int>(least) - 1);
        const int to = std::min(static_cast<int>(most_), static_cast<int>(most) + 2);
        forEnds(from, to, from, to, tryPalettes);
    }
    /// Tries all pairs whose endpoints are near opposite extremes, in both orders.
    template <class Try>
    void forPairs(float least, float most, const Try& tryPalettes) const {
        const auto aside = static_cast<int>(std::min(4 + 0.15F * (most - least), 12.0F));
        const auto from = [&](float at) { return std::max(0, static_cast<int>(at) - aside); };
        const auto to = [&](float at) { return std::min(static_cast<int>(most_), static_cast<int>(at) + aside); };
        forEnds(from(most), to(most), from(least), to(least), tryPalettes);
        forEnds(from(least), to(least), from(most), to(most), tryPalettes);
    }

    [[nodiscard]] std::array<std::uint8_t, 8> pack(const FittedChannel& fitted) const {
        const Palette& palette = fitted.palette;
        const int zero = is_signed_ ? 127 : 0, parts = static_cast<int>(palette.kind);
        const int first = static_cast<int>(palette.origin + 0.5F);
        const int last = static_cast<int>(palette.origin + palette.kind * palette.step + 0.5F);
        std::array<std::uint8_t, 16> codes{};
        for (std::size_t i = 0; i < 16; ++i) {
            // The endpoints have codes 0 and 1; the values between them have the codes from 2 on.
            const int code = static_cast<int>(fitted.codes[i]);
            codes[i] = static_cast<std::uint8_t>(code == 0 ? 0 : code == parts ? 1 : code + 1);
        }
        return packBc4Block(first - zero, last - zero, codes);
    }

  private:
    template <class Try>
    void forEnds(int from_first, int to_first, int from_last, int to_last, const Try& tryPalettes) const {
        Eight origin, step, kind;
        std::size_t lane = 0;
        const auto add = [&](int first, int last) {
            const float parts = first > last ? 7 : 5;
            origin.set(lane, static_cast<float>(first));
            step.set(lane, static_cast<float>(last - first) / parts);
            kind.set(lane, parts);
            if (++lane < 8) return;
            tryPalettes(origin, step, kind);
            lane = 0;
        };
        for (int first = from_first; first <= to_first; ++first) {
            for (int last = from_last; last <= to_last; ++last) add(first, last);
        }
        while (lane != 0) add(to_first, to_last);
    }

    template <class Try>
    void tryRounded(const Eight& first, const Eight& last, float kind, const Try& tryPalettes) const {
        Eight origin, step;
        round(first, (last - first) / kind, 0.0F, kind, origin, step);
        tryPalettes(origin, step, Eight(kind));
    }

    bool is_signed_;
    float most_;
};

/// EAC block format, in steps of 1 / 2047 (signed: 1 / 2046). A value is a base, which is a multiple of 8, plus a
/// modifier from one of 16 tables, multiplied by 1 or by a multiple of 8 up to 8 * 15. `kind`: index of the table.
class EacFormat {
  public:
    explicit EacFormat(bool is_signed)
        : is_signed_(is_signed), most_(is_signed ? 2046.0F : 2047.0F), zero_(is_signed ? 7.0F : 4.0F) {}

    [[nodiscard]] float most() const { return most_; }
    [[nodiscard]] static float stepsOfByte() { return kBaseStep; }

    struct Values {
        Eight origin, step, most;
        std::array<Eight, 8> modifiers;  ///< modifiers in ascending order
        std::array<Eight, 7> borders;    ///< midpoints between adjacent values

        [[nodiscard]] NearestCode nearest(const Eight& wanted) const {
            Eight code = modifiers[0];
            for (std::size_t i = 0; i < 7; ++i) code = whereLess(borders[i], wanted, modifiers[i + 1], code);
            return {code, between(origin + code * step, 0.0F, most)};
        }
    };
    [[nodiscard]] Values valuesOf(const Eight& origin, const Eight& step, const Eight& kind) const {
        Values values{origin, step, most_, {}, {}};
        for (std::size_t lane = 0; lane < 8; ++lane) {
            const std::int8_t* const table = kEacModifiers[static_cast<std::size_t>(kind[lane])];
            for (std::size_t i = 0; i < 8; ++i) values.modifiers[i].set(lane, table[kAscending[i]]);
        }
        for (std::size_t i = 0; i < 7; ++i)
            values.borders[i] = origin + 0.5F * step * (values.modifiers[i] + values.modifiers[i + 1]);
        return values;
    }
    [[nodiscard]] Eight value(const Eight& origin, const Eight& step, const Eight& code) const {
        return between(origin + code * step, 0.0F, most_);
    }

    /// Rounds the step to the format, and adjusts the origin so that the mean is preserved.
    void round(const Eight& origin, const Eight& step, const Eight& mean_code, const Eight& /*kind*/, Eight& new_origin,
               Eight& new_step) const {
        const Eight multiplier = nearestWhole(between((1 / kBaseStep) * step, 0.0F, 15.0F));
        new_step = whereLess(multiplier, 0.5F, 1.0F, kBaseStep * multiplier);
        new_origin = onBase(origin + (step - new_step) * mean_code);
    }

    [[nodiscard]] Palette neighbor(const Palette& palette, std::size_t i, float by) const {
        constexpr float kBases[] = {-1, -1, -1, 0, 0, 1, 1, 1}, kMultipliers[] = {-1, 0, 1, -1, 1, -1, 0, 1};
        const float multiplier = std::clamp(multiplierOf(palette) + by * kMultipliers[i], 0.0F, 15.0F);
        return {onBase(palette.origin + kBaseStep * by * kBases[i])[0], multiplier < 0.5F ? 1 : kBaseStep * multiplier,
                palette.kind};
    }

    /// Tries, for each table, the step that spans the range, and smaller steps.
    template <class Try>
    void forStarts(float least, float most, bool all, const Try& tryPalettes) const {
        constexpr float kScales[] = {1, 0.9F, 0.8F};
        for (std::size_t scale = 0; scale < (all ? std::size(kScales) : 1); ++scale) {
            for (std::size_t first = 0; first < 16; first += 8) {
                Eight origin, step, kind;
                for (std::size_t lane = 0; lane < 8; ++lane) {
                    const std::int8_t* const table = kEacModifiers[first + lane];
                    const auto low = static_cast<float>(table[3]), span = static_cast<float>(table[7] - table[3]);
                    const float wide = kScales[scale] * (most - least) / span;
                    step.set(lane, wide);
                    origin.set(lane, 0.5F * (least + most) - wide * (low + 0.5F * span));
                    kind.set(lane, static_cast<float>(first + lane));
                }
                const Eight exact_origin = origin, exact_step = step;
                round(exact_origin, exact_step, 0.0F, kind, origin, step);
                tryPalettes(origin, step, kind);
            }
        }
    }

    /// Tries the two smallest steps of all tables, with bases near the middle.
    template <class Try>
    void forNear(float least, float most, const Try& tryPalettes) const {
        constexpr int kAside = 2;
        for (const float step : {1.0F, kBaseStep}) {
            for (int aside = -kAside; aside <= kAside; ++aside) {
                const Eight origin = onBase(0.5F * (least + most) + kBaseStep * static_cast<float>(aside));
                for (const float first : {0.0F, 8.0F})
                    tryPalettes(origin, step, first + Eight(Eight::Four{0, 1, 2, 3}, Eight::Four{4, 5, 6, 7}));
            }
        }
    }

    /// Tries no pairs: EAC needs no pair search, because every start tries all tables.
    template <class Try>
    void forPairs(float, float, const Try&) const {}

    [[nodiscard]] std::array<std::uint8_t, 8> pack(const FittedChannel& fitted) const {
        const Palette& palette = fitted.palette;
        const int stored = static_cast<int>((palette.origin - zero_) / kBaseStep + 0.5F) - (is_signed_ ? 127 : 0);
        const auto table = static_cast<std::size_t>(palette.kind);
        std::array<std::uint8_t, 16> codes{};
        for (std::size_t i = 0; i < 16; ++i) {
            const std::int8_t* const modifiers = kEacModifiers[table];
            const auto* const found = std::find(modifiers, modifiers + 7, static_cast<std::int8_t>(fitted.codes[i]));
            codes[i] = static_cast<std::uint8_t>(found - modifiers);
        }
        return packEacBlock(stored, static_cast<int>(multiplierOf(palette)), static_cast<int>(table), codes);
    }

  private:
    static constexpr float kBaseStep = 8;
    static constexpr std::size_t kAscending[] = {3, 2, 1, 0, 4, 5, 6, 7};

    static float multiplierOf(const Palette& palette) {
        return palette.step < kBaseStep ? 0 : static_cast<float>(static_cast<int>(palette.step / kBaseStep + 0.5F));
    }
    [[nodiscard]] Eight onBase(const Eight& origin) const {
        const float last = is_signed_ ? 254 : 255;
        return zero_ + kBaseStep * nearestWhole(between((1 / kBaseStep) * (origin - zero_), 0.0F, last));
    }

    bool is_signed_;
    float most_, zero_;
};

}  // namespace tspace
