// SPDX-License-Identifier: MIT
// Low poly, high poly, and the rays between them; checks of calls that take both.
#pragma once

#include <memory>
#include <string>

#include "core/base/memory.h"
#include "core/base/vec_math.h"
#include "maps/layout/low_points.h"
#include "maps/layout/uv_coverage.h"
#include "maps/rays/ray_directions.h"
#include "maps/rays/rays.h"
#include "maps/texels/shading.h"
#include "tspace/maps.h"
#include "tspace/span.h"

namespace tspace {

// Diagnosis of meshes that should coincide but do not.

/// Returns the default ray reach for meshes with these bounding boxes (see chosenReach).
double reachBetween(const PositionBox& low, const PositionBox& high);

/// Returns the likely reason why a high poly does not coincide with its low poly (a different unit or up axis) in one
/// sentence, or an empty string if none is found.
std::string misplacement(const PositionBox& low, const PositionBox& high);

/// Checks the meshes of measureMap, bakeMap and similar calls. Returns ErrorCode::ok if they are valid.
Error checkSurfaces(const LowPoly& low, const HighPoly& high, bool needs_tangents);

/// Checks the options of bakeMap for meshes with these numbers of triangles. Returns ErrorCode::ok if they are valid.
Error checkBakeOptions(const BakeOptions& options, std::size_t low_triangles, std::size_t high_triangles);

/// Checks the ray options. Returns ErrorCode::ok if they are valid.
Error checkRays(const RayOptions& rays, double reach);

/// Surroundings of the point where a ray hit the high poly, or properties of a ray without a hit.
struct RayNeighborhood {
    bool has_front_further_out = false, met_back = false;
    bool normal_is_inward = false;  ///< the shading normal of the high poly points inward at the hit front face
};

/// Hit of the ray from a point of the low poly on the high poly.
struct SurfaceHit {
    std::uint32_t triangle = 0;  ///< triangle of the high poly
    std::array<double, 3> weights = {};
    double height = 0;  ///< distance from the low poly along the ray, positive outward
    DVec3 place = {};
    DVec3 normal = {}, face = {};  ///< unit vectors: shading normal and face normal
};

class MapSurfaces {
  public:
    /// Prepares the rays. Requires checked meshes and rays; the meshes and the image of the rays must outlive the
    /// result. `reach`: 0 chooses a value. Errors: unsupportedFile, outOfMemory, missingAttribute (the meshes are far
    /// apart). `surface`: existing ray structure of the high poly, or null.
    static Result<MapSurfaces> make(const LowPoly& low, const HighPoly& high, double reach, const RayOptions& rays,
                                    Parallel& parallel, const Allocator* allocator,
                                    std::shared_ptr<const RaySurface> surface = nullptr);
    /// Returns the same meshes with other rays. `reach`: 0 keeps the current value.
    [[nodiscard]] MapSurfaces withRays(const RayOptions& rays, double reach, Parallel& parallel,
                                       const Allocator* allocator) const;

    [[nodiscard]] const LowPoly& low() const { return low_; }
    [[nodiscard]] const HighPoly& high() const { return high_; }
    [[nodiscard]] const RayOptions& rays() const { return options_; }
    [[nodiscard]] double reach() const { return reach_; }
    /// Returns the cage offset, or 0 if the low poly has its own cage.
    [[nodiscard]] double cageOffset() const { return low_.cage.empty() ? cage_offset_ : 0; }
    [[nodiscard]] std::size_t triangleCount() const { return low_.positions.count / 3; }
    [[nodiscard]] const std::shared_ptr<const RaySurface>& surface() const { return rays_; }

    /// Computes the unit shading normal of the high poly where the ray from a point of the low poly hits it. Returns
    /// false if the ray hits nothing. `guess`: as in RaySurface::nearest; initially 0. `around`: null, or receives the
    /// surroundings of the hit. Thread-safe.
    bool truthAt(std::size_t triangle, const std::array<double, 3>& weights, double& guess, DVec3& normal,
                 RayNeighborhood* around = nullptr) const;
    /// Computes truthAt for at most kLinesAtOnce points, which is faster than single calls if they are close together.
    /// The normal of a point without a hit is zero.
    void truthsAt(std::span<const LowPoint> points, double& guess, std::span<DVec3> normals) const;
    /// Computes the same hits as truthsAt, but with all members. Bit i of the result is set if hits[i] is valid.
    [[nodiscard]] std::uint32_t hitsAt(std::span<const LowPoint> points, double& guess,
                                       std::span<SurfaceHit> hits) const;

    [[nodiscard]] CornerFrames corners(std::size_t triangle, const StridedSpan<const Vec4>& tangents) const;

  private:
    LowPoly low_ = {};
    HighPoly high_ = {};
    double reach_ = 0, cage_offset_ = 0;
    RayOptions options_ = {};
    RayField field_ = {};
    std::shared_ptr<const RaySurface> rays_ = {};

    /// Ray of a point of the low poly: the point (`place`), the outward direction, and the distance from the point to
    /// the cage (`height`).
    struct Ray {
        std::size_t triangle = 0;
        std::array<double, 3> weights = {};
        DVec3 place = {}, outward = {};
        double height = 0;
        std::uint32_t group = 0;

        [[nodiscard]] RayLine line(double begin, double end) const { return {place, outward, begin, end, group}; }
    };
    bool rayAt(std::size_t triangle, const std::array<double, 3>& weights, Ray& ray) const;
    /// Finds the hit of a ray; `hit`.distance is measured outward from the low poly.
    bool meet(const Ray& ray, double& guess, RayHit& hit) const;
    /// Finds the innermost hit beyond the cage, for a ray that hit nothing from the cage inward. Returns false if there
    /// is none.
    bool meetBeyond(const Ray& ray, RayHit& hit) const;
    /// Calls meet() for several points at once. Bit i of the result is set if hits[i] is valid.
    std::uint32_t meetAll(std::span<const LowPoint> points, double& guess, std::span<RayHit> hits) const;
    [[nodiscard]] RayNeighborhood around(const Ray& ray, const RayHit* hit) const;
    void aim(const RayOptions& rays, Parallel& parallel, const Allocator* allocator);
    [[nodiscard]] DVec3 normalOf(const RayHit& hit) const;
    [[nodiscard]] DVec3 faceOf(std::uint32_t triangle) const;
    /// Returns the normal from the high poly's own normal map, or zero if the map has no direction at the hit.
    [[nodiscard]] DVec3 mappedNormal(const RayHit& hit, const std::array<std::uint32_t, 3>& vertices) const;
};

/// Collects points, each with a tag, and passes them to `query` in batches of kLinesAtOnce (queryInBatches).
template <class Tag, class QueryPoints>
class PointBatch {
  public:
    explicit PointBatch(const QueryPoints& query) : query_(query) {}

    void add(const LowPoint& point, const Tag& tag) {
        points_[count_] = point;
        tags_[count_] = tag;
        if (++count_ == kLinesAtOnce) finish();
    }
    void finish() {
        if (count_ > 0)
            query_(std::span<const LowPoint>(points_.data(), count_), std::span<const Tag>(tags_.data(), count_));
        count_ = 0;
    }

  private:
    const QueryPoints& query_;
    std::size_t count_ = 0;
    std::array<LowPoint, kLinesAtOnce> points_ = {};
    std::array<Tag, kLinesAtOnce> tags_ = {};
};

/// Calls query(points, tags) for the points that body(together) adds with together.add(point, tag): in batches of
/// kLinesAtOnce, in the order of adding.
template <class Tag, class QueryPoints, class Body>
void queryInBatches(const QueryPoints& query, const Body& body) {
    PointBatch<Tag, QueryPoints> together(query);
    body(together);
    together.finish();
}

}  // namespace tspace
