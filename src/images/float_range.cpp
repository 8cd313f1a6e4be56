// SPDX-License-Identifier: MIT
// Prepares floats from an image file: fills texels that are not finite, and detects vectors in the range -1 to 1.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/fill_rings.h"
#include "images/codecs.h"

namespace tspace {
namespace {

/// Values down to this limit may come from sharpening filters.
constexpr float kBelowZero = -1.0F / 64.0F;

/// A float file stores vectors either directly, from -1 to 1, or encoded as (v + 1) / 2. Counts how well texels match
/// either interpretation: unit length, or at most unit length for two channels. Zero texels are ignored as background.
class RangeEvidence {
  public:
    explicit RangeEvidence(bool has_z) : has_z_(has_z) {}

    void add(const Vec3& texel) {
        is_gray_ = is_gray_ && texel.x == texel.y && texel.y == texel.z;
        if (texel == Vec3{}) return;
        const Vec3 moved{2 * texel.x - 1, 2 * texel.y - 1, 2 * texel.z - 1};
        ++count_;
        negative_ += texel.x < kBelowZero || texel.y < kBelowZero || texel.z < kBelowZero ? 1 : 0;
        stored_fit_ += fits(texel) ? 1 : 0;
        moved_fit_ += fits(moved) ? 1 : 0;
        sum_x_ += static_cast<double>(texel.x);
        sum_y_ += static_cast<double>(texel.y);
        sum_z_ += static_cast<double>(texel.z);
    }

    /// Returns why the values are vectors in the range -1 to 1, as a clause; empty if they are not.
    /// Heights may be below 0 too, so gray texels are vectors only if alpha is a component of them (`is_vector`).
    [[nodiscard]] std::string whySigned(bool is_vector) const {
        constexpr double kMax = 0.9, kHalf = 0.5, kFew = 0.1, kSome = 0.01;
        if (count_ == 0 || (is_gray_ && !is_vector)) return {};
        const double stored = share(stored_fit_), moved = share(moved_fit_), negative = share(negative_);
        const std::string read = "; they were read as vectors from -1 to 1";
        if (negative_ > 0 && stored >= kHalf && stored > moved)
            return "the floats of the image are " + lengths() + " as stored, and some are below 0" + read;
        if (negative_ == 0 && stored >= kMax && moved <= kFew && (!has_z_ || pointsUp()))
            return "the floats of the image are " + lengths() + " as stored, but not if decoded as 2c - 1" + read;
        if (negative >= kSome && stored >= moved)
            return "values of " + std::to_string(negative_) + " of " + std::to_string(count_) +
                   " texels are below 0, so the image was read as vectors from -1 to 1; but few texels are " +
                   lengths() + ", either as stored or after 2c - 1: check that the image is a normal map";
        if (is_vector && moved < kHalf) return "its alpha is below 0 in places, like x or y of a vector" + read;
        return {};
    }

  private:
    [[nodiscard]] bool fits(const Vec3& v) const {
        constexpr float kOff = 0.1F;
        const float square = v.x * v.x + v.y * v.y;
        if (!has_z_) return square <= 1 + kOff;
        return std::fabs(std::sqrt(square + v.z * v.z) - 1) <= kOff;
    }
    [[nodiscard]] double share(std::uint64_t count) const {
        return static_cast<double>(count) / static_cast<double>(count_);
    }
    /// Returns whether the vectors point along +z on average. Unit length alone is not sufficient evidence, because
    /// colors and factors can have it too.
    [[nodiscard]] bool pointsUp() const {
        constexpr double kUp = 0.8, kMaxMeanXy = 0.25;
        const auto n = static_cast<double>(count_);
        return sum_z_ > kUp * n && std::fabs(sum_x_) < kMaxMeanXy * n && std::fabs(sum_y_) < kMaxMeanXy * n;
    }
    [[nodiscard]] std::string lengths() const { return has_z_ ? "unit vectors" : "x and y of unit vectors"; }

    bool has_z_, is_gray_ = true;
    std::uint64_t count_ = 0, negative_ = 0, stored_fit_ = 0, moved_fit_ = 0;
    double sum_x_ = 0, sum_y_ = 0, sum_z_ = 0;
};

/// Calls visit(texel) for a texel and those next to it.
template <class Visit>
void forAdjacentTexels(const FloatImage& image, std::size_t i, const Visit& visit) {
    const std::size_t x = i % image.width, y = i / image.width;
    for (std::size_t row = y == 0 ? 0 : y - 1; row < std::min<std::size_t>(y + 2, image.height); ++row) {
        for (std::size_t column = x == 0 ? 0 : x - 1; column < std::min<std::size_t>(x + 2, image.width); ++column)
            visit(row * image.width + column);
    }
}

/// Fills texels that are not finite with the means of their finite neighbors, ring by ring from the border of each
/// hole. If no texel is finite, all become `otherwise`.
void fillHoles(FloatImage& image, std::vector<bool> is_hole, const Vec3& otherwise) {
    const auto meanAround = [&](std::size_t i) {
        double count = 0, x = 0, y = 0, z = 0;
        forAdjacentTexels(image, i, [&](std::size_t near) {
            if (is_hole[near]) return;
            const Vec3& texel = image.texels[near];
            ++count;
            x += static_cast<double>(texel.x);
            y += static_cast<double>(texel.y);
            z += static_cast<double>(texel.z);
        });
        return std::optional(
            Vec3{static_cast<float>(x / count), static_cast<float>(y / count), static_cast<float>(z / count)});
    };
    for (std::size_t i = 0; i < is_hole.size(); ++i) {
        if (is_hole[i]) image.texels[i] = otherwise;
    }
    fillRings(
        is_hole, [&](std::size_t i, const auto& visit) { forAdjacentTexels(image, i, visit); }, meanAround,
        [&](std::size_t i, const Vec3& mean) { image.texels[i] = mean; });
}

}  // namespace

void readFloats(ImageUse use, FloatImage& image) {
    RangeEvidence evidence(image.texture.layout.z.channel != MapChannel::none);
    std::vector<bool> is_broken;
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        const Vec3& texel = image.texels[i];
        if (std::isfinite(texel.x) && std::isfinite(texel.y) && std::isfinite(texel.z)) {
            evidence.add(texel);
            continue;
        }
        is_broken.resize(image.texels.size());
        is_broken[i] = true;
        ++image.not_finite;
    }
    for (float& alpha : image.alpha) {
        if (!std::isfinite(alpha)) alpha = 1;
    }
    // Coverage is never negative, so an alpha below 0 is x or y of vectors.
    const bool has_signed_alpha =
        std::any_of(image.alpha.begin(), image.alpha.end(), [](float alpha) { return alpha < kBelowZero; });
    if (use == ImageUse::vectors) image.range_text = evidence.whySigned(has_signed_alpha);
    if (!image.range_text.empty()) {
        for (Vec3& texel : image.texels) texel = {0.5F * texel.x + 0.5F, 0.5F * texel.y + 0.5F, 0.5F * texel.z + 0.5F};
        if (has_signed_alpha) {
            for (float& alpha : image.alpha) alpha = 0.5F * alpha + 0.5F;
        }
    }
    if (image.not_finite == 0) return;
    fillHoles(image, std::move(is_broken), use == ImageUse::vectors ? Vec3{0.5F, 0.5F, 1} : Vec3{0.5F, 0.5F, 0.5F});
}

RgbImage roundedImage(const FloatImage& image) {
    RgbImage rounded{image.width, image.height, {}, image.not_finite, image.layer_text};
    rounded.rgb.reserve(3 * image.texels.size());
    for (const Vec3& texel : image.texels) {
        for (const float channel : {texel.x, texel.y, texel.z}) rounded.rgb.push_back(roundedChannel(channel));
    }
    return rounded;
}

}  // namespace tspace
