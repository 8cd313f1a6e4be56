// SPDX-License-Identifier: MIT
#include "maps/solve/choose_lengths.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/vec_math.h"

namespace tspace {
namespace {

constexpr std::uint32_t kRowsOfBand = 128;
constexpr unsigned kRounds = 3;

/// Consecutive rows of a map, with the row above and the row below, whose texels are fixed.
class Band {
  public:
    Band(const VectorMap& map, std::uint32_t first, std::uint32_t rows, const Allocator* allocator)
        : map_(map), height_(static_cast<std::uint32_t>(map.vectors.size() / map.width)), first_(first), rows_(rows),
          allocator_(allocator), vectors_(allocator, std::size_t{rows + 2} * map.width, Vec3{}),
          roles_(allocator, vectors_.size(), TexelRole::excluded) {}

    void choose(const IntegerChoice& choice, Parallel& parallel) {
        bool has_unknown = false;
        for (std::uint32_t y = 0; y < rows_ + 2; ++y) has_unknown = takeRow(y) || has_unknown;
        if (!has_unknown) return;
        TexelSystem system(allocator_, map_.width, rows_ + 2, {roles_.data(), roles_.size()});
        forNonAdjacentRows(parallel, rows_ + 1, [&](std::uint32_t y) {
            if (!isCut(y)) addCells(y, system);
        });
        const std::span<Vec3> vectors(vectors_.data(), vectors_.size());
        makeUnit(choice);
        chooseIntegers(system, choice, vectors, kRounds, parallel, allocator_);
        for (std::uint32_t y = 1; y <= rows_; ++y) {
            for (std::uint32_t x = 0; x < map_.width; ++x) {
                const std::size_t at = std::size_t{y} * map_.width + x;
                if (roles_[at] == TexelRole::unknown) map_.vectors[inMap(y) + x] = vectors_[at];
            }
        }
    }

  private:
    /// Returns the offset in the map of a row of the band.
    [[nodiscard]] std::size_t inMap(std::uint32_t y) const {
        return std::size_t{(first_ + height_ + y - 1) % height_} * map_.width;
    }
    /// Returns whether the texture ends between this row of the band and the next.
    [[nodiscard]] bool isCut(std::uint32_t y) const {
        return map_.wrap_v != TextureWrap::repeat && (first_ + y == 0 || first_ + y == height_);
    }

    /// Loads a row. Returns whether it contains vectors that have to be chosen.
    bool takeRow(std::uint32_t y) {
        const bool is_inside = y > 0 && y <= rows_;
        bool has_unknown = false;
        for (std::uint32_t x = 0; x < map_.width; ++x) {
            const std::size_t at = std::size_t{y} * map_.width + x, from = inMap(y) + x;
            vectors_[at] = map_.vectors[from];
            if (isZero(vectors_[at])) continue;
            const bool is_unknown = is_inside && !map_.keeps[from];
            roles_[at] = is_unknown ? TexelRole::unknown : TexelRole::fixed;
            has_unknown = has_unknown || is_unknown;
        }
        return has_unknown;
    }

    void addCells(std::uint32_t y, TexelSystem& system) const {
        const std::size_t here = std::size_t{y} * map_.width, below = here + map_.width;
        const std::uint32_t cells = map_.wrap_u == TextureWrap::repeat && map_.width > 1 ? map_.width : map_.width - 1;
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t right = system.right(x);
            const auto isUnknown = [&](std::size_t at) { return roles_[at] == TexelRole::unknown; };
            if (!isUnknown(here + x) && !isUnknown(here + right) && !isUnknown(below + x) && !isUnknown(below + right))
                continue;
            addCell(
                x, y, {vectors_.data(), vectors_.size()}, [&](const Vec3& mixed) { return sampleOf(mixed); }, system);
        }
    }

    /// Returns a sample that measures errors across a filtered vector, as angles.
    [[nodiscard]] FitSample sampleOf(const Vec3& mixed) const {
        // minimum squared length: below it, the filtered direction is unreliable
        constexpr float kLeastSquare = 0.05F;
        const float scale = map_.scale;
        const Vec3 read{scale * mixed.x, scale * mixed.y, mixed.z};
        const float square = dot(read, read);
        if (!(square > 0)) return {};
        FitSample sample = acrossSample((1 / std::sqrt(square)) * read, 0, 1);
        const float weight = 1 / std::max(square, kLeastSquare);
        const std::array<float, 6> scales{scale * scale, scale * scale, scale, scale * scale, scale, 1};
        for (std::size_t i = 0; i < scales.size(); ++i) sample.metric[i] *= weight * scales[i];
        return sample;
    }

    /// Normalizes the vectors whose length is in the requested range: only their directions matter. Other vectors keep
    /// their length, and so do vectors next to one that differs by more than 9 degrees, because filtering there depends
    /// on the lengths.
    void makeUnit(const IntegerChoice& choice) {
        constexpr float kCosine = 0.98769F, kSlack = 1e-5F;
        const Buffer<float> lengths = lengthsOf();
        const auto isNear = [&](std::size_t a, std::size_t b) {
            return !(dot(vectors_[a], vectors_[b]) < kCosine * lengths[a] * lengths[b]);
        };
        Buffer<bool> is_any(allocator_, vectors_.size(), false);
        for (std::size_t y = 1; y <= rows_; ++y) {
            for (std::size_t x = 0; x < map_.width; ++x) {
                const std::size_t row = y * map_.width, at = row + x;
                const std::size_t left = row + (x + map_.width - 1) % map_.width, right = row + (x + 1) % map_.width;
                is_any[at] = roles_[at] == TexelRole::unknown && lengths[at] > choice.least_length - kSlack &&
                             lengths[at] < choice.most_length + kSlack && isNear(at, left) && isNear(at, right) &&
                             isNear(at, at - map_.width) && isNear(at, at + map_.width);
            }
        }
        for (std::size_t i = 0; i < is_any.size(); ++i) {
            if (is_any[i]) vectors_[i] = (1 / lengths[i]) * vectors_[i];
        }
    }

    [[nodiscard]] Buffer<float> lengthsOf() const {
        Buffer<float> lengths(allocator_, vectors_.size(), 0.0F);
        for (std::size_t i = 0; i < lengths.size(); ++i) lengths[i] = length(vectors_[i]);
        return lengths;
    }

    const VectorMap& map_;
    std::uint32_t height_, first_, rows_;
    const Allocator* allocator_;
    Buffer<Vec3> vectors_;
    Buffer<TexelRole> roles_;
};

}  // namespace

IntegerChoice integerChoice(TexelLengths lengths) {
    // A range narrower than that of `even` would not improve smaller mip levels, but would increase the error of the
    // first level (figures: docs/evidence/bake-theory.md).
    if (lengths == TexelLengths::free) return {.least_length = 0.7F, .most_length = 1.1F};
    return {.least_length = 0.9F, .most_length = 1.0F};
}

void chooseLengths(const VectorMap& map, TexelLengths lengths, Parallel& parallel, const Allocator* allocator) {
    IntegerChoice choice = integerChoice(lengths);
    choice.keeps_lengths = true;
    const auto height = static_cast<std::uint32_t>(map.vectors.size() / map.width);
    for (std::uint32_t first = 0; first < height; first += kRowsOfBand)
        Band(map, first, std::min(kRowsOfBand, height - first), allocator).choose(choice, parallel);
}

}  // namespace tspace
