// SPDX-License-Identifier: MIT
// Tangents without UVs: an orthonormal basis from the normal alone.
// Based on: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
#include "core/sum_ranges.h"
#include "core/unit.h"
#include "tangents/indexed_methods.h"
#include "tspace/frame.h"

namespace tspace {

namespace {

constexpr std::size_t kGrain = 2048;

CornerFrame basisFrame(const Vec3& normal, float sign_factor) {
    DVec3 n = toDouble(normal);
    const bool has_direction = normalize(n);
    const Frame frame = basisFromNormal(has_direction ? toFloat(n) : Vec3{0, 0, 1});
    const Vec3& t = frame.tangent;
    return {{t.x, t.y, t.z, sign_factor}, sign_factor * frame.bitangent, 1, 1, !has_direction};
}

}  // namespace

std::uint64_t evaluateBasis(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out,
                            Parallel& parallel) {
    return sumRanges(parallel, plan.face_corner_count, kGrain, [&](std::size_t begin, std::size_t end) {
        std::uint64_t count = 0;
        for (std::size_t c = begin; c < end; ++c) {
            if (plan.corner_used[c] == 0) continue;
            const CornerFrame frame = basisFrame(pose.normals[plan.corner_vertices[c]], plan.sign_factor);
            writeCorner(out, c, frame);
            count += frame.is_default ? 1 : 0;
        }
        return count;
    });
}

}  // namespace tspace
