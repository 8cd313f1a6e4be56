// SPDX-License-Identifier: MIT
#include "commands/check/map_slopes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "commands/check/map_alpha.h"
#include "commands/check/normal_map.h"
#include "commands/check/texel_statistics.h"
#include "images/layout_guess.h"

namespace tspace {
namespace {

/// Returns the image decoded by the layout.
RgbImage readAs(const DecodedMap& map, const MapLayout& layout) {
    RgbImage read = map.image;
    readByLayout(read, map.alpha, layout);
    return read;
}

GreenTest slopesOf(const RgbImage& read, const DecodedMap& map) { return GreenBlocks(read, map.inside).all(); }
GreenTest slopesOf(const DecodedMap& map, const MapLayout& layout) { return slopesOf(readAs(map, layout), map); }

MapLayout exchanged(MapLayout layout) {
    std::swap(layout.x, layout.y);
    return layout;
}

bool hasSide(const GreenTest& test) { return test.verdict == GreenVerdict::up || test.verdict == GreenVerdict::down; }

/// Returns whether the slopes of a map fit a height field well.
bool fitsWell(const GreenTest& other, double min_correlation = 0.8) {
    return hasSide(other) && std::fabs(other.correlation) > min_correlation;
}

/// Decides which of the two channels other than z is x. Returns whether the slopes show it; if not, the layout stays.
bool chooseXAndY(const DecodedMap& map, MapLayout& layout) {
    constexpr double kClear = 0.2, kMuchNearer = 2, kRounding = 0.02;
    const auto isClear = [](const GreenTest& one, const GreenTest& other) {
        const double a = std::fabs(one.correlation), b = std::fabs(other.correlation);
        return a > b + kClear || (fitsWell(one) && 1 - b > kMuchNearer * (1 - a) + kRounding);
    };
    const GreenTest plain = slopesOf(map, layout), other = slopesOf(map, exchanged(layout));
    if (isClear(plain, other)) return true;
    if (!isClear(other, plain)) return false;
    layout = exchanged(layout);
    return true;
}

/// Finds x or y in alpha. DXT5nm, with x in alpha and y in green, is assumed where the slopes do not show which is x.
std::optional<MapAnalysis> analyzeAlpha(const DecodedMap& map, std::span<const TexelBytes> texels) {
    constexpr double kMinCorrelation = 0.5;  // a mask or heights in alpha correlate by less than 0.1
    for (const AlphaPair& pair : alphaPairs(texels)) {
        MapAnalysis analysis{.content = MapContent::xInAlpha, .count = texels.size(), .total = texels.size()};
        analysis.layout = pair.is_gray ? twoChannelLayout(pair.color, MapChannel::alpha)
                                       : twoChannelLayout(MapChannel::alpha, pair.color);
        const bool is_known = chooseXAndY(map, analysis.layout);
        analysis.is_order_open = !is_known && pair.color != MapChannel::green;
        if (pair.is_certain || fitsWell(slopesOf(map, analysis.layout), kMinCorrelation)) return analysis;
    }
    return {};
}

/// Returns whether red and green are exchanged. This cannot be detected in relief that has equal curvature along x and
/// y, such as a product of waves.
bool areXAndYExchanged(const DecodedMap& map) {
    constexpr double kMax = 0.5;
    return std::fabs(slopesOf(map.image, map).correlation) <= kMax && fitsWell(slopesOf(map, exchanged({})));
}

/// Decodes octahedral encoding of vectors with z >= 0 from the channels that the layout assigns to x and y. `is_hemi`:
/// the channels contain x + y and x - y (hemi-octahedral encoding).
RgbImage decodeOctahedral(const DecodedMap& map, const MapLayout& layout, bool is_hemi) {
    RgbImage read = readAs(map, layout);
    for (std::size_t i = 0; i + 2 < read.rgb.size(); i += 3) {
        const double first = read.rgb[i] / 127.5 - 1, second = read.rgb[i + 1] / 127.5 - 1;
        const double x = is_hemi ? (first + second) / 2 : first, y = is_hemi ? (first - second) / 2 : second;
        const double z = std::max(0.0, 1 - std::fabs(x) - std::fabs(y)), length = std::sqrt(x * x + y * y + z * z);
        read.rgb[i] = storedValue(x / length);
        read.rgb[i + 1] = storedValue(y / length);
        read.rgb[i + 2] = storedValue(z / length);
    }
    return read;
}

/// Returns whether the decoded vectors fit a height field clearly better than the plain ones. Octahedral x increases
/// with x, so plain vectors correlate too, but less: their correlation is 1.2 to 300 times as far from 1 if slopes
/// reach 0.3.
bool fitsBetter(const GreenTest& decoded, const GreenTest& plain) {
    constexpr double kClear = 1.15;
    const auto deviation = [](const GreenTest& test) { return 1 - std::fabs(test.correlation); };
    return fitsWell(decoded) && deviation(plain) > kClear * deviation(decoded);
}

/// Tests by slopes whether two channels are x and y. For a periodic height h, the products h_xx h_yy and h_xy h_xy have
/// equal means. So if the channels hold x + y and x - y, their derivatives do not correlate as those of x and y.
void testTwoChannels(const DecodedMap& map, MapAnalysis& analysis) {
    constexpr std::uint64_t kManyBlocks = 32;
    constexpr double kNoCorrelation = 0.1, kClear = 0.3;
    const GreenTest plain = slopesOf(map, analysis.layout);
    const GreenTest hemi = slopesOf(decodeOctahedral(map, analysis.layout, true), map);
    if (fitsWell(hemi) && std::fabs(hemi.correlation) > std::fabs(plain.correlation) + kClear) {
        analysis.content = MapContent::hemiOctahedral;
        return;
    }
    if (analysis.layout.z.channel != MapChannel::none) return;
    analysis.may_be_octahedral = fitsBetter(slopesOf(decodeOctahedral(map, analysis.layout, false), map), plain);
    analysis.is_doubtful =
        analysis.may_be_octahedral || (plain.verdict == GreenVerdict::unknown && plain.block_count >= kManyBlocks &&
                                       std::fabs(plain.correlation) < kNoCorrelation);
}

/// Returns the analysis of a map whose layout is known.
MapAnalysis knownLayout(const MapLayout& layout, std::span<const TexelBytes> texels) {
    const bool is_plain = layout.x == MapLayout{}.x && layout.y == MapLayout{}.y;
    return {.content = layout.z.channel != MapChannel::none ? MapContent::exchanged
                       : is_plain                           ? MapContent::twoChannels
                                                            : MapContent::xInAlpha,
            .layout = layout,
            .count = texels.size(),
            .total = texels.size()};
}

/// Returns the layout that the texels of an image with alpha suggest. In a gray image only the slopes show whether x is
/// in the colors or in alpha.
std::optional<MapAnalysis> guessedLayout(const DecodedMap& map, std::span<const TexelBytes> texels) {
    LayoutDetector guess;
    for (const TexelBytes& texel : texels) {
        const auto part = [&](std::size_t i) { return static_cast<float>(texel[i]) / 255.0F; };
        guess.add({part(0), part(1), part(2)}, part(3));
    }
    const std::optional<MapLayout> layout = guess.layout();
    if (!layout) return {};
    MapAnalysis analysis = knownLayout(*layout, texels);
    if (layout->y.channel == MapChannel::alpha)
        analysis.is_order_open = !chooseXAndY(map, analysis.layout) && map.declared == nullptr;
    return analysis;
}

/// Detects the content of a map without a transfer curve by the declared layout, alpha, the texels, and the slopes.
/// Content `encoded` means that only the curve is known so far.
MapAnalysis linearContentOf(const DecodedMap& map, std::span<const TexelBytes> texels,
                            std::span<const TexelOnSurface> surface, std::span<const TexelOnSurface> in_world) {
    if (map.declared != nullptr && !(*map.declared == MapLayout{})) {
        MapAnalysis analysis = knownLayout(*map.declared, texels);
        analysis.is_declared = true;
        return analysis;
    }
    if (const std::optional<MapAnalysis> found = analyzeAlpha(map, texels)) return *found;
    MapAnalysis analysis = analyzeTexels(texels, !map.alpha.empty(), surface, in_world);
    if (analysis.content == MapContent::exchanged) chooseXAndY(map, analysis.layout);
    if (analysis.content == MapContent::normals && areXAndYExchanged(map)) {
        analysis.content = MapContent::exchanged;
        analysis.layout = exchanged({});
    }
    if (map.declared != nullptr ? !map.alpha.empty() : analysis.content == MapContent::xInAlpha)
        return guessedLayout(map, texels).value_or(analysis);
    return analysis;
}

/// Returns whether a map with this content may have a transfer curve in addition, or instead.
bool mayHaveCurve(const MapAnalysis& analysis, const DecodedMap& map, std::span<const TexelBytes> texels) {
    constexpr double kFewUnit = 0.5;
    switch (analysis.content) {
        case MapContent::encoded:
        case MapContent::picture:
        case MapContent::twoChannels: return true;
        case MapContent::normals: return unitShare(texels) < kFewUnit;
        case MapContent::objectSpace: return !analysis.follows_mesh;
        case MapContent::height: return !map.alpha.empty();  // x or y in gray, beside alpha
        default: return false;
    }
}

/// Maximum absolute mean of x and of y that shows that a curve was undone: without relief, both are 0.
constexpr double kNearZero = 0.15;

/// Returns whether showsCurve() can be true for these texels: they contain the vectors of object space, or two channels
/// whose means are near 0. Much faster than their analysis.
bool mayShowCurve(std::span<const TexelBytes> texels) {
    std::size_t near_zero = 0;
    for (std::size_t channel = 0; channel < 4; ++channel)
        near_zero += std::fabs(spreadOf(texels, channel).mean * kByteStep - 1) < kNearZero;
    return near_zero >= 2 || unitShare(texels) >= kLeastUnitShare;
}

/// Returns whether the content of a map after a curve was undone shows that the map had the curve: x and y are near 0,
/// and the slopes fit a height field.
bool showsCurve(const DecodedMap& map, const MapAnalysis& analysis, std::span<const TexelBytes> texels) {
    constexpr double kAnyLength = 1;
    if (analysis.content == MapContent::objectSpace) return analysis.follows_mesh;
    const auto at = [](const MapComponent& component) { return static_cast<std::size_t>(component.channel); };
    return analysis.content != MapContent::normals && holdsNormals(analysis.content) &&
           canBeXy(texels, at(analysis.layout.x), at(analysis.layout.y), kNearZero, kAnyLength) &&
           fitsWell(slopesOf(map, analysis.layout));
}

/// Detects the content of a map that may have a transfer curve.
MapAnalysis contentOf(const DecodedMap& map, std::span<const TexelBytes> texels,
                      std::span<const TexelOnSurface> surface, std::span<const TexelOnSurface> in_world) {
    const MapAnalysis plain = linearContentOf(map, texels, surface, in_world);
    if (!mayHaveCurve(plain, map, texels)) return plain;
    const bool is_encoded = plain.content == MapContent::encoded;
    for (const MapCurve curve : {MapCurve::srgb, MapCurve::linearized}) {
        if (is_encoded && plain.layout.curve != curve) continue;
        const LayoutReader reader({.curve = curve});
        const auto decoded = [&reader](const TexelBytes& texel) -> TexelBytes {
            const DVec3 v = reader.vector(texel);
            return {storedValue(v.x), storedValue(v.y), storedValue(v.z), texel[3]};
        };
        std::vector<TexelBytes> read;
        std::transform(texels.begin(), texels.end(), std::back_inserter(read), decoded);
        if (!is_encoded && !mayShowCurve(read)) continue;
        const auto decodedAll = [&](std::span<const TexelOnSurface> points) {
            std::vector<TexelOnSurface> all(points.begin(), points.end());
            for (TexelOnSurface& point : all) point.texel = decoded(point.texel);
            return all;
        };
        const RgbImage image = readAs(map, {.curve = curve});
        const DecodedMap linear{image, map.alpha, map.inside, map.declared};
        MapAnalysis analysis = linearContentOf(linear, read, decodedAll(surface), decodedAll(in_world));
        const bool is_known = is_encoded && analysis.content != MapContent::normals && holdsNormals(analysis.content);
        if (!is_known && !showsCurve(linear, analysis, read)) continue;
        analysis.layout.curve = curve;
        return analysis;
    }
    return plain;
}

}  // namespace

MapAnalysis analyzeMap(const DecodedMap& map, std::span<const TexelOnSurface> surface,
                       std::span<const TexelOnSurface> in_world) {
    const std::vector<TexelBytes> texels = sampleTexels(map.image, map.alpha, map.inside);
    MapAnalysis analysis = contentOf(map, texels, surface, in_world);
    // In hemi-octahedral encoding, steep relief has larger values than x and y of unit vectors can have, and gentle
    // relief looks flat.
    const bool has_two = analysis.content == MapContent::twoChannels || analysis.content == MapContent::xInAlpha;
    const bool may_have_two = analysis.content == MapContent::normals || analysis.content == MapContent::picture;
    if (has_two || (may_have_two && isBlueConstant(texels))) testTwoChannels(map, analysis);
    return analysis;
}

MapLayout invertedRelief(MapLayout layout) {
    layout.x.is_inverted = !layout.x.is_inverted;
    layout.y.is_inverted = !layout.y.is_inverted;
    return layout;
}

bool isRotated(const MapAnalysis& analysis, bool is_y_inverted) {
    const MapLayout& layout = analysis.layout;
    return analysis.content == MapContent::exchanged && !analysis.is_declared && layout.z == MapLayout{}.z &&
           layout.x.channel == MapChannel::green && (layout.x.is_inverted != layout.y.is_inverted) != is_y_inverted;
}

}  // namespace tspace
