// SPDX-License-Identifier: MIT
// Plans of lengyel, flat and basis: triangulated faces, and counts that do not depend on the pose.
#include "core/tangents/indexed_methods.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "core/base/mesh_loops.h"
#include "core/base/parallel.h"
#include "core/base/vec_math.h"
#include "core/tangents/mikktspace/weld.h"

namespace tspace {
namespace {

/// Triangulates faces, unless all are triangles.
void cutFaces(const MeshView& mesh, Ngons ngons, const Allocator* allocator, IndexedPlan& plan) {
    plan.triangle_vertices = plan.corner_vertices;
    mikk::TriangleList cut = mikk::cutFaces(mesh, ngons, allocator);
    if (3 * cut.count == mesh.cornerCount() && cut.corners.empty()) return;
    plan.report.skipped_face_count = cut.skipped_face_count;
    plan.cut_triangles = std::move(cut.corners);
    for (std::uint32_t& corner : plan.cut_triangles) corner = mesh.indices[corner];
    plan.triangle_vertices = {plan.cut_triangles.data(), plan.cut_triangles.size(), IndexType::u32};
    if (cut.skipped_face_count != 0) plan.corner_used = Buffer<std::uint8_t>(allocator, mesh.cornerCount(), 1);
    for (const std::uint32_t corner : cut.skipped_corners) plan.corner_used[corner] = 0;
    plan.face_begins = Buffer<std::uint32_t>(allocator, mesh.faceCount() + 1);
    forEachFace(mesh, [&](std::size_t face, std::size_t first_corner, std::uint32_t) {
        plan.face_begins[face] = static_cast<std::uint32_t>(first_corner);
    });
    plan.face_begins[mesh.faceCount()] = static_cast<std::uint32_t>(mesh.cornerCount());
}

/// Copies an array for a plan that outlives the call.
template <class View, class T>
void keep(const View& from, Buffer<T>& kept, const Allocator* allocator, Parallel& parallel) {
    kept = Buffer<T>(allocator, from.count);
    parallel.forRanges(from.count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) kept[i] = from[i];
    });
}

void countUvs(Parallel& parallel, IndexedPlan& plan) {
    std::atomic<std::uint64_t> degenerate{0}, mirrored{0};
    parallel.forRanges(plan.triangleCount(), Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
        std::uint64_t without_area = 0, negative = 0;
        for (std::size_t i = 3 * begin; i < 3 * end; i += 3) {
            const auto uv = [&](std::size_t k) { return plan.uvs[plan.triangle_vertices[i + k]]; };
            const double determinant = uvFrame({}, {}, {}, uv(0), uv(1), uv(2)).determinant;
            if (!hasUvArea(determinant))
                ++without_area;
            else if (determinant < 0)
                ++negative;
        }
        degenerate.fetch_add(without_area, std::memory_order_relaxed);
        mirrored.fetch_add(negative, std::memory_order_relaxed);
    });
    plan.report.degenerate_uv_count = degenerate;
    plan.report.mirrored_count = mirrored;
}

std::uint64_t countDegenerate(const IndexedPlan& plan, const Pose& pose, Parallel& parallel) {
    return sumRanges(parallel, plan.triangleCount(), Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
        std::uint64_t count = 0;
        for (std::size_t i = 3 * begin; i < 3 * end; i += 3) {
            const auto p = [&](std::size_t k) { return pose.positions[plan.triangle_vertices[i + k]]; };
            if (p(0) == p(1) || p(1) == p(2) || p(2) == p(0)) ++count;
        }
        return count;
    });
}

void clearUnusedCorners(const IndexedPlan& plan, const TangentOutput& out) {
    if (plan.domain == OutputDomain::vertex) return;
    for (std::size_t c = 0; c < plan.corner_used.size(); ++c) {
        if (plan.corner_used[c] == 0) writeFrame(out, c, {});
    }
}

}  // namespace

std::size_t IndexedPlan::memoryBytes() const {
    return 4 * (face_begins.size() + cut_triangles.size() + kept_vertices.size()) + corner_used.size() +
           sizeof(Vec2) * kept_uvs.size();
}

IndexedPlan planIndexed(const MeshView& mesh, const Call<TangentOptions>& options, Parallel& parallel, PlanUse use) {
    const Allocator* const allocator = options.execution.allocator;
    IndexedPlan plan;
    plan.method = options.method;
    plan.domain = options.domain;
    plan.sign_factor = signFactor(options.convention);
    plan.vertex_count = mesh.vertexCount();
    plan.face_count = mesh.faceCount();
    plan.corner_vertices = mesh.indices;
    plan.corner_vertices.count = mesh.cornerCount();
    if (plan.method != Method::basis) plan.uvs = mesh.uvs;
    if (use == PlanUse::kept) {
        keep(plan.corner_vertices, plan.kept_vertices, allocator, parallel);
        keep(plan.uvs, plan.kept_uvs, allocator, parallel);
        plan.corner_vertices.data = plan.kept_vertices.data();
        plan.corner_vertices.type = IndexType::u32;
        plan.uvs = {plan.kept_uvs.data(), plan.kept_uvs.size()};
    }
    cutFaces(mesh, options.ngons, allocator, plan);
    plan.report.triangle_count = plan.triangleCount();
    if (plan.method == Method::flat) {
        countUvs(parallel, plan);
        plan.report.group_count = plan.face_count - plan.report.skipped_face_count;
    }
    return plan;
}

TangentReport evaluateIndexed(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out,
                              const Execution& execution, Parallel& parallel) {
    TangentReport report = plan.report;
    if (plan.method != Method::lengyel) report.degenerate_triangle_count = countDegenerate(plan, pose, parallel);
    if (plan.method == Method::lengyel)
        evaluateLengyel(plan, pose, out, execution, parallel, report);
    else if (plan.method == Method::basis)
        evaluateBasis(plan, pose, out, execution.allocator, parallel, report);
    else
        evaluateFlat(plan, pose, out, parallel, report);
    // Unused corners are cleared last, because lengyel uses the memory of the outputs for its sums.
    clearUnusedCorners(plan, out);
    return report;
}

float meanLength(const DVec3& sum, double count) {
    return static_cast<float>(std::min(length(sum) / count, double{std::numeric_limits<float>::max()}));
}

CornerFrame makeCornerFrame(const Derivatives& d, const Vec3& normal, float sign_factor) {
    const CornerFrame fallback{{1, 0, 0, sign_factor}, {0, sign_factor, 0}, 1, 1, false};
    const DVec3 n = toDouble(normal);
    // cross(N, T) has the direction of cross(N, dP/du), which needs fewer operations, so less rounding.
    const float sign = (dot(cross(n, d.s), d.t) < 0 ? -1.0f : 1.0f) * sign_factor;
    DVec3 t = d.s - dot(n, d.s) * n;
    if (!normalize(t)) return fallback;

    DVec3 b = d.t;
    float b_sign = sign_factor;
    if (!normalize(b)) {
        b = cross(n, t);
        b_sign = sign;
        if (!normalize(b)) b = {0, 1, 0};
    }
    const Vec3 tangent = toFloat(t);
    return {{tangent.x, tangent.y, tangent.z, sign}, toFloat(b_sign * b), meanLength(d.s, 1), meanLength(d.t, 1), true};
}

void writeFrame(const TangentOutput& out, std::size_t entry, const CornerFrame& frame) {
    out.tangents[entry] = frame.tangent;
    writeExtras(out, entry, frame);
}

void writeExtras(const TangentOutput& out, std::size_t entry, const CornerFrame& frame) {
    if (!out.bitangents.empty()) out.bitangents[entry] = frame.bitangent;
    if (!out.magnitudes_s.empty()) out.magnitudes_s[entry] = frame.magnitude_s;
    if (!out.magnitudes_t.empty()) out.magnitudes_t[entry] = frame.magnitude_t;
    if (!out.has_tangent.empty()) out.has_tangent[entry] = frame.has_tangent ? 1 : 0;
}

// Method `flat`: each face has one dP/du and one dP/dv, which are orthogonalized against the normal of each of its
// corners.
//
// For a polygon they are the mean over its UV area, sum(t2 E1 - t1 E2) / sum(determinant) over any fan of triangles: by
// Green's theorem this depends only on the border, not on the choice of diagonals.

namespace {

Derivatives faceDerivatives(const IndexedPlan& plan, const Pose& pose, std::uint32_t first, std::uint32_t past) {
    const std::uint32_t v0 = plan.corner_vertices[first];
    UvFrame sum;
    for (std::uint32_t c = first + 1; c + 1 < past; ++c) {
        const std::uint32_t v1 = plan.corner_vertices[c];
        const std::uint32_t v2 = plan.corner_vertices[c + 1];
        const UvFrame frame = uvFrame(pose.positions[v0], pose.positions[v1], pose.positions[v2], plan.uvs[v0],
                                      plan.uvs[v1], plan.uvs[v2]);
        sum = {sum.tangent + frame.tangent, sum.bitangent + frame.bitangent, sum.determinant + frame.determinant};
    }
    if (!hasUvArea(sum.determinant)) return {};
    const double r = 1 / sum.determinant;
    const Derivatives d{r * sum.tangent, r * sum.bitangent};
    return std::isfinite(length(d.s)) && std::isfinite(length(d.t)) ? d : Derivatives{};
}

}  // namespace

void evaluateFlat(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out, Parallel& parallel,
                  TangentReport& report) {
    report.default_corner_count =
        sumRanges(parallel, plan.face_count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
            std::uint64_t count = 0;
            for (std::size_t face = begin; face < end; ++face) {
                const std::uint32_t first = plan.faceBegin(face);
                const std::uint32_t past = plan.faceBegin(face + 1);
                if (first == past || !plan.isUsed(first)) continue;
                const Derivatives d = faceDerivatives(plan, pose, first, past);
                for (std::uint32_t c = first; c < past; ++c) {
                    const CornerFrame frame =
                        makeCornerFrame(d, pose.normals[plan.corner_vertices[c]], plan.sign_factor);
                    writeFrame(out, c, frame);
                    count += frame.has_tangent ? 0 : 1;
                }
            }
            return count;
        });
}

// Method `basis`: an orthonormal basis from the normal, without UVs.
// Based on: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.

namespace {

CornerFrame basisFrame(const Vec3& normal, float sign_factor) {
    DVec3 n = toDouble(normal);
    const bool has_direction = normalize(n);
    const PlaneAxes axes = planeAxes(toDouble(has_direction ? toFloat(n) : Vec3{0, 0, 1}));
    const Vec3 t = toFloat(axes.x);
    return {{t.x, t.y, t.z, sign_factor}, sign_factor * toFloat(axes.y), 1, 1, has_direction};
}

/// Returns 1 for each vertex that a used corner refers to.
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
                count += is_used && !frame.has_tangent ? 1 : 0;
            }
            return count;
        });
}

}  // namespace tspace
