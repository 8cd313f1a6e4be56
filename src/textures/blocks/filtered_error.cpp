// SPDX-License-Identifier: MIT
#include "textures/blocks/filtered_error.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "maps/texels/shading.h"

namespace tspace {
namespace {

/// Number of sample points per texel and axis. They are in the middle of equal parts of the distance between adjacent
/// texel centers, so none is at a center, where the error of fitted blocks is larger than between centers.
constexpr std::size_t kPoints = 3;

class FilteredPair {
  public:
    FilteredPair(const NormalLevel& truth, std::span<const Vec3> texels, bool makes_z)
        : truth_(truth), texels_(texels), makes_z_(makes_z) {}

    /// Computes the angles at the points of row y and stores them from `angles` on.
    void measureRow(std::size_t y, float* angles) const {
        for (std::size_t x = 0; x < truth_.width; ++x) {
            for (std::size_t point = 0; point < kPoints * kPoints; ++point)
                *angles++ = static_cast<float>(angleAt(x, y, (static_cast<double>(point % kPoints) + 0.5) / kPoints,
                                                       (static_cast<double>(point / kPoints) + 0.5) / kPoints));
        }
    }

  private:
    [[nodiscard]] double angleAt(std::size_t x, std::size_t y, double right, double down) const {
        const std::size_t next_x = (x + 1) % truth_.width, next_y = (y + 1) % truth_.height;
        const std::array<std::size_t, 4> places{y * truth_.width + x, y * truth_.width + next_x,
                                                next_y * truth_.width + x, next_y * truth_.width + next_x};
        const std::array<double, 4> weights{(1 - right) * (1 - down), right * (1 - down), (1 - right) * down,
                                            right * down};
        DVec3 shaded{}, packed{};
        for (std::size_t i = 0; i < 4; ++i) {
            shaded = shaded + weights[i] * toDouble(truth_.normals[places[i]]);
            packed = packed + weights[i] * toDouble(texels_[places[i]]);
        }
        if (makes_z_) packed.z = std::sqrt(std::max(0.0, 1 - packed.x * packed.x - packed.y * packed.y));
        return degreesBetween(shaded, packed);
    }

    const NormalLevel& truth_;
    std::span<const Vec3> texels_;
    bool makes_z_;
};

}  // namespace

FilteredError measureFiltered(const NormalLevel& truth, std::span<const Vec3> texels, bool makes_z,
                              Parallel& parallel) {
    constexpr std::size_t kMostPoints = std::size_t{1} << 22;
    const std::size_t row_points = kPoints * kPoints * truth.width;
    const std::size_t step = row_points * truth.height / kMostPoints + 1;
    const std::size_t first = std::min<std::size_t>(step / 2, truth.height - 1),
                      rows = (truth.height - first + step - 1) / step;
    std::vector<float> angles(rows * row_points);
    const FilteredPair pair(truth, texels, makes_z);
    parallel.forRanges(rows, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) pair.measureRow(first + i * step, &angles[i * row_points]);
    });
    FilteredError error;
    double sum = 0;
    for (const float angle : angles) sum += static_cast<double>(angle);
    error.mean_deg = sum / static_cast<double>(angles.size());
    const auto worst = static_cast<std::size_t>(std::max_element(angles.begin(), angles.end()) - angles.begin());
    error.max_deg = static_cast<double>(angles[worst]);
    const std::size_t texel = worst % row_points / (kPoints * kPoints), point = worst % (kPoints * kPoints);
    error.max_x = static_cast<double>(texel) + (static_cast<double>(point % kPoints) + 0.5) / kPoints + 0.5;
    error.max_y = static_cast<double>(first + worst / row_points * step) +
                  (static_cast<double>(point / kPoints) + 0.5) / kPoints + 0.5;
    const auto near_end = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() * 99 / 100);
    std::nth_element(angles.begin(), near_end, angles.end());
    error.p99_deg = static_cast<double>(*near_end);
    return error;
}

}  // namespace tspace
