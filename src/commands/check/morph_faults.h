// SPDX-License-Identifier: MIT
// Morph targets of a primitive that share a fault, and the one finding about them.
#pragma once

#include <algorithm>
#include <string>
#include <utility>

#include "commands/check/primitive_checks.h"
#include "commands/check/tally.h"

namespace tspace {

/// Offsets that come from a formula or a finer mesh are off in places beside coarse triangles. So a target counts only from
/// this part on of the surface that turns.
inline constexpr double kOffShare = 0.25;

struct MorphFault {
    Tally targets = {};    ///< vertices of the first; count and total in targets
    double far_share = 0;  ///< largest share of the surface that is off by more than error_deg
    std::size_t first = 0;

    /// A target that has it. `far_area`: of vertices that are off by more than error_deg.
    void addTarget(std::size_t number, const Tally& vertices, double far_area, double whole_area) {
        if (targets.count++ == 0) {
            first = number;
            targets.vertices = vertices.vertices;
        }
        targets.worst_deg = std::max(targets.worst_deg, vertices.worst_deg);
        targets.surface_share = std::max(targets.surface_share, vertices.surface_share);
        if (whole_area > 0) far_share = std::max(far_share, far_area / whole_area);
    }

    /// Nothing where no target has the fault. `what`: the sentence without the angle of these vectors ("normals", "tangents").
    void report(PrimitiveFacts& facts, FindingCode code, Severity severity, const std::string& what,
                const char* vectors) const {
        if (targets.count == 0) return;
        facts.add(
            code, severity, targets, "targets",
            what + "; at full weight " + vectors + " are off by up to " + decimalText(targets.worst_deg) + " degrees");
        facts.findings.back().place = facts.primitive.place + "/targets/" + std::to_string(first);
    }
};

}  // namespace tspace
