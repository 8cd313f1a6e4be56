// SPDX-License-Identifier: MIT
// Mends the winding of faces: those that are wound against their neighbours, and whole parts that are inside out.
#pragma once

#include <cstdint>

#include "tspace/convention.h"
#include "tspace/execution.h"
#include "tspace/mesh.h"

namespace tspace {

struct WindingOptions {
    /// Its handedness and winding say which order of corners is right as seen from outside; the default is glTF's.
    Convention convention = {};
    /// true: the mesh's normals, where it has some, say which side of a component is out, if they agree among themselves.
    bool use_normals = true;
    /// true: vertices at the same position are one point (so a mesh without indices is a surface); false: only equal
    /// indices are.
    bool weld_positions = true;
    /// With `weld_positions`: positions that differ by no more than this in each coordinate are one, as for normals. 0, the
    /// default: only equal positions are. -1: by the spacing of floats, as there.
    float weld_distance = 0;
};

/// What was found and done. A *component* is what hangs together over pairs of faces at edges. A pair is in *conflict*
/// where both faces run through their edge in the same direction.
struct WindingReport {
    std::uint64_t face_count = 0;    ///< faces with at least 3 corners
    std::uint64_t turned_count = 0;  ///< faces to be turned
    std::uint64_t conflict_count_before = 0;
    std::uint64_t conflict_count_after = 0;  ///< as if the faces had been turned
    std::uint64_t component_count = 0;
    std::uint64_t turned_component_count = 0;  ///< of which more than half of the faces are turned

    // How the components were decided; together component_count:

    std::uint64_t by_normals_count = 0;  ///< by normals of the mesh
    std::uint64_t by_volume_count = 0;   ///< closed: the volume is positive
    /// Closed, and lying in another one: as most of the area was wound, or, if that says nothing, a cavity.
    std::uint64_t by_nesting_count = 0;
    std::uint64_t by_winding_number_count = 0;  ///< open, but with an inside: the winding number on its own faces
    std::uint64_t by_majority_count = 0;        ///< open, and no side is inside: as most of the area was wound
    /// Fewer than 4 faces, such as leaves and cards: nothing is turned, since nothing says what is right.
    std::uint64_t small_count = 0;
    /// Turning some faces would leave as many conflicts as there are, as on a Moebius band: none is turned, or all, where the
    /// component is open and its winding number says that it is inside out.
    std::uint64_t one_sided_count = 0;
};

/// Says which faces to turn (to reverse the order of their corners) so that neighbours are wound alike and the outside is
/// where the convention wants it.
///
/// Faces are paired at the edges that they share. Where more than two meet, those that share the edge by their indices
/// are paired if they are two; others are sorted as they turn about the edge, and neighbours in that order are paired, of
/// the two ways to do so the one with the smaller gaps; of an odd number only the two that lie straightest. Pairs by turn that
/// contradict the others are none. Faces that lie
/// on one another keep the winding that they have to each other: both sides of a sheet stay so.
/// Each component is wound alike in itself, and then decided as a whole, by the first of the rules in WindingReport that
/// applies. Nothing else about it is known: an open surface without an inside, such as a terrain, that is wholly inside
/// out and has no normals stays so.
///
/// mesh       positions and indices, and normals where options.use_normals; UVs are not looked at
/// turned     one per face: 1 to turn it, else 0; must not overlap the inputs
/// execution  threads and memory; changes no bit
/// Errors: those of validate(); countMismatch (turned), outOfMemory.
/// O(corners) but for sorting the edges of one point and, where closed components lie in one another, O(n log n). Scratch
/// memory: 16 bytes per corner, 32 per face and 28 per vertex, and where closed components lie in one another 50 per face
/// more. Thread-safe; same bits for any thread count.
Result<WindingReport> mendWinding(const MeshView& mesh, const WindingOptions& options, StridedSpan<std::uint8_t> turned,
                                  const Execution& execution = {});

}  // namespace tspace
