// SPDX-License-Identifier: MIT
// Points spread over a low poly, the truth at each, and how far a map is from it.
#pragma once

#include "core/base/parallel.h"
#include "maps/map_surfaces.h"

namespace tspace {

/// Resources of a call.
struct MapWork {
    const Allocator* allocator;
    Parallel& parallel;
    const Progress& progress;
};

class MeasurePoints {
  public:
    /// Shoots a ray for each of `count` points. Memory: 48 bytes a point.
    static MeasurePoints spread(const MapSurfaces& surfaces, std::uint32_t count, const MapWork& work);

    /// Without heat. `tangents` as MapCandidate.
    [[nodiscard]] MapError measure(const MapImage& map, const MapSurfaces& surfaces, const MapCandidate& candidate,
                                   Parallel& parallel) const;

  private:
    struct Point {
        std::uint32_t triangle = 0;
        std::array<float, 2> weights = {};  ///< of the second and the third corner
        bool is_hit = false, is_hidden = false, met_back = false, is_inward = false;
        Vec3 normal = {};  ///< the truth
    };
    std::vector<Point> points_ = {};
    std::vector<std::uint8_t> borders_ =
        {};  ///< per triangle: bit i, its edge from corner i on is a border of the UV map

    void findBorders(const LowPoly& low);
    void countPoints(MapError& error) const;
    [[nodiscard]] bool isNearBorder(const MapImage& map, const LowPoly& low, const Point& point, const Vec2& uv) const;
};

/// The unit normal that a renderer shades at a point.
DVec3 shadedAt(const MapImage& map, const MapCandidate& candidate, const CornerFrames& corners,
               const std::array<double, 3>& weights, const Vec2& uv);

/// Degrees per texel: the mean of four points of it, -1 where none is in a triangle or meets the high poly.
std::vector<float> heatOf(const MapImage& map, const MapSurfaces& surfaces, const MapCandidate& candidate,
                          const MapWork& work);

/// Bodies of parallel loops see nothing of the caller. Calls task(i) for each i below `count`, and now and then `progress`
/// from the calling thread.
template <class Task>
void forTasksTold(const MapWork& work, std::size_t count, const char* what, Task&& task) {
    const std::size_t at_once = std::size_t{work.parallel.width()} * 4;
    for (std::size_t begin = 0; begin < count; begin += at_once) {
        if (work.progress) work.progress(what, begin, count);
        work.parallel.forTasks(std::min(at_once, count - begin), [&](std::size_t i) { task(begin + i); });
    }
}

}  // namespace tspace
