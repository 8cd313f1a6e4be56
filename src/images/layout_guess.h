// SPDX-License-Identifier: MIT
// Detects normal maps whose four channels contain only x and y, and which channels contain them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "tspace/map_files.h"

namespace tspace {

/// Returns the two-channel layout with x and y in the given output colors.
inline MapLayout twoChannelLayout(MapChannel x, MapChannel y) { return {.x = {x}, .y = {y}, .z = {MapChannel::none}}; }

/// Detects common layouts: x in alpha and y in green, with constant red; or x in all three colors and y in alpha.
class LayoutDetector {
  public:
    /// Adds a texel with channels from 0 to 1.
    void add(const Vec3& texel, float alpha) {
        constexpr float kApart = 8.0F / 255.0F;  // tolerance for compression errors
        const std::array<float, 4> values{texel.x, texel.y, texel.z, alpha};
        for (std::size_t i = 0; i < 4; ++i) {
            min_[i] = std::fmin(min_[i], values[i]);
            max_[i] = std::fmax(max_[i], values[i]);
        }
        gray_ += std::fabs(texel.x - texel.y) <= kApart && std::fabs(texel.x - texel.z) <= kApart ? 1 : 0;
        green_.add(alpha, texel.y);
        red_.add(texel.x, alpha);
        ++count_;
    }

    [[nodiscard]] std::optional<MapLayout> layout() const {
        constexpr float kSame = 3.0F / 255.0F;
        const auto varies = [&](std::size_t i) { return max_[i] - min_[i] > kSame; };
        if (count_ == 0 || !varies(3) || !varies(1)) return {};
        if (!varies(0) && green_.fits(count_)) return twoChannelLayout(MapChannel::alpha, MapChannel::green);
        if (isNearlyAll(gray_, count_) && red_.fits(count_))
            return twoChannelLayout(MapChannel::red, MapChannel::alpha);
        return {};
    }

  private:
    static bool isNearlyAll(std::uint64_t part, std::uint64_t count) {
        constexpr double kNearly = 0.99;
        return static_cast<double>(part) >= kNearly * static_cast<double>(count);
    }

    /// Counts how many pairs of values are x and y of unit vectors with positive z.
    struct Pairs {
        double sum_x = 0, sum_y = 0;
        std::uint64_t inside = 0;

        void add(float x, float y) {
            constexpr double kLongest = 1.04;
            const double a = 2 * static_cast<double>(x) - 1, b = 2 * static_cast<double>(y) - 1;
            sum_x += a;
            sum_y += b;
            inside += a * a + b * b <= kLongest ? 1 : 0;
        }
        [[nodiscard]] bool fits(std::uint64_t count) const {
            constexpr double kMaxMean = 0.3;
            const auto total = static_cast<double>(count);
            return std::fabs(sum_x) < kMaxMean * total && std::fabs(sum_y) < kMaxMean * total &&
                   isNearlyAll(inside, count);
        }
    };

    std::array<float, 4> min_ = {1, 1, 1, 1}, max_ = {};
    std::uint64_t gray_ = 0, count_ = 0;
    Pairs green_ = {}, red_ = {};
};

}  // namespace tspace
