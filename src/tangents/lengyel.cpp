// SPDX-License-Identifier: MIT
// The classic: sums of unnormalised dP/du and dP/dv per vertex index, then Gram-Schmidt.
// Based on: Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", 2001.
#include "core/sum_ranges.h"
#include "core/uv_frame.h"
#include "tangents/indexed_methods.h"

namespace tspace {

namespace {

constexpr std::size_t kGrain = 2048;

struct VertexSum {
    Vec3 s, t;
    std::uint32_t count = 0;  ///< corners that were added
};

/// In float and in face order, on one thread: so the bits do not depend on the number of threads.
Buffer<VertexSum> sumDerivatives(const IndexedPlan& plan, const Pose& pose, const Allocator* allocator) {
    Buffer<VertexSum> sums(allocator, plan.vertex_count, VertexSum{});
    for (std::size_t i = 0; i < plan.triangles.size(); i += 3) {
        const std::uint32_t v0 = plan.corner_vertices[plan.triangles[i]];
        const std::uint32_t v1 = plan.corner_vertices[plan.triangles[i + 1]];
        const std::uint32_t v2 = plan.corner_vertices[plan.triangles[i + 2]];
        const UvFrame frame = uvFrame(pose.positions[v0], pose.positions[v1], pose.positions[v2],
                                      plan.uvs[v0], plan.uvs[v1], plan.uvs[v2]);
        if (!hasUvArea(frame.determinant)) continue;
        const double r = 1 / frame.determinant;
        const Vec3 s = toFloat(r * frame.tangent);
        const Vec3 t = toFloat(r * frame.bitangent);
        if (!isFinite(s) || !isFinite(t)) continue;  // one broken face must not spoil its neighbours
        for (const std::uint32_t v : {v0, v1, v2}) {
            sums[v].s = sums[v].s + s;
            sums[v].t = sums[v].t + t;
            ++sums[v].count;
        }
    }
    return sums;
}

}  // namespace

std::uint64_t evaluateLengyel(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out,
                              const Allocator* allocator, Parallel& parallel) {
    const Buffer<VertexSum> sums = sumDerivatives(plan, pose, allocator);
    Buffer<CornerFrame> frames(allocator, plan.vertex_count);
    parallel.forRanges(plan.vertex_count, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            const double share = sums[v].count > 0 ? 1.0 / sums[v].count : 0.0;
            const Derivatives mean{share * toDouble(sums[v].s), share * toDouble(sums[v].t)};
            frames[v] = makeCornerFrame(mean, pose.normals[v], plan.sign_factor);
        }
    });
    return sumRanges(parallel, plan.face_corner_count, kGrain, [&](std::size_t begin, std::size_t end) {
        std::uint64_t count = 0;
        for (std::size_t c = begin; c < end; ++c) {
            if (plan.corner_used[c] == 0) continue;
            const CornerFrame& frame = frames[plan.corner_vertices[c]];
            writeCorner(out, c, frame);
            count += frame.is_default ? 1 : 0;
        }
        return count;
    });
}

}  // namespace tspace
