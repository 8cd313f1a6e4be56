// SPDX-License-Identifier: MIT
#include "maps/carried_error.h"

#include <cmath>
#include <vector>

#include "maps/texel_triangles.h"
#include "maps/texture_sample.h"

namespace tspace {

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
    // One point of four for each texel, off its centre as those that renderers filter.
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
