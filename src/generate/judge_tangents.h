// SPDX-License-Identifier: MIT
// Repair: which tangents that are there may stay.
#pragma once

#include <span>
#include <string>

#include "generate/primitive.h"

namespace tspace {

/// Why the pool's tangents have to be made anew; empty: they are good. What counts is what `check` calls an error, and,
/// on however few vertices, values that no file may have: not finite, not of length 1, a sign other than +1 and -1.
///
/// tangents    one per vertex of the pool; those that no primitive uses do not count
/// primitives  triangles; at one vertex all of them are looked at together, as they are split together
/// options     convention and execution are those of `tangents`
///
/// Near-linear time; the memory that `check` needs. Fails where generateTangents does.
Result<std::string> whyTangentsCannotStay(const VertexPool& pool, std::span<const Vec4> tangents,
                                          std::span<const PrimitiveGeometry> primitives,
                                          const GenerateOptions& options);

}  // namespace tspace
