// SPDX-License-Identifier: MIT
#include "maps/map_surfaces.h"

#include <algorithm>

#include "core/base/border.h"
#include "maps/position_box.h"

namespace tspace {

namespace {

template <class T>
DVec3 mixedAt(const StridedSpan<const T>& values, std::size_t triangle, const std::array<double, 3>& weights) {
    DVec3 sum{};
    for (std::size_t i = 0; i < 3; ++i) sum = sum + weights[i] * toDouble(values[3 * triangle + i]);
    return sum;
}

Error apartError(const PositionBox& low, const PositionBox& high) {
    const std::string why = misplacement(low, high);
    return makeError(ErrorCode::missingAttribute, kNoElement,
                     "the low poly and the high poly are nowhere near each other%s%s", why.empty() ? "" : "; ",
                     why.c_str());
}

}  // namespace

Error checkSurfaces(const LowPoly& low, const HighPoly& high, bool needs_tangents) {
    const std::size_t corners = low.positions.count;
    Error error = checkSpan(low.positions, corners, "low.positions");
    const auto then = [&](Error next) {
        if (error.code == ErrorCode::ok) error = std::move(next);
    };
    if (error.code == ErrorCode::ok && (corners % 3 != 0 || corners > kMaxCorners))
        return makeError(ErrorCode::countMismatch, kNoElement, "the low poly needs three positions per triangle");
    if (low.uvs.empty()) then(makeError(ErrorCode::missingAttribute, kNoElement, "the low poly has no UVs"));
    if (low.normals.empty()) then(makeError(ErrorCode::missingAttribute, kNoElement, "the low poly has no normals"));
    if (needs_tangents && low.tangents.empty())
        then(makeError(ErrorCode::missingAttribute, kNoElement, "the low poly has no tangents"));
    then(checkSpan(low.normals, corners, "low.normals"));
    then(checkSpan(low.uvs, corners, "low.uvs"));
    if (!low.tangents.empty()) then(checkSpan(low.tangents, corners, "low.tangents"));
    if (!low.cage.empty()) then(checkSpan(low.cage, corners, "low.cage"));
    then(checkSpan(high.positions, kAnyCount, "high.positions"));
    if (!high.normals.empty()) then(checkSpan(high.normals, high.positions.count, "high.normals"));
    if (error.code != ErrorCode::ok) return error;
    if (high.corners.size() % 3 != 0 || high.corners.size() > kMaxCorners)
        return makeError(ErrorCode::countMismatch, kNoElement, "high.corners needs three entries per triangle");
    const bool has_groups = !low.groups.empty();
    if (has_groups != !high.groups.empty() ||
        (has_groups && (low.groups.size() != corners / 3 || high.groups.size() != high.corners.size() / 3)))
        return makeError(ErrorCode::countMismatch, kNoElement, "groups are one per triangle, of both meshes or none");
    if (high.corners.empty()) return error;
    return checkIndices(IndexView(high.corners), high.positions.count);
}

double chosenReach(const LowPoly& low, const HighPoly& high) {
    return reachBetween(PositionBox(low.positions), PositionBox(high.positions));
}

Result<MapSurfaces> MapSurfaces::make(const LowPoly& low, const HighPoly& high, double reach, Parallel& parallel) {
    if (!std::isfinite(reach) || reach < 0)
        return makeError(ErrorCode::invalidOption, kNoElement, "the reach must be a length");
    MapSurfaces surfaces;
    surfaces.low_ = low;
    surfaces.high_ = high;
    surfaces.reach_ = reach > 0 ? reach : chosenReach(low, high);
    if (!(surfaces.reach_ > 0)) return apartError(PositionBox(low.positions), PositionBox(high.positions));
    Result<std::unique_ptr<const RaySurface>> rays =
        RaySurface::make(high.positions, high.corners, high.groups, parallel);
    if (!rays) return std::move(rays).error();
    surfaces.rays_ = *std::move(rays);
    return surfaces;
}

DVec3 MapSurfaces::normalOf(const RayHit& hit) const {
    std::array<std::uint32_t, 3> vertices{};
    for (std::size_t i = 0; i < 3; ++i) vertices[i] = high_.corners[3 * std::size_t{hit.triangle} + i];
    if (!high_.normals.empty()) {
        DVec3 sum{};
        for (std::size_t i = 0; i < 3; ++i) sum = sum + hit.weights[i] * toDouble(high_.normals[vertices[i]]);
        if (normalize(sum)) return sum;
    }
    const DVec3 first = toDouble(high_.positions[vertices[0]]);
    DVec3 flat = cross(toDouble(high_.positions[vertices[1]]) - first, toDouble(high_.positions[vertices[2]]) - first);
    return normalize(flat) ? flat : DVec3{};
}

bool MapSurfaces::truthAt(std::size_t triangle, const std::array<double, 3>& weights, double& guess,
                          DVec3& normal) const {
    const DVec3 place = mixedAt(low_.positions, triangle, weights);
    DVec3 outward = mixedAt(low_.normals, triangle, weights);
    if (!std::isfinite(place.x + place.y + place.z)) return false;
    const std::uint32_t group = low_.groups.empty() ? 0 : low_.groups[triangle];
    RayHit hit;
    if (!low_.cage.empty()) {
        const DVec3 cage = mixedAt(low_.cage, triangle, weights);
        DVec3 inward = place - cage;
        const double from_cage = length(inward);
        if (!normalize(inward) || !rays_->first(cage, inward, from_cage + reach_, group, hit)) return false;
    } else if (!normalize(outward) || !rays_->nearest(place, outward, reach_, group, guess, hit)) {
        return false;
    }
    normal = normalOf(hit);
    return dot(normal, normal) > 0;
}

CornerFrames MapSurfaces::corners(std::size_t triangle, const StridedSpan<const Vec4>& tangents) const {
    CornerFrames frames;
    for (std::size_t i = 0; i < 3; ++i) {
        frames.normals[i] = low_.normals[3 * triangle + i];
        if (!tangents.empty()) frames.tangents[i] = tangents[3 * triangle + i];
    }
    return frames;
}

LowUvs::LowUvs(const LowPoly& low, const Allocator* allocator)
    : corners(allocator, low.uvs.count), uvs(allocator, low.uvs.count) {
    for (std::size_t i = 0; i < low.uvs.count; ++i) {
        corners[i] = static_cast<std::uint32_t>(i);
        uvs[i] = low.uvs[i];
    }
}

}  // namespace tspace
