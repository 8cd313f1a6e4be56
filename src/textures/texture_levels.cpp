// SPDX-License-Identifier: MIT
#include "textures/texture_levels.h"

#include <cmath>

#include "images/map_coverage.h"
#include "images/texture_vectors.h"
#include "maps/texels/shading.h"
#include "textures/blocks/filtered_error.h"
#include "textures/blocks/fit_blocks.h"

namespace tspace {
namespace {

/// Returns unit vectors, and counts texels without a direction and texels below the horizon. `far_off`: number of
/// texels whose length is outside 0.65 to 1.15, which normal maps do not have: `bake --lengths free` and `convert-map
/// --bits 8` write lengths from 0.7 to 1.1 before rounding.
NormalLevel normalsOf(const FloatImage& image, std::vector<float>&& coverage, std::uint64_t& far_off,
                      CompressMapFileReport& report) {
    constexpr double kMostOff = 0.1, kShortest = 0.65, kLongest = 1.15;
    NormalLevel level{image.width, image.height, std::vector<Vec3>(image.texels.size()), {}, std::move(coverage)};
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        if (!level.coverage.empty() && level.coverage[i] == 0) {
            level.normals[i] = {0, 0, 1};
            continue;
        }
        DVec3 vector = decodeTexel(image.texels[i], {});
        const double size = length(vector);
        if (std::fabs(size - 1) > kMostOff) ++report.not_unit;
        if (size < kShortest || size > kLongest) ++far_off;
        if (vector.z < 0) ++report.below_horizon;
        level.normals[i] = normalize(vector) ? toFloat(vector) : Vec3{0, 0, 1};
    }
    return level;
}

/// Projects vectors below the horizon onto it, where two channels can represent them.
void projectOntoHorizon(NormalLevel& level) {
    for (Vec3& normal : level.normals) {
        if (normal.z >= 0) continue;
        DVec3 laid{normal.x, normal.y, 0};
        normal = normalize(laid) ? toFloat(laid) : Vec3{0, 0, 1};
    }
}

PackedLevel roundLevel(const NormalLevel& level, bool is_signed) {
    PackedLevel packed;
    packed.bytes.reserve(2 * level.normals.size());
    packed.texels.reserve(level.normals.size());
    const double half = is_signed ? 127 : 127.5, zero = is_signed ? 0 : 127.5;
    const auto add = [&](float part) {
        const double number = std::floor(static_cast<double>(part) * half + zero + 0.5);
        packed.bytes.push_back(static_cast<std::uint8_t>(static_cast<int>(number)));
        return static_cast<float>((number - zero) / half);
    };
    for (const Vec3& normal : level.normals) {
        const float x = add(normal.x), y = add(normal.y);
        packed.texels.push_back({x, y, 0});
    }
    return packed;
}

std::optional<PackedLevel> packByAstcenc(const NormalLevel& level, TextureQuality quality, Parallel& parallel) {
    std::vector<Vec2> texels = fitTexels(level, parallel);
    std::optional<std::vector<std::uint8_t>> blocks = packAstc(level.width, level.height, quality, texels, parallel);
    if (!blocks) return {};
    PackedLevel packed{*std::move(blocks), {}};
    for (const Vec2& texel : texels) packed.texels.push_back({texel.x, texel.y, 0});
    return packed;
}

void addWarnings(const FloatImage& image, std::uint64_t far_off, const CompressMapFileOptions& options, bool has_three,
                 CompressMapFileReport& report) {
    const auto warn = [&](std::string text) { report.warnings.push_back(std::move(text)); };
    const std::uint64_t total = image.texels.size();
    if (report.below_horizon > 0 && !has_three)
        warn(std::to_string(report.below_horizon) +
             " texels point below the surface, which two channels cannot store; "
             "they were moved to the horizon (z = 0)");
    if (far_off > total / 10)
        warn(std::to_string(far_off) + " of " + std::to_string(total) +
             " texels are not unit vectors; check that the image is a normal map in tangent space");
    if (has_three) {
        if (options.format != TextureFormat::bc5 || options.is_signed)
            warn("PNGs store three channels, so --format is ignored");
    } else if (options.format == TextureFormat::rg8 && options.quality != TextureQuality::fast) {
        warn("the quality has no effect on RG8, which is only rounded");
    }
}

}  // namespace

std::optional<PackedLevel> packLevel(const NormalLevel& level, const CompressMapFileOptions& options,
                                     Parallel& parallel) {
    if (options.format == TextureFormat::rg8) return roundLevel(level, options.is_signed);
    if (options.format == TextureFormat::astc4x4) return packByAstcenc(level, options.quality, parallel);
    FittedLevel fitted = fitBlocks(level, {options.format, options.is_signed, options.quality}, parallel);
    PackedLevel packed{std::move(fitted.blocks), {}};
    packed.texels.reserve(fitted.texels.size());
    for (const Vec2& texel : fitted.texels) packed.texels.push_back({texel.x, texel.y, 0});
    return packed;
}

TexelKind textureKind(const CompressMapFileOptions& options) {
    constexpr TexelKind kKinds[][2] = {{TexelKind::bc5, TexelKind::bc5s},
                                       {TexelKind::eacRg, TexelKind::eacRgs},
                                       {TexelKind::rg8, TexelKind::rg8s},
                                       {TexelKind::astc, TexelKind::astc}};
    return kKinds[static_cast<std::size_t>(options.format)][options.is_signed ? 1 : 0];
}

std::vector<std::uint8_t> ddsFileOf(const Texture& texture, DdsHeader header) {
    return writeDds(texture, header == DdsHeader::dx10 ? nullptr : header == DdsHeader::bc5u ? "BC5U" : "ATI2");
}

std::optional<Error> textureFault(const CompressMapFileOptions& options, bool is_dds) {
    if (!(options.roughness_factor >= 0 && options.roughness_factor <= 1))
        return Error{ErrorCode::invalidOption, "the roughness factor must be from 0 to 1"};
    if (options.format == TextureFormat::astc4x4) {
        if (options.is_signed)
            return Error{ErrorCode::invalidOption, "ASTC has no signed format; omit --signed, or use another --format"};
        if (const char* why_not = whyNoAstcWritten()) return Error{ErrorCode::unsupportedFile, why_not};
    }
    if (is_dds) {
        if (const char* why_not = whyNotDds(textureKind(options))) return Error{ErrorCode::invalidOption, why_not};
    }
    return {};
}

void beginReport(FloatImage& image, CompressMapFileReport& report) {
    report.width = image.width;
    report.height = image.height;
    report.bits_before = image.bits;
    if (std::string how_read = readTextureVectors(image); !how_read.empty())
        report.warnings.push_back(std::move(how_read));
}

MapLevels makeMapLevels(FloatImage image, const CompressMapFileOptions& options, bool has_roughness, bool has_three,
                        Parallel& parallel, CompressMapFileReport& report) {
    MapLevels made;
    std::uint64_t far_off = 0;
    std::vector<float> coverage = takeCoverage(options.alpha, image, report.warnings);
    NormalLevel first = normalsOf(image, std::move(coverage), far_off, report);
    addWarnings(image, far_off, options, has_three, report);
    image = {};
    if (report.below_horizon > 0 && !has_three) {
        made.truth = first;
        projectOntoHorizon(first);
    }
    const bool has_coverage = !first.coverage.empty();
    if (options.levels || has_roughness || has_coverage) {
        made.levels = makeNormalLevels(std::move(first), parallel, has_roughness);
    } else {
        made.levels.push_back(std::move(first));
    }
    for (std::size_t i = 0; has_coverage && i < made.truth.normals.size(); ++i) {
        if (made.truth.coverage[i] == 0) made.truth.normals[i] = made.levels.front().normals[i];
    }
    return made;
}

void keepError(const FilteredError& error, CompressMapFileReport& report) {
    report.mean_error_deg = error.mean_deg;
    report.p99_error_deg = error.p99_deg;
    report.max_error_deg = error.max_deg;
    report.max_error_x = error.max_x;
    report.max_error_y = error.max_y;
}

std::optional<Texture> packLevels(const MapLevels& map, const CompressMapFileOptions& options, Parallel& parallel,
                                  CompressMapFileReport& report) {
    Texture texture{.width = report.width, .height = report.height, .kind = textureKind(options), .levels = {}};
    report.format = std::string(texelFormat(texture.kind).name) + (texture.kind == TexelKind::astc ? " 4x4" : "");
    for (const NormalLevel& level : map.levels) {
        std::optional<PackedLevel> packed = packLevel(level, options, parallel);
        if (!packed) return {};
        if (texture.levels.empty()) {
            const NormalLevel& truth = map.truth.normals.empty() ? level : map.truth;
            keepError(measureFiltered(truth, packed->texels, true, parallel), report);
        }
        texture.levels.push_back(std::move(packed->bytes));
    }
    return texture;
}

std::vector<RoughnessLevel> makeRoughness(const RoughnessLevel& first, const CompressMapFileOptions& options,
                                          const MapLevels& map, Parallel& parallel, CompressMapFileReport& report) {
    std::vector<RoughnessLevel> levels =
        makeRoughnessLevels(first, static_cast<float>(options.roughness_factor), map.levels, parallel);
    double sum = 0;
    for (const Vec3& texel : first.texels) sum += static_cast<double>(texel.y);
    report.mean_roughness = options.roughness_factor * sum / static_cast<double>(first.texels.size());
    report.mean_widened_roughness = static_cast<double>(levels.back().texels.front().y);
    if (!options.levels) levels.resize(1);
    return levels;
}

Texture roughnessTexture(std::span<const RoughnessLevel> levels) {
    Texture texture{
        .width = levels.front().width, .height = levels.front().height, .kind = TexelKind::rgba8, .levels = {}};
    for (const RoughnessLevel& level : levels) {
        std::vector<std::uint8_t>& bytes = texture.levels.emplace_back();
        bytes.reserve(4 * level.texels.size());
        for (const Vec3& texel : level.texels) {
            for (const float part : {texel.x, texel.y, texel.z, 1.0F}) bytes.push_back(roundedChannel(part));
        }
    }
    return texture;
}

}  // namespace tspace
