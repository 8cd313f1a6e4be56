// SPDX-License-Identifier: MIT
// Points spread over a low poly, the truth at each, and how far a map is from it.
#pragma once

#include <optional>

#include "core/parallel.h"
#include "maps/map_surfaces.h"

namespace tspace {

class MeasurePoints {
  public:
    /// Shoots a ray for each of `count` points. Nothing where `stop` says so. Memory: 48 bytes a point.
    static std::optional<MeasurePoints> spread(const MapSurfaces& surfaces, std::uint32_t count, Parallel& parallel,
                                               const MapErrorOptions& options);

    /// Without heat. `tangents` as MapCandidate.
    [[nodiscard]] MapError measure(const MapImage& map, const MapSurfaces& surfaces, const MapCandidate& candidate,
                                   Parallel& parallel) const;

  private:
    struct Point {
        std::uint32_t triangle = 0;
        std::array<float, 2> weights = {};  ///< of the second and the third corner
        bool is_hit = false;
        Vec3 normal = {};  ///< the truth
    };
    std::vector<Point> points_ = {};
    std::vector<std::uint8_t> borders_ =
        {};  ///< per triangle: bit i, its edge from corner i on is a border of the UV map

    void findBorders(const LowPoly& low);
    [[nodiscard]] bool isNearBorder(const MapImage& map, const LowPoly& low, const Point& point, const Vec2& uv) const;
};

/// The unit normal that a renderer shades at a point.
DVec3 shadedAt(const MapImage& map, const MapCandidate& candidate, const CornerFrames& corners,
               const std::array<double, 3>& weights, const Vec2& uv);

/// Degrees per texel: the mean of four points of it, -1 where none is in a triangle or meets the high poly. Empty where
/// `stop` says so.
std::vector<float> heatOf(const MapImage& map, const MapSurfaces& surfaces, const MapCandidate& candidate,
                          Parallel& parallel, const MapErrorOptions& options);

/// Bodies of parallel loops see nothing of the caller. Calls task(i) for each i below `count`, and now and then `progress`
/// and `stop` from the calling thread. False when stopped.
template <class Task>
bool forTasksTold(Parallel& parallel, std::size_t count, const char* what, const MapProgress& progress,
                  const std::function<bool()>& stop, Task&& task) {
    const std::size_t at_once = std::size_t{parallel.width()} * 4;
    for (std::size_t begin = 0; begin < count; begin += at_once) {
        if (stop && stop()) return false;
        if (progress) progress(what, begin, count);
        parallel.forTasks(std::min(at_once, count - begin), [&](std::size_t i) { task(begin + i); });
    }
    return true;
}

}  // namespace tspace
