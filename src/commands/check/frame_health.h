// SPDX-License-Identifier: MIT
// Examines the tangents of one mesh, and finds the causes of wrong ones. Independent of files: `check` converts the
// result to findings, and repair uses it to decide which tangents to keep.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/check/direction_cones.h"
#include "commands/check/tally.h"
#include "core/mesh/surface/surface.h"
#include "tspace/check.h"

namespace tspace {

/// Returns the bit of a finding in FrameHealth::faults. Only codes below greenFlipped concern vertices.
inline constexpr std::uint32_t faultBit(FindingCode code) { return 1u << static_cast<std::uint32_t>(code); }

/// Additional bit for vertices with an undecided sign, in a patch of inverted signs.
inline constexpr std::uint32_t kUndecidedSign = 1u << 31;

/// Additional bit for vertices whose tangent is nearly parallel to N.
inline constexpr std::uint32_t kParallelTangent = 1u << 30;

/// Normals and tangents whose lengths deviate from 1 by more than this are wrong, rather than rounded.
inline constexpr double kFarFromUnit = 0.1;

struct FrameHealth {
    /// Fault bits of each vertex: the bits of the findings that count it; an empty list means no faults. Vertices with
    /// wrong signs have the bit of signsWrong. If nearly all signs are wrong, other vertices of the same patches have
    /// kUndecidedSign. If nearly all directions are wrong, other vertices of the same patches also have the bit of
    /// directionsWrong.
    std::vector<std::uint32_t> faults = {};
    /// Vertices whose tangents equal those that `generate` would compute; no finding below counts them. May be empty.
    std::vector<bool> settled = {};
    float settled_sign = 1;  ///< -1: settled tangents have the opposite sign

    void fault(std::uint32_t vertex, FindingCode code, std::size_t vertex_count) {
        addFaults(vertex, faultBit(code), vertex_count);
    }
    void addFaults(std::uint32_t vertex, std::uint32_t bits, std::size_t vertex_count) {
        if (faults.empty()) faults.resize(vertex_count);
        faults[vertex] |= bits;
    }
    [[nodiscard]] bool isSettled(std::uint32_t vertex) const { return !settled.empty() && settled[vertex]; }

    // Values of single tangents. The flags, `not_orthogonal` and `parallel` concern only vertices that triangles use;
    // the other tallies count all vertices.
    Tally not_finite;             ///< vertices whose tangent has a component that is not finite
    bool has_not_finite = false;  ///< some used vertices have a tangent that is not finite
    Tally not_unit;               ///< vertices whose tangent is finite, but does not have unit length
    double far_from_unit = 0;     ///< share of the surface with lengths below 0.9 or above 1.1
    bool has_zero = false;        ///< some tangents have zero length
    Tally not_orthogonal;         ///< not perpendicular to N, but not `parallel`
    Tally parallel;               ///< within 5 degrees of N or -N, so that there is no frame
    bool has_no_frame = false;    ///< some tangents are within 1 degree of N or -N
    /// Tangents parallel to N are reported separately, as an error, although they cover little of the surface. Only
    /// they have the bit of tangentsNotOrthogonal; other tilted tangents are a warning.
    bool parallel_apart = false;
    Tally sign_not_one;
    bool sign_vanishes = false;  ///< some |w| is below 0.5
    Tally signs_mixed;           ///< triangles with mixed signs; with UVs, only those with UV area

    // Results of the comparison with the UVs; all are zero without UVs.
    Tally signs_wrong;             ///< vertices whose triangles have one orientation, which contradicts w
    double wrong_sign_share = 0;   ///< share of the examined surface with wrong signs
    bool all_signs_wrong = false;  ///< wrong on nearly all of the examined surface
    Tally mirrored_seams;          ///< vertices where mirrored and unmirrored triangles share a tangent
    Tally uv_seams;                ///< vertices with the mean tangent of both sides of a UV seam
    Tally directions_wrong;        ///< other vertices whose tangents are off by more than direction_deg
    double far_directions = 0;     ///< share of the surface where a direction is off by more than error_deg
    /// Vertices that differ from another only in the tangent, although MikkTSpace would give both the same tangent.
    Tally frames_differ;
};

/// Examines tangents that should follow mesh.uvs. Without normals or UVs only values are examined. Triangles without UV
/// area are ignored. Tangents that `generate` would compute on this mesh are never wrong. Expected near-linear time.
/// Fails if generateTangents fails, which happens only if memory runs out.
FrameHealth examineTangents(const TangentView& mesh, const CheckOptions& options);

/// Examines tangents that should follow mesh.uvs, with `surface` that the caller has computed from `mesh`.
FrameHealth examineTangents(const TangentView& mesh, const Surface& surface, const CheckOptions& options);

}  // namespace tspace
