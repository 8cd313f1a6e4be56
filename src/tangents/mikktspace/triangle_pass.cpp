// SPDX-License-Identifier: MIT
// Step 3: what each triangle says on its own. Degenerate triangles (two corners at one position) are taken
// out, the triangles of a quad are given one orientation.
#include "tangents/mikktspace/triangle_pass.h"

#include <atomic>
#include <cmath>

#include "tangents/mikktspace/vector_rules.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kGrain = 4096;        // triangles
constexpr std::size_t kLookAhead = 16;      // triangles; far enough for a line to arrive from memory
constexpr std::uint8_t kDegenerate = 0x80;  // a flag of this file only: such triangles leave the list here

bool isDegenerate(const Vec3& a, const Vec3& b, const Vec3& c) { return a == b || b == c || c == a; }

struct Counts {
    std::atomic<std::size_t> degenerate{0}, any{0}, mirrored{0};
};

/// Shapes of all triangles, degenerate ones too.
void readTriangles(GroupedPlan& plan, PoseData& pose, std::size_t count, Counts& counts, Parallel& parallel) {
    parallel.forRanges(count, kGrain, [&](std::size_t begin, std::size_t end) {
        std::size_t degenerate = 0, any = 0, mirrored = 0;
        for (std::size_t t = begin; t < end; ++t) {
            if (t + kLookAhead < end) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t ahead = plan.nodes[3 * (t + kLookAhead) + k];
                    __builtin_prefetch(&pose.positions[ahead]);
                    __builtin_prefetch(&plan.node_uv[ahead]);
                }
            }
            const std::uint32_t* n = plan.nodes.data() + 3 * t;
            const Vec3 &a = pose.positions[n[0]], &b = pose.positions[n[1]], &c = pose.positions[n[2]];
            if (isDegenerate(a, b, c)) {
                plan.flags[t] = kDegenerate;
                ++degenerate;
                continue;
            }
            const TriangleShape shape =
                triangleShape(a, b, c, plan.node_uv[n[0]], plan.node_uv[n[1]], plan.node_uv[n[2]]);
            const bool positive = shape.area > 0.0f;
            plan.flags[t] = static_cast<std::uint8_t>((positive ? kPositive : 0) | (shape.any ? kAny : 0));
            pose.frames[t] = shape.frame;
            any += shape.any;
            mirrored += !shape.any && !positive;
        }
        counts.degenerate += degenerate;
        counts.any += any;
        counts.mirrored += mirrored;
    });
}

/// Corners that only degenerate triangles have. Where a face has good triangles too, such a corner takes the
/// result of the corner at its own position in the same face; else that of the first good corner of its node.
/// (The reference searches the face's good triangle for the position; in a quad there is only one such
/// corner.)
void planCopies(const MeshView& mesh, const TriangleList& list, const Nodes& nodes, const GroupedPlan& plan,
                TrianglePass& pass, const Allocator* allocator) {
    pass.copies.reserve(3 * plan.report.degenerate_triangle_count);
    Buffer<std::uint8_t> done(allocator, mesh.cornerCount(), std::uint8_t{0});
    for (std::size_t i = 0; i < 3 * list.count; ++i) {
        if (plan.flags[i / 3] != kDegenerate) done[list.corner(i)] = 1;
    }
    const auto at = [&](std::uint32_t corner) { return mesh.positions[mesh.indices[corner]]; };
    for (std::size_t t = 0; t < list.count; ++t) {
        if (plan.flags[t] != kDegenerate) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t to = list.corner(3 * t + k);
            if (done[to] != 0 || nodes.of(mesh, to) >= plan.listed_count) continue;
            done[to] = 2;
            std::uint32_t from = kNone;
            for (std::size_t j = 1; j < 3 && from == kNone; ++j) {
                const std::uint32_t other = list.corner(3 * t + (k + j) % 3);
                if (done[other] == 1 && at(other) == at(to)) from = other;
            }
            pass.copies.push({to, from != kNone ? from : kMark | nodes.of(mesh, to)});
        }
    }
}

/// Moves good triangles to the front, in order.
void removeDegenerate(GroupedPlan& plan, PoseData& pose) {
    std::size_t to = 0;
    for (std::size_t t = 0; t < plan.triangle_count; ++t) {
        if (plan.flags[t] == kDegenerate) continue;
        for (std::size_t k = 0; k < 3; ++k) plan.nodes[3 * to + k] = plan.nodes[3 * t + k];
        plan.flags[to] = plan.flags[t];
        pose.frames[to] = pose.frames[t];
        ++to;
    }
    plan.triangle_count = to;
}

/// Slots and faces of the good triangles; left empty when they would just count up.
void readSlots(const TriangleList& list, std::size_t degenerate_count, GroupedPlan& plan, TrianglePass& pass,
               const Allocator* allocator) {
    if (list.corners.empty() && degenerate_count == 0) return;
    const std::size_t good = list.count - degenerate_count;
    plan.slots = Buffer<std::uint32_t>(allocator, 3 * good);
    pass.faces = Buffer<std::uint32_t>(allocator, good);
    std::size_t to = 0;
    for (std::size_t t = 0; t < list.count; ++t) {
        if (plan.flags[t] == kDegenerate) continue;
        for (std::size_t k = 0; k < 3; ++k) plan.slots[3 * to + k] = list.corner(3 * t + k);
        pass.faces[to++] = list.face(t);
    }
}

float uvArea(const GroupedPlan& plan, std::size_t t) {
    const std::uint32_t* n = plan.nodes.data() + 3 * t;
    const Vec2 a = plan.node_uv[n[1]] - plan.node_uv[n[0]], b = plan.node_uv[n[2]] - plan.node_uv[n[0]];
    const float area = a.x * b.y - a.y * b.x;
    return area < 0 ? -area : area;
}

/// All triangles of a face get the orientation of one of them.
void uniteOrientation(GroupedPlan& plan, const Buffer<std::uint32_t>& faces) {
    for (std::size_t first = 0; first < plan.triangle_count;) {
        std::size_t end = first + 1;
        while (end < plan.triangle_count && faces[end] == faces[first]) ++end;
        const std::size_t chosen = orientingTriangle(
            first, end, [&](std::size_t t) { return (plan.flags[t] & kAny) != 0; },
            [&](std::size_t t) { return uvArea(plan, t); });
        for (std::size_t t = first; t < end; ++t) {
            plan.flags[t] = static_cast<std::uint8_t>((plan.flags[t] & ~kPositive) | (plan.flags[chosen] & kPositive));
        }
        first = end;
    }
}

}  // namespace

TriangleShape triangleShape(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec2& uv0, const Vec2& uv1,
                            const Vec2& uv2) {
    const float x = uv1.x - uv0.x, y = uv1.y - uv0.y, z = uv2.x - uv0.x, w = uv2.y - uv0.y;
    const Vec3 d1 = p1 - p0, d2 = p2 - p0;
    TriangleShape shape;
    shape.area = x * w - y * z;
    if (!notZero(shape.area)) return shape;
    const Vec3 s = w * d1 - y * d2, t = (-z) * d1 + x * d2;
    const float length_s = length(s), length_t = length(t);
    const float facing = shape.area > 0.0f ? 1.0f : -1.0f;
    if (notZero(length_s)) shape.frame.s = (facing / length_s) * s;
    if (notZero(length_t)) shape.frame.t = (facing / length_t) * t;
    const float absolute = std::fabs(shape.area);
    shape.frame.mag_s = length_s / absolute;
    shape.frame.mag_t = length_t / absolute;
    shape.any = !(notZero(shape.frame.mag_s) && notZero(shape.frame.mag_t));
    return shape;
}

TrianglePass passTriangles(const MeshView& mesh, const TriangleList& list, const Nodes& nodes, GroupedPlan& plan,
                           PoseData& pose, const Allocator* allocator, Parallel& parallel) {
    TrianglePass pass(allocator);
    plan.nodes = Buffer<std::uint32_t>(allocator, 3 * list.count);
    parallel.forRanges(plan.nodes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) plan.nodes[i] = nodes.of(mesh, list.corner(i));
    });
    plan.flags = Buffer<std::uint8_t>(allocator, list.count);
    pose.frames = Buffer<TriangleFrame>(allocator, list.count);
    plan.triangle_count = list.count;
    Counts counts;
    readTriangles(plan, pose, list.count, counts, parallel);
    plan.report.degenerate_triangle_count = counts.degenerate;
    plan.report.degenerate_uv_count = counts.any;
    plan.report.mirrored_count = counts.mirrored;
    pass.uv_degenerate_count = counts.any;
    readSlots(list, counts.degenerate, plan, pass, allocator);
    if (counts.degenerate != 0) {
        planCopies(mesh, list, nodes, plan, pass, allocator);
        removeDegenerate(plan, pose);
    }
    if (!list.faces.empty()) uniteOrientation(plan, pass.faces);
    return pass;
}

}  // namespace tspace::mikk
