// SPDX-License-Identifier: MIT
// Frames for pools of a glTF file, several pools at the same time.
#pragma once

#include <span>
#include <vector>

#include "asset/gltf/generate_plan.h"
#include "generate/primitive.h"

namespace tspace::gltf {

/// What the tangents of a pool are computed from. `first`: any primitive of it.
VertexPool readVertices(const Document& document, const Primitive& first, const Pool& pool);

/// The triangles of each geometry of a pool.
std::vector<PrimitiveGeometry> readGeometries(const Document& document, std::span<const Primitive> primitives,
                                              const Pool& pool);

/// Frames of each pool, in their order. Fills normals, tangents and sanitize of the reports of their primitives.
/// Throws what the first pool with an error throws. Which threads work on what changes no bit.
std::vector<PoolFrames> computePools(const Document& document, std::span<const Primitive> primitives,
                                     std::span<const Pool> pools, const GenerateOptions& options,
                                     std::span<PrimitiveReport> reports);

}  // namespace tspace::gltf
