// SPDX-License-Identifier: MIT
// Words and numbers of this folder:
//
// node            a welded vertex: all corners with equal position, normal and UV (weld.h)
// half-edge       3 * triangle + k: the edge of a triangle from its corner k to corner k+1, and also that corner itself
// slot            the corner of the mesh that a half-edge's result belongs to; the two corners at a quad's diagonal are
//                 slots of two half-edges each
// group           half-edges at one node that share tangents
// facing          the orientation of a triangle's UVs: kFacesUp with positive area, kFacesDown (mirrored) otherwise
// simple node     its triangles make one fan, face one way, and no angular threshold can split them: one group. One pass
//                 (one_pass.cpp) finishes these nodes. All others are complex and go the vertex path (vertex_path.h)
// contested       a triangle without UV area at whose nodes groups of both orientations may ask for it (groups.h)
// representative  the corner that the reference keeps for a node: the lowest in its own search order (grid_order.h)
//
// The reference works face by face, with recursion; its "tri info" is a triangle, its "tangent space" a result. Here every
// node is grouped alone: groups.h proves that the result is the same.
#pragma once

#include "tspace/tangents.h"

namespace tspace::mikk {

inline constexpr std::uint32_t kNone = 0xffffffffu;
/// No number of a half-edge, a corner or a group has this bit: lists use it as a flag (table in plan.cpp).
inline constexpr std::uint32_t kTopBit = 0x80000000u;
inline constexpr std::uint32_t kValue = 0x7fffffffu;
/// Most half-edges a mesh may have: they share 32 bits with kTopBit.
inline constexpr std::uint64_t kMaxHalfEdges = kValue;

struct Copy {
    std::uint32_t to = 0, from = 0;  ///< corners of the mesh
};

/// The number of triangles that the faces of a mesh are cut into.
std::uint64_t countTriangles(const MeshView& mesh, Ngons ngons);

}  // namespace tspace::mikk
