// SPDX-License-Identifier: MIT
// Meshes as triangulated by CAD kernels, and as produced by simplifiers.
#include <array>
#include <cmath>
#include <cstddef>

#include "core/base/vec_math.h"
#include "scans.h"

#ifdef TSPACE_HAS_MESHOPT
#include <meshoptimizer.h>
#endif

namespace tspace::accuracy {

namespace {

using ProfilePoint = std::array<double, 2>;  ///< radius and height

std::uint32_t addPoint(Scan& to, const DVec3& p) {
    to.positions.push_back(toFloat(p));
    return static_cast<std::uint32_t>(to.positions.size() - 1);
}

/// Returns the surface of revolution of the profile about z: quads cut into triangles and, unless the profile is
/// closed, a fan from one vertex at each end.
Scan turnedAboutZ(const Shape& shape, const std::vector<ProfilePoint>& profile, std::uint32_t sides, bool is_closed) {
    Scan made{&shape};
    const auto rings = static_cast<std::uint32_t>(profile.size());
    for (const ProfilePoint& p : profile) {
        for (std::uint32_t i = 0; i < sides; ++i) {
            const auto [sine, cosine] = sineCosine(2 * kPi * i / sides);
            addPoint(made, {p[0] * cosine, p[0] * sine, p[1]});
        }
    }
    for (std::uint32_t ring = 0; ring + (is_closed ? 0 : 1) < rings; ++ring) {
        for (std::uint32_t i = 0; i < sides; ++i) {
            const std::uint32_t next = (i + 1) % sides, above = (ring + 1) % rings * sides, a = ring * sides;
            made.indices.insert(made.indices.end(), {a + i, a + next, above + next, a + i, above + next, above + i});
        }
    }
    for (std::uint32_t i = 1; i + 1 < sides && !is_closed; ++i) {
        const std::uint32_t top = (rings - 1) * sides;
        made.indices.insert(made.indices.end(), {0, i + 1, i, top, top + i, top + i + 1});
    }
    return made;
}

Scan lathed(std::uint32_t around, std::uint32_t across) {
    std::vector<ProfilePoint> circle;
    for (std::uint32_t i = 0; i < across; ++i) {
        const auto [sine, cosine] = sineCosine(2 * kPi * i / across);
        circle.push_back({0.6 + 0.25 * cosine, 0.25 * sine});
    }
    return turnedAboutZ(drawnShapes()[0], circle, around, true);
}

Scan filleted(std::uint32_t sides, std::uint32_t segments) {
    std::vector<ProfilePoint> profile;
    for (const double side : {-1.0, 1.0}) {
        for (std::uint32_t i = 0; i <= segments; ++i) {
            const auto [sine, cosine] = sineCosine(0.5 * kPi * (side < 0 ? segments - i : i) / segments);
            profile.push_back({0.64 + 0.16 * cosine, side * (0.64 + 0.16 * sine)});
        }
    }
    return turnedAboutZ(drawnShapes()[1], profile, sides, false);
}

/// Returns a slab: two opposite faces consist of `strips` long quads each, and the other four of single quads.
Scan slab(std::uint32_t strips) {
    Scan made{&drawnShapes()[3]};
    std::vector<std::uint32_t> lower, upper;
    for (const double z : {-0.2, 0.2}) {
        for (std::uint32_t i = 0; i <= strips; ++i) {
            const double x = 1.6 * i / strips - 0.8;
            addPoint(made, {x, -0.6, z});
            addPoint(made, {x, 0.6, z});
        }
    }
    const std::uint32_t top = 2 * (strips + 1);
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        made.indices.insert(made.indices.end(), {a, b, c, a, c, d});
    };
    for (std::uint32_t i = 0; i < strips; ++i) {
        const std::uint32_t a = 2 * i;
        quad(a, a + 1, a + 3, a + 2);
        quad(top + a, top + a + 2, top + a + 3, top + a + 1);
        quad(a, a + 2, top + a + 2, top + a);
        quad(a + 1, top + a + 1, top + a + 3, a + 3);
    }
    quad(0, top, top + 1, 1);
    quad(2 * strips, 2 * strips + 1, top + 2 * strips + 1, top + 2 * strips);
    return made;
}

}  // namespace

std::vector<Scan> drawnMeshes(bool is_sharp) {
    if (!is_sharp) return {lathed(96, 12), lathed(12, 64), filleted(48, 5), filleted(16, 2)};
    const std::vector<ProfilePoint> side = {{0.8, -0.8}, {0.8, 0.8}};
    return {turnedAboutZ(drawnShapes()[2], side, 48, false), turnedAboutZ(drawnShapes()[2], side, 16, false), slab(1),
            slab(40)};
}

Scan decimated(const Scan& scan, double share) {
    Scan made{scan.shape};
#ifdef TSPACE_HAS_MESHOPT
    const auto wanted = static_cast<std::size_t>(share * static_cast<double>(scan.indices.size() / 3)) * 3;
    made.indices.resize(scan.indices.size());
    made.indices.resize(meshopt_simplify(made.indices.data(), scan.indices.data(), scan.indices.size(),
                                         &scan.positions[0].x, scan.positions.size(), sizeof(Vec3), wanted, 1.0f));
    std::vector<std::uint32_t> kept(scan.positions.size(), ~0u);
    for (std::uint32_t& vertex : made.indices) {
        if (kept[vertex] == ~0u) {
            kept[vertex] = static_cast<std::uint32_t>(made.positions.size());
            made.positions.push_back(scan.positions[vertex]);
        }
        vertex = kept[vertex];
    }
#else
    static_cast<void>(share);
#endif
    return made;
}

}  // namespace tspace::accuracy
