// SPDX-License-Identifier: MIT
#include "commands/check/map_content.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "commands/check/mesh_regression.h"
#include "commands/check/normal_map.h"
#include "commands/check/texel_statistics.h"
#include "core/base/vec_math.h"
#include "maps/texels/gray.h"

namespace tspace {
namespace {

/// Maximum deviation from 1 of an 8-bit vector's length after compression and filtering.
constexpr double kLengthSlack = 0.1;
/// Minimum x^2 + y^2 of tilted texels; corresponds to a tilt of 11 degrees.
constexpr double kMinTilt = 0.04;

/// Share of texels that are unit vectors, and statistics of their directions.
struct Fit {
    double unit_share = 0;
    DVec3 mean = {};
    std::array<double, 3> below_share = {};  ///< for x, y and z: share of unit vectors in which it is negative
};

Fit fitOf(std::span<const TexelBytes> texels, const MapLayout& layout) {
    const LayoutReader reader(layout);
    Fit fit;
    std::array<std::uint64_t, 3> below = {};
    std::uint64_t unit = 0;
    for (const TexelBytes& texel : texels) {
        const DVec3 v = reader.vector(texel);
        if (std::fabs(length(v) - 1) >= kLengthSlack) continue;
        ++unit;
        fit.mean = fit.mean + v;
        // A value one rounding step below 0 does not count as negative.
        below[0] += v.x < -kByteStep;
        below[1] += v.y < -kByteStep;
        below[2] += v.z < -kByteStep;
    }
    if (unit == 0) return fit;
    const auto count = static_cast<double>(unit);
    fit.unit_share = count / static_cast<double>(texels.size());
    fit.mean = (1 / count) * fit.mean;
    for (std::size_t i = 0; i < 3; ++i) fit.below_share[i] = static_cast<double>(below[i]) / count;
    return fit;
}

bool pointsUp(const Fit& fit) {
    return fit.mean.z > 0.5 && std::fabs(fit.mean.x) < kMaxMean && std::fabs(fit.mean.y) < kMaxMean;
}

/// Returns a function that returns red, green and blue of a texel (0 to 255).
auto colorsOf(std::span<const TexelBytes> texels) {
    return [texels](std::size_t i) {
        const TexelBytes& texel = texels[i];
        return std::array<double, 3>{static_cast<double>(texel[0]), static_cast<double>(texel[1]),
                                     static_cast<double>(texel[2])};
    };
}

bool isGrayTexels(std::span<const TexelBytes> texels) { return isGray(texels.size(), colorsOf(texels)); }

/// Returns all texels except black and white ones, which were never painted or baked.
std::vector<TexelBytes> paintedOf(std::span<const TexelBytes> texels) {
    constexpr int kBlack = 8, kWhite = 247;
    std::vector<TexelBytes> painted;
    std::copy_if(texels.begin(), texels.end(), std::back_inserter(painted), [](const TexelBytes& texel) {
        const auto [least, most] = std::minmax({texel[0], texel[1], texel[2]});
        return most > kBlack && least < kWhite;
    });
    return painted;
}

class MapAnalyzer {
  public:
    MapAnalyzer(std::span<const TexelBytes> texels, bool has_alpha, std::span<const TexelOnSurface> surface,
                std::span<const TexelOnSurface> in_world)
        : texels_(texels), has_alpha_(has_alpha), surface_(surface), in_world_(in_world), plain_(fitOf(texels, {})) {
        for (std::size_t i = 0; i < channels_.size(); ++i)
            channels_[i] = spreadOf(texels, [i](const TexelBytes& texel) { return static_cast<double>(texel[i]); });
    }

    [[nodiscard]] MapAnalysis analysis() const {
        if (const auto found = directionsInSurface()) return *found;
        if (const auto found = xInAlpha()) return *found;
        if (const auto found = lostX()) return *found;
        if (isGrayTexels(texels_)) return made(MapContent::height, {}, 1);
        if (const auto found = twoChannels(kMaxMean)) return *found;
        if (const auto found = encoded()) return *found;
        if (const auto found = tiltedTwoChannels()) return *found;
        if (const auto found = picture()) return *found;
        if (const auto found = objectSpace()) return *found;
        if (const auto found = exchanged()) return *found;
        if (const auto found = unsignedZ()) return *found;
        return made(MapContent::normals, {}, 1);
    }

  private:
    [[nodiscard]] MapAnalysis made(MapContent content, const MapLayout& layout, double share) const {
        const std::uint64_t total = texels_.size();
        const auto count = static_cast<std::uint64_t>(share * static_cast<double>(total) + 0.5);
        return {.content = content, .layout = layout, .count = count, .total = total};
    }

    /// Detects directions in the surface, as in flow and anisotropy maps: blue is constant, and (red, green) has length
    /// 1 nearly everywhere, which in a normal map would be a cliff.
    [[nodiscard]] std::optional<MapAnalysis> directionsInSurface() const {
        constexpr double kNearOne = 0.1, kMinShare = 0.9;
        if (channels_[2].deviation > kConstant || channels_[0].deviation <= kConstant) return {};
        const double share = texelShare(texels_, [](const TexelBytes& texel) {
            return std::fabs(std::sqrt(squareOf(texel, 0, 1)) - 1) < kNearOne;
        });
        if (share < kMinShare) return {};
        MapAnalysis analysis = made(MapContent::picture, {}, share);
        analysis.holds_directions = true;
        return analysis;
    }

    [[nodiscard]] bool mayBeXInAlpha() const {
        return has_alpha_ && channels_[3].deviation > kConstant && channels_[1].deviation > kConstant &&
               (channels_[0].deviation <= kConstant || isGrayTexels(texels_));
    }

    /// Detects x in alpha: red is constant or a copy of green, and alpha varies like x. A gray image with another alpha
    /// channel is a height map with a mask.
    [[nodiscard]] std::optional<MapAnalysis> xInAlpha() const {
        if (!mayBeXInAlpha() || plain_.unit_share > 0.5 || !canBeXy(texels_, 3, 1)) return {};
        MapLayout layout;
        layout.x.channel = MapChannel::alpha;
        layout.z.channel = MapChannel::none;
        return made(MapContent::xInAlpha, layout, 1);
    }

    /// Detects a lost x: red and blue are constant, red is not a possible mean of x, and green varies like y.
    [[nodiscard]] std::optional<MapAnalysis> lostX() const {
        constexpr double kFarX = 0.9, kFewUnit = 0.1;
        const auto isConstant = [&](std::size_t i) { return channels_[i].deviation <= kConstant; };
        const auto valueOf = [&](std::size_t i) { return channels_[i].mean * kByteStep - 1; };
        if (!isConstant(0) || isConstant(1) || !isConstant(2) || (has_alpha_ && !isConstant(3))) return {};
        if (std::fabs(valueOf(0)) < kFarX || std::fabs(valueOf(1)) > kMaxMean || plain_.unit_share > kFewUnit)
            return {};
        MapAnalysis analysis = made(MapContent::picture, {}, 1);
        analysis.is_x_lost = true;
        return analysis;
    }

    /// Returns whether blue is z of vectors with equal lengths, which may differ from 1: z^2 falls as x^2 + y^2 grows.
    /// For gentle relief in 8 bits, rounding alone makes the squared lengths vary.
    [[nodiscard]] bool haveOneLength(double max_of_spread) const {
        constexpr double kRounding = 0.006, kMinSlope = 0.5, kMaxSlope = 1.5;
        const auto zz = [](const TexelBytes& texel) { return signedValue(texel[2]) * signedValue(texel[2]); };
        const auto xy = [](const TexelBytes& texel) { return squareOf(texel, 0, 1); };
        const Spread across = spreadOf(texels_, xy), up = spreadOf(texels_, zz);
        const double rest = spreadOf(texels_, [&](const TexelBytes& texel) { return xy(texel) + zz(texel); }).deviation;
        if (channels_[2].mean * kByteStep < 1 || !(across.deviation > 0)) return false;
        if (rest < max_of_spread * across.deviation) return true;
        double product = 0;
        for (const TexelBytes& texel : texels_) product -= (xy(texel) - across.mean) * (zz(texel) - up.mean);
        const double unit = across.deviation * across.deviation * static_cast<double>(texels_.size());
        return rest < kRounding && product > kMinSlope * unit && product < kMaxSlope * unit;
    }

    /// Detects two channels: blue is constant and differs from the expected z, on all texels or on tilted ones. Maps
    /// that are flat nearly everywhere are not reported: Khronos' Lantern has one with blue = 255, which is wrong by
    /// only 0.15 degrees on average.
    [[nodiscard]] std::optional<MapAnalysis> twoChannels(double max_mean) const {
        constexpr double kFar = 0.3, kNearlyConstant = 16, kMaxCorrelation = 0.5;
        constexpr double kSeenDeg = 0.5, kMaxTogether = 0.9;
        constexpr std::uint64_t kMinCount = 16;
        const Spread& blue = channels_[2];
        if (blue.deviation > kNearlyConstant) return {};
        if (!canBeXy(texels_, 0, 1, max_mean)) return {};
        // In shaded pictures, red correlates with green, and slightly with blue.
        if (blue.deviation > kConstant && channelCorrelations(texels_.size(), colorsOf(texels_))[0] > kMaxTogether)
            return {};
        double off = 0, wanted = 0, error = 0, product = 0, angle = 0;
        const Spread up = spreadOf(texels_, [](const TexelBytes& texel) { return expectedZ(texel, 0, 1); });
        std::uint64_t count = 0;
        for (const TexelBytes& texel : texels_) {
            const double z = expectedZ(texel, 0, 1);
            const double stored = signedValue(texel[2]), across = std::sqrt(squareOf(texel, 0, 1));
            error += std::fabs(stored - z);
            angle += std::fabs(std::atan2(across, stored) - std::atan2(across, z)) * 180 / kPi;
            product += (texel[2] - blue.mean) * (z - up.mean);
            if (squareOf(texel, 0, 1) < kMinTilt) continue;
            ++count;
            off += (texel[2] - blue.mean) * (texel[2] - blue.mean);
            wanted += (127.5 * (z + 1) - blue.mean) * (127.5 * (z + 1) - blue.mean);
        }
        // Blue is far from z and does not correlate with it: it varies only by compression.
        const auto total = static_cast<double>(texels_.size());
        const bool goes_with_z =
            blue.deviation > kConstant && std::fabs(product) > kMaxCorrelation * total * blue.deviation * up.deviation;
        const bool is_far = error / total > kFar && !goes_with_z;
        const bool is_constant = blue.deviation <= kConstant && count >= kMinCount &&
                                 off <= kConstant * kConstant * static_cast<double>(count) && wanted >= 4 * off &&
                                 angle >= kSeenDeg * total;
        if ((!is_far && !is_constant) || haveOneLength(0.5)) return {};
        MapLayout layout;
        layout.z.channel = MapChannel::none;
        return made(MapContent::twoChannels, layout, 1);
    }

    /// Detects two channels in maps with a constant blue channel whose relief is tilted to one side.
    [[nodiscard]] std::optional<MapAnalysis> tiltedTwoChannels() const {
        constexpr double kMaxTiltedMean = 0.6;
        for (std::size_t i = 0; i < 3; ++i) {
            if ((channels_[i].deviation > kConstant) == (i == 2)) return {};
        }
        return twoChannels(kMaxTiltedMean);
    }

    [[nodiscard]] std::optional<MapAnalysis> encoded() const {
        for (const MapCurve curve : {MapCurve::srgb, MapCurve::linearized}) {
            const MapLayout layout{.curve = curve};
            const Fit fit = fitOf(texels_, layout);
            if (pointsUp(fit) && fit.unit_share > 0.8 && fit.unit_share > plain_.unit_share + 0.4)
                return made(MapContent::encoded, layout, fit.unit_share);
        }
        return {};
    }

    /// Axis (0 to 2) and sign of the mean direction of the vectors; none if they have no main axis.
    struct MainDirection {
        std::size_t axis = 2;
        bool is_inverted = false;
    };
    [[nodiscard]] std::optional<MainDirection> mainDirection() const {
        constexpr double kMinMean = 0.6, kMaxAside = 0.3, kMaxBelow = 0.02;
        const std::array<double, 3> mean{plain_.mean.x, plain_.mean.y, plain_.mean.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double below = mean[axis] < 0 ? 1 - plain_.below_share[axis] : plain_.below_share[axis];
            if (std::fabs(mean[axis]) < kMinMean || below > kMaxBelow) continue;
            if (std::fabs(mean[(axis + 1) % 3]) > kMaxAside || std::fabs(mean[(axis + 2) % 3]) > kMaxAside) continue;
            return MainDirection{axis, mean[axis] < 0};
        }
        return {};
    }

    /// Agreement of the map's vectors with normals: the mean cosine; 0 if they do not follow the normals.
    struct NormalAgreement {
        MapLayout layout = {};
        double agreement = 0;
    };
    [[nodiscard]] NormalAgreement agreementWithNormals(std::span<const TexelOnSurface> surface,
                                                       const std::optional<MainDirection>& up) const;
    [[nodiscard]] std::optional<MapAnalysis> objectSpace() const;

    [[nodiscard]] std::optional<MapAnalysis> exchanged() const {
        const std::optional<MainDirection> up = mainDirection();
        if (plain_.unit_share < 0.7 || !up || (up->axis == 2 && !up->is_inverted)) return {};
        MapLayout layout;
        if (up->axis == 0) std::swap(layout.x, layout.z);
        if (up->axis == 1) std::swap(layout.y, layout.z);
        layout.z.is_inverted = up->is_inverted;
        const double below = plain_.below_share[up->axis];
        return made(MapContent::exchanged, layout, up->is_inverted ? below : 1 - below);
    }

    /// Detects z stored without sign: over tilted texels the slope of blue against z is about 1, not 1/2, and blue is
    /// much nearer to z than to (z + 1) / 2.
    [[nodiscard]] std::optional<MapAnalysis> unsignedZ() const {
        constexpr std::uint64_t kMinCount = 64;
        // Maximum share of texels with x^2 + y^2 > 1. JPEG causes some if blue varies as much as red and green.
        constexpr double kMaxLong = 0.05;
        constexpr double kNoSpread = 0.2;  // limit of haveOneLength; unsigned z results in 0.4 or more
        if (!canBeXy(texels_, 0, 1, kMaxMean, kMaxLong) || haveOneLength(kNoSpread)) return {};
        double z = 0, b = 0, zz = 0, zb = 0, bb = 0, off = 0, off_signed = 0;
        std::uint64_t count = 0;
        for (const TexelBytes& texel : texels_) {
            const double square = squareOf(texel, 0, 1);
            if (square < kMinTilt || square > 1) continue;
            const double wanted = std::sqrt(1 - square), blue = texel[2] / 255.0;
            ++count;
            z += wanted;
            b += blue;
            zz += wanted * wanted;
            zb += wanted * blue;
            bb += blue * blue;
            off += (blue - wanted) * (blue - wanted);
            off_signed += (blue - (wanted + 1) / 2) * (blue - (wanted + 1) / 2);
        }
        if (count < kMinCount) return {};
        const auto n = static_cast<double>(count);
        const double var_z = zz / n - z * z / n / n, var_b = bb / n - b * b / n / n, cov = zb / n - z * b / n / n;
        if (var_z < 1e-5 || var_b < 1e-5 || std::sqrt(off / n) > 0.1 || 4 * off > off_signed) return {};
        const double slope = cov / var_z, agreement = cov * cov / var_z / var_b;
        if (slope < 0.6 || slope > 1.3 || agreement < 0.5) return {};
        MapLayout layout;
        layout.z.channel = MapChannel::none;
        MapAnalysis analysis = made(MapContent::unsignedZ, layout, 1);
        analysis.count = count;
        return analysis;
    }

    /// Returns the share of texels that are unit vectors when decoded by the best transfer curve. A curve is used only
    /// if the decoded vectors point up.
    [[nodiscard]] static double unitShareOf(std::span<const TexelBytes> texels) {
        double share = fitOf(texels, {}).unit_share;
        for (const MapCurve curve : {MapCurve::srgb, MapCurve::linearized}) {
            const Fit fit = fitOf(texels, {.curve = curve});
            if (pointsUp(fit)) share = std::max(share, fit.unit_share);
        }
        return share;
    }

    /// Returns whether the map can be in tangent space: blue is z and nearly always positive, or blue is constant and
    /// red and green can be x and y.
    [[nodiscard]] bool mayPointUp(std::span<const TexelBytes> texels, const DVec3& mean) const {
        constexpr double kMinUp = 0.7, kMaxBelow = 0.1;
        constexpr std::uint8_t kZero = 127 - 16;  // tolerance for compression errors
        const double below = texelShare(texels, [](const TexelBytes& texel) { return texel[2] < kZero; });
        return (mean.z > kMinUp && below < kMaxBelow) || (channels_[2].deviation <= kConstant && canBeXy(texels, 0, 1));
    }

    /// Detects pictures: few colors are unit vectors, and either they do not point up, or the channels rise and fall
    /// together, as shading makes them. Light and dark grays are unit vectors only by chance: they lie on a diagonal,
    /// where the components of real unit vectors cannot all increase together. Images with one color or few texels, and
    /// images with x and y plus another channel, are not classified.
    [[nodiscard]] std::optional<MapAnalysis> picture() const {
        constexpr double kMaxUnit = 0.7, kFewUnit = 0.5, kTogether = 0.5, kMuchTogether = 0.8, kMinDiagonal = 0.35,
                         kOneWay = 0.75;
        constexpr std::size_t kMinCount = 256;
        const bool varies = std::any_of(channels_.begin(), channels_.begin() + 3,
                                        [](const Spread& channel) { return channel.deviation > kConstant; });
        if (!varies || mayBeXInAlpha()) return {};
        const std::vector<TexelBytes> painted = paintedOf(texels_);
        if (painted.size() < kMinCount) return {};
        DVec3 mean{};
        for (const TexelBytes& texel : painted)
            mean = mean + DVec3{signedValue(texel[0]), signedValue(texel[1]), signedValue(texel[2])};
        if (!normalize(mean)) mean = {};
        const std::array<double, 3> together = channelCorrelations(painted.size(), colorsOf(painted));
        const auto [weakest, strongest] = std::minmax({together[0], together[1], together[2]});
        const double least = std::min({mean.x, mean.y, mean.z}), most = std::max({mean.x, mean.y, mean.z});
        const bool is_diagonal = weakest >= kTogether && (least > kMinDiagonal || most < -kMinDiagonal);
        // Detects colors that all have one direction, which is not an axis. A map of a wall in object space has such
        // vectors too, but its channels do not rise and fall together like those of a picture.
        const bool is_aside = strongest >= kMuchTogether && !mainDirection() && length(plain_.mean) > kOneWay;
        const double unit = unitShareOf(painted);
        const double max_unit = !mayPointUp(painted, mean) ? kMaxUnit : weakest >= kTogether ? kFewUnit : 0;
        const bool is_none = is_diagonal || is_aside;
        if (!is_none && unit >= max_unit) return {};
        MapAnalysis analysis = made(MapContent::picture, {}, 1);
        analysis.total = painted.size();
        analysis.count =
            static_cast<std::uint64_t>((is_none ? 1 : 1 - unit) * static_cast<double>(analysis.total) + 0.5);
        return analysis;
    }

    std::span<const TexelBytes> texels_;
    bool has_alpha_;
    std::span<const TexelOnSurface> surface_, in_world_;
    Fit plain_;
    std::array<Spread, 4> channels_ = {};
};

Moments momentsOf(std::span<const TexelOnSurface> surface) {
    const LayoutReader reader({});
    Moments moments;
    for (const TexelOnSurface& point : surface) {
        DVec3 v = reader.vector(point.texel);
        if (!normalize(v)) continue;
        const std::array<double, 3> from{point.normal.x, point.normal.y, point.normal.z}, to{v.x, v.y, v.z};
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) moments.sum[i][k] += point.weight * from[i] * to[k];
        }
        moments.weight += point.weight;
    }
    return moments;
}

MapAnalyzer::NormalAgreement MapAnalyzer::agreementWithNormals(std::span<const TexelOnSurface> surface,
                                                               const std::optional<MainDirection>& up) const {
    constexpr std::size_t kMinPoints = 8;
    constexpr double kMinAgreement = 0.5, kSureAgreement = 0.9, kOfTheBest = 0.97, kOfTheRest = 0.4;
    const Moments moments = momentsOf(surface);
    if (surface.size() < kMinPoints || !(moments.weight > 0)) return {};
    const bool is_up = up && up->axis == 2 && !up->is_inverted;
    // Agreement with the mesh's own axes: with unchanged channels (`plain`), and with permuted channels (`axes`).
    const double plain = (moments.sum[0][0] + moments.sum[1][1] + moments.sum[2][2]) / moments.weight;
    const Axes axes = bestAxes(moments);
    const std::array<double, 3> mean{plain_.mean.x, plain_.mean.y, plain_.mean.z};
    const double constant = std::fabs(up ? mean[up->axis] : plain_.mean.z);
    const bool is_plain = plain >= kMinAgreement && plain > axes.agreement - 0.05;
    const double agreement = is_plain ? plain : axes.agreement;
    // If a rotation agrees better than any permutation, the map was made for the axes of another program, which are
    // unknown.
    const bool is_clear = agreement >= kMinAgreement && agreement >= kOfTheBest * bestAgreement(moments) &&
                          1 - agreement < kOfTheRest * (1 - constant);
    const bool is_wall = !is_up && up && is_plain && plain >= kSureAgreement;
    const MapLayout layout = is_plain ? MapLayout{} : axes.layout;
    const bool is_of_mesh = is_clear || is_wall
                                ? isOfMesh(surface, layout, is_up)
                                : is_plain && agreement >= kMinAgreement && isOfMeshUnderRelief(surface, layout, is_up);
    if (!is_of_mesh) return {};
    return {layout, agreement};
}

std::optional<MapAnalysis> MapAnalyzer::objectSpace() const {
    constexpr double kMuchBelow = 0.2, kRounding = 1e-6;
    if (plain_.unit_share < kLeastUnitShare) return {};
    const std::optional<MainDirection> up = mainDirection();
    const NormalAgreement mesh = agreementWithNormals(surface_, up), world = agreementWithNormals(in_world_, up);
    const bool is_in_world = world.agreement > mesh.agreement + kRounding;
    if (const NormalAgreement& best = is_in_world ? world : mesh; best.agreement > 0) {
        MapAnalysis analysis = made(MapContent::objectSpace, best.layout, plain_.unit_share);
        analysis.follows_mesh = true;
        analysis.is_in_world = is_in_world;
        return analysis;
    }
    if (up || plain_.below_share[2] < kMuchBelow) return {};
    return made(MapContent::objectSpace, {}, plain_.below_share[2]);
}

}  // namespace

std::vector<TexelBytes> sampleTexels(const RgbImage& image, std::span<const std::uint8_t> alpha,
                                     const TexelMask& inside) {
    constexpr std::uint64_t kMax = std::uint64_t{1} << 18;
    std::uint32_t step = 1;
    while (std::uint64_t{image.width} * image.height / step / step > kMax) ++step;
    std::vector<TexelBytes> texels;
    for (std::uint32_t y = step / 2; y < image.height; y += step) {
        for (std::uint32_t x = step / 2; x < image.width; x += step) {
            if (!inside.has(x, y)) continue;
            const std::size_t pixel = std::size_t{y} * image.width + x;
            const std::uint8_t* rgb = image.rgb.data() + 3 * pixel;
            texels.push_back({rgb[0], rgb[1], rgb[2], alpha.empty() ? std::uint8_t{255} : alpha[pixel]});
        }
    }
    return texels;
}

MapAnalysis analyzeTexels(std::span<const TexelBytes> texels, bool has_alpha, std::span<const TexelOnSurface> surface,
                          std::span<const TexelOnSurface> in_world) {
    if (texels.empty()) return {};
    return MapAnalyzer(texels, has_alpha, surface, in_world).analysis();
}

double unitShare(std::span<const TexelBytes> texels) { return texels.empty() ? 0 : fitOf(texels, {}).unit_share; }

bool isBlueConstant(std::span<const TexelBytes> texels) { return !texels.empty() && isConstant(texels, 2); }

void readByLayout(RgbImage& image, std::span<const std::uint8_t> alpha, const MapLayout& layout) {
    const LayoutReader reader(layout);
    for (std::size_t pixel = 0; 3 * pixel < image.rgb.size(); ++pixel) {
        std::uint8_t* rgb = image.rgb.data() + 3 * pixel;
        const DVec3 v = reader.vector({rgb[0], rgb[1], rgb[2], alpha.empty() ? std::uint8_t{255} : alpha[pixel]});
        rgb[0] = storedValue(v.x);
        rgb[1] = storedValue(v.y);
        rgb[2] = storedValue(v.z);
    }
}

}  // namespace tspace
