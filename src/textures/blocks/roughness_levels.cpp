// SPDX-License-Identifier: MIT
// Based on: Toksvig, Mipmapping Normal Maps, 2004; Olano and Baker, LEAN Mapping, 2010; Neubelt and Pettineo, The
// Order: 1886, 2013.
#include "textures/blocks/roughness_levels.h"

#include <algorithm>
#include <cmath>

namespace tspace {
namespace {

/// Computes the number of levels by which a roughness texture is smaller than the normal map (negative: larger).
/// Returns false if the sizes do not differ by a power of two.
bool findShift(const RoughnessLevel& roughness, std::uint32_t width, std::uint32_t height, int& shift) {
    constexpr int kMost = 31;
    const auto isTimes = [](std::uint32_t large, std::uint32_t small, int by) {
        return std::uint64_t{small} << by == large;
    };
    for (shift = 0; shift <= kMost; ++shift) {
        if (isTimes(width, roughness.width, shift) && isTimes(height, roughness.height, shift)) return true;
        if (isTimes(roughness.width, width, shift) && isTimes(roughness.height, height, shift)) {
            shift = -shift;
            return true;
        }
    }
    return false;
}

/// Returns the coverage of each texel of the first roughness level; empty: fully covered. `shift`: result of findShift.
std::vector<float> coverageOf(const RoughnessLevel& first, std::span<const NormalLevel> normals, int shift) {
    const auto level = static_cast<std::size_t>(std::max(shift, 0));
    if (level >= normals.size() || normals[level].coverage.empty()) return {};
    const NormalLevel& beside = normals[level];
    std::vector<float> coverage(first.texels.size());
    for (std::size_t i = 0; i < coverage.size(); ++i) {
        const std::size_t x = i % first.width * beside.width / first.width;
        const std::size_t y = i / first.width * beside.height / first.height;
        coverage[i] = beside.coverage[y * beside.width + x];
    }
    return coverage;
}

RoughnessLevel meanLevel(const RoughnessLevel& first, std::span<const float> coverage, std::uint32_t width,
                         std::uint32_t height, Parallel& parallel) {
    const std::vector<Cover> across = coversOf(first.width, width), down = coversOf(first.height, height);
    RoughnessLevel level{width, height, std::vector<Vec3>(std::size_t{width} * height)};
    parallel.forRanges(height, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t at = begin * width; at < end * width; ++at) {
            const Cover &columns = across[at % width], &rows = down[at / width];
            DVec3 sum{}, covered_sum{};
            double covered = 0;
            forCovered(first.width, columns, rows, [&](std::size_t texel, double weight) {
                const DVec3 value = toDouble(first.texels[texel]);
                sum = sum + weight * value;
                if (coverage.empty()) return;
                const double part = weight * static_cast<double>(coverage[texel]);
                covered += part;
                covered_sum = covered_sum + part * value;
            });
            level.texels[at] = toFloat(covered > 0 ? (1 / covered) * covered_sum : sum);
        }
    });
    return level;
}

float widened(float roughness, float spread) {
    const double r = static_cast<double>(roughness), square = r * r;
    return static_cast<float>(std::min(1.0, std::sqrt(std::sqrt(square * square + static_cast<double>(spread)))));
}

}  // namespace

std::string whyGridsDiffer(const RoughnessLevel& roughness, std::uint32_t width, std::uint32_t height) {
    int shift = 0;
    if (findShift(roughness, width, height, shift)) return {};
    const auto sizeOf = [](std::uint32_t across, std::uint32_t down) {
        return std::to_string(across) + " x " + std::to_string(down);
    };
    return "its " + sizeOf(roughness.width, roughness.height) + " texels do not match the " + sizeOf(width, height) +
           " texels of the normal map: the ratio of the widths and that of the heights must be the same power of two";
}

std::vector<RoughnessLevel> makeRoughnessLevels(const RoughnessLevel& first, float factor,
                                                std::span<const NormalLevel> normals, Parallel& parallel) {
    int shift = 0;
    findShift(first, normals.front().width, normals.front().height, shift);
    const std::vector<float> coverage = coverageOf(first, normals, shift);
    std::vector<RoughnessLevel> levels;
    for (std::uint32_t width = first.width, height = first.height;;
         width = std::max(width / 2, 1U), height = std::max(height / 2, 1U)) {
        RoughnessLevel level = levels.empty() ? first : meanLevel(first, coverage, width, height, parallel);
        const std::ptrdiff_t beside = static_cast<std::ptrdiff_t>(levels.size()) + shift;
        const auto count = static_cast<std::ptrdiff_t>(normals.size());
        const std::vector<float>* const spreads =
            beside < 0 ? nullptr : &normals[static_cast<std::size_t>(std::min(beside, count - 1))].spreads;
        for (std::size_t i = 0; i < level.texels.size(); ++i) {
            Vec3& texel = level.texels[i];
            texel.y = widened(factor * texel.y, spreads == nullptr ? 0.0F : (*spreads)[i % spreads->size()]);
        }
        levels.push_back(std::move(level));
        if (width == 1 && height == 1) return levels;
    }
}

}  // namespace tspace
