// SPDX-License-Identifier: MIT
// A low poly, its high poly, and the rays between them; and the checks of a call on both.
#pragma once

#include <memory>
#include <string>

#include "core/base/memory.h"
#include "core/base/vec_math.h"
#include "maps/layout/uv_coverage.h"
#include "maps/rays/ray_directions.h"
#include "maps/rays/rays.h"
#include "maps/texels/shading.h"
#include "tspace/maps.h"
#include "tspace/span.h"

namespace tspace {

// The bounding box of points, and why two meshes that should coincide do not.

struct PositionBox {
    DVec3 least{INFINITY, INFINITY, INFINITY}, most{-INFINITY, -INFINITY, -INFINITY};

    PositionBox() = default;
    /// Points that are not finite are left out.
    explicit PositionBox(const StridedSpan<const Vec3>& points);

    void add(const DVec3& point);
    [[nodiscard]] bool isEmpty() const { return !(least.x <= most.x); }
    [[nodiscard]] double diagonal() const { return isEmpty() ? 0 : length(most - least); }
    /// Largest distance between corresponding sides of the two boxes.
    [[nodiscard]] double difference(const PositionBox& other) const;
    [[nodiscard]] bool meets(const PositionBox& other, double margin) const;
};

/// chosenReach of meshes in these boxes.
double reachBetween(const PositionBox& low, const PositionBox& high);

/// The likely reason why a high poly does not lie on its low poly: another unit, or another axis that points up; one
/// sentence. Empty where none shows.
std::string misplacement(const PositionBox& low, const PositionBox& high);

/// Checks the meshes of measureMap, bakeMap and the calls like them. An Error with code ok when all is well.
Error checkSurfaces(const LowPoly& low, const HighPoly& high, bool needs_tangents);

/// Checks the options of bakeMap for meshes of so many triangles. An Error with code ok when all is well.
Error checkBakeOptions(const BakeOptions& options, std::size_t low_triangles, std::size_t high_triangles);

/// Checks what says where rays go. An Error with code ok when all is well.
Error checkRays(const RayOptions& rays, double reach);

/// Surroundings of the point where a ray hit the high poly, or of a ray without a hit.
struct RayNeighbourhood {
    bool has_front_further_out = false, met_back = false;
    bool normal_is_inward = false;  ///< the shaded normal of the high poly points inwards at the hit front face
};

/// A point of the low poly.
struct LowPoint {
    std::uint32_t triangle = 0;
    std::array<double, 3> weights = {};
};

/// Hit of the ray from a point of the low poly on the high poly.
struct SurfaceHit {
    std::uint32_t triangle = 0;  ///< triangle of the high poly
    std::array<double, 3> weights = {};
    double height = 0;  ///< outwards from the low poly, along the ray
    DVec3 place = {};
    DVec3 normal = {}, face = {};  ///< unit: as shaded, and that of the triangle
};

class MapSurfaces {
  public:
    /// Checked meshes, which must stay, and checked rays, whose image must stay. `reach`: 0 chooses. Errors:
    /// unsupportedFile, outOfMemory, missingAttribute (meshes that are nowhere near each other). `surface`: that of the high
    /// poly, where it is there already, or null.
    static Result<MapSurfaces> make(const LowPoly& low, const HighPoly& high, double reach, const RayOptions& rays,
                                    Parallel& parallel, const Allocator* allocator,
                                    std::shared_ptr<const RaySurface> surface = nullptr);
    /// Returns these meshes with other rays. `reach`: 0 keeps the current one.
    [[nodiscard]] MapSurfaces withRays(const RayOptions& rays, double reach, Parallel& parallel,
                                       const Allocator* allocator) const;

    [[nodiscard]] const LowPoly& low() const { return low_; }
    [[nodiscard]] const HighPoly& high() const { return high_; }
    [[nodiscard]] const RayOptions& rays() const { return options_; }
    [[nodiscard]] double reach() const { return reach_; }
    /// 0 with a cage of the low poly's own.
    [[nodiscard]] double cageOffset() const { return low_.cage.empty() ? cage_offset_ : 0; }
    [[nodiscard]] std::size_t triangleCount() const { return low_.positions.count / 3; }
    [[nodiscard]] const std::shared_ptr<const RaySurface>& surface() const { return rays_; }

    /// The unit normal of the high poly, as shaded, where the ray of a point of the low poly meets it. `guess` as
    /// RaySurface::nearest; begin with 0. `around`: null, or where to say what else the ray meets. Threads may call at the
    /// same time.
    bool truthAt(std::size_t triangle, const std::array<double, 3>& weights, double& guess, DVec3& normal,
                 RayNeighbourhood* around = nullptr) const;
    /// truthAt of kLinesAtOnce points at most, which takes less time where they lie beside each other. Zero where it is false.
    void truthsAt(std::span<const LowPoint> points, double& guess, std::span<DVec3> normals) const;
    /// truthsAt, and all of the places. Bit i of the result: whether hits[i] is one.
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

    /// The ray of a point: where it begins to look, outwards, and how far the low poly is from there.
    struct Ray {
        std::size_t triangle = 0;
        std::array<double, 3> weights = {};
        DVec3 place = {}, outward = {};
        double height = 0;
        std::uint32_t group = 0;
    };
    bool rayAt(std::size_t triangle, const std::array<double, 3>& weights, Ray& ray) const;
    /// `hit`.distance is outwards from the low poly.
    bool meet(const Ray& ray, double& guess, RayHit& hit) const;
    /// Whether a ray that met nothing from the cage inwards meets something further out.
    bool meetBeyond(const Ray& ray, RayHit& hit) const;
    /// meet for points that are asked for together. Bit i of the result: whether hits[i] is one.
    std::uint32_t meetTogether(std::span<const LowPoint> points, double& guess, std::span<RayHit> hits) const;
    [[nodiscard]] RayNeighbourhood around(const Ray& ray, const RayHit* hit) const;
    void aim(const RayOptions& rays, Parallel& parallel, const Allocator* allocator);
    [[nodiscard]] DVec3 normalOf(const RayHit& hit) const;
    [[nodiscard]] DVec3 faceOf(std::uint32_t triangle) const;
    /// The normal that the high poly's own map gives; zero where it shows none there.
    [[nodiscard]] DVec3 mappedNormal(const RayHit& hit, const std::array<std::uint32_t, 3>& vertices) const;
};

/// Points, each with a tag that says what it is for, until there are kLinesAtOnce: see askTogether.
template <class Tag, class Ask>
class PointsTogether {
  public:
    explicit PointsTogether(const Ask& ask) : ask_(ask) {}

    void add(const LowPoint& point, const Tag& tag) {
        points_[count_] = point;
        tags_[count_] = tag;
        if (++count_ == kLinesAtOnce) finish();
    }
    void finish() {
        if (count_ > 0)
            ask_(std::span<const LowPoint>(points_.data(), count_), std::span<const Tag>(tags_.data(), count_));
        count_ = 0;
    }

  private:
    const Ask& ask_;
    std::size_t count_ = 0;
    std::array<LowPoint, kLinesAtOnce> points_ = {};
    std::array<Tag, kLinesAtOnce> tags_ = {};
};

/// ask(points, tags) for what body(together) adds by together.add(point, tag): kLinesAtOnce at a time, in that order.
template <class Tag, class Ask, class Body>
void askTogether(const Ask& ask, const Body& body) {
    PointsTogether<Tag, Ask> together(ask);
    body(together);
    together.finish();
}

/// The UVs of a low poly as a list of triangles.
struct LowUvs {
    explicit LowUvs(const LowPoly& low, const Allocator* allocator);
    [[nodiscard]] UvTriangles triangles(TextureWrap wrap_u, TextureWrap wrap_v) const {
        return {.corners = {corners.data(), corners.size()},
                .uvs = {uvs.data(), uvs.size()},
                .wrap_u = wrap_u,
                .wrap_v = wrap_v};
    }

    Buffer<std::uint32_t> corners;
    Buffer<Vec2> uvs;
};

}  // namespace tspace
