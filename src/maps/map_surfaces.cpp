// SPDX-License-Identifier: MIT
#include "maps/map_surfaces.h"

#include <algorithm>
#include <thread>

#include "core/border.h"

namespace tspace {

namespace {

struct Box {
    DVec3 least{INFINITY, INFINITY, INFINITY}, most{-INFINITY, -INFINITY, -INFINITY};

    explicit Box(const StridedSpan<const Vec3>& points) {
        for (std::size_t i = 0; i < points.count; ++i) {
            const Vec3& at = points[i];
            if (!isFinite(at)) continue;
            least = {std::fmin(least.x, at.x), std::fmin(least.y, at.y), std::fmin(least.z, at.z)};
            most = {std::fmax(most.x, at.x), std::fmax(most.y, at.y), std::fmax(most.z, at.z)};
        }
    }
    [[nodiscard]] bool isEmpty() const { return !(least.x <= most.x); }
    [[nodiscard]] double diagonal() const { return isEmpty() ? 0 : length(most - least); }
    /// How far a side of one lies from that of the other, at most.
    [[nodiscard]] double difference(const Box& other) const {
        const DVec3 a = least - other.least, b = most - other.most;
        return std::max(
            {std::fabs(a.x), std::fabs(a.y), std::fabs(a.z), std::fabs(b.x), std::fabs(b.y), std::fabs(b.z)});
    }
    [[nodiscard]] bool meets(const Box& other, double margin) const {
        return least.x - margin <= other.most.x && other.least.x - margin <= most.x &&
               least.y - margin <= other.most.y && other.least.y - margin <= most.y &&
               least.z - margin <= other.most.z && other.least.z - margin <= most.z;
    }
};

template <class T>
DVec3 mixedAt(const StridedSpan<const T>& values, std::size_t triangle, const std::array<double, 3>& weights) {
    DVec3 sum{};
    for (std::size_t i = 0; i < 3; ++i) sum = sum + weights[i] * toDouble(values[3 * triangle + i]);
    return sum;
}

unsigned threadsOf(const Execution& execution) {
    if (execution.executor != nullptr) return std::max(1U, execution.executor->concurrency);
    if (execution.thread_count == kAllThreads) return std::max(1U, std::thread::hardware_concurrency());
    return std::max(1U, execution.thread_count);
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
    const Box low_box(low.positions), high_box(high.positions);
    if (low_box.isEmpty() || high_box.isEmpty()) return 0;
    const double size = std::max(low_box.diagonal(), high_box.diagonal());
    const double most = size / 4, reach = std::max(size / 20, 1.5 * low_box.difference(high_box));
    return low_box.meets(high_box, size / 20) ? std::min(most, reach) : 0;
}

Result<MapSurfaces> MapSurfaces::make(const LowPoly& low, const HighPoly& high, double reach,
                                      const Execution& execution) {
    if (!std::isfinite(reach) || reach < 0)
        return makeError(ErrorCode::invalidOption, kNoElement, "the reach must be a length");
    MapSurfaces surfaces;
    surfaces.low_ = low;
    surfaces.high_ = high;
    surfaces.reach_ = reach > 0 ? reach : chosenReach(low, high);
    if (!(surfaces.reach_ > 0))
        return makeError(ErrorCode::missingAttribute, kNoElement,
                         "the low poly and the high poly are nowhere near each other");
    Result<std::unique_ptr<const RaySurface>> rays =
        RaySurface::make(high.positions, high.corners, high.groups, threadsOf(execution));
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
