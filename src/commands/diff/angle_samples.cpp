// SPDX-License-Identifier: MIT
// Nearest-rank percentiles.
#include "commands/diff/angle_samples.h"

#include <algorithm>
#include <cmath>

#include "core/base/sort.h"
#include "core/base/vec_math.h"

namespace tspace {

namespace {

/// The smallest value that `share` of all do not exceed.
double percentile(const std::vector<float>& sorted, double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

double AngleSamples::add(const Vec3& a, const Vec3& b) {
    const bool has_a = isDirection(a), has_b = isDirection(b);
    if (!has_a || !has_b) {
        unusable_count_ += has_a != has_b;
        return 0;
    }
    const double degrees = angleBetween(toDouble(a), toDouble(b)) * (180 / kPi);
    degrees_.push_back(static_cast<float>(degrees));
    return degrees;
}

void AngleSamples::append(const AngleSamples& other) {
    degrees_.insert(degrees_.end(), other.degrees_.begin(), other.degrees_.end());
    unusable_count_ += other.unusable_count_;
}

AngleStatistics AngleSamples::statistics() const {
    AngleStatistics result;
    result.count = degrees_.size();
    result.unusable_count = unusable_count_;
    if (degrees_.empty()) return result;
    std::vector<float> sorted = degrees_;
    sortList(sorted.begin(), sorted.end());
    double sum = 0;
    for (const float value : sorted) {
        sum += value;
        const auto bin = std::lower_bound(kAngleBins.begin(), kAngleBins.end() - 1, static_cast<double>(value));
        ++result.histogram[static_cast<std::size_t>(bin - kAngleBins.begin())];
    }
    result.mean_deg = sum / static_cast<double>(sorted.size());
    result.median_deg = percentile(sorted, 0.5);
    result.p95_deg = percentile(sorted, 0.95);
    result.max_deg = sorted.back();
    return result;
}

}  // namespace tspace
