// SPDX-License-Identifier: MIT
// Tangents without UVs: an orthonormal basis from the normal alone.
// Based on: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
#include <algorithm>

#include "core/base/parallel.h"
#include "core/base/unit.h"
#include "core/tangents/indexed_methods.h"

namespace tspace {

namespace {

CornerFrame basisFrame(const Vec3& normal, float sign_factor) {
    DVec3 n = toDouble(normal);
    const bool has_direction = normalize(n);
    const PlaneAxes axes = planeAxes(toDouble(has_direction ? toFloat(n) : Vec3{0, 0, 1}));
    const Vec3 t = toFloat(axes.x);
    return {{t.x, t.y, t.z, sign_factor}, sign_factor * toFloat(axes.y), 1, 1, !has_direction};
}

/// 1 for each vertex that a used corner names.
Buffer<std::uint8_t> findUsedVertices(const IndexedPlan& plan, const Allocator* allocator) {
    Buffer<std::uint8_t> used(allocator, plan.vertex_count, 0);
    for (std::size_t c = 0; c < plan.cornerCount(); ++c) {
        if (plan.isUsed(c)) used[plan.corner_vertices[c]] = 1;
    }
    return used;
}

}  // namespace

void evaluateBasis(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out, const Allocator* allocator,
                   Parallel& parallel, TangentReport& report) {
    const bool per_vertex = plan.domain == OutputDomain::vertex;
    const Buffer<std::uint8_t> used = findUsedVertices(plan, allocator);
    report.group_count = static_cast<std::uint64_t>(std::count(used.begin(), used.end(), std::uint8_t{1}));
    report.default_corner_count =
        sumRanges(parallel, plan.outputCount(), Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
            std::uint64_t count = 0;
            for (std::size_t i = begin; i < end; ++i) {
                const bool is_used = per_vertex ? used[i] != 0 : plan.isUsed(i);
                const std::size_t vertex = per_vertex ? i : plan.corner_vertices[i];
                const CornerFrame frame = is_used ? basisFrame(pose.normals[vertex], plan.sign_factor) : CornerFrame{};
                writeFrame(out, i, frame);
                count += frame.is_default ? 1 : 0;
            }
            return count;
        });
}

}  // namespace tspace
