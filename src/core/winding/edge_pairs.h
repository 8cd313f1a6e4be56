// SPDX-License-Identifier: MIT
// Which faces go on into one another over the edges that they share.
#pragma once

#include <cstdint>

#include "core/base/memory.h"
#include "core/normals/normals_call.h"

namespace tspace::winding {

/// The faces of a call and the points that they share.
struct Surface {
    const MeshView& mesh;
    const Faces& faces;
    const Buffer<std::uint32_t>& points;  ///< of each corner

    [[nodiscard]] std::uint32_t pointOf(std::uint32_t corner) const { return points[corner]; }
    [[nodiscard]] DVec3 position(std::uint32_t corner) const { return toDouble(mesh.positions[mesh.indices[corner]]); }
    /// Twice the area times the normal that a counter-clockwise winding gives.
    [[nodiscard]] DVec3 areaVector(std::uint32_t face) const {
        const std::uint32_t first = faces.first(face), past = faces.past(face);
        const DVec3 origin = position(first);
        DVec3 sum, before = position(first + 1) - origin;
        for (std::uint32_t c = first + 2; c < past; ++c) {
            const DVec3 here = position(c) - origin;
            sum = sum + cross(before, here);
            before = here;
        }
        return sum;
    }
};

inline constexpr std::uint32_t kNoPartner = 0xffffffffu;
/// Of a pair that lies on one another: neither is turned against the other.
inline constexpr std::uint32_t kFixed = 0x80000000u;

/// For each corner c: the corner whose edge, from it to the next one of its face, is the other half of c's edge. kNoPartner
/// at borders, and for faces that are not used or touch a point twice.
Buffer<std::uint32_t> pairEdges(const Surface& surface, const Allocator* allocator);

}  // namespace tspace::winding
