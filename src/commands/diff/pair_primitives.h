// SPDX-License-Identifier: MIT
// Which primitive of one file is which of another, and which of their triangles are which.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "model/scene/scene.h"

namespace tspace {

// Matches the triangles of two meshes that show the same surface.

/// Triangle `a` of A is triangle `b` of B; corner k of it is corner (k + rotation) % 3 there.
struct TrianglePair {
    std::uint32_t a = 0, b = 0;
    std::uint32_t rotation = 0;
};

/// A number that two meshes have in common when they consist of the same triangles (corner positions), whatever the
/// order and the vertices. Different meshes nearly never have the same.
std::uint64_t geometryHash(const ScenePrimitive& primitive);

/// Pairs triangles with the same corner positions, those with the same UVs (of `uv_set`) first. Positions are compared
/// as numbers. Triangles that are there several times are paired in their order. Expected linear.
std::vector<TrianglePair> pairByCorners(const ScenePrimitive& a, const ScenePrimitive& b);

/// Pairs triangles whose corners lie at the same place but for 1/1000 of the size of the mesh, after both meshes were
/// moved and scaled to the same box: quantised, and written with fewer digits. Expected linear; where hundreds of
/// triangles share a place, some may stay without a partner.
std::vector<TrianglePair> pairByPlace(const ScenePrimitive& a, const ScenePrimitive& b);

inline constexpr std::size_t kNoPrimitive = ~std::size_t{0};

struct PrimitivePair {
    std::size_t a = kNoPrimitive, b = kNoPrimitive;  ///< numbers in their scenes; kNoPrimitive: no partner
    std::string paired_by = "none";                  ///< PrimitiveDiff::paired_by
    std::vector<TrianglePair> triangles = {};
};

/// The primitives of A in file order, then those of B without a partner. Primitives without triangles are left out.
std::vector<PrimitivePair> pairPrimitives(const Scene& a, const Scene& b);

}  // namespace tspace
