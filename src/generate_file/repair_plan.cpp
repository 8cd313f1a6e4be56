// SPDX-License-Identifier: MIT
// From the verdict of `check` to what is mended.
#include "generate_file/repair_plan.h"

#include <algorithm>
#include <map>
#include <utility>

#include "asset/file_error.h"
#include "asset/gltf/compute_pools.h"
#include "asset/gltf/read_scene.h"
#include "check/frame_health.h"
#include "check/scene_verdict.h"

namespace tspace::gltf {

namespace {

/// What a finding asks to mend at the vertices that it counts; 0: it is not about tangents.
std::uint8_t partsOf(FindingCode code) {
    switch (code) {
        case FindingCode::tangentsNotFinite:
        case FindingCode::tangentsNotOrthogonal:
        case FindingCode::uvSeamAveraged:
        case FindingCode::directionsWrong:
        case FindingCode::uvSetWrong:
            return mend::kWhole;
        case FindingCode::tangentsNotUnit:
            return mend::kLength;
        case FindingCode::signsNotOne:
            return mend::kSignSize;
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
    std::string why = {};  ///< empty: nothing
};

Verdict verdictOf(const PrimitiveJudgement& judgement) {
    Verdict verdict;
    verdict.mends.inverted_signs = judgement.signs_stay;
    std::vector<std::pair<std::uint32_t, std::uint8_t>> rules;  // bits of faults, and what they ask for
    for (const Finding& finding : judgement.findings) {
        const std::uint8_t parts = partsOf(finding.code);
        if (finding.severity != Severity::error || parts == 0) continue;
        const bool is_inverted = finding.code == FindingCode::signsInverted;
        rules.emplace_back(is_inverted ? faultBit(FindingCode::signsWrong) | kUndecidedSign : faultBit(finding.code),
                           parts);
        // Where signs are turned no seam between them may be left, however short.
        if (is_inverted) rules.emplace_back(faultBit(FindingCode::mirroredSeamAveraged), mend::kSides);
        verdict.why += (verdict.why.empty() ? "" : "; and ") + finding.message;
    }
    if (rules.empty() || !judgement.faults) return {};
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
        if (primitive.uses.empty() && options.all) primitive.uses.push_back({.needed_by = "what was asked for"});
        if (options.texture_transform == TextureTransform::apply) continue;
        for (TangentUse& use : primitive.uses) use.transform = {};
    }
}

/// The verdicts on these primitives. Memory for them is given back at the end.
std::vector<Verdict> judge(const Document& document, std::span<const Primitive> primitives,
                           const GenerateOptions& options) {
    const std::int64_t left = document.memory->left();
    CheckOptions check;
    check.convention = options.tangents.convention;
    check.execution = options.tangents.execution;
    check.execution.allocator = nullptr;
    Scene scene = sceneOf(document, primitives);
    readAsAsked(options, scene);
    std::vector<PrimitiveJudgement> judgements = judgePrimitives(scene, check, true);
    if (waitForImages(judgements)) {
        readImages(document, scene);
        ImageFindings images = checkImages(scene, check);
        weighImages(scene, check, images, judgements);
    }
    std::vector<Verdict> verdicts;
    for (const PrimitiveJudgement& judgement : judgements) verdicts.push_back(verdictOf(judgement));
    document.memory->giveBack(left);
    return verdicts;
}

void keep(PrimitiveReport& report) {
    report.action = PrimitiveAction::kept;
    report.reason = "its tangents are good";
}

/// Whether its tangents, if it has any, have the shape that they must have.
bool isVec4(const Document& document, const Primitive& primitive) {
    const auto tangents = primitive.find("TANGENT");
    return !tangents || readAccessor(document, *tangents).component_count == 4;
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
            result.corner_count += primitives[number].triangleCount() * 3;
        }
    }
    std::sort(result.primitives.begin(), result.primitives.end());
    return result;
}

}  // namespace

void planRepair(const Document& document, std::span<const Primitive> primitives, const GenerateOptions& options,
                GeneratePlan& plan) {
    // Tangents of normals that are made anew are computed anew with them.
    const auto isJudged = [](const Pool& pool) {
        return pool.has_tangents && pool.makes_tangents && !pool.overwrites_normals;
    };
    if (std::none_of(plan.pools.begin(), plan.pools.end(), isJudged)) return;
    // All of them, since normal maps are weighed by what the whole file shows of them.
    std::vector<Primitive> judged;
    std::map<std::size_t, std::size_t> place_of;  // primitive -> number in `judged`
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (!isVec4(document, primitives[i])) continue;
        place_of.emplace(i, judged.size());
        judged.push_back(primitives[i]);
    }
    const std::vector<Verdict> verdicts = judge(document, judged, options);
    std::vector<Pool> pools;
    for (Pool& pool : plan.pools) {
        if (!isJudged(pool)) {
            pools.push_back(std::move(pool));
            continue;
        }
        if (!place_of.contains(pool.primitives[0])) {
            for (const std::size_t number : pool.primitives) {
                plan.reports[number].notes.emplace_back("its tangents were wrong: they do not have 4 components");
            }
            pools.push_back(std::move(pool));
            continue;
        }
        const auto verdictOn = [&](std::size_t number) -> const Verdict& { return verdicts[place_of.at(number)]; };
        static const Mends kNothing;
        Pool wrong = selected(pool, primitives, [&](std::size_t number) {
            const Verdict& verdict = verdictOn(number);
            return verdict.mends.vertices.empty() ? nullptr : &verdict.mends;
        });
        Pool good = selected(pool, primitives, [&](std::size_t number) {
            return verdictOn(number).mends.vertices.empty() ? &kNothing : nullptr;
        });
        for (const std::size_t number : good.primitives) keep(plan.reports[number]);
        for (const std::size_t number : wrong.primitives) {
            PrimitiveReport& report = plan.reports[number];
            report.mended_vertex_count = verdictOn(number).mends.vertices.size();
            report.notes.push_back("its tangents were wrong: " + verdictOn(number).why + "; mended at " +
                                   std::to_string(report.mended_vertex_count) + " of " +
                                   std::to_string(report.vertices_before) + " vertices");
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
