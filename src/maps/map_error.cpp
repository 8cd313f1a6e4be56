// SPDX-License-Identifier: MIT
#include "tspace/map_error.h"

#include "core/base/border.h"
#include "maps/measure_points.h"

namespace tspace {

namespace {

constexpr std::uint32_t kMostPoints = 10'000'000;

Error checkMap(const MapImage& map, const MapErrorOptions& options) {
    if (map.width == 0 || map.height == 0 || map.texels.size() / map.width != map.height ||
        map.texels.size() % map.width != 0)
        return makeError(ErrorCode::countMismatch, kNoElement, "the map needs width * height texels, and one at least");
    if (options.point_count == 0 || options.point_count > kMostPoints)
        return makeError(ErrorCode::invalidOption, kNoElement, "point_count must be 1 to %u", kMostPoints);
    return {ErrorCode::ok};
}

Result<std::vector<MapError>> measureAll(const MapImage& map, const LowPoly& low, const HighPoly& high,
                                         std::span<const MapCandidate> candidates, const MapErrorOptions& options,
                                         const Execution& execution, const Progress& progress) {
    if (Error error = checkMap(map, options); error.code != ErrorCode::ok) return error;
    for (const MapCandidate& candidate : candidates) {
        const bool needs_tangents = candidate.space == MapSpace::tangent && candidate.tangents.empty();
        if (Error error = checkSurfaces(low, high, needs_tangents); error.code != ErrorCode::ok) return error;
        if (candidate.tangents.empty()) continue;
        Error error = checkSpan(candidate.tangents, low.positions.count, "candidate.tangents");
        if (error.code != ErrorCode::ok) return error;
    }
    Parallel parallel(execution);
    const MapWork work{execution.allocator, parallel, progress};
    Result<MapSurfaces> surfaces = MapSurfaces::make(low, high, options.reach, parallel);
    if (!surfaces) return std::move(surfaces).error();
    const MeasurePoints points = MeasurePoints::spread(*surfaces, options.point_count, work);
    std::vector<MapError> errors;
    for (const MapCandidate& candidate : candidates) {
        errors.push_back(points.measure(map, *surfaces, candidate, parallel));
        if (options.heat) errors.back().heat = heatOf(map, *surfaces, candidate, work);
    }
    return errors;
}

}  // namespace

Result<MapError> measureMap(const MapImage& map, const LowPoly& low, const HighPoly& high,
                            const MapErrorOptions& options, const Execution& execution, const Progress& progress) {
    return atBorder([&]() -> Result<MapError> {
        const MapCandidate candidate{options.space, options.reading, {}};
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
