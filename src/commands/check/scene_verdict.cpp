// SPDX-License-Identifier: MIT
// Judges the primitives of a scene, and determines the remedies of their findings.
#include "commands/check/scene_verdict.h"

#include <algorithm>
#include <array>
#include <bit>
#include <initializer_list>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "commands/check/findings.h"
#include "commands/check/primitive_checks.h"
#include "commands/check/remedy.h"
#include "model/io/file_error.h"
#include "model/io/memory_budget.h"

namespace tspace {
namespace {

/// Share of the examined surface from which wrong signs indicate another convention rather than single faults.
constexpr double kSignMajority = 2.0 / 3;

/// Primitives with equal keys have the same findings. Arrays that a file shares have the same address.
class PrimitiveKey {
  public:
    explicit PrimitiveKey(const ScenePrimitive& primitive) {
        words_.push_back(primitive.mode);
        add({primitive.is_unlit, primitive.is_double_sided, primitive.packedAlone() != nullptr,
             primitive.other_reader.empty(), primitive.uv_sets.size(), primitive.tangent_faults.size(),
             primitive.attribute_faults.size(), primitive.morph_targets.size(),
             std::bit_cast<std::uint64_t>(primitive.position_step)});
        arrays_ = {primitive.corners.data(), primitive.positions.data(), primitive.normals.data(),
                   primitive.tangents.data()};
        for (const SharedArray<Vec2>& uvs : primitive.uv_sets) arrays_.push_back(uvs.data());
        for (const SceneTangentFault& fault : primitive.tangent_faults) {
            add({static_cast<std::uint64_t>(fault.target)});
            words_.push_back(fault.why);
        }
        for (const SceneAttributeFault& fault : primitive.attribute_faults) {
            add({static_cast<std::uint64_t>(fault.target)});
            words_.push_back(fault.name);
            words_.push_back(fault.why);
        }
        for (const SceneComponentFault& fault : primitive.component_faults) words_.push_back(fault.name + fault.found);
        for (const SceneMorphTarget& target : primitive.morph_targets)
            arrays_.insert(arrays_.end(), {target.positions.data(), target.normals.data(), target.tangents.data()});
        for (const TangentUse& use : primitive.uses) {
            words_.push_back(use.needed_by);
            // If a primitive has several materials, findings contain the name of the material.
            if (use.material != primitive.uses.front().material)
                add({use.material, primitive.uses.front().material, use.only_in_variant ? 1U : 0U});
            add({use.has_texture, static_cast<std::uint64_t>(use.uv_set),
                 std::bit_cast<std::uint64_t>(use.transform.rotation),
                 std::bit_cast<std::uint64_t>(use.transform.scale[0]),
                 std::bit_cast<std::uint64_t>(use.transform.scale[1])});
        }
    }

    friend bool operator<(const PrimitiveKey& a, const PrimitiveKey& b) {
        return std::tie(a.words_, a.arrays_, a.numbers_) < std::tie(b.words_, b.arrays_, b.numbers_);
    }

  private:
    void add(std::initializer_list<std::uint64_t> numbers) { numbers_.insert(numbers_.end(), numbers); }

    std::vector<std::string> words_ = {};
    std::vector<const void*> arrays_ = {};
    std::vector<std::uint64_t> numbers_ = {};
};

/// Primitives that are checked, and the assignment of their results to all primitives.
struct Work {
    std::vector<std::size_t> primitives = {};  ///< first primitive of each key
    std::vector<std::size_t> result_of = {};   ///< per primitive of the scene: index into `primitives`
};

Work collectWork(const Scene& scene) {
    Work work;
    std::map<PrimitiveKey, std::size_t> known;
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        const auto [entry, is_new] = known.try_emplace(PrimitiveKey(scene.primitives[i]), work.primitives.size());
        if (is_new) work.primitives.push_back(i);
        work.result_of.push_back(entry->second);
    }
    return work;
}

using SharedFaults = std::shared_ptr<const std::vector<VertexFaults>>;

/// Result of checking one geometry.
struct Judged {
    std::vector<Finding> findings = {};
    SharedFaults faults = {};
    double wrong_sign_share = 0, compared_share = 0;
};

SharedFaults keptFaults(const std::vector<std::uint32_t>& faults, const ScenePrimitive& primitive,
                        MemoryBudget* memory) {
    const auto count = static_cast<std::size_t>(
        std::count_if(faults.begin(), faults.end(), [](std::uint32_t bits) { return bits != 0; }));
    if (count == 0) return nullptr;
    if (memory != nullptr) memory->take(count * sizeof(VertexFaults), primitive.place);
    std::vector<VertexFaults> kept;
    kept.reserve(count);
    for (std::uint32_t v = 0; v < faults.size(); ++v) {
        if (faults[v] != 0) kept.push_back({v, faults[v]});
    }
    return std::make_shared<const std::vector<VertexFaults>>(std::move(kept));
}

std::vector<Judged> judgeAll(const Scene& scene, const Work& work, const CheckOptions& options, bool with_faults) {
    std::vector<Judged> results(work.primitives.size());
    const bool is_gltf = scene.format == "glb" || scene.format == "gltf";
    const auto primitiveAt = [&](std::size_t i) -> const ScenePrimitive& {
        return scene.primitives[work.primitives[i]];
    };
    const auto bytesOf = [&](std::size_t i) {
        const ScenePrimitive& primitive = primitiveAt(i);
        return checkBytes(primitive.corners.size(), primitive.positions.size(), !primitive.tangents.empty());
    };
    Parallel parallel(options.execution);
    const bool is_alone = parallel.width() == 1;
    const auto reportProgress = [&](std::size_t done) {
        if (options.progress) options.progress("checking", done, results.size());
    };
    reportProgress(0);
    workTogether(scene.memory.get(), results.size(), parallel, bytesOf, [&](std::size_t i) {
        if (is_alone && i != 0) reportProgress(i);
        PrimitiveVerdict verdict = judgePrimitive(primitiveAt(i), options, is_gltf, scene.primitives);
        results[i].findings = std::move(verdict.findings);
        results[i].wrong_sign_share = verdict.wrong_sign_share;
        results[i].compared_share = verdict.compared_share;
        if (with_faults) results[i].faults = keptFaults(verdict.faults, primitiveAt(i), scene.memory.get());
    });
    reportProgress(results.size());
    return results;
}

/// Converts a finding of the first primitive with this key to a finding of `primitive`.
Finding placed(Finding finding, const ScenePrimitive& primitive, const ScenePrimitive& checked) {
    std::string place = finding.place;
    if (place.empty()) {
        place = primitive.place;
    } else if (place.starts_with(checked.place)) {
        place = primitive.place + place.substr(checked.place.size());
    }
    placeAt(primitive, place, finding);
    return finding;
}

/// Returns the name of the preset that equals the convention; the first one if several are equal.
std::string nameOf(const Convention& convention) {
    for (const char* name : {"opengl", "directx", "unreal", "unity"}) {
        if (*findConvention(name) == convention) return name;
    }
    return "opengl";  // not a preset, but with the same signs as opengl
}

/// Returns whether a command computes tangents, either all or only wrong ones, as its first option specifies.
bool makesTangents(const RemedyCommand& command) {
    if (command.verb != "generate" || command.options.empty()) return false;
    const std::string& name = command.options.front().name;
    return name == "repair" || name == "overwrite";
}

/// Adds the convention to the commands of a remedy: if the check used another convention than the format's, tangents
/// must be computed for it.
void addConvention(const CheckOptions& options, Finding& finding) {
    if (signFactor(options.convention) == signFactor(conventions::gltf)) return;
    static constexpr std::array kComputing{"repair", "overwrite", "overwrite-normals", "fix-winding", "morph-normals"};
    for (RemedyCommand& command : finding.commands) {
        std::vector<RemedyOption>& list = command.options;
        const auto first = std::find_if(list.begin(), list.end(), [](const RemedyOption& option) {
            return std::find(kComputing.begin(), kComputing.end(), option.name) != kComputing.end();
        });
        // Without options, generate computes missing tangents.
        if (command.verb != "generate" || (first == list.end() && !list.empty())) continue;
        list.insert(first == list.end() ? first : first + 1, RemedyOption{"convention", nameOf(options.convention)});
    }
}

/// Sets the option by which commands compute tangents: "repair" or "overwrite".
void setCommandOption(Finding& finding, const char* name, bool flips_green = false) {
    for (RemedyCommand& command : finding.commands) {
        if (!makesTangents(command)) continue;
        command.options.front().name = name;
        if (flips_green) command.options.insert(command.options.begin() + 1, RemedyOption{"flip-green", {}});
    }
}

// Remedies for wrong signs if green points down.

/// Returns the remedy if inverted signs and inverted green cancel out.
Remedy bothOrNeither() {
    return {"No action is needed: the two inversions cancel out. Correct both or neither. To correct both: {}.",
            {toCommand("generate --overwrite --flip-green")}};
}

/// Remedy if the requested convention has green pointing down: both the maps and the signs are then correct.
constexpr const char* kNothingToDo =
    "No action is needed with this convention; readers that follow glTF expect green to point up.";

/// Returns the remedy if the signs of some meshes, but not of all, were computed for green pointing down.
Remedy signsFirst() {
    return {"Correct the green channel and the inverted signs together: {}.",
            {toCommand("generate --overwrite --flip-green")}};
}

/// States whether the normal maps of a primitive cancel inverted signs: no, unknown, yes.
enum class MapEffect { nothing, open, cancel };

class Maps {
  public:
    Maps(const ImageFindings& images, const CheckOptions& options)
        : images_(images), other_way_(options.convention.green == Green::down ? GreenSide::up : GreenSide::down),
          any_cancels_(std::count(images.image_green.begin(), images.image_green.end(), other_way_) != 0),
          is_requested_(signFactor(options.convention) != signFactor(conventions::gltf)) {}

    /// Returns whether the normal maps of a primitive cancel its inverted signs. `number`: index of the primitive in
    /// the scene.
    [[nodiscard]] MapEffect effectOn(const ScenePrimitive& primitive, std::size_t number) const {
        MapEffect result = MapEffect::nothing;
        for (const TangentUse& use : primitive.uses) {
            if (!use.image || use.needed_by == "anisotropy") continue;
            const bool is_first = &use == &primitive.uses.front();
            const GreenSide green =
                is_first ? at(images_.primitive_green, number) : at(images_.image_green, *use.image);
            if (green == other_way_) return MapEffect::cancel;
            // A map whose direction is unknown is treated like the other maps of the file. A convention other than the
            // format's is requested by the user and defines the correct signs, also for maps that cannot be read.
            const bool is_open = (green == GreenSide::unread && !is_requested_) || green == GreenSide::mixed ||
                                 (green == GreenSide::unknown && any_cancels_);
            if (is_open) result = MapEffect::open;
        }
        return result;
    }

  private:
    /// Returns `unread` if images were not examined.
    static GreenSide at(const std::vector<GreenSide>& sides, std::size_t i) {
        return i < sides.size() ? sides[i] : GreenSide::unread;
    }

    const ImageFindings& images_;
    GreenSide other_way_;
    bool any_cancels_;
    bool is_requested_;
};

void soften(Finding& finding, const std::string& why) {
    finding.severity = std::min(finding.severity, Severity::warning);
    extendCause(finding, why);
}

void lowerSigns(PrimitiveJudgement& judgement, MapEffect maps) {
    if (maps == MapEffect::nothing) return;
    Finding* inverted = judgement.find(FindingCode::signsInverted);
    Finding* wrong = judgement.find(FindingCode::signsWrong);
    if (inverted == nullptr && wrong == nullptr) return;
    const bool most = judgement.wrong_sign_share >= kSignMajority;
    judgement.signs = maps == MapEffect::cancel ? SignVerdict::cancelled
                      : most                    ? SignVerdict::open
                                                : SignVerdict::plain;
    judgement.signs_stay = most;
    if (inverted != nullptr) {
        soften(
            *inverted,
            maps == MapEffect::cancel
                ? "; but green points down in its normal map too, so the two inversions cancel out"
                : "; but it is unknown whether green also points down in its normal map, which would cancel this out");
        return;
    }
    if (maps == MapEffect::cancel) {
        soften(*wrong, "; but green points down in its normal map too, so the inverted signs render correctly");
    } else if (most) {
        soften(*wrong,
               "; but it is unknown whether green also points down in its normal map, in which case they would render "
               "correctly");
    }
}

}  // namespace

Finding* PrimitiveJudgement::find(FindingCode code) { return const_cast<Finding*>(std::as_const(*this).find(code)); }

const Finding* PrimitiveJudgement::find(FindingCode code) const {
    const auto found =
        std::find_if(findings.begin(), findings.end(), [&](const Finding& finding) { return finding.code == code; });
    return found == findings.end() ? nullptr : &*found;
}

std::vector<PrimitiveJudgement> judgePrimitives(const Scene& scene, const CheckOptions& options, bool with_faults) {
    const Work work = collectWork(scene);
    const std::vector<Judged> results = judgeAll(scene, work, options, with_faults);
    std::vector<PrimitiveJudgement> judgements(scene.primitives.size());
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        const std::size_t number = work.result_of[i];
        const ScenePrimitive& checked = scene.primitives[work.primitives[number]];
        for (const Finding& finding : results[number].findings)
            judgements[i].findings.push_back(placed(finding, scene.primitives[i], checked));
        judgements[i].faults = results[number].faults;
        judgements[i].wrong_sign_share = results[number].wrong_sign_share;
        judgements[i].compared_share = results[number].compared_share;
    }
    return judgements;
}

bool dependOnImages(std::span<const PrimitiveJudgement> judgements) {
    return std::any_of(judgements.begin(), judgements.end(), [](const PrimitiveJudgement& judgement) {
        return judgement.find(FindingCode::signsInverted) != nullptr ||
               judgement.find(FindingCode::signsWrong) != nullptr;
    });
}

void applyImageVerdicts(const Scene& scene, const CheckOptions& options, ImageFindings& images,
                        std::span<PrimitiveJudgement> judgements) {
    const Maps maps(images, options);
    std::vector<bool> is_needed(scene.images.size(), false);  // images used by a primitive whose signs are correct
    std::vector<bool> is_cancelled(scene.images.size(), false);
    for (std::size_t i = 0; i < judgements.size(); ++i) {
        const bool is_inverted = judgements[i].find(FindingCode::signsInverted) != nullptr;
        for (const TangentUse& use : scene.primitives[i].uses) {
            if (use.image && !is_inverted) is_needed[*use.image] = true;
        }
        for (const TangentUse& use : scene.primitives[i].unknown_maps) {
            if (use.image) is_needed[*use.image] = true;  // its tangents may be others
        }
        lowerSigns(judgements[i], maps.effectOn(scene.primitives[i], i));
        for (const TangentUse& use : scene.primitives[i].uses) {
            if (use.image && judgements[i].signs != SignVerdict::plain) is_cancelled[*use.image] = true;
        }
    }
    for (std::size_t i = 0; i < images.findings.size(); ++i) {
        Finding& finding = images.findings[i];
        if (finding.code != FindingCode::greenFlipped) continue;
        if (options.convention.green == Green::down) {
            finding.severity = Severity::note;
            extendCause(finding, "; the requested convention expects this");
            setRemedy(finding, kNothingToDo);
            continue;
        }
        if (is_cancelled[images.images[i]]) setRemedy(finding, signsFirst());
        if (!is_needed[images.images[i]]) {
            finding.severity = Severity::note;
            extendCause(finding,
                        "; but the tangent signs of its meshes are inverted too, so the two inversions cancel out");
            setRemedy(finding, bothOrNeither());
        }
        addConvention(options, finding);
    }
}

// Chooses the remedies of findings for their file. A command is named only if running it fixes the finding.

namespace {

constexpr const char* kUnwrapFirst =
    "Add the UV set that the texture uses to the mesh; no tangent can be computed without it.";
constexpr const char* kNoUvsToFollow =
    "Add UVs to the mesh, because tangents are computed from UVs; or export the tangents from the program that made "
    "the model.";
constexpr const char* kOtherTool =
    "Recompute the tangents with the program that made them. If tspace recomputed all tangents of the file, it would "
    "invert signs that its normal maps may rely on.";
constexpr const char* kBothByHand =
    "No action is needed: the two inversions cancel out. Correct both or neither: negate every w, and invert the green "
    "channel of the normal map.";
constexpr const char* kExamineTheMap =
    "Examine the normal map. If green points up in it, negate every w. If green points down, either negate every w and "
    "invert the green channel, or change neither. If the high poly is available, {} measures which is correct.";

constexpr const char* kOnlyForItsReaders =
    "No action is needed for programs that read the packed frames. For other programs, use the model from which the "
    "frames were packed.";
constexpr const char* kAlsoForOthers =
    "No action is needed for programs that read the packed frames. For other programs, compute tangents too: {}.";

constexpr const char* kAuthoredTangents =
    "Repair the tangents with the program that made them. No texture uses them, so tspace cannot determine their "
    "correct direction.";

/// Returns whether computing the tangents again fixes the finding.
bool concernsTangents(FindingCode code) {
    return (code >= FindingCode::tangentsNotFinite && code <= FindingCode::morphTangentsWrong);
}

/// Returns whether the finding concerns values that the format forbids. These are fixed without regard to UVs, even at
/// a single vertex.
bool concernsValues(FindingCode code) {
    return code == FindingCode::tangentsNotFinite || code == FindingCode::tangentsNotUnit ||
           code == FindingCode::signsNotOne;
}

class Advice {
  public:
    /// Prepares the remedies for a scene. `signs`: verdicts of all primitives.
    Advice(const CheckOptions& options, const std::set<SignVerdict>& signs)
        : options_(options), inverts_green_(options.convention.green == Green::up),
          any_cancelled_(signs.contains(SignVerdict::cancelled)), any_open_(signs.contains(SignVerdict::open)) {}

    void give(const ScenePrimitive& primitive, const PrimitiveJudgement& judgement, Finding& finding) const {
        const bool can_compute = canCompute(primitive);
        if (finding.code == FindingCode::tangentsMissing && primitive.packedAlone() != nullptr) {
            setRemedy(finding, primitive.normals.empty() || !can_compute
                                   ? Remedy{kOnlyForItsReaders}
                                   : Remedy{kAlsoForOthers, {toCommand("generate --overwrite")}});
            return addConvention(options_, finding);
        }
        if (finding.code == FindingCode::tangentsMissing || finding.code == FindingCode::tangentsIgnored) {
            if (!can_compute) setRemedy(finding, primitive.uvsDetermineDirection() ? kUnwrapFirst : kNoUvsToFollow);
            return addConvention(options_, finding);
        }
        if (!concernsTangents(finding.code)) return addConvention(options_, finding);
        const bool concerns_signs =
            finding.code == FindingCode::signsInverted || finding.code == FindingCode::signsWrong;
        const bool is_error = finding.severity == Severity::error;
        if (concernsValues(finding.code) || (finding.code == FindingCode::tangentsNotOrthogonal && is_error)) {
            // The usual remedy repairs forbidden values, regardless of UVs and signs.
        } else if (primitive.mayHaveAuthoredTangents()) {
            setRemedy(finding, kAuthoredTangents);
        } else if (!can_compute) {
            setRemedy(finding, kUnwrapFirst);
        } else if (concerns_signs && judgement.signs != SignVerdict::plain) {
            setRemedy(finding, judgement.signs == SignVerdict::open
                                   ? Remedy{kExamineTheMap, {toCommand("map-error MAP MODEL --high HIGH")}}
                               : inverts_green_ ? bothOrNeither()
                                                : Remedy{kBothByHand});
        } else if (is_error) {
            setCommandOption(finding, "repair");
        } else if (any_open_ || (any_cancelled_ && !inverts_green_)) {
            setRemedy(finding, kOtherTool);
        } else {
            setCommandOption(finding, "overwrite", any_cancelled_);
        }
        addConvention(options_, finding);
    }

  private:
    const CheckOptions& options_;
    bool inverts_green_;  ///< generate can invert green that points down, but not green that points up
    bool any_cancelled_, any_open_;
};

}  // namespace

bool canCompute(const ScenePrimitive& primitive) {
    return !primitive.corners.empty() && !primitive.uses.empty() &&
           !plainReading(primitive, primitive.uses.front().uv_set).uvs.empty();
}

void setRemedies(const Scene& scene, const CheckOptions& options, std::span<PrimitiveJudgement> judgements) {
    std::set<SignVerdict> signs;
    for (const PrimitiveJudgement& judgement : judgements) signs.insert(judgement.signs);
    const Advice advice(options, signs);
    for (std::size_t i = 0; i < judgements.size(); ++i) {
        for (Finding& finding : judgements[i].findings) advice.give(scene.primitives[i], judgements[i], finding);
    }
}

}  // namespace tspace
