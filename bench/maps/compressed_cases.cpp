// SPDX-License-Identifier: MIT
#include "compressed_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace tspace::bench {

namespace {

constexpr double kTurn = 6.283185307179586;

class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    /// Returns a number from 0 to 1, equal for every standard library.
    double operator()() { return static_cast<double>(engine_()) / 4294967296.0; }
    double around(double most) { return most * (2 * (*this)() - 1); }

  private:
    std::mt19937 engine_;
};

/// Smooth interpolation of random values at the corners of a periodic grid.
class ValueNoise {
  public:
    ValueNoise(std::size_t cells, Random& random) : cells_(cells), values_(cells * cells) {
        for (double& value : values_) value = random.around(1);
    }
    /// Returns the interpolated value at a position. x, y: in cells.
    double operator()(double x, double y) const {
        const double left = std::floor(x), top = std::floor(y);
        const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
        const double right = smooth(x - left), down = smooth(y - top);
        const auto at = [&](double i, double j) {
            const auto wrap = [&](double k) { return static_cast<std::size_t>(k) % cells_; };
            return values_[wrap(j) * cells_ + wrap(i)];
        };
        return (at(left, top) * (1 - right) + at(left + 1, top) * right) * (1 - down) +
               (at(left, top + 1) * (1 - right) + at(left + 1, top + 1) * right) * down;
    }

  private:
    std::size_t cells_;
    std::vector<double> values_;
};

/// Returns the mean normal of each texel of a height field. `heights`: in texels, with `fine` x `fine` samples per
/// texel.
NormalLevel levelOf(const std::vector<double>& heights, std::uint32_t size, std::uint32_t fine) {
    const std::size_t wide = std::size_t{size} * fine;
    const auto height = [&](std::size_t x, std::size_t y) { return heights[y % wide * wide + x % wide]; };
    NormalLevel level{size, size, std::vector<Vec3>(std::size_t{size} * size), {}};
    for (std::size_t i = 0; i < level.normals.size(); ++i) {
        DVec3 sum{};
        for (std::size_t k = 0; k < std::size_t{fine} * fine; ++k) {
            const std::size_t x = i % size * fine + k % fine, y = i / size * fine + k / fine;
            DVec3 normal{0.5 * fine * (height(x + wide - 1, y) - height(x + 1, y)),
                         0.5 * fine * (height(x, y + wide - 1) - height(x, y + 1)), 1};
            normalize(normal);
            sum = sum + normal;
        }
        normalize(sum);
        level.normals[i] = toFloat(sum);
    }
    return level;
}

template <class Height>
NormalLevel heightLevel(std::uint32_t size, std::uint32_t fine, const Height& height) {
    const std::size_t wide = std::size_t{size} * fine;
    std::vector<double> heights(wide * wide);
    for (std::size_t i = 0; i < heights.size(); ++i)
        heights[i] = height((static_cast<double>(i % wide) + 0.5) / fine, (static_cast<double>(i / wide) + 0.5) / fine);
    return levelOf(heights, size, fine);
}

NormalLevel smoothLevel(std::uint32_t size, Random random) {
    constexpr std::uint32_t kCell = 32;
    const std::uint32_t cells = size / kCell;
    std::vector<Vec2> bulges(std::size_t{cells} * cells);
    for (Vec2& bulge : bulges) bulge = {static_cast<float>(random.around(1)), static_cast<float>(random.around(1))};
    NormalLevel level{size, size, {}, {}};
    for (std::uint32_t i = 0; i < size * size; ++i) {
        const std::uint32_t x = i % size, y = i / size;
        const Vec2& bulge = bulges[std::size_t{y / kCell} * cells + x / kCell];
        const double u = (x % kCell + 0.5) / kCell, v = (y % kCell + 0.5) / kCell;
        const double across = 16 * u * (1 - u) * v * (1 - v);
        DVec3 normal{bulge.x * (0.18 * across + 0.4 * (u - 0.5) * u * (1 - u)),
                     bulge.y * (0.18 * across + 0.4 * (v - 0.5) * v * (1 - v)), 0};
        normal.z = std::sqrt(1 - normal.x * normal.x - normal.y * normal.y);
        level.normals.push_back(toFloat(normal));
    }
    return level;
}

NormalLevel reliefLevel(std::uint32_t size, Random random) {
    const ValueNoise grain(size / 4, random);
    std::array<double, 256> of_brick{};
    for (double& number : of_brick) number = random();
    const double wide = size / 8.0, high = size / 16.0;
    return heightLevel(size, 3, [&](double x, double y) {
        constexpr double kJoint = 2, kBevel = 5, kDeep = 6, kDome = 7;
        const auto row = static_cast<int>(y / high);
        const double shifted = x + (row % 2 == 0 ? 0 : wide / 2);
        const double lean = of_brick[static_cast<std::size_t>(row * 31 + static_cast<int>(shifted / wide) % 8) & 255];
        const double u = std::fmod(shifted, wide), v = std::fmod(y, high);
        const double inside = std::min({u, wide - u, v, high - v}) - kJoint;
        const double up = std::clamp(inside / kBevel, 0.0, 1.0);
        double height = kDeep * up * up * (3 - 2 * up) + 0.4 * grain(x / 4, y / 4);
        if (inside > 0) height += 0.02 * lean * (u - wide / 2) + 0.03 * (lean - 0.5) * (v - high / 2);
        const double from = ((u - wide / 2) * (u - wide / 2) + (v - high / 2) * (v - high / 2)) / (kDome * kDome);
        if (lean > 0.4 && from < 1) height += kDome * (1 - from) * (1 - from);
        return 1.3 * height;
    });
}

NormalLevel leatherLevel(std::uint32_t size, Random random) {
    const ValueNoise cells(size / 8, random), pores(size / 4, random);
    return heightLevel(size, 2,
                       [&](double x, double y) { return 2.3 * std::fabs(cells(x / 8, y / 8)) + pores(x / 4, y / 4); });
}

NormalLevel hardLevel(std::uint32_t size, Random random) {
    struct Flat {
        double x, y;
        DVec3 normal;
    };
    constexpr std::size_t kFine = 3;
    std::vector<Flat> flats(40);
    for (std::size_t i = 0; i < flats.size(); ++i) {
        const double around = kTurn * random(), tilt = i % 3 == 0 ? 0 : kTurn / 9 * random();
        const double x = size * random(), y = size * random();
        flats[i] = {x, y, {std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around), std::cos(tilt)}};
    }
    const auto flatAt = [&](double x, double y) -> const Flat& {
        const auto farFrom = [&](const Flat& flat) {
            const double across = std::fabs(x - flat.x), down = std::fabs(y - flat.y);
            return std::max(std::min(across, size - across), std::min(down, size - down));
        };
        return *std::min_element(flats.begin(), flats.end(),
                                 [&](const Flat& a, const Flat& b) { return farFrom(a) < farFrom(b); });
    };
    NormalLevel level{size, size, {}, {}};
    for (std::size_t i = 0; i < std::size_t{size} * size; ++i) {
        DVec3 sum{};
        for (std::size_t k = 0; k < kFine * kFine; ++k)
            sum = sum + flatAt(static_cast<double>(i % size) + (static_cast<double>(k % kFine) + 0.5) / kFine,
                               static_cast<double>(i / size) + (static_cast<double>(k / kFine) + 0.5) / kFine)
                            .normal;
        normalize(sum);
        level.normals.push_back(toFloat(sum));
    }
    return level;
}

NormalLevel scratchLevel(std::uint32_t size, Random random) {
    constexpr std::uint32_t kFine = 3;
    const auto wide = static_cast<int>(size * kFine);
    std::vector<double> heights(static_cast<std::size_t>(wide) * static_cast<std::size_t>(wide));
    const int count = static_cast<int>(260 * (size / 512.0) * (size / 512.0)) + 1;
    for (int i = 0; i < count; ++i) {
        const double x = size * random(), y = size * random(), turn = kTurn * random();
        const double longest = 30 + 120 * random(), width = 0.5 + random(), depth = 0.2 + 0.8 * random();
        const int reach = std::min(static_cast<int>(longest * kFine / 2) + 12, wide / 2 - 1);
        for (int row = -reach; row <= reach; ++row) {
            for (int column = -reach; column <= reach; ++column) {
                const double right = static_cast<double>(column) / kFine, down = static_cast<double>(row) / kFine;
                const double along = right * std::cos(turn) + down * std::sin(turn);
                const double across = down * std::cos(turn) - right * std::sin(turn);
                if (std::fabs(along) > longest / 2 || std::fabs(across) > 2 * width) continue;
                const double groove =
                    std::exp(-across * across / (width * width)) * (1 - 4 * along * along / (longest * longest));
                const int at_x = (static_cast<int>(x * kFine) + column + wide) % wide;
                const int at_y = (static_cast<int>(y * kFine) + row + wide) % wide;
                double& height = heights[static_cast<std::size_t>(at_y * wide + at_x)];
                height = std::min(height, -depth * groove);
            }
        }
    }
    return levelOf(heights, size, kFine);
}

}  // namespace

std::vector<CompressedCase> compressedCases(std::uint32_t size, std::uint32_t seed) {
    return {{"smooth", smoothLevel(size, Random(seed))},
            {"relief", reliefLevel(size, Random(seed + 1))},
            {"leather", leatherLevel(size, Random(seed + 2))},
            {"hard", hardLevel(size, Random(seed + 3))},
            {"scratch", scratchLevel(size, Random(seed + 4))}};
}

}  // namespace tspace::bench
