// SPDX-License-Identifier: MIT
// Words and numbers of this folder:
//
// node        a welded vertex: all corners with equal position, normal and UV (see weld.h)
// half-edge   3 * triangle + k: the edge of a triangle from its corner k to corner k+1, and also that corner itself
// slot        the corner of the mesh that a half-edge's result belongs to; the two corners at a quad's diagonal are
//             slots of two half-edges each
// group       half-edges at one node that share tangents
//
// The reference names these "tri info", "group" and "tangent space"; its results are described in terms of
// faces and recursion. Here every node is worked on alone: see groups.h for why that gives the same result.
#pragma once

#include "tspace/tangents.h"

namespace tspace::mikk {

inline constexpr std::uint32_t kNone = 0xffffffffu;
/// A bit that no number of a half-edge, a corner or a group has.
inline constexpr std::uint32_t kTopBit = 0x80000000u;
inline constexpr std::uint32_t kValue = 0x7fffffffu;
/// Most half-edges a mesh may have: they share 32 bits with kTopBit.
inline constexpr std::uint64_t kMaxHalfEdges = kValue;

struct Copy {
    std::uint32_t to = 0, from = 0;  ///< corners of the mesh
};

/// How many triangles the faces of a mesh are cut into.
std::uint64_t countTriangles(const MeshView& mesh, Ngons ngons);

}  // namespace tspace::mikk
