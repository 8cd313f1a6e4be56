// SPDX-License-Identifier: MIT
// Planning for lengyel, flat and basis: faces cut to triangles, vertices of corners, and what can be counted
// early.
#include "tangents/indexed_plan.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/face_walk.h"
#include "core/polygon.h"
#include "core/sum_ranges.h"
#include "core/unit.h"
#include "core/uv_frame.h"
#include "tangents/indexed_methods.h"

namespace tspace {

namespace {

constexpr std::size_t kGrain = 4096;

bool isUsed(std::uint32_t face_size, Ngons ngons) {
    return face_size >= 3 && (face_size <= 4 || ngons == Ngons::triangulate);
}

/// Cuts one face after another, reusing its memory.
class FaceCutter {
  public:
    explicit FaceCutter(const MeshView& mesh) : mesh_(mesh) {}

    /// Writes 3 * (size - 2) corners of the mesh.
    void cut(std::size_t first_corner, std::uint32_t size, std::uint32_t* triangles) {
        const std::size_t written = 3 * (std::size_t{size} - 2);
        if (size == 3) {
            for (std::uint32_t i = 0; i < 3; ++i) triangles[i] = static_cast<std::uint32_t>(first_corner) + i;
            return;
        }
        positions_.resize(size);
        uvs_.resize(mesh_.uvs.empty() ? 0 : size);
        for (std::uint32_t i = 0; i < size; ++i) {
            const std::uint32_t vertex = mesh_.indices[first_corner + i];
            positions_[i] = mesh_.positions[vertex];
            if (!uvs_.empty()) uvs_[i] = mesh_.uvs[vertex];
        }
        cutPolygon(positions_.data(), uvs_.empty() ? nullptr : uvs_.data(), size, triangles, scratch_);
        for (std::size_t i = 0; i < written; ++i) triangles[i] += static_cast<std::uint32_t>(first_corner);
    }

  private:
    const MeshView& mesh_;
    std::vector<Vec3> positions_;
    std::vector<Vec2> uvs_;
    PolygonScratch scratch_;
};

void cutFaces(const MeshView& mesh, Ngons ngons, const Allocator* allocator, IndexedPlan& plan) {
    std::size_t triangle_count = 0;
    forEachFace(mesh, [&](std::size_t, std::size_t, std::uint32_t size) {
        if (isUsed(size, ngons))
            triangle_count += size - 2;
        else
            ++plan.report.skipped_face_count;
    });
    plan.triangles = Buffer<std::uint32_t>(allocator, 3 * triangle_count);
    plan.corner_used = Buffer<std::uint8_t>(allocator, plan.face_corner_count, 0);
    plan.report.triangle_count = triangle_count;

    FaceCutter cutter(mesh);
    std::uint32_t* end = plan.triangles.data();
    forEachFace(mesh, [&](std::size_t, std::size_t first_corner, std::uint32_t size) {
        if (!isUsed(size, ngons)) return;
        std::fill_n(plan.corner_used.data() + first_corner, size, std::uint8_t{1});
        cutter.cut(first_corner, size, end);
        end += 3 * (std::size_t{size} - 2);
    });
}

void keepFaces(const MeshView& mesh, const Allocator* allocator, IndexedPlan& plan) {
    plan.face_begins = Buffer<std::uint32_t>(allocator, mesh.faceCount() + 1);
    forEachFace(mesh, [&](std::size_t face, std::size_t first_corner, std::uint32_t) {
        plan.face_begins[face] = static_cast<std::uint32_t>(first_corner);
    });
    plan.face_begins[mesh.faceCount()] = static_cast<std::uint32_t>(plan.face_corner_count);
}

void countUvs(IndexedPlan& plan) {
    for (std::size_t i = 0; i < plan.triangles.size(); i += 3) {
        const auto uv = [&](std::size_t k) { return plan.uvs[plan.corner_vertices[plan.triangles[i + k]]]; };
        const double determinant = uvFrame({}, {}, {}, uv(0), uv(1), uv(2)).determinant;
        if (!hasUvArea(determinant))
            ++plan.report.degenerate_uv_count;
        else if (determinant < 0)
            ++plan.report.mirrored_count;
    }
}

/// A face for flat; for the others a vertex that a used corner names.
void countGroups(const Allocator* allocator, IndexedPlan& plan) {
    if (plan.method == Method::flat) {
        plan.report.group_count = plan.face_begins.size() - 1 - plan.report.skipped_face_count;
        return;
    }
    Buffer<std::uint8_t> seen(allocator, plan.vertex_count, 0);
    for (std::size_t c = 0; c < plan.face_corner_count; ++c) {
        if (plan.corner_used[c] == 0 || seen[plan.corner_vertices[c]] != 0) continue;
        seen[plan.corner_vertices[c]] = 1;
        ++plan.report.group_count;
    }
}

std::uint64_t countDegenerate(const IndexedPlan& plan, const Pose& pose, Parallel& parallel) {
    return sumRanges(parallel, plan.triangles.size() / 3, kGrain, [&](std::size_t begin, std::size_t end) {
        std::uint64_t count = 0;
        for (std::size_t i = 3 * begin; i < 3 * end; i += 3) {
            const Vec3& a = pose.positions[plan.corner_vertices[plan.triangles[i]]];
            const Vec3& b = pose.positions[plan.corner_vertices[plan.triangles[i + 1]]];
            const Vec3& c = pose.positions[plan.corner_vertices[plan.triangles[i + 2]]];
            if (a == b || b == c || c == a) ++count;
        }
        return count;
    });
}

void clearUnusedCorners(const IndexedPlan& plan, const TangentOutput& out) {
    if (plan.report.skipped_face_count == 0) return;
    for (std::size_t c = 0; c < plan.face_corner_count; ++c) {
        if (plan.corner_used[c] == 0) writeCorner(out, c, {});
    }
}

}  // namespace

std::size_t IndexedPlan::memoryBytes() const {
    return 4 * (corner_vertices.size() + triangles.size() + face_begins.size()) + corner_used.size() +
           sizeof(Vec2) * uvs.size();
}

IndexedPlan planIndexed(const MeshView& mesh, const TangentOptions& options, Parallel& parallel) {
    const Allocator* const allocator = options.execution.allocator;
    IndexedPlan plan;
    plan.method = options.method;
    plan.sign_factor = signFactor(options.convention);
    plan.vertex_count = mesh.vertexCount();
    plan.face_corner_count = mesh.cornerCount();
    plan.corner_vertices = Buffer<std::uint32_t>(allocator, plan.face_corner_count);
    parallel.forRanges(plan.face_corner_count, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) plan.corner_vertices[c] = mesh.indices[c];
    });
    cutFaces(mesh, options.ngons, allocator, plan);
    if (plan.method != Method::basis) {
        plan.uvs = Buffer<Vec2>(allocator, plan.vertex_count);
        for (std::size_t v = 0; v < plan.vertex_count; ++v) plan.uvs[v] = mesh.uvs[v];
        countUvs(plan);
    }
    if (plan.method == Method::flat) keepFaces(mesh, allocator, plan);
    countGroups(allocator, plan);
    return plan;
}

TangentReport evaluateIndexed(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out,
                              const Allocator* allocator, Parallel& parallel) {
    TangentReport report = plan.report;
    report.degenerate_triangle_count = countDegenerate(plan, pose, parallel);
    clearUnusedCorners(plan, out);
    if (plan.method == Method::basis) {
        report.default_corner_count = evaluateBasis(plan, pose, out, parallel);
    } else if (plan.method == Method::flat) {
        report.default_corner_count = evaluateFlat(plan, pose, out, parallel);
    } else {
        report.default_corner_count = evaluateLengyel(plan, pose, out, allocator, parallel);
    }
    return report;
}

CornerFrame makeCornerFrame(const Derivatives& d, const Vec3& normal, float sign_factor) {
    const CornerFrame fallback{{1, 0, 0, sign_factor}, {0, sign_factor, 0}, 1, 1, true};
    const DVec3 n = toDouble(normal);
    DVec3 t = d.s - dot(n, d.s) * n;
    if (!normalize(t)) return fallback;

    const float sign = (dot(cross(n, t), d.t) < 0 ? -1.0f : 1.0f) * sign_factor;
    DVec3 b = d.t;
    float b_sign = sign_factor;
    if (!normalize(b)) {
        b = cross(n, t);
        b_sign = sign;
        if (!normalize(b)) b = {0, 1, 0};
    }
    const Vec3 tangent = toFloat(t);
    // A mean of floats can be longer than the largest float only by its rounding.
    const auto magnitude = [](double l) {
        return static_cast<float>(std::min(l, double{std::numeric_limits<float>::max()}));
    };
    return {{tangent.x, tangent.y, tangent.z, sign},
            toFloat(b_sign * b),
            magnitude(length(d.s)),
            magnitude(length(d.t)),
            false};
}

void writeCorner(const TangentOutput& out, std::size_t corner, const CornerFrame& frame) {
    out.tangents[corner] = frame.tangent;
    if (!out.bitangents.empty()) out.bitangents[corner] = frame.bitangent;
    if (!out.magnitudes_s.empty()) out.magnitudes_s[corner] = frame.magnitude_s;
    if (!out.magnitudes_t.empty()) out.magnitudes_t[corner] = frame.magnitude_t;
}

}  // namespace tspace
