// SPDX-License-Identifier: MIT
// What both ways to smooth normals read, these ways, and the rounds of NormalWeighting::best, which both end with.
#pragma once

#include "core/base/call.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/weld.h"
#include "core/normals/face_terms.h"
#include "core/normals/faces.h"
#include "tspace/normals.h"

namespace tspace {

/// A call whose mesh and options have been checked.
struct NormalsCall {
    NormalsCall(const MeshView& m, const MeshView& p, const Call<NormalOptions>& o, StridedSpan<Vec3> to,
                Parallel& threads)
        : mesh(m),
          posed(p),
          options(o),
          out(to),
          allocator(o.execution.allocator),
          parallel(threads),
          faces(m, allocator),
          points(o.weld_positions ? weldPositions(m, allocator, parallel) : Buffer<std::uint32_t>()),
          items(m, faces, points, allocator),
          kernel(smooth::faceKernelFor(o.execution.simd)),
          factor(normalFactor(o.convention)),
          are_triangles(PointItems::areTriangles(m)),
          is_best(o.weighting == NormalWeighting::best),
          weighting(is_best ? NormalWeighting::angleArea : o.weighting),
          by_area(weighting == NormalWeighting::area || weighting == NormalWeighting::angleArea),
          by_angle(weighting == NormalWeighting::angle || weighting == NormalWeighting::angleArea) {}

    [[nodiscard]] smooth::FaceSource source(const MeshView& of, bool angles, bool areas) const {
        const StridedSpan<const Vec3>& p = of.positions;
        return {reinterpret_cast<const std::byte*>(p.data),
                p.stride_bytes,
                static_cast<std::uint32_t>(p.count - 1),
                factor,
                angles,
                areas};
    }

    const MeshView &mesh, &posed;  ///< what is one point and what is hard is decided by the mesh, all else by the pose
    const Call<NormalOptions>& options;
    StridedSpan<Vec3> out;
    const Allocator* allocator;
    Parallel& parallel;
    Faces faces;
    Buffer<std::uint32_t> points;  ///< the point of each vertex; empty when each is its own
    PointItems items;
    smooth::FaceKernel kernel;
    double factor;
    bool are_triangles, is_best;
    NormalWeighting weighting;  ///< of the means
    bool by_area, by_angle;
};

/// The common case by a shorter way: triangles, all weightings but max, and a point has one normal. Scratch
/// memory: 4 bytes per vertex, core/range_lists.h and 1 MB, or up to 4 MB for each of several threads; where triangles
/// that follow one another are far apart 36 bytes per vertex; for `best` 60, and core/sum_rounds.h. While vertices are
/// welded 10 to 24. Throws OutOfMemory.
NormalReport smoothTriangles(const NormalsCall& call);

/// Any mesh: faces of any size, hard edges, all weightings. Range by range of points, with a list of the corners around
/// each. Scratch memory: 4 bytes per vertex, core/range_lists.h, faces.h where faces differ in size, and for each task
/// 150 bytes per triangle of a range, which are an eighth of a small mesh and about 8000 of a large one; for `best`
/// also 28 bytes per corner. While vertices are welded 10 to 24 bytes per vertex. Throws OutOfMemory.
NormalReport smoothFaces(const NormalsCall& call);

/// The weighting `flat`, but that corners of degenerate faces keep what they have; these are what it counts as substitutes.
/// Looks at no points.
NormalReport writeFaceNormals(const NormalsCall& call);

namespace smooth {

/// Vectors that are read behind those of all groups: one, and a part of another.
inline constexpr std::size_t kBehind = 2;

/// From the means by angle * area to the normals of `best`, in place; then options.refine steps.
///
/// adding_corners  3, or 1 where only the first corner of each triangle adds something
/// normals         one per group, zero where a mean vanished; what is there afterwards means nothing
/// sharp           the means by `max`, or zero where one vanished, and kBehind more; empty: they are found by the same
///                 triangles. Where one vanished the mean by angle * area stays
///
/// Scratch memory: 24 bytes per group with `sharp`, and core/sum_rounds.h. Linear. Throws OutOfMemory.
void refine(const NormalsCall& call, const TriangleGroups& triangles, std::size_t adding_corners,
            StridedSpan<Vec3> normals, Buffer<Vec3> sharp);

}  // namespace smooth

}  // namespace tspace
