// SPDX-License-Identifier: MIT
#include "maps/error/measure_points.h"

#include <algorithm>
#include <numeric>

#include "maps/layout/low_points.h"
#include "maps/rays/ray_directions.h"
#include "maps/texels/texture_sample.h"

namespace tspace {
namespace {

constexpr std::size_t kPointsOfTask = 1024;

/// Returns a hash of an edge that is equal for both directions.
std::uint64_t hashEdge(const LowPoly& low, std::size_t a, std::size_t b) {
    const std::uint64_t x = hashCorner(low, a), y = hashCorner(low, b);
    return foldHash(std::min(x, y), std::max(x, y));
}

/// Returns whether a triangle has finite UVs.
bool shows(const LowPoly& low, std::size_t triangle) {
    const Vec2 a = low.uvs[3 * triangle], b = low.uvs[3 * triangle + 1], c = low.uvs[3 * triangle + 2];
    return std::isfinite(a.x + a.y + b.x + b.y + c.x + c.y);
}

}  // namespace

DVec3 shadedAt(const MapImage& map, const MapCandidate& candidate, const CornerFrames& corners,
               const std::array<double, 3>& weights, const Vec2& uv) {
    const TextureShape shape{map.width, map.height, map.wrap_u, map.wrap_v};
    DVec3 vector = decodeTexel(sampleBilinear(shape, map.texels, uv), candidate.reading);
    if (candidate.space == MapSpace::object) {
        vector = fromAxes(candidate.axes, vector);
        return normalize(vector) ? vector : DVec3{};
    }
    return shadedNormal(shadingFrame(corners, weights, candidate.reading), vector);
}

MeasurePoints MeasurePoints::spread(const MapSurfaces& surfaces, std::uint32_t count, const MapWork& work) {
    MeasurePoints made;
    const LowPoly& low = surfaces.low();
    made.findBorders(low);
    const AreaPoints places(surfaces.triangleCount(),
                            [&](std::size_t i) { return shows(low, i) ? faceSize(low.positions, i) : 0; });
    if (places.empty()) return made;
    made.points_.resize(count);
    const auto spreadTask = [&](std::size_t task) {
        double guess = 0;
        const std::size_t end = std::min<std::size_t>(count, (task + 1) * kPointsOfTask);
        for (std::size_t i = task * kPointsOfTask; i < end; ++i) {
            Point& point = made.points_[i];
            const LowPoint place = places.at(i, count);
            point.triangle = place.triangle;
            point.second = static_cast<float>(place.weights[1]);
            point.third = static_cast<float>(place.weights[2]);
            DVec3 normal;
            RayNeighborhood around;
            point.is_hit = surfaces.truthAt(point.triangle, point.weights(), guess, normal, &around);
            point.is_hidden = around.has_front_further_out;
            point.met_back = around.met_back;
            point.is_inward = around.normal_is_inward;
            if (point.is_hit) point.normal = toFloat(normal);
        }
    };
    const std::size_t tasks = (count + kPointsOfTask - 1) / kPointsOfTask;
    forTasksWithProgress(work, tasks, "measuring", spreadTask);
    return made;
}

void MeasurePoints::findBorders(const LowPoly& low) {
    const std::size_t count = low.positions.count;
    std::vector<std::uint64_t> edges(count);
    for (std::size_t corner = 0; corner < count; ++corner)
        edges[corner] = hashEdge(low, corner, corner % 3 == 2 ? corner - 2 : corner + 1);
    std::vector<std::uint64_t> sorted = edges;
    std::sort(sorted.begin(), sorted.end());
    borders_.assign(count / 3, 0);
    for (std::size_t corner = 0; corner < count; ++corner) {
        const auto [from, to] = std::equal_range(sorted.begin(), sorted.end(), edges[corner]);
        if (to - from == 1) borders_[corner / 3] |= static_cast<std::uint8_t>(1U << corner % 3);
    }
}

bool MeasurePoints::isNearBorder(const MapImage& map, const LowPoly& low, const Point& point, const Vec2& uv) const {
    const unsigned borders = borders_[point.triangle];
    const auto inTexels = [&](const Vec2& at) {
        return DVec3{static_cast<double>(at.x) * map.width, static_cast<double>(at.y) * map.height, 0};
    };
    for (std::size_t i = 0; i < 3; ++i) {
        if ((borders >> i & 1) == 0) continue;
        const std::size_t corner = 3 * std::size_t{point.triangle};
        if (squaredDistanceTo(inTexels(uv), inTexels(low.uvs[corner + i]), inTexels(low.uvs[corner + (i + 1) % 3])) <=
            1)
            return true;
    }
    return false;
}

MapError MeasurePoints::measure(const MapImage& map, const MapSurfaces& surfaces, const MapCandidate& candidate,
                                Parallel& parallel) const {
    MapError error;
    error.reach = surfaces.reach();
    error.cage_offset = surfaces.cageOffset();
    const LowPoly& low = surfaces.low();
    const StridedSpan<const Vec4>& tangents = candidate.tangents.empty() ? low.tangents : candidate.tangents;
    // A point whose ray hit nothing counts as kMissedDeg, whatever the map contains at that point.
    std::vector<float> angles(points_.size(), static_cast<float>(kMissedDeg));
    std::vector<std::uint8_t> near_border(points_.size());
    parallel.forRanges(points_.size(), kPointsOfTask, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Point& point = points_[i];
            const std::array<double, 3> weights = point.weights();
            const Vec2 uv = mixedAt(low.uvs, point.triangle, weights);
            near_border[i] = isNearBorder(map, low, point, uv) ? 1 : 0;
            if (!point.is_hit) continue;
            const DVec3 shaded = shadedAt(map, candidate, surfaces.corners(point.triangle, tangents), weights, uv);
            const double angle = degreesBetween(shaded, toDouble(point.normal));
            // A point for which the map yields no direction gets the largest possible error.
            angles[i] = dot(shaded, shaded) > 0 && std::isfinite(angle) ? static_cast<float>(angle) : 180.0F;
        }
    });
    countPoints(error);
    if (points_.empty()) return error;
    double at_seams = 0, inside = 0, met = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const auto angle = static_cast<double>(angles[i]);
        if (points_[i].is_hit) met += angle;
        (near_border[i] != 0 ? at_seams : inside) += angle;
        error.seam_point_count += near_border[i];
    }
    error.mean_deg = (at_seams + inside) / static_cast<double>(points_.size());
    const std::size_t inside_count = points_.size() - error.seam_point_count;
    if (error.point_count > 0) error.met_mean_deg = met / static_cast<double>(error.point_count);
    if (error.seam_point_count > 0) error.seam_mean_deg = at_seams / static_cast<double>(error.seam_point_count);
    if (inside_count > 0) error.inside_mean_deg = inside / static_cast<double>(inside_count);
    const auto place = angles.begin() + static_cast<std::ptrdiff_t>((angles.size() - 1) * 99 / 100);
    std::nth_element(angles.begin(), place, angles.end());
    error.p99_deg = static_cast<double>(*place);
    error.max_deg = static_cast<double>(*std::max_element(place, angles.end()));
    return error;
}

void MeasurePoints::countPoints(MapError& error) const {
    for (const Point& point : points_) {
        error.point_count += point.is_hit ? 1 : 0;
        error.hidden_count += point.is_hidden ? 1 : 0;
        error.back_count += point.met_back ? 1 : 0;
        error.inward_count += point.is_inward ? 1 : 0;
    }
    error.missed_count = points_.size() - error.point_count;
}

std::vector<float> heatOf(const MapImage& map, const MapSurfaces& surfaces, const MapCandidate& candidate,
                          const MapWork& work) {
    constexpr std::uint32_t kSide = 2;  // number of points per texel and axis
    const SampleBands bands(uvTriangles(surfaces.low().uvs, map), map.width, map.height, kSide, 0);
    const StridedSpan<const Vec4>& tangents = candidate.tangents.empty() ? surfaces.low().tangents : candidate.tangents;
    std::vector<float> heat(std::size_t{map.width} * map.height, 0);
    std::vector<std::uint16_t> counts(heat.size(), 0);
    const auto fillBand = [&](std::size_t band) {
        double guess = 0;
        bands.forSamples(band, [&](const BandSample& sample) {
            const std::size_t texel = std::size_t{sample.row / kSide} * map.width + sample.column / kSide;
            DVec3 truth;
            const std::array<double, 3> weights = sample.weights();
            if (counts[texel] == 0xffff || !surfaces.truthAt(sample.triangle, weights, guess, truth)) return;
            const DVec3 shaded = shadedAt(map, candidate, surfaces.corners(sample.triangle, tangents), weights,
                                          mixedAt(surfaces.low().uvs, sample.triangle, weights));
            const double angle = degreesBetween(shaded, truth);
            heat[texel] += std::isfinite(angle) ? static_cast<float>(angle) : 180.0F;
            ++counts[texel];
        });
    };
    forTasksWithProgress(work, bands.bandCount(), "drawing the error", fillBand);
    for (std::size_t i = 0; i < heat.size(); ++i) heat[i] = counts[i] > 0 ? heat[i] / counts[i] : -1;
    return heat;
}

}  // namespace tspace
