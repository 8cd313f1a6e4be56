// SPDX-License-Identifier: MIT
// What to do about a finding, in the file where it is. A command stands there only where running it mends the finding.
#include <algorithm>
#include <string_view>

#include "commands/check/findings.h"
#include "commands/check/primitive_checks.h"
#include "commands/check/scene_verdict.h"

namespace tspace {

namespace {

constexpr const char* kUnwrapFirst =
    "Give the mesh the UVs that the texture is read with; without them no tangent can be computed.";
constexpr const char* kNoUvsToFollow =
    "Give the mesh UVs for the tangents to follow, or export the tangents that are meant.";
constexpr const char* kOtherTool =
    "Compute them anew with the tool that made them. Doing it here for the whole file would turn signs round that the "
    "normal maps of this file may want as they are.";
constexpr const char* kLookAtTheMap =
    "Look at the normal map. If its green points up, negate every w. If it points down, do both or neither: negate "
    "every w and invert the green channel, or leave both as they are. Where the high poly is at hand, tspace map-error "
    "MAP MODEL --high HIGH says which, in degrees.";

constexpr const char* kOnlyForItsReaders =
    "Nothing needs to be done for programs that read the packed frames. For others take the model that they were "
    "packed from.";
constexpr const char* kAlsoForOthers =
    "Nothing needs to be done for programs that read the packed frames. For others compute tangents too: tspace "
    "generate --overwrite.";

constexpr const char* kDrawnTangents =
    "Mend it with the tool that made the tangents. No texture is read with them, so nothing here says where they must "
    "point.";

constexpr std::string_view kRepairOption = "--repair", kOverwriteOption = "--overwrite";

/// Findings that computing the tangents anew mends.
bool isOfTangents(FindingCode code) {
    return (code >= FindingCode::tangentsNotFinite && code <= FindingCode::morphTangentsWrong);
}

/// Findings of values that the format forbids. They are mended without a look at UVs, however few vertices have them.
bool isOfValues(FindingCode code) {
    return code == FindingCode::tangentsNotFinite || code == FindingCode::tangentsNotUnit ||
           code == FindingCode::signsNotOne;
}

/// The preset that a convention is; of two that are equal the first.
std::string nameOf(const Convention& convention) {
    for (const char* name : {"opengl", "directx", "unreal", "unity"}) {
        if (*findConvention(name) == convention) return name;
    }
    return "opengl";  // it has the same signs
}

void replaceAll(std::string& text, std::string_view old, const std::string& with) {
    for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + with.size())) {
        text.replace(at, old.size(), with);
    }
}

class Advice {
  public:
    Advice(const CheckOptions& options, bool signs_stay_somewhere)
        : signs_stay_somewhere_(signs_stay_somewhere),
          convention_(signFactor(options.convention) == signFactor(conventions::gltf)
                          ? ""
                          : " --convention " + nameOf(options.convention)) {}

    void give(const ScenePrimitive& primitive, const PrimitiveJudgement& judgement, Finding& finding) const {
        const bool can_compute = canCompute(primitive);
        if (finding.code == FindingCode::tangentsMissing && primitive.packedAlone() != nullptr) {
            finding.remedy = primitive.normals.empty() || !can_compute ? kOnlyForItsReaders : kAlsoForOthers;
            return addConvention(finding);
        }
        if (finding.code == FindingCode::tangentsMissing || finding.code == FindingCode::tangentsIgnored) {
            if (!can_compute) finding.remedy = primitive.uvsDecide() ? kUnwrapFirst : kNoUvsToFollow;
            return addConvention(finding);
        }
        if (!isOfTangents(finding.code)) return;
        const bool is_of_signs = finding.code == FindingCode::signsInverted || finding.code == FindingCode::signsWrong;
        const bool is_error = finding.severity == Severity::error;
        if (isOfValues(finding.code) || (finding.code == FindingCode::tangentsNotOrthogonal && is_error)) {
            // As the remedy says.
        } else if (primitive.hasFreeTangents()) {
            finding.remedy = kDrawnTangents;
        } else if (!can_compute) {
            finding.remedy = kUnwrapFirst;
        } else if (is_of_signs && judgement.signs != SignVerdict::plain) {
            finding.remedy = judgement.signs == SignVerdict::cancelled ? kBothOrNeither : kLookAtTheMap;
        } else if (is_error) {
            replaceAll(finding.remedy, kOverwriteOption, std::string(kRepairOption));
        } else if (signs_stay_somewhere_) {
            finding.remedy = kOtherTool;
        } else {
            replaceAll(finding.remedy, kRepairOption, std::string(kOverwriteOption));
        }
        addConvention(finding);
    }

  private:
    /// Who checks by another convention has to compute by it.
    void addConvention(Finding& finding) const {
        if (convention_.empty()) return;
        for (const std::string_view command :
             {std::string_view("tspace generate --repair"), std::string_view("tspace generate --overwrite")}) {
            replaceAll(finding.remedy, command, std::string(command) + convention_);
        }
    }

    bool signs_stay_somewhere_;
    std::string convention_;
};

}  // namespace

bool canCompute(const ScenePrimitive& primitive) {
    return !primitive.corners.empty() && !primitive.uses.empty() &&
           !plainReading(primitive, primitive.uses.front().uv_set).uvs.empty();
}

void adviseOn(const Scene& scene, const CheckOptions& options, std::span<PrimitiveJudgement> judgements) {
    const bool signs_stay_somewhere =
        std::any_of(judgements.begin(), judgements.end(),
                    [](const PrimitiveJudgement& judgement) { return judgement.signs != SignVerdict::plain; });
    const Advice advice(options, signs_stay_somewhere);
    for (std::size_t i = 0; i < judgements.size(); ++i) {
        for (Finding& finding : judgements[i].findings) advice.give(scene.primitives[i], judgements[i], finding);
    }
}

}  // namespace tspace
