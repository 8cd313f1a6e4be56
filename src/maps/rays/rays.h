// SPDX-License-Identifier: MIT
// Intersections of lines and a surface. Only this file knows Embree, which is loaded with the first surface: Embree and
// its dependencies take 60 MB, and most runs shoot no ray.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "core/base/parallel.h"
#include "core/base/vec_math.h"
#include "tspace/result.h"
#include "tspace/span.h"

namespace tspace {

struct RayHit {
    std::uint32_t triangle = 0;
    std::array<double, 3> weights = {};  ///< barycentric weights of its corners
    double distance = 0;                 ///< along the direction; negative on the other side
};

/// Number of triangles that a segment of a line crosses.
struct RayCrossings {
    std::uint32_t fronts = 0;  ///< front faces
    std::uint32_t backs = 0;   ///< back faces
};

/// A part of a line: what lies between `begin` and `end` along `outward` (unit) from a place.
struct RayLine {
    DVec3 from = {}, outward = {};
    double begin = 0, end = 0;
    std::uint32_t group = 0;
};

/// Lines that are asked for together.
inline constexpr std::size_t kLinesAtOnce = 16;

/// The triangles of a surface, ordered for rays. Const calls are thread-safe. Embree only says which triangles a line may
/// meet: places are computed here, in double, and do not depend on the order in which triangles are found.
class RaySurface {
  public:
    /// `positions`, `corners` and `groups` (one per triangle, or empty) must stay. Triangles that are not finite, or have no
    /// area, are not met. Lines may begin and end anywhere. Built by the threads of `parallel`. Errors: unsupportedFile (no Embree), outOfMemory.
    static Result<std::unique_ptr<const RaySurface>> make(StridedSpan<const Vec3> positions,
                                                          std::span<const std::uint32_t> corners,
                                                          std::span<const std::uint32_t> groups, Parallel& parallel);
    ~RaySurface();
    RaySurface(const RaySurface&) = delete;
    RaySurface& operator=(const RaySurface&) = delete;

    /// The triangle nearest to `from` on the line along `outward` (unit), at most `reach` away on either side, whose front
    /// faces `outward`. Of equally near ones the first. `guess`: how near it may be, which changes the time alone; it is
    /// set for the next call nearby. Of the triangles of `group` alone, where there are groups.
    bool nearest(const DVec3& from, const DVec3& outward, double reach, std::uint32_t group, double& guess,
                 RayHit& hit) const;

    /// The first triangle from `from` along `inward` (unit) whose front faces `from`, within `most`.
    bool first(const DVec3& from, const DVec3& inward, double most, std::uint32_t group, RayHit& hit) const;

    /// Of the triangles whose fronts face `outward` (unit), and which the line along it meets between `begin` and `end`, the
    /// one that is furthest out, or the one that is furthest in.
    bool outermost(const DVec3& from, const DVec3& outward, double begin, double end, std::uint32_t group,
                   RayHit& hit) const;
    bool innermost(const DVec3& from, const DVec3& outward, double begin, double end, std::uint32_t group,
                   RayHit& hit) const;
    /// outermost of kLinesAtOnce lines at most, which takes half of the time where they lie beside each other. Bit i of the
    /// result: whether line i meets something, which is hits[i] then.
    [[nodiscard]] std::uint32_t outermost(std::span<const RayLine> lines, std::span<RayHit> hits) const;

    /// Counts the triangles, front and back faces, that the line along `outward` (unit) crosses from `begin` to `end`.
    [[nodiscard]] RayCrossings crossings(const DVec3& from, const DVec3& outward, double begin, double end,
                                         std::uint32_t group) const;

    /// Whether a triangle other than `skipped` lies on the line from `from` along `direction` (unit), between `begin` and `end`
    /// away, whichever way it faces and whatever its group.
    [[nodiscard]] bool isBlocked(const DVec3& from, const DVec3& direction, double begin, double end,
                                 std::uint32_t skipped) const;
    /// The first of these triangles.
    bool firstOfAny(const DVec3& from, const DVec3& direction, double begin, double end, std::uint32_t skipped,
                    RayHit& hit) const;

    /// The longest side of the box of the surface.
    [[nodiscard]] double size() const;

    struct State;

  private:
    explicit RaySurface(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tspace
