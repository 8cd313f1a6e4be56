// SPDX-License-Identifier: MIT
// The plan of the methods that need no groups: lengyel, flat and basis.
#pragma once

#include "core/memory.h"
#include "core/parallel.h"
#include "tspace/tangents.h"

namespace tspace {

struct IndexedPlan {
    Method method = Method::lengyel;
    float sign_factor = 1.0f;               ///< signFactor(convention)
    std::size_t vertex_count = 0;
    std::size_t face_corner_count = 0;      ///< corners of the mesh
    Buffer<std::uint32_t> corner_vertices;  ///< one per corner of the mesh
    Buffer<std::uint32_t> triangles;        ///< three corners of the mesh per triangle, after cutting faces; face order
    Buffer<std::uint8_t> corner_used;       ///< one per corner: 1 when it belongs to a triangle; else outputs are 0
    Buffer<std::uint32_t> face_begins;      ///< flat only: first corner of each face, and one past the last
    Buffer<Vec2> uvs;                       ///< one per vertex; empty for basis
    TangentReport report;                   ///< what can be counted without a pose

    [[nodiscard]] std::size_t memoryBytes() const;
};

/// Makes the plan; the mesh has been validated and has the attributes that the method needs. Throws OutOfMemory.
IndexedPlan planIndexed(const MeshView& mesh, const TangentOptions& options, Parallel& parallel);

/// Evaluates one pose into checked outputs; returns the plan's report with the counts that depend on the pose added.
/// Throws OutOfMemory.
TangentReport evaluateIndexed(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out,
                              const Allocator* allocator, Parallel& parallel);

}  // namespace tspace
