// SPDX-License-Identifier: MIT
// Intersections of lines with a surface. Only this file uses Embree, which is loaded with the first surface: Embree and
// its dependencies take 60 MB, and most runs trace no rays.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>

#include "core/base/parallel.h"
#include "core/base/vec_math.h"
#include "tspace/result.h"
#include "tspace/span.h"

namespace tspace {

/// Bounding box.
struct PositionBox {
    DVec3 least{INFINITY, INFINITY, INFINITY}, most{-INFINITY, -INFINITY, -INFINITY};

    PositionBox() = default;
    /// Creates the bounding box of the finite points.
    explicit PositionBox(const StridedSpan<const Vec3>& points);

    void add(const DVec3& point);
    [[nodiscard]] bool isEmpty() const { return !(least.x <= most.x); }
    [[nodiscard]] double diagonal() const { return isEmpty() ? 0 : length(most - least); }
    /// Returns the largest distance between corresponding sides of the two boxes.
    [[nodiscard]] double difference(const PositionBox& other) const;
    [[nodiscard]] bool meets(const PositionBox& other, double margin) const;
};

struct RayHit {
    std::uint32_t triangle = 0;
    std::array<double, 3> weights = {};  ///< barycentric weights of the corners
    double distance = 0;                 ///< distance along the direction; negative on the opposite side
};

/// Number of triangles that a segment of a line crosses.
struct RayCrossings {
    std::uint32_t fronts = 0;  ///< front faces
    std::uint32_t backs = 0;   ///< back faces
};

/// Segment of a line: the points from `begin` to `end` along `outward` (unit), relative to `from`.
struct RayLine {
    DVec3 from = {}, outward = {};
    double begin = 0, end = 0;
    std::uint32_t group = 0;
};

/// Maximum number of lines per call.
inline constexpr std::size_t kLinesAtOnce = 16;

/// Triangles of a surface in a structure for ray queries. Const calls are thread-safe. Embree only finds candidate
/// triangles: intersections are computed here in double precision, and do not depend on the order in which triangles
/// are found.
class RaySurface {
  public:
    /// `positions`, `corners` and `groups` (one per triangle, or empty) must outlive the surface. Triangles that are
    /// not finite or are degenerate are never hit. Lines may start and end anywhere. Builds on the threads of
    /// `parallel`. Errors: unsupportedFile (no Embree), outOfMemory.
    static Result<std::unique_ptr<const RaySurface>> make(StridedSpan<const Vec3> positions,
                                                          std::span<const std::uint32_t> corners,
                                                          std::span<const std::uint32_t> groups, Parallel& parallel);
    ~RaySurface();
    RaySurface(const RaySurface&) = delete;
    RaySurface& operator=(const RaySurface&) = delete;

    /// Finds the triangle that is nearest to `from` on the line along `outward` (unit), among triangles whose front
    /// faces `outward` and that are at most `reach` away on either side. Of equally near triangles, the one with the
    /// lowest index is used. If the surface has groups, only triangles of `group` are considered. `guess`: expected
    /// distance; it affects only the time, and is updated for the next call nearby.
    bool nearest(const DVec3& from, const DVec3& outward, double reach, std::uint32_t group, double& guess,
                 RayHit& hit) const;

    /// Finds the first triangle within `most` from `from` along `inward` (unit) whose front faces `from`.
    bool first(const DVec3& from, const DVec3& inward, double most, std::uint32_t group, RayHit& hit) const;

    /// Finds the outermost (or innermost) triangle that the line hits, among triangles whose front faces outward.
    bool outermost(const RayLine& line, RayHit& hit) const;
    bool innermost(const RayLine& line, RayHit& hit) const;
    /// Finds the outermost hits of at most kLinesAtOnce lines, in half of the time of single calls if the lines are
    /// close together. Bit i of the result is set if line i has a hit, which is stored in hits[i].
    [[nodiscard]] std::uint32_t outermost(std::span<const RayLine> lines, std::span<RayHit> hits) const;

    /// Counts the front and back faces that the line crosses.
    [[nodiscard]] RayCrossings crossings(const RayLine& line) const;

    /// Returns whether the line hits a triangle other than `skipped`, regardless of orientation and group.
    [[nodiscard]] bool isBlocked(const RayLine& line, std::uint32_t skipped) const;
    /// Finds the first triangle that would make isBlocked return true.
    bool firstOfAny(const RayLine& line, std::uint32_t skipped, RayHit& hit) const;

    /// Returns the longest side of the surface's bounding box.
    [[nodiscard]] double size() const;

    struct State;

  private:
    explicit RaySurface(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tspace
