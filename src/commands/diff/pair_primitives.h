// SPDX-License-Identifier: MIT
// Pairs the primitives of two files, and their triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "model/scene/scene.h"

namespace tspace {

// Matching of triangles of two meshes that represent the same surface.

/// Triangle `a` of A corresponds to triangle `b` of B; corner k of `a` corresponds to corner (k + rotation) % 3 of `b`.
struct TrianglePair {
    std::uint32_t a = 0, b = 0;
    std::uint32_t rotation = 0;
};

/// Returns a hash of the triangles of a mesh (of their corner positions). It does not depend on the order of the
/// triangles, nor on which corners share a vertex. The hashes of different meshes are almost never equal.
std::uint64_t geometryHash(const ScenePrimitive& primitive);

/// Pairs triangles with the same corner positions, first those whose UVs (of the first set) are equal, too. Positions
/// are compared as numbers. Repeated triangles are paired in order. Expected linear time.
std::vector<TrianglePair> pairByCorners(const ScenePrimitive& a, const ScenePrimitive& b);

/// Pairs triangles whose corners agree within 1/1000 of the size of the mesh, after both meshes were moved and scaled
/// to the same bounding box. It is meant for meshes that were quantized, or written with fewer digits. Expected linear
/// time; if hundreds of triangles coincide, some may remain unpaired.
std::vector<TrianglePair> pairByPlace(const ScenePrimitive& a, const ScenePrimitive& b);

inline constexpr std::size_t kNoPrimitive = ~std::size_t{0};

struct PrimitivePair {
    std::size_t a = kNoPrimitive, b = kNoPrimitive;  ///< indices in their scenes; kNoPrimitive: no partner
    std::string paired_by = "none";                  ///< value for PrimitiveDiff::paired_by
    std::vector<TrianglePair> triangles = {};
};

/// Returns the primitives of A in file order, then those of B without a partner. Primitives without triangles are
/// omitted.
std::vector<PrimitivePair> pairPrimitives(const Scene& a, const Scene& b);

}  // namespace tspace
