// SPDX-License-Identifier: MIT
#include "tspace/maps.h"

#include <algorithm>

#include "core/base/border.h"
#include "maps/error/measure_points.h"

namespace tspace {
namespace {

constexpr std::uint32_t kMostPoints = 10'000'000;

Error checkMap(const MapImage& map, const MapErrorOptions& options) {
    if (map.width == 0 || map.height == 0 || map.texels.size() / map.width != map.height ||
        map.texels.size() % map.width != 0)
        return makeError(ErrorCode::countMismatch, kNoElement,
                         "the map must have width * height texels, and at least 1");
    if (options.point_count == 0 || options.point_count > kMostPoints)
        return makeError(ErrorCode::invalidOption, kNoElement, "point_count must be from 1 to %u", kMostPoints);
    return {ErrorCode::ok};
}

Result<std::vector<MapError>> measureAll(const MapImage& map, const LowPoly& low, const HighPoly& high,
                                         std::span<const MapCandidate> candidates, const MapErrorOptions& options,
                                         const Execution& execution, const Progress& progress) {
    if (Error error = checkMap(map, options); error.code != ErrorCode::ok) return error;
    if (Error error = checkRays(options.rays, options.reach); error.code != ErrorCode::ok) return error;
    for (const MapCandidate& candidate : candidates) {
        const bool needs_tangents = candidate.space == MapSpace::tangent && candidate.tangents.empty();
        if (Error error = checkSurfaces(low, high, needs_tangents); error.code != ErrorCode::ok) return error;
        if (candidate.rays != nullptr) {
            if (Error error = checkRays(*candidate.rays, candidate.reach); error.code != ErrorCode::ok) return error;
        }
        if (candidate.tangents.empty()) continue;
        Error error = checkSpan(candidate.tangents, low.positions.count, "candidate.tangents");
        if (error.code != ErrorCode::ok) return error;
    }
    Parallel parallel(execution);
    const MapWork work{execution.allocator, parallel, progress};
    Result<MapSurfaces> surfaces =
        MapSurfaces::make(low, high, options.reach, options.rays, parallel, execution.allocator);
    if (!surfaces) return std::move(surfaces).error();
    std::vector<MapError> errors(candidates.size());
    const auto measure = [&](const MapSurfaces& used, const auto& has_these_rays) {
        const MeasurePoints points = MeasurePoints::spread(used, options.point_count, work);
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            if (!has_these_rays(candidates[i])) continue;
            errors[i] = points.measure(map, used, candidates[i], parallel);
            if (options.heat) errors[i].heat = heatOf(map, used, candidates[i], work);
        }
    };
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const auto is_alike = [&](const MapCandidate& other) {
            return other.rays == candidates[i].rays && (other.rays == nullptr || other.reach == candidates[i].reach);
        };
        // Candidates with the same ray settings share their points, which are created once.
        if (std::any_of(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(i), is_alike)) continue;
        if (candidates[i].rays == nullptr) {
            measure(*surfaces, is_alike);
        } else {
            measure(surfaces->withRays(*candidates[i].rays, candidates[i].reach, parallel, execution.allocator),
                    is_alike);
        }
    }
    return errors;
}

}  // namespace

Result<MapError> measureMap(const MapImage& map, const LowPoly& low, const HighPoly& high,
                            const MapErrorOptions& options, const Execution& execution, const Progress& progress) {
    return atBorder([&]() -> Result<MapError> {
        const MapCandidate candidate{.space = options.space, .reading = options.reading, .axes = options.axes};
        Result<std::vector<MapError>> errors =
            measureAll(map, low, high, {&candidate, 1}, options, execution, progress);
        if (!errors) return std::move(errors).error();
        return std::move(errors->front());
    });
}

Result<std::vector<MapError>> measureReadings(const MapImage& map, const LowPoly& low, const HighPoly& high,
                                              std::span<const MapCandidate> candidates, const MapErrorOptions& options,
                                              const Execution& execution, const Progress& progress) {
    return atBorder([&] {
        MapErrorOptions without_heat = options;
        without_heat.heat = false;
        return measureAll(map, low, high, candidates, without_heat, execution, progress);
    });
}

}  // namespace tspace
