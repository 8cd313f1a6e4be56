// SPDX-License-Identifier: MIT
// The one verdict on the tangents of a scene. `check` reports it. Repair acts on its errors, but on none that a normal map
// cancels.
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
    std::uint32_t bits = 0;  ///< faults, as in FrameHealth::faults
};

/// Whether the normal maps of a primitive cancel its wrong signs.
enum class SignVerdict {
    plain,      ///< no: the signs are wrong, if any finding says so
    cancelled,  ///< green points the other way too
    open,       ///< perhaps it does: a map could not be looked at
};

/// Findings on one primitive of a scene.
struct PrimitiveJudgement {
    std::vector<Finding> findings = {};  ///< with place and names
    /// The vertices that findings above count, ascending; null: none, or not asked for.
    std::shared_ptr<const std::vector<VertexFaults>> faults = {};
    double wrong_sign_share = 0;  ///< share of the surface whose signs were examined
    double compared_share = 0;    ///< share of the surface where tangents were compared with UVs
    SignVerdict signs = SignVerdict::plain;
    /// Most signs are inverted and stay so: a normal map whose green points the other way makes that right, or may.
    bool signs_stay = false;

    /// The finding of that code, or null.
    [[nodiscard]] Finding* find(FindingCode code);
    [[nodiscard]] const Finding* find(FindingCode code) const;
};

/// Looks at all primitives but not at their images, each geometry once. In the order of the scene.
/// `with_faults`: they take memory of the scene's budget.
std::vector<PrimitiveJudgement> judgePrimitives(const Scene& scene, const CheckOptions& options,
                                                bool with_faults = false);

/// Whether the verdict on signs waits for what the normal maps say.
bool waitForImages(std::span<const PrimitiveJudgement> judgements);

/// Lowers the severity of wrong signs that a normal map cancels, or may cancel because it could not be looked at; and of maps
/// whose green points down where the signs of all that use them are inverted.
void weighImages(const Scene& scene, const CheckOptions& options, ImageFindings& images,
                 std::span<PrimitiveJudgement> judgements);

/// Whether `generate` can compute tangents that a material of the primitive needs.
bool canCompute(const ScenePrimitive& primitive);

/// Fills in the remedy of each finding for this file: it names a command only where that command mends the finding.
void adviseOn(const Scene& scene, const CheckOptions& options, std::span<PrimitiveJudgement> judgements);

}  // namespace tspace
