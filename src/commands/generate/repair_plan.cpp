// SPDX-License-Identifier: MIT
// From the verdict of `check` to what is mended.
#include "commands/generate/repair_plan.h"

#include <algorithm>
#include <utility>

#include "commands/check/findings.h"
#include "commands/check/frame_health.h"
#include "commands/check/scene_verdict.h"
#include "core/base/sort.h"
#include "model/gltf/material_needs.h"
#include "model/gltf/read_scene.h"
#include "model/io/file_error.h"

namespace tspace::gltf {

namespace {

/// What a finding asks to mend at the vertices that it counts; 0: it is not about tangents.
std::uint8_t partsOf(FindingCode code) {
    switch (code) {
        case FindingCode::tangentsNotFinite:
        case FindingCode::uvSeamAveraged:
        case FindingCode::directionsWrong:
        case FindingCode::uvSetWrong:
            return mend::kWhole;
        case FindingCode::tangentsNotUnit:
        case FindingCode::signsNotOne:
            return mend::kValues;
        case FindingCode::tangentsNotOrthogonal:
            return mend::kStraighten;
        case FindingCode::signsWrong:
        case FindingCode::signsInverted:
            return mend::kTurnSign;
        case FindingCode::signsMixed:
        case FindingCode::mirroredSeamAveraged:
            return mend::kSides;
        case FindingCode::morphTangentsWrong:
            return mend::kDeltas;
        default:
            return 0;
    }
}

/// What is wrong with one primitive.
struct Verdict {
    Mends mends = {};
    std::string why = {};   ///< empty: nothing
    std::string kept = {};  ///< what was looked at, where nothing is wrong
    bool is_free = false;   ///< no texture is read with its tangents
};

/// Whether vertices are mended that the finding counts. What the format forbids is, however little it matters.
bool asksForMending(const Finding& finding) {
    const std::uint8_t parts = partsOf(finding.code);
    const bool is_of_values = parts == mend::kValues || finding.code == FindingCode::tangentsNotFinite;
    return parts != 0 && (finding.severity == Severity::error || is_of_values);
}

/// Half a sentence about tangents that stay.
std::string whyKept(const PrimitiveJudgement& judgement, bool is_free) {
    constexpr double kNearlyAll = 0.99;
    std::string warnings;
    for (const Finding& finding : judgement.findings) {
        const bool is_of_tangents = partsOf(finding.code) != 0 || finding.code == FindingCode::positionsRounded ||
                                    finding.code == FindingCode::textureTransformIgnored ||
                                    finding.code == FindingCode::splitFramesDiffer;
        if (is_of_tangents) warnings += (warnings.empty() ? "" : "; and ") + finding.message;
    }
    if (is_free) {
        return "its tangents stay: no texture is read with them, so their values alone were looked at" +
               (warnings.empty() ? "" : "; " + warnings);
    }
    if (!warnings.empty()) return "its tangents stay, since nothing in them is surely wrong; but " + warnings;
    if (judgement.compared_share == 0)
        return "its tangents stay: its UVs have no area, so their values alone were looked at";
    if (judgement.compared_share >= kNearlyAll) return "its tangents are good";
    return "nothing wrong was found in its tangents; on " + shareText(1 - judgement.compared_share) +
           " of the surface the UVs have no area, and their values alone were looked at";
}

Verdict verdictOf(const PrimitiveJudgement& judgement, bool is_free) {
    Verdict verdict{.kept = whyKept(judgement, is_free), .is_free = is_free};
    verdict.mends.inverted_signs = judgement.signs_stay;
    std::vector<std::pair<std::uint32_t, std::uint8_t>> rules;  // bits of faults, and what they ask for
    for (const Finding& finding : judgement.findings) {
        if (!asksForMending(finding)) continue;
        const bool is_inverted = finding.code == FindingCode::signsInverted;
        rules.emplace_back(is_inverted ? faultBit(FindingCode::signsWrong) | kUndecidedSign : faultBit(finding.code),
                           partsOf(finding.code));
        // Where signs are turned no seam between them may be left, however short.
        if (is_inverted) rules.emplace_back(faultBit(FindingCode::mirroredSeamAveraged), mend::kSides);
        verdict.why += (verdict.why.empty() ? "" : "; and ") + finding.message;
    }
    // What was drawn is not computed anew: its values are mended on their own.
    if (rules.empty() || !judgement.faults || is_free) return verdict;
    for (const VertexFaults& faults : *judgement.faults) {
        std::uint8_t parts = 0;
        for (const auto& [bits, asked] : rules) parts |= (faults.bits & bits) != 0 ? asked : 0;
        if (parts != 0) verdict.mends.vertices.push_back({faults.vertex, parts});
    }
    return verdict;
}

/// As `generate` was asked to read them.
void readAsAsked(const GenerateOptions& options, Scene& scene) {
    for (ScenePrimitive& primitive : scene.primitives) {
        // As if something read these tangents.
        if (primitive.uses.empty() && options.all) {
            primitive.uses.push_back(
                {.needed_by = "what was asked for", .has_texture = primitive.other_reader.empty()});
        }
        if (options.texture_transform == TextureTransform::apply) continue;
        for (TangentUse& use : primitive.uses) use.transform = {};
    }
}

/// The verdicts on all primitives. Memory for them is given back at the end; the scene stays with the model.
std::vector<Verdict> judge(Model& model, const GenerateOptions& options) {
    const Document& document = model.document();
    Scene scene = model.scene();
    const std::int64_t left = document.memory->left();
    CheckOptions check;
    check.convention = options.tangents.convention;
    check.execution = options.execution;
    check.execution.allocator = nullptr;
    readAsAsked(options, scene);
    std::vector<PrimitiveJudgement> judgements = judgePrimitives(scene, check, true);
    if (waitForImages(judgements)) {
        readImages(document, scene);
        ImageFindings images = checkImages(scene, check);
        weighImages(scene, check, images, judgements);
    }
    std::vector<Verdict> verdicts;
    for (std::size_t i = 0; i < judgements.size(); ++i)
        verdicts.push_back(verdictOf(judgements[i], scene.primitives[i].hasFreeTangents()));
    document.memory->giveBack(left);
    return verdicts;
}

void keep(const Verdict& verdict, PrimitiveReport& report) {
    report.action = PrimitiveAction::kept;
    report.reason = verdict.kept;
    // They were not computed, and may follow the transform or not.
    std::erase_if(report.notes, [](const std::string& note) { return note.rfind(kTransformNote, 0) == 0; });
}

/// It has tangents with normals, and they cannot be computed.
bool hasOnlyItsOwn(const Primitive& primitive, const PrimitiveReport& report) {
    return report.action == PrimitiveAction::impossible && primitive.find("TANGENT") && primitive.find("NORMAL");
}

/// The pool with some of its primitives, in groups that are mended alike. `mendsOf`: null for those to be left out.
template <class MendsOf>
Pool selected(const Pool& pool, std::span<const Primitive> primitives, const MendsOf& mendsOf) {
    Pool result = pool;
    result.geometries.clear();
    result.primitives.clear();
    result.corner_count = 0;
    for (const PoolGeometry& geometry : pool.geometries) {
        const std::size_t first = result.geometries.size();
        for (const std::size_t number : geometry.primitives) {
            const Mends* const mends = mendsOf(number);
            if (mends == nullptr) continue;
            result.primitives.push_back(number);
            const auto same =
                std::find_if(result.geometries.begin() + static_cast<std::ptrdiff_t>(first), result.geometries.end(),
                             [&](const PoolGeometry& other) { return other.mends == *mends; });
            if (same != result.geometries.end()) {
                same->primitives.push_back(number);
                continue;
            }
            result.geometries.push_back({.primitives = {number}, .mends = *mends});
            result.corner_count += std::uint64_t{3} * primitives[number].triangleCount();
        }
    }
    sortList(result.primitives.begin(), result.primitives.end());
    return result;
}

}  // namespace

void planRepair(Model& model, const GenerateOptions& options, GeneratePlan& plan) {
    const std::span<const Primitive> primitives = model.primitives();
    // Tangents of normals that are made anew are computed anew with them.
    const auto isJudged = [](const Pool& pool) {
        return pool.has_tangents && pool.makes_tangents && !pool.overwrites_normals;
    };
    bool is_needed = std::any_of(plan.pools.begin(), plan.pools.end(), isJudged);
    for (std::size_t i = 0; i < primitives.size(); ++i)
        is_needed = is_needed || hasOnlyItsOwn(primitives[i], plan.reports[i]);
    if (!is_needed) return;
    // All of them, since normal maps are weighed by what the whole file shows of them.
    const std::vector<Verdict> verdicts = judge(model, options);
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (verdicts[i].is_free && hasOnlyItsOwn(primitives[i], plan.reports[i])) keep(verdicts[i], plan.reports[i]);
    }
    std::vector<Pool> pools;
    for (Pool& pool : plan.pools) {
        if (!isJudged(pool)) {
            pools.push_back(std::move(pool));
            continue;
        }
        const auto verdictOn = [&](std::size_t number) -> const Verdict& { return verdicts[number]; };
        static const Mends kNothing;
        Pool wrong = selected(pool, primitives, [&](std::size_t number) {
            const Verdict& verdict = verdictOn(number);
            return verdict.mends.vertices.empty() ? nullptr : &verdict.mends;
        });
        Pool good = selected(pool, primitives, [&](std::size_t number) {
            return verdictOn(number).mends.vertices.empty() ? &kNothing : nullptr;
        });
        for (const std::size_t number : good.primitives) keep(verdictOn(number), plan.reports[number]);
        for (const std::size_t number : wrong.primitives) {
            plan.reports[number].notes.push_back(kWrongNote + verdictOn(number).why);
        }
        if (!wrong.primitives.empty()) pools.push_back(std::move(wrong));
        if (!good.primitives.empty() && (lacksDeltas(primitives[good.primitives[0]]) || !good.morph_normals.empty())) {
            good.keeps_tangents = true;
            pools.push_back(std::move(good));
        }
    }
    plan.pools = std::move(pools);
}

}  // namespace tspace::gltf
