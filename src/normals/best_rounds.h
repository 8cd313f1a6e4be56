// SPDX-License-Identifier: MIT
// NormalWeighting::best: rounds of sums at groups of corners that share a normal.
#pragma once

#include "normals/normals_call.h"

namespace tspace::smooth {

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

}  // namespace tspace::smooth
