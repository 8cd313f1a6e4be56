// SPDX-License-Identifier: MIT
#include "maps/convert/convert_texel.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "maps/layout/texel_triangles.h"
#include "maps/texels/quantize.h"
#include "maps/texels/texture_sample.h"

namespace tspace {
namespace {

/// Maximum distance of vectors that count as equal: far below a step of 16 bits, and far above the error of inverting a
/// frame in double precision.
constexpr double kSameVector = 1e-7;

bool isOnGrid(float channel, unsigned most) {
    const double scaled = static_cast<double>(channel) * most;
    // The error of a float n / most is half a unit in the last place, and slightly more after computing 1 - n / most.
    return std::fabs(scaled - std::nearbyint(scaled)) <= most * 1.5e-7;
}

bool isOnGrid(const Vec3& texel, const TexelNumbers& numbers) {
    if (numbers.bits == 32) return true;
    const unsigned most = numbers.most();
    return isOnGrid(texel.x, most) && isOnGrid(texel.y, most) && isOnGrid(texel.z, most);
}

/// Returns the texel that stores a vector. If it chooses 8-bit integers, the length of the vector may change for a
/// better direction. Otherwise the length changes only if a component exceeds 1.
Vec3 storedTexel(const DVec3& vector, const MapReading& reading, const TexelNumbers& numbers) {
    const DVec3 encoded = encodeTexel(vector, reading);
    DVec3 stored{2 * encoded.x - 1, 2 * encoded.y - 1, 2 * encoded.z - 1};
    if (numbers.bits == 8 && !numbers.are_chosen) {
        DVec3 direction = stored;
        if (normalize(direction))
            stored = nearestIntegers(
                {.most = numbers.most(), .is_two_channel = reading.two_channels, .scale = reading.scale}, direction);
    }
    const double largest = std::max({std::fabs(stored.x), std::fabs(stored.y), std::fabs(stored.z)});
    if (largest > 1) stored = (1 / largest) * stored;
    return channelsOf(stored, numbers.are_chosen ? TexelNumbers{.bits = 32} : numbers);
}

/// Returns whether two interpretations store a vector in the same way, apart from the direction of green.
bool storesAlike(const MapReading& a, const MapReading& b) {
    return a.scale == b.scale && a.two_channels == b.two_channels;
}

}  // namespace

Vec3 channelsOf(const DVec3& stored, const TexelNumbers& numbers) {
    const auto channel = [&](double component) {
        const double part = std::clamp(0.5 * (component + 1), 0.0, 1.0);
        if (numbers.bits == 32) return static_cast<float>(part);
        const auto most = static_cast<float>(numbers.most());
        return static_cast<float>(std::floor(part * most + 0.5)) / most;
    };
    return {channel(stored.x), channel(stored.y), channel(stored.z)};
}

std::optional<ConvertedTexel> convertTexel(const Vec3& texel, const ShadingFrame& from, const MapReading& from_reading,
                                           const ShadingFrame& to, const MapReading& to_reading,
                                           const TexelNumbers& numbers) {
    const DVec3 before = decodeTexel(texel, from_reading);
    const double size = length(before);
    const DVec3 direction = shadedNormal(from, before);
    DVec3 after = vectorFor(to, direction);
    if (!(size > 0) || !std::isfinite(size) || !(dot(direction, direction) > 0) || !(dot(after, after) > 0)) return {};
    after = size * after;
    ConvertedTexel converted;
    const DVec3 unconverted = shadedNormal(to, decodeTexel(texel, to_reading));
    converted.change_deg = degreesBetween(unconverted, direction);
    if (!std::isfinite(converted.change_deg)) return {};
    if (length(after - before) <= kSameVector * size && storesAlike(from_reading, to_reading)) {
        converted.texel = texel;
        if (from_reading.green != to_reading.green) converted.texel.y = 1 - texel.y;
        converted.stays = isOnGrid(converted.texel, numbers);
        if (converted.stays) return converted;
    }
    if (to_reading.two_channels && after.z < 0) {
        after.z = 0;
        converted.is_below_horizon = true;
        if (!normalize(after)) return {};
    }
    converted.texel = storedTexel(after, to_reading, numbers);
    return converted;
}

namespace {

constexpr std::size_t kTrianglesOfTask = 256;

struct AngleSums {
    double converted = 0, unconverted = 0;
    std::uint64_t count = 0;
};

}  // namespace

ShadingFrame sideFrame(const MapSide& side, std::size_t triangle, const std::array<double, 3>& weights) {
    if (side.space == MapSpace::object) {
        const MapAxes axes = side.axes.empty() ? MapAxes{} : side.axes[triangle];
        return {toDouble(axes.x), toDouble(axes.y), toDouble(axes.z)};
    }
    CornerFrames corners;
    for (std::size_t i = 0; i < 3; ++i) {
        corners.normals[i] = side.normals[3 * triangle + i];
        corners.tangents[i] = side.tangents[3 * triangle + i];
    }
    return shadingFrame(corners, weights, side.reading);
}

CarriedError measureCarried(const MapImage& map, std::span<const Vec3> converted, const MapSide& from,
                            const MapSide& to, Parallel& parallel) {
    const TextureShape shape{map.width, map.height, map.wrap_u, map.wrap_v};
    const std::size_t triangles = from.uvs.count / 3, tasks = (triangles + kTrianglesOfTask - 1) / kTrianglesOfTask;
    std::vector<AngleSums> sums(tasks);
    // The error is measured at one of four points per texel, which differs between adjacent texels. None of the points
    // is a texel center, so the maps are filtered as in a renderer.
    const auto isTaken = [](const UvSample& sample) {
        const double column = std::floor(sample.x), row = std::floor(sample.y);
        const int corner = (sample.x - column > 0.5 ? 1 : 0) + (sample.y - row > 0.5 ? 2 : 0);
        return ((static_cast<std::int64_t>(column) + 2 * static_cast<std::int64_t>(row)) & 3) == corner;
    };
    const auto addSample = [&](std::size_t triangle, const UvSample& sample, AngleSums& sum) {
        const Vec2 uv{static_cast<float>(sample.x / map.width), static_cast<float>(sample.y / map.height)};
        const Vec3 old_texel = sampleBilinear(shape, map.texels, uv), texel = sampleBilinear(shape, converted, uv);
        const ShadingFrame before = sideFrame(from, triangle, sample.weights);
        const ShadingFrame after = sideFrame(to, triangle, sample.weights);
        const DVec3 wanted = shadedNormal(before, decodeTexel(old_texel, from.reading));
        const DVec3 old = shadedNormal(after, decodeTexel(old_texel, to.reading));
        const DVec3 now = shadedNormal(after, decodeTexel(texel, to.reading));
        const double unconverted_deg = degreesBetween(old, wanted), converted_deg = degreesBetween(now, wanted);
        if (!std::isfinite(unconverted_deg) || !std::isfinite(converted_deg)) return;
        sum.unconverted += unconverted_deg;
        sum.converted += converted_deg;
        ++sum.count;
    };
    parallel.forTasks(tasks, [&](std::size_t task) {
        const std::size_t end = std::min(triangles, (task + 1) * kTrianglesOfTask);
        for (std::size_t triangle = task * kTrianglesOfTask; triangle < end; ++triangle) {
            const std::array<Vec2, 3> uvs{from.uvs[3 * triangle], from.uvs[3 * triangle + 1],
                                          from.uvs[3 * triangle + 2]};
            forEachSample(uvs, shape, 2, [&](const UvSample& sample) {
                if (isTaken(sample)) addSample(triangle, sample, sums[task]);
            });
        }
    });
    AngleSums all;
    for (const AngleSums& part : sums) {
        all.converted += part.converted;
        all.unconverted += part.unconverted;
        all.count += part.count;
    }
    if (all.count == 0) return {};
    const auto count = static_cast<double>(all.count);
    return {.mean_deg = all.converted / count, .mean_unconverted_deg = all.unconverted / count, .count = all.count};
}

}  // namespace tspace
