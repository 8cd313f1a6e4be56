// SPDX-License-Identifier: MIT
// Based on: Jacobson, Kavan & Sorkine-Hornung, "Robust Inside-Outside Segmentation using Generalized Winding Numbers",
// 2013 (the winding number of an open surface); van Oosterom & Strackee, "The Solid Angle of a Plane Triangle", 1983;
// Barill et al., "Fast Winding Numbers for Soups and Clouds", 2018 (far faces as dipoles).
#include "core/winding/components.h"

#include "core/base/angle.h"

namespace tspace::winding {

namespace {

DVec3 centre(const Surface& surface, std::uint32_t face) {
    const std::uint32_t first = surface.faces.first(face), past = surface.faces.past(face);
    DVec3 sum;
    for (std::uint32_t c = first; c < past; ++c) sum = sum + surface.position(c);
    return (1.0 / (past - first)) * sum;
}

/// The normals of a face's corners, added up.
DVec3 normalSum(const Surface& surface, std::uint32_t face) {
    const MeshView& mesh = surface.mesh;
    DVec3 sum;
    for (std::uint32_t c = surface.faces.first(face); c < surface.faces.past(face); ++c) {
        const bool is_own = mesh.normal_indices.type != IndexType::none;
        sum = sum + toDouble(mesh.normals[is_own ? mesh.normal_indices[c] : mesh.indices[c]]);
    }
    return sum;
}

/// Of a triangle, as seen from the origin.
double solidAngle(const DVec3& a, const DVec3& b, const DVec3& c) {
    const double volume = dot(a, cross(b, c)), la = length(a), lb = length(b), lc = length(c);
    const double along = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    if (!(std::fabs(along) < 1e300 && std::fabs(volume) < 1e300)) return 0;
    const double half = polarAngle(along, std::fabs(volume));
    return volume < 0 ? -2 * half : 2 * half;
}

/// Faces together, so that sums do not depend on threads.
constexpr std::size_t kBlock = 2048;
constexpr std::uint32_t kPoints = 12;

/// Solid angles of the faces of a block, as seen from each of the points.
struct OwnAngles {
    const WindingCall& call;
    double x[kPoints], y[kPoints], z[kPoints];
    std::uint32_t own[kPoints];  ///< the face on which a point lies, which is not seen from it

    void add(std::uint32_t face, double (&sums)[kPoints]) const {
        // Beyond this many squared lengths of its edges a face is a dipole; that is good to some percent.
        constexpr double kFar = 25;
        const Surface& surface = call.surface;
        const DVec3 middle = centre(surface, face), vector = call.areaVector(face);
        const double reach = kFar * longestEdge(face);
        double angles[kPoints];
        bool is_far = reach < 1e300;
        for (std::uint32_t p = 0; p < kPoints; ++p) {
            const double a = middle.x - x[p], b = middle.y - y[p], c = middle.z - z[p], square = a * a + b * b + c * c;
            angles[p] = 0.5 * (vector.x * a + vector.y * b + vector.z * c) / (square * std::sqrt(square));
            is_far &= square > reach;
        }
        if (!is_far) seeExactly(face, reach, middle, angles);
        for (std::uint32_t p = 0; p < kPoints; ++p) sums[p] += angles[p];
    }

  private:
    /// Of those from the first corner, squared.
    [[nodiscard]] double longestEdge(std::uint32_t face) const {
        const Faces& faces = call.surface.faces;
        const DVec3 origin = call.surface.position(faces.first(face));
        double longest = 0;
        for (std::uint32_t c = faces.first(face) + 1; c < faces.past(face); ++c) {
            const DVec3 edge = call.surface.position(c) - origin;
            longest = std::max(longest, dot(edge, edge));
        }
        return longest;
    }
    void seeExactly(std::uint32_t face, double reach, const DVec3& middle, double (&angles)[kPoints]) const {
        const Surface& surface = call.surface;
        for (std::uint32_t p = 0; p < kPoints; ++p) {
            const DVec3 from{x[p], y[p], z[p]}, to = middle - from;
            if (dot(to, to) > reach && std::fabs(angles[p]) < 1e300) continue;
            const std::uint32_t first = surface.faces.first(face), past = surface.faces.past(face);
            double sum = 0;
            for (std::uint32_t c = first + 1; c + 1 < past && face != own[p]; ++c)
                sum += solidAngle(surface.position(first) - from, surface.position(c) - from,
                                  surface.position(c + 1) - from);
            const double sign = call.turned[face] != 0 ? -call.outward : call.outward;
            angles[p] = std::fabs(sum) < 1e300 ? sign * sum : 0;
        }
    }
};

}  // namespace

Component flood(const WindingCall& call, std::uint32_t first, std::uint32_t begin, Buffer<std::uint32_t>& order,
                Buffer<std::uint8_t>& reached) {
    const Surface& surface = call.surface;
    const Faces& faces = surface.faces;
    const auto runsForward = [&](std::uint32_t corner) {
        return surface.pointOf(corner) < surface.pointOf(faces.next(corner));
    };
    Component component{.begin = begin, .end = begin};
    order[component.end++] = first;
    reached[first] = 1;
    std::uint64_t before = 0, after = 0;
    for (std::uint32_t at = begin; at < component.end; ++at) {
        const std::uint32_t face = order[at];
        for (std::uint32_t c = faces.first(face); c < faces.past(face); ++c) {
            const std::uint32_t partner = call.partners[c];
            if (partner == kNoPartner) {
                component.is_closed = false;
                continue;
            }
            const std::uint32_t other = faces.of(partner & ~kFixed);
            const bool differs = (partner & kFixed) == 0 && runsForward(c) == runsForward(partner & ~kFixed);
            if (reached[other] == 0) {
                reached[other] = 1;
                call.turned[other] = std::uint8_t{(call.turned[face] != 0) != differs};
                order[component.end++] = other;
            }
            // Each pair is met from both sides.
            before += differs ? 1U : 0U;
            after += ((call.turned[face] != call.turned[other]) != differs) ? 1U : 0U;
        }
    }
    component.conflicts_before = before / 2;
    component.conflicts_after = after / 2;
    return component;
}

void measure(const WindingCall& call, const Buffer<std::uint32_t>& order, Component& component) {
    const Surface& surface = call.surface;
    const bool has_normals = call.options.use_normals && !surface.mesh.normals.empty();
    const DVec3 origin = surface.position(surface.faces.first(order[component.begin]));
    for (std::uint32_t i = component.begin; i < component.end; ++i) {
        const std::uint32_t face = order[i];
        for (std::uint32_t c = surface.faces.first(face); c < surface.faces.past(face); ++c)
            component.box.add(surface.mesh.positions[surface.mesh.indices[c]]);
        const DVec3 vector = call.areaVector(face);
        const double area = length(vector);
        const bool is_turned = call.turned[face] != 0;
        component.turned_count += is_turned ? 1U : 0U;
        if (!(area < 1e300)) continue;
        component.area += area;
        component.kept += is_turned ? -area : area;
        // Newell's vector times any corner: for a flat face what its triangles give together.
        component.volume += dot(vector, surface.position(surface.faces.first(face)) - origin);
        if (!has_normals) continue;
        const double side = dot(vector, normalSum(surface, face));
        if (!(std::fabs(side) > 0)) continue;
        component.facing += side > 0 ? area : -area;
        component.faced += area;
    }
}

double ownWindingNumber(const WindingCall& call, const Buffer<std::uint32_t>& order, const Component& component) {
    OwnAngles angles{call, {}, {}, {}, {}};
    for (std::uint32_t p = 0; p < kPoints; ++p) {
        const std::uint64_t place = (2 * std::uint64_t{p} + 1) * component.size() / (2 * kPoints);
        angles.own[p] = order[component.begin + static_cast<std::uint32_t>(place)];
        const DVec3 from = centre(call.surface, angles.own[p]);
        angles.x[p] = from.x;
        angles.y[p] = from.y;
        angles.z[p] = from.z;
    }
    const std::size_t blocks = (component.size() + kBlock - 1) / kBlock;
    Buffer<double> block_sums(call.allocator(), blocks * kPoints);
    call.parallel.forTasks(blocks, [&](std::size_t block) {
        double sums[kPoints] = {};
        const std::size_t begin = component.begin + block * kBlock,
                          end = std::min<std::size_t>(component.end, begin + kBlock);
        for (std::size_t i = begin; i < end; ++i) angles.add(order[i], sums);
        for (std::uint32_t p = 0; p < kPoints; ++p) block_sums[block * kPoints + p] = sums[p];
    });
    double sum = 0;
    for (std::size_t i = 0; i < block_sums.size(); ++i) sum += block_sums[i];
    return sum / (4 * kPi * kPoints);
}

}  // namespace tspace::winding
