// SPDX-License-Identifier: MIT
#include "maps/bake/occlusion.h"

#include "core/base/vec_math.h"
#include "maps/bake/hemisphere.h"

namespace tspace {
namespace {

/// Offset of ray origins from the surface, relative to the size of the high poly. It avoids hits on the triangle itself
/// and on adjacent ones.
constexpr double kBegin = 1e-6;

DVec3 turned(const PlaneAxes& axes, const DVec3& normal, const DVec3& direction) {
    return direction.x * axes.x + direction.y * axes.y + direction.z * normal;
}

}  // namespace

Occlusion occlusionAt(const MapSurfaces& surfaces, const SurfaceHit& hit, const OcclusionOptions& options,
                      std::uint32_t x, std::uint32_t y) {
    const RaySurface& rays = *surfaces.surface();
    const double begin = kBegin * rays.size(), far = 4 * rays.size();
    const double sky = options.sky_distance > 0 ? std::min(options.sky_distance, far) : far;
    const DVec3 normal = dot(hit.normal, hit.face) > 0 ? hit.normal : hit.face;
    const PlaneAxes axes = planeAxes(normal);
    const ScrambledSobol points(options.ray_count, x, y);
    std::uint32_t over = 0, open = 0, solid = 0;
    DVec3 bent{};
    double thickness = 0;
    for (std::uint32_t i = 0; i < options.ray_count; ++i) {
        const DVec3 direction = turned(axes, normal, cosineDirection(points.at(i)));
        if (!(dot(direction, hit.face) > 0)) continue;
        ++over;
        if (options.has_sky && !rays.isBlocked({hit.place, direction, begin, sky}, hit.triangle)) {
            ++open;
            bent = bent + direction;
        }
        RayHit inside;
        if (options.has_thickness && rays.firstOfAny({hit.place, -1.0 * direction, begin, far}, hit.triangle, inside)) {
            ++solid;
            thickness += inside.distance * dot(direction, normal);
        }
    }
    Occlusion result;
    result.open = over > 0 ? static_cast<double>(open) / over : 1;
    result.bent = normalize(bent) ? bent : normal;
    result.solid = over > 0 ? static_cast<double>(solid) / over : 0;
    result.thickness = solid > 0 ? thickness / solid : 0;
    return result;
}

}  // namespace tspace
