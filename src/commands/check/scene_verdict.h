// SPDX-License-Identifier: MIT
// Verdict on the tangents of a scene, shared by check and repair. Repair acts on its errors, except on those that a
// normal map cancels.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "commands/check/scene_checks.h"
#include "model/scene/scene.h"
#include "tspace/check.h"

namespace tspace {

struct VertexFaults {
    std::uint32_t vertex = 0;
    std::uint32_t bits = 0;  ///< fault bits, see FrameHealth::faults (frame_health.h)
};

/// States whether the normal maps of a primitive cancel its wrong signs.
enum class SignVerdict {
    plain,      ///< no: the signs are wrong if a finding reports wrong signs
    cancelled,  ///< yes: green is inverted too
    open,       ///< unknown: a map could not be examined
};

/// Findings on one primitive of a scene.
struct PrimitiveJudgement {
    std::vector<Finding> findings = {};  ///< with location and names
    /// Vertices that the findings count, ascending; null: none, or not requested.
    std::shared_ptr<const std::vector<VertexFaults>> faults = {};
    double wrong_sign_share = 0;  ///< share of the surface with wrong signs, see FrameHealth::wrong_sign_share
    double compared_share = 0;    ///< share of the surface where tangents were compared with UVs
    SignVerdict signs = SignVerdict::plain;
    /// Most signs are inverted and must be kept: a normal map with inverted green makes them correct, or may do so.
    bool signs_stay = false;

    /// Returns the finding with this code, or null.
    [[nodiscard]] Finding* find(FindingCode code);
    [[nodiscard]] const Finding* find(FindingCode code) const;
};

/// Checks all primitives without their images, each geometry once. Results are in the order of the scene.
/// `with_faults`: also returns faults of vertices, which use memory of the scene's budget.
std::vector<PrimitiveJudgement> judgePrimitives(const Scene& scene, const CheckOptions& options,
                                                bool with_faults = false);

/// Returns whether the verdict on signs depends on the normal maps.
bool dependOnImages(std::span<const PrimitiveJudgement> judgements);

/// Lowers the severity of wrong signs that a normal map cancels, or may cancel because it could not be examined. Also
/// lowers the severity of maps whose green points down, if the signs of all primitives that use them are inverted.
void applyImageVerdicts(const Scene& scene, const CheckOptions& options, ImageFindings& images,
                        std::span<PrimitiveJudgement> judgements);

/// Returns whether `generate` can compute tangents that a material of the primitive needs.
bool canCompute(const ScenePrimitive& primitive);

/// Sets the remedy of each finding for this file. A command is named only if it fixes the finding.
void setRemedies(const Scene& scene, const CheckOptions& options, std::span<PrimitiveJudgement> judgements);

}  // namespace tspace
