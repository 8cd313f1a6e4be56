// SPDX-License-Identifier: MIT
#include "generate/mend_tangents.h"

#include <algorithm>
#include <array>

#include "core/unit.h"
#include "surface/surface.h"

namespace tspace {

namespace {

/// What `check` allows a direction to be off by: 10 degrees.
constexpr double kSameTangent = 0.98480775301220802;

bool isNear(const Vec4& a, const Vec4& b) {
    DVec3 ta = toDouble(xyz(a)), tb = toDouble(xyz(b));
    return normalize(ta) && normalize(tb) && dot(ta, tb) >= kSameTangent;
}

/// Whether the triangle of a corner says which sign is right there.
bool hasSide(const PoolView& pool, std::span<const std::uint32_t> corners, std::size_t corner) {
    const std::uint32_t* const v = corners.data() + corner / 3 * 3;
    const std::array<Vec2, 3> uvs{pool.uvs[v[0]], pool.uvs[v[1]], pool.uvs[v[2]]};
    return describeFace({pool.positions[v[0]], pool.positions[v[1]], pool.positions[v[2]]}, &uvs).orientation != 0;
}

std::uint8_t partsOf(const Mends& mends, std::uint32_t vertex) {
    const auto found =
        std::lower_bound(mends.vertices.begin(), mends.vertices.end(), vertex,
                         [](const VertexMend& mend, std::uint32_t wanted) { return mend.vertex < wanted; });
    return found != mends.vertices.end() && found->vertex == vertex ? found->parts : std::uint8_t{0};
}

/// The kept tangent, mended without a look at the triangles around it.
Vec4 mendedAlone(const Vec4& kept, const Vec4& computed, std::uint8_t parts) {
    Vec4 tangent = kept;
    if ((parts & mend::kLength) != 0) {
        DVec3 t = toDouble(xyz(kept));
        const bool has_length = normalize(t);
        const Vec3 unit = has_length ? toFloat(t) : xyz(computed);
        tangent = {unit.x, unit.y, unit.z, tangent.w};
    }
    if ((parts & mend::kSignSize) != 0) tangent.w = tangent.w == 0 ? computed.w : tangent.w < 0 ? -1.0f : 1.0f;
    if ((parts & mend::kTurnSign) != 0) tangent.w = -tangent.w;
    return tangent;
}

}  // namespace

std::vector<bool> mendCorners(const PoolView& pool, std::span<const std::uint32_t> corners, const Mends& mends,
                              std::span<Vec4> tangents) {
    std::vector<bool> has_new_deltas(corners.size(), false);
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const std::uint8_t parts = partsOf(mends, corners[c]);
        Vec4 computed = tangents[c];
        if (mends.inverted_signs) computed.w = -computed.w;
        const Vec4 stays = mendedAlone(pool.kept_tangents[corners[c]], computed, parts);
        const bool wants_deltas = (parts & mend::kDeltas) != 0;
        bool is_new = (parts & mend::kWhole) != 0;
        if ((parts & mend::kSides) != 0 && hasSide(pool, corners, c)) {
            is_new = is_new || (stays.w > 0) != (computed.w > 0) || !isNear(stays, computed);
        }
        // Deltas belong to the direction that they were made for.
        is_new = is_new || (wants_deltas && !isNear(stays, computed));
        tangents[c] = is_new ? computed : stays;
        has_new_deltas[c] = is_new || wants_deltas;
    }
    return has_new_deltas;
}

}  // namespace tspace
