// SPDX-License-Identifier: MIT
// Fixes the winding of faces: faces wound against their neighbors, and components that are inside out.
#pragma once

#include <cstdint>

#include "tspace/convention.h"
#include "tspace/execution.h"
#include "tspace/mesh.h"

namespace tspace {

struct WindingOptions {
    /// Handedness and winding define the corner order of a face seen from outside. Default: glTF.
    Convention convention = {};
    /// true: the mesh's normals, if present and consistent within a component, decide which side of it is outside.
    bool use_normals = true;
    /// true: weld vertices with equal positions (so a non-indexed mesh is a connected surface); false: weld by index
    /// only.
    bool weld_positions = true;
    /// With `weld_positions`: maximum difference per coordinate of welded positions. Same meaning as
    /// NormalOptions::weld_distance. 0, the default: only equal positions. -1: derived from the spacing of floats.
    float weld_distance = 0;
};

/// Results of mendWinding. A *component* is a set of faces connected by pairs of faces at edges. A pair is in
/// *conflict* if both faces traverse their shared edge in the same direction.
struct WindingReport {
    std::uint64_t face_count = 0;    ///< faces with at least 3 corners
    std::uint64_t turned_count = 0;  ///< faces to flip
    std::uint64_t conflict_count_before = 0;
    std::uint64_t conflict_count_after = 0;  ///< conflicts left after flipping
    std::uint64_t component_count = 0;
    std::uint64_t turned_component_count = 0;  ///< components in which more than half of the faces are flipped

    // Numbers of components, for each rule that decided their outside; the sum is component_count:

    std::uint64_t by_normals_count = 0;  ///< normals of the mesh
    std::uint64_t by_volume_count = 0;   ///< closed: the volume must be positive
    /// Closed, inside another component: keeps the winding of most of its area; if that is undecided, it is a cavity.
    std::uint64_t by_nesting_count = 0;
    /// Open, but with an inside: decided by the generalized winding number at its own faces.
    std::uint64_t by_winding_number_count = 0;
    std::uint64_t by_majority_count = 0;  ///< open, without an inside: keeps the winding of most of its area
    /// Fewer than 4 faces, such as leaves and cards: never flipped, because nothing shows their outside.
    std::uint64_t small_count = 0;
    /// Flipping single faces would not reduce the number of conflicts, as on a Moebius band. No face is flipped, or all
    /// faces if the component is open and its winding number shows that it is inside out.
    std::uint64_t one_sided_count = 0;
};

/// Determines which faces to flip (reverse the order of their corners) so that neighboring faces have consistent
/// winding and the outside matches the convention.
///
/// Faces are paired at shared edges. If more than two faces meet at an edge, two that share it by index are paired;
/// other faces are sorted by angle around the edge and adjacent ones are paired (of the two possible pairings, the one
/// with the smaller gaps; of an odd number, only the straightest pair). Pairs by angle that contradict other pairs are
/// dropped. Coincident faces keep their relative winding, so two-sided sheets stay two-sided.
/// Winding is first made consistent within each component; then the first applicable rule of WindingReport decides the
/// component as a whole. An open surface without an inside (such as a terrain) that is entirely inverted and has no
/// normals cannot be detected; it is left unchanged.
///
/// mesh       positions and indices, and normals with options.use_normals; UVs are ignored
/// turned     one per face: 1 to flip it, else 0; must not overlap the inputs
/// execution  threads and memory; does not affect the result
/// Errors: those of validate(); countMismatch (turned), outOfMemory.
/// O(corners), except for sorting the edges of one point, and O(n log n) for nested closed components. Scratch memory:
/// 16 bytes per corner, 32 per face, 28 per vertex, and 50 more per face for nested closed components. Thread-safe;
/// same bits for any thread count.
Result<WindingReport> mendWinding(const MeshView& mesh, const WindingOptions& options, StridedSpan<std::uint8_t> turned,
                                  const Execution& execution = {});

}  // namespace tspace
