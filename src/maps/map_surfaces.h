// SPDX-License-Identifier: MIT
// A low poly, its high poly, and the rays between them; and the checks of a call on both.
#pragma once

#include <memory>

#include "core/base/memory.h"
#include "maps/rays.h"
#include "maps/shading.h"
#include "maps/uv_coverage.h"
#include "tspace/map_bake.h"
#include "tspace/map_error.h"

namespace tspace {

/// Checks the meshes of a call of map_error.h or map_bake.h. An Error with code ok when all is well.
Error checkSurfaces(const LowPoly& low, const HighPoly& high, bool needs_tangents);

/// Checks the options of bakeMap for meshes of so many triangles. An Error with code ok when all is well.
Error checkBakeOptions(const BakeOptions& options, std::size_t low_triangles, std::size_t high_triangles);

class MapSurfaces {
  public:
    /// Checked meshes, which must stay. `reach`: 0 chooses. Errors: unsupportedFile, outOfMemory, invalidOption (a reach
    /// that is no length), missingAttribute (meshes that are nowhere near each other).
    static Result<MapSurfaces> make(const LowPoly& low, const HighPoly& high, double reach, Parallel& parallel);

    [[nodiscard]] const LowPoly& low() const { return low_; }
    [[nodiscard]] double reach() const { return reach_; }
    [[nodiscard]] std::size_t triangleCount() const { return low_.positions.count / 3; }

    /// The unit normal of the high poly, as shaded, where the line through a point of the low poly meets it. `guess` as
    /// RaySurface::nearest; begin with 0. Threads may call at the same time.
    bool truthAt(std::size_t triangle, const std::array<double, 3>& weights, double& guess, DVec3& normal) const;

    [[nodiscard]] CornerFrames corners(std::size_t triangle, const StridedSpan<const Vec4>& tangents) const;

  private:
    LowPoly low_ = {};
    HighPoly high_ = {};
    double reach_ = 0;
    std::unique_ptr<const RaySurface> rays_ = {};

    [[nodiscard]] DVec3 normalOf(const RayHit& hit) const;
};

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
