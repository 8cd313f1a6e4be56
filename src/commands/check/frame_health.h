// SPDX-License-Identifier: MIT
// Whether the tangents of one mesh are good, and why not. No file is known here: `check` makes findings of the result, and
// repair decides by it which tangents to keep.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/check/direction_cones.h"
#include "commands/check/tally.h"
#include "core/mesh/surface/surface.h"
#include "tspace/check.h"

namespace tspace {

/// The bit of a finding in FrameHealth::faults. Only codes below greenFlipped are about vertices.
inline constexpr std::uint32_t faultBit(FindingCode code) { return 1u << static_cast<std::uint32_t>(code); }

/// A further bit: the sign is undecided, in a patch of inverted ones.
inline constexpr std::uint32_t kUndecidedSign = 1u << 31;

/// A further bit: the tangent is nearly parallel to N.
inline constexpr std::uint32_t kParallelTangent = 1u << 30;

/// Lengths of normals and tangents that are further from 1 are wrong, and not rounded.
inline constexpr double kFarFromUnit = 0.1;

struct FrameHealth {
    /// Per vertex the bits of the findings that count it below; empty: there are none. Wrong signs have the bit of
    /// signsWrong, however many there are; where that is nearly all, others of the same patches have kUndecidedSign.
    /// Where nearly all directions are wrong, others of the same patches have the bit of directionsWrong too.
    std::vector<std::uint32_t> faults = {};
    /// Vertices with the tangents that `generate` would give them, which no finding below counts; may be empty.
    std::vector<bool> settled = {};
    float settled_sign = 1;  ///< -1: but for the sign, which is the opposite

    void fault(std::uint32_t vertex, FindingCode code, std::size_t vertex_count) {
        addFaults(vertex, faultBit(code), vertex_count);
    }
    void addFaults(std::uint32_t vertex, std::uint32_t bits, std::size_t vertex_count) {
        if (faults.empty()) faults.resize(vertex_count);
        faults[vertex] |= bits;
    }
    [[nodiscard]] bool isSettled(std::uint32_t vertex) const { return !settled.empty() && settled[vertex]; }

    // Values on their own. Counted: all vertices, and for directions those that triangles use. Flags: of the latter.
    Tally not_finite;             ///< tangent or w
    bool has_not_finite = false;  ///< some
    Tally not_unit;               ///< not unit, but finite
    double far_from_unit = 0;     ///< share of the surface with lengths below 0.9 or above 1.1
    bool has_zero = false;        ///< some have no length at all
    Tally not_orthogonal;         ///< finite, not zero, with a usable N
    Tally parallel;  ///< within 5 degrees of N or its opposite, so that there is no frame; not counted in the others
    /// Their surface is so small that other leaning tangents are a warning of their own: only these have the bit of
    /// tangentsNotOrthogonal.
    bool has_no_frame = false;  ///< some are within 1 degree of N or its opposite
    bool parallel_apart = false;
    Tally sign_not_one;
    bool sign_vanishes = false;  ///< some |w| is below 0.5
    Tally signs_mixed;           ///< triangles that have UV area

    // Against the UVs. All zero where there are none.
    Tally signs_wrong;             ///< vertices whose triangles agree with each other, but not with w
    double wrong_sign_share = 0;   ///< share of the surface whose signs were examined
    bool all_signs_wrong = false;  ///< on nearly all of it
    Tally mirrored_seams;          ///< vertices where mirrored and other triangles share a tangent
    Tally uv_seams;                ///< vertices with the mean tangent of both sides of a UV seam
    Tally directions_wrong;        ///< the other vertices whose tangents are off by more than direction_deg
    double far_directions = 0;     ///< share of the surface where a direction is off by more than error_deg
    Tally frames_differ;  ///< vertices equal to another but for the tangent, which MikkTSpace would give the same
};

/// Looks at tangents that follow mesh.uvs. Without normals or UVs nothing is looked at but values. Triangles without UV
/// area say nothing. What `generate` gives on this very mesh is never wrong.
/// Expected near-linear time. Fails where generateTangents does, which is for lack of memory.
Result<FrameHealth> examineTangents(const TangentView& mesh, const CheckOptions& options);

/// Like the overload above, with a surface of the mesh that the caller has already computed.
Result<FrameHealth> examineTangents(const TangentView& mesh, const Surface& surface, const CheckOptions& options);

}  // namespace tspace
