// SPDX-License-Identifier: MIT
#include "images/map_coverage.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tspace {
namespace {

constexpr float kTransparent = 0.5F / 255, kOpaque = 1 - kTransparent;

bool isUnit(const Vec3& texel) {
    constexpr float kOff = 0.1F;
    const Vec3 v{2 * texel.x - 1, 2 * texel.y - 1, 2 * texel.z - 1};
    return std::fabs(std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z) - 1) <= kOff;
}

Vec3 dividedBy(const Vec3& texel, float alpha) { return {texel.x / alpha, texel.y / alpha, texel.z / alpha}; }

/// Evidence for the meaning of alpha: number of texels by alpha, and number of unit vectors among them.
struct AlphaEvidence {
    std::uint64_t transparent = 0, transparent_unit = 0, opaque = 0, opaque_unit = 0;
    std::uint64_t partial = 0, straight_unit = 0, divided_unit = 0;

    explicit AlphaEvidence(const FloatImage& image) {
        for (std::size_t i = 0; i < image.texels.size(); ++i) {
            const Vec3& texel = image.texels[i];
            const float alpha = image.alpha[i];
            const std::uint64_t is_unit = isUnit(texel) ? 1 : 0;
            if (alpha <= kTransparent) {
                ++transparent;
                transparent_unit += is_unit;
            } else if (alpha >= kOpaque) {
                ++opaque;
                opaque_unit += is_unit;
            } else {
                ++partial;
                straight_unit += is_unit;
                divided_unit += isUnit(dividedBy(texel, alpha)) ? 1 : 0;
            }
        }
    }
    [[nodiscard]] bool isPremultiplied() const { return divided_unit > straight_unit; }
    [[nodiscard]] bool isCoverage() const {
        const std::uint64_t surface = opaque + partial, unit = opaque_unit + std::max(straight_unit, divided_unit);
        return transparent > 0 && 10 * transparent_unit <= transparent && surface > 0 && 10 * unit >= 9 * surface;
    }
};

}  // namespace

std::vector<float> takeCoverage(MapAlpha alpha, FloatImage& image, std::vector<std::string>& warnings) {
    std::vector<float> coverage = std::exchange(image.alpha, {});
    if (coverage.empty()) {
        if (alpha == MapAlpha::coverage)
            warnings.emplace_back("the image has no alpha channel, so all texels are treated as fully covered");
        return {};
    }
    image.alpha = std::move(coverage);
    const AlphaEvidence evidence(image);
    coverage = std::exchange(image.alpha, {});
    if (alpha == MapAlpha::data || (alpha == MapAlpha::automatic && !evidence.isCoverage())) {
        const bool is_unclear = alpha == MapAlpha::automatic && evidence.transparent > 0;
        warnings.push_back(std::string("the image has an alpha channel, which is ignored") +
                           (is_unclear ? ": of " + std::to_string(evidence.transparent) + " texels with alpha 0, " +
                                             std::to_string(evidence.transparent_unit) +
                                             " hold unit vectors; if alpha 0 marks texels outside the surface, set the "
                                             "option alpha to coverage"
                                       : ""));
        return {};
    }
    if (alpha == MapAlpha::automatic)
        warnings.push_back(
            "alpha is read as coverage, because only texels with alpha above 0 hold unit vectors; the " +
            std::to_string(evidence.transparent) +
            " texels with alpha 0 are excluded from mip levels; set the option alpha to data to ignore alpha");
    if (evidence.isPremultiplied()) {
        for (std::size_t i = 0; i < image.texels.size(); ++i) {
            if (coverage[i] > kTransparent) image.texels[i] = dividedBy(image.texels[i], coverage[i]);
        }
        if (alpha == MapAlpha::automatic)
            warnings.emplace_back("the colors were premultiplied by alpha, so they were divided by it");
    }
    for (float& part : coverage) part = part <= kTransparent ? 0 : std::min(part, 1.0F);
    return coverage;
}

}  // namespace tspace
