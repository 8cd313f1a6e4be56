// SPDX-License-Identifier: MIT
#include "maps/rays/map_surfaces.h"

#include <algorithm>
#include <cmath>

#include "core/base/border.h"
#include "core/base/near_positions.h"
#include "core/base/numbers.h"
#include "maps/texels/texture_sample.h"

namespace tspace {
namespace {

/// Ratio of the sizes of two models above which they are assumed to use different units.
constexpr double kOtherUnit = 8;
/// Maximum distance between corresponding sides of two boxes, relative to the low poly's diagonal: kFits for boxes that
/// match after a rotation, kMismatch for boxes that match as they are (or after scaling).
constexpr double kFits = 0.02, kMismatch = 0.1;

/// Returns the bounding box of the transformed corners of a box.
template <class Change>
PositionBox changed(const PositionBox& box, const Change& change) {
    PositionBox result;
    result.add(change(box.least));
    result.add(change(box.most));
    return result;
}

std::string sizesApart(const PositionBox& low, const PositionBox& high) {
    const double factor = high.diagonal() / low.diagonal();
    const char* const larger = factor > 1 ? "high" : "low";
    const char* const smaller = factor > 1 ? "low" : "high";
    const std::string text = std::string("the ") + larger + " poly is " + shortNumber(std::max(factor, 1 / factor)) +
                             " times as large as the " + smaller + " poly";
    const PositionBox scaled = changed(high, [&](const DVec3& at) { return (1 / factor) * at; });
    if (scaled.difference(low) > kMismatch * low.diagonal()) return text + ": check that both use the same unit";
    return text + ": scale the high poly by " + shortNumber(1 / factor) + " to align it with the low poly";
}

}  // namespace

double reachBetween(const PositionBox& low, const PositionBox& high) {
    if (low.isEmpty() || high.isEmpty()) return 0;
    const double size = std::max(low.diagonal(), high.diagonal());
    const double most = size / 4, reach = std::max(size / 20, 1.5 * low.difference(high));
    return low.meets(high, size / 20) ? std::min(most, reach) : 0;
}

std::string misplacement(const PositionBox& low, const PositionBox& high) {
    const double size = low.diagonal(), other = high.diagonal();
    if (!(size > 0 && other > 0)) return {};
    if (other > kOtherUnit * size || size > kOtherUnit * other) return sizesApart(low, high);
    if (high.difference(low) <= kMismatch * size) return {};
    const auto fits = [&](double sign) {
        const PositionBox turned = changed(high, [&](const DVec3& at) {
            return DVec3{at.x, sign * at.z, -sign * at.y};
        });
        return turned.difference(low) <= kFits * size;
    };
    for (const int sign : {1, -1}) {
        if (fits(sign))
            return std::string("the up axis of the high poly differs: rotate it by ") + (sign > 0 ? "-90" : "90") +
                   " degrees about x to align it with the low poly";
    }
    return {};
}

namespace {

Error apartError(const PositionBox& low, const PositionBox& high) {
    const std::string why = misplacement(low, high);
    return makeError(ErrorCode::missingAttribute, kNoElement, "the low poly and the high poly do not overlap%s%s",
                     why.empty() ? "" : "; ", why.c_str());
}

Error checkHighMaps(const HighPoly& high) {
    if (high.maps.empty()) return {ErrorCode::ok};
    if (high.normals.empty() || high.tangents.empty() || high.uvs.empty())
        return makeError(ErrorCode::missingAttribute, kNoElement,
                         "using the normal maps of the high poly needs its normals, tangents and UVs");
    if (Error error = checkSpan(high.tangents, high.positions.count, "high.tangents"); error.code != ErrorCode::ok)
        return error;
    if (Error error = checkSpan(high.uvs, high.positions.count, "high.uvs"); error.code != ErrorCode::ok) return error;
    if (high.map_of.size() != high.corners.size() / 3)
        return makeError(ErrorCode::countMismatch, kNoElement, "high.map_of must have one entry per triangle");
    for (std::size_t i = 0; i < high.map_of.size(); ++i) {
        if (high.map_of[i] != kNoHighMap && high.map_of[i] >= high.maps.size())
            return makeError(ErrorCode::indexOutOfRange, i,
                             "high.map_of contains the index of a map that does not exist");
    }
    for (const HighMap& map : high.maps) {
        const MapImage& image = map.image;
        if (image.texels.empty() || image.texels.size() != std::uint64_t{image.width} * image.height)
            return makeError(ErrorCode::countMismatch, kNoElement,
                             "a map of the high poly must have width * height texels");
        if (!std::isfinite(map.reading.scale))
            return makeError(ErrorCode::invalidOption, kNoElement, "the scale of a map must be finite");
    }
    return {ErrorCode::ok};
}

}  // namespace

Error checkSurfaces(const LowPoly& low, const HighPoly& high, bool needs_tangents) {
    const std::size_t corners = low.positions.count;
    Error error = checkSpan(low.positions, corners, "low.positions");
    const auto then = [&](Error next) {
        if (error.code == ErrorCode::ok) error = std::move(next);
    };
    if (error.code == ErrorCode::ok && (corners % 3 != 0 || corners > kMaxCorners))
        return makeError(ErrorCode::countMismatch, kNoElement,
                         "the number of positions of the low poly must be a multiple of 3 and at most 2^31-1");
    if (low.uvs.empty()) then(makeError(ErrorCode::missingAttribute, kNoElement, "the low poly has no UVs"));
    if (low.normals.empty()) then(makeError(ErrorCode::missingAttribute, kNoElement, "the low poly has no normals"));
    if (needs_tangents && low.tangents.empty())
        then(makeError(ErrorCode::missingAttribute, kNoElement, "the low poly has no tangents"));
    then(checkSpan(low.normals, corners, "low.normals"));
    then(checkSpan(low.uvs, corners, "low.uvs"));
    if (!low.tangents.empty()) then(checkSpan(low.tangents, corners, "low.tangents"));
    if (!low.cage.empty()) then(checkSpan(low.cage, corners, "low.cage"));
    if (!low.rest_positions.empty() || !low.rest_normals.empty()) {
        then(checkSpan(low.rest_positions, kAnyCount, "low.rest_positions"));
        then(checkSpan(low.rest_normals, low.rest_positions.count, "low.rest_normals"));
        if (low.rest_positions.count % 3 != 0 || low.rest_positions.count > kMaxCorners - corners)
            then(makeError(ErrorCode::countMismatch, kNoElement,
                           "the number of rest positions of the low poly must be a multiple of 3, and the number of "
                           "positions and rest positions together must not exceed 2^31-1"));
    }
    then(checkSpan(high.positions, kAnyCount, "high.positions"));
    if (!high.normals.empty()) then(checkSpan(high.normals, high.positions.count, "high.normals"));
    if (error.code != ErrorCode::ok) return error;
    if (high.corners.size() % 3 != 0 || high.corners.size() > kMaxCorners)
        return makeError(ErrorCode::countMismatch, kNoElement,
                         "the number of entries of high.corners must be a multiple of 3 and at most 2^31-1");
    const bool has_groups = !low.groups.empty();
    if (has_groups != !high.groups.empty() ||
        (has_groups && (low.groups.size() != corners / 3 || high.groups.size() != high.corners.size() / 3)))
        return makeError(ErrorCode::countMismatch, kNoElement,
                         "groups must have one entry per triangle, in both meshes or in neither");
    if (error = checkHighMaps(high); error.code != ErrorCode::ok || high.corners.empty()) return error;
    return checkIndices(IndexView(high.corners), high.positions.count);
}

double chosenReach(const LowPoly& low, const HighPoly& high) {
    return reachBetween(PositionBox(low.positions), PositionBox(high.positions));
}

Error checkRays(const RayOptions& rays, double reach) {
    const auto wrong = [](const char* what) { return makeError(ErrorCode::invalidOption, kNoElement, "%s", what); };
    if (!std::isfinite(reach) || reach < 0) return wrong("the reach must be finite and not negative");
    if (!std::isfinite(rays.cage_offset) || rays.cage_offset < 0)
        return wrong("the cage offset must be finite and not negative");
    const MapImage& skew = rays.skew;
    if (skew.texels.size() != std::size_t{skew.width} * skew.height)
        return makeError(ErrorCode::countMismatch, kNoElement, "the skew image must have width * height texels");
    return checkWeldDistance(rays.weld_distance);
}

Result<MapSurfaces> MapSurfaces::make(const LowPoly& low, const HighPoly& high, double reach, const RayOptions& rays,
                                      Parallel& parallel, const Allocator* allocator,
                                      std::shared_ptr<const RaySurface> surface) {
    MapSurfaces surfaces;
    surfaces.low_ = low;
    surfaces.high_ = high;
    surfaces.reach_ = reach > 0 ? reach : chosenReach(low, high);
    if (!(surfaces.reach_ > 0)) return apartError(PositionBox(low.positions), PositionBox(high.positions));
    if (surface == nullptr) {
        Result<std::unique_ptr<const RaySurface>> made =
            RaySurface::make(high.positions, high.corners, high.groups, parallel);
        if (!made) return std::move(made).error();
        surface = *std::move(made);
    }
    surfaces.rays_ = std::move(surface);
    surfaces.aim(rays, parallel, allocator);
    return surfaces;
}

MapSurfaces MapSurfaces::withRays(const RayOptions& rays, double reach, Parallel& parallel,
                                  const Allocator* allocator) const {
    MapSurfaces surfaces;
    surfaces.low_ = low_;
    surfaces.high_ = high_;
    surfaces.reach_ = reach > 0 ? reach : reach_;
    surfaces.rays_ = rays_;
    surfaces.aim(rays, parallel, allocator);
    return surfaces;
}

void MapSurfaces::aim(const RayOptions& rays, Parallel& parallel, const Allocator* allocator) {
    options_ = rays;
    cage_offset_ = rays.cage_offset > 0 ? rays.cage_offset : reach_;
    field_ = RayField(low_, rays, cage_offset_, parallel, allocator);
}

DVec3 MapSurfaces::normalOf(const RayHit& hit) const {
    std::array<std::uint32_t, 3> vertices{};
    for (std::size_t i = 0; i < 3; ++i) vertices[i] = high_.corners[3 * std::size_t{hit.triangle} + i];
    if (const DVec3 mapped = mappedNormal(hit, vertices); dot(mapped, mapped) > 0) return mapped;
    if (!high_.normals.empty()) {
        DVec3 sum{};
        for (std::size_t i = 0; i < 3; ++i) sum = sum + hit.weights[i] * toDouble(high_.normals[vertices[i]]);
        if (normalizeOrdinary(sum)) return sum;
    }
    return faceOf(hit.triangle);
}

DVec3 MapSurfaces::faceOf(std::uint32_t triangle) const {
    const auto at = [&](std::size_t i) {
        return toDouble(high_.positions[high_.corners[3 * std::size_t{triangle} + i]]);
    };
    DVec3 flat = cross(at(1) - at(0), at(2) - at(0));
    return normalize(flat) ? flat : DVec3{};
}

DVec3 MapSurfaces::mappedNormal(const RayHit& hit, const std::array<std::uint32_t, 3>& vertices) const {
    if (high_.maps.empty() || high_.map_of[hit.triangle] == kNoHighMap) return {};
    const HighMap& map = high_.maps[high_.map_of[hit.triangle]];
    CornerFrames frames;
    double u = 0, v = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        frames.normals[i] = high_.normals[vertices[i]];
        frames.tangents[i] = high_.tangents[vertices[i]];
        u += hit.weights[i] * high_.uvs[vertices[i]].x;
        v += hit.weights[i] * high_.uvs[vertices[i]].y;
    }
    const TextureShape shape{map.image.width, map.image.height, map.image.wrap_u, map.image.wrap_v};
    const Vec3 texel = sampleBilinear(shape, map.image.texels, {static_cast<float>(u), static_cast<float>(v)});
    const DVec3 shaded = shadedNormal(shadingFrame(frames, hit.weights, map.reading), decodeTexel(texel, map.reading));
    return std::isfinite(shaded.x + shaded.y + shaded.z) ? shaded : DVec3{};
}

bool MapSurfaces::rayAt(std::size_t triangle, const std::array<double, 3>& weights, Ray& ray) const {
    ray.triangle = triangle;
    ray.weights = weights;
    ray.place = mixedAt(low_.positions, triangle, weights);
    if (!std::isfinite(ray.place.x + ray.place.y + ray.place.z)) return false;
    ray.group = low_.groups.empty() ? 0 : low_.groups[triangle];
    if (low_.cage.empty()) return field_.at(triangle, weights, ray.outward, ray.height);
    ray.outward = mixedAt(low_.cage, triangle, weights) - ray.place;
    ray.height = length(ray.outward);
    return normalize(ray.outward);
}

bool MapSurfaces::meet(const Ray& ray, double& guess, RayHit& hit) const {
    if (low_.cage.empty() && options_.target == RayTarget::nearest)
        return rays_->nearest(ray.place, ray.outward, reach_, ray.group, guess, hit);
    if (!low_.cage.empty()) {
        const DVec3 cage = mixedAt(low_.cage, ray.triangle, ray.weights);
        if (!rays_->first(cage, -1.0 * ray.outward, ray.height + reach_, ray.group, hit)) return false;
        hit.distance = ray.height - hit.distance;
        return true;
    }
    return rays_->outermost(ray.line(-reach_, ray.height), hit) || meetBeyond(ray, hit);
}

bool MapSurfaces::meetBeyond(const Ray& ray, RayHit& hit) const {
    return ray.height < reach_ && rays_->innermost(ray.line(ray.height, reach_), hit);
}

RayNeighborhood MapSurfaces::around(const Ray& ray, const RayHit* hit) const {
    // A line through an edge hits both triangles at the edge, so hits within this distance count as one. It is relative
    // to the length of the ray.
    constexpr double kNearby = 1e-6;
    const double most = std::max(ray.height, reach_), least = -reach_;
    if (hit == nullptr) return {.met_back = rays_->crossings(ray.line(least, most)).backs > 0};
    const double begin = hit->distance + kNearby * (most + reach_);
    const RayCrossings crossings = rays_->crossings(ray.line(begin, std::max(most, hit->distance)));
    return {.has_front_further_out = crossings.fronts > 0, .met_back = crossings.backs > 0};
}

bool MapSurfaces::truthAt(std::size_t triangle, const std::array<double, 3>& weights, double& guess, DVec3& normal,
                          RayNeighborhood* around) const {
    Ray ray;
    if (!rayAt(triangle, weights, ray)) return false;
    RayHit hit;
    const bool is_hit = meet(ray, guess, hit);
    if (around != nullptr) *around = this->around(ray, is_hit ? &hit : nullptr);
    if (!is_hit) return false;
    normal = normalOf(hit);
    if (around != nullptr) around->normal_is_inward = dot(normal, ray.outward) < 0;
    return dot(normal, normal) > 0;
}

std::uint32_t MapSurfaces::meetAll(std::span<const LowPoint> points, double& guess, std::span<RayHit> hits) const {
    std::array<Ray, kLinesAtOnce> rays;
    std::array<RayLine, kLinesAtOnce> lines;
    const bool is_from_cage = low_.cage.empty() && options_.target == RayTarget::outermost;
    std::uint32_t aimed = 0, met = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        Ray& ray = rays[i];
        if (!rayAt(points[i].triangle, points[i].weights, ray)) {
            lines[i] = {.begin = 1, .end = 0};  // an empty range, in which nothing is hit
            continue;
        }
        aimed |= 1U << i;
        if (is_from_cage) lines[i] = ray.line(-reach_, ray.height);
    }
    if (is_from_cage) met = rays_->outermost(std::span(lines).first(points.size()), hits);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::uint32_t bit = 1U << i;
        if ((aimed & bit) == 0 || (met & bit) != 0) continue;
        if (is_from_cage ? meetBeyond(rays[i], hits[i]) : meet(rays[i], guess, hits[i])) met |= bit;
    }
    return met;
}

void MapSurfaces::truthsAt(std::span<const LowPoint> points, double& guess, std::span<DVec3> normals) const {
    std::array<RayHit, kLinesAtOnce> hits;
    const std::uint32_t met = meetAll(points, guess, hits);
    for (std::size_t i = 0; i < points.size(); ++i) normals[i] = (met >> i & 1) != 0 ? normalOf(hits[i]) : DVec3{};
}

std::uint32_t MapSurfaces::hitsAt(std::span<const LowPoint> points, double& guess, std::span<SurfaceHit> hits) const {
    std::array<RayHit, kLinesAtOnce> places;
    std::uint32_t met = meetAll(points, guess, places);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if ((met >> i & 1) == 0) continue;
        const RayHit& at = places[i];
        SurfaceHit& hit = hits[i];
        hit = {.triangle = at.triangle, .weights = at.weights, .height = at.distance};
        for (std::size_t k = 0; k < 3; ++k)
            hit.place =
                hit.place + at.weights[k] * toDouble(high_.positions[high_.corners[3 * std::size_t{at.triangle} + k]]);
        hit.normal = normalOf(at);
        hit.face = faceOf(at.triangle);
        if (!(dot(hit.normal, hit.normal) > 0)) met &= ~(1U << i);
    }
    return met;
}

CornerFrames MapSurfaces::corners(std::size_t triangle, const StridedSpan<const Vec4>& tangents) const {
    CornerFrames frames;
    for (std::size_t i = 0; i < 3; ++i) {
        frames.normals[i] = low_.normals[3 * triangle + i];
        if (!tangents.empty()) frames.tangents[i] = tangents[3 * triangle + i];
    }
    return frames;
}

}  // namespace tspace
