// SPDX-License-Identifier: MIT
// Existing tangents of a file: decides which of them a repair keeps, whether a normal map compensates for their signs,
// and repairs invalid values.
#include <algorithm>
#include <cstring>
#include <map>
#include <utility>

#include "commands/check/findings.h"
#include "commands/check/frame_health.h"
#include "commands/check/scene_verdict.h"
#include "commands/generate/edit_attributes.h"
#include "commands/generate/generate_steps.h"
#include "commands/shared/uv_reading.h"
#include "core/base/sort.h"
#include "core/mesh/pools/primitive.h"
#include "core/mesh/pools/unit_lattice.h"
#include "core/mesh/surface/surface.h"
#include "model/gltf/editor.h"
#include "model/gltf/material_needs.h"
#include "model/gltf/packed_layout.h"
#include "model/gltf/read_scene.h"
#include "model/io/file_error.h"

namespace tspace::gltf {

// Derives the repairs from the findings of `check`.

namespace {

/// Returns the parts of the tangent to repair at the vertices of a finding, or 0 if it is not about tangents.
std::uint8_t partsOf(FindingCode code) {
    switch (code) {
        case FindingCode::tangentsNotFinite:
        case FindingCode::uvSeamAveraged:
        case FindingCode::directionsWrong:
        case FindingCode::uvSetWrong: return repair::kWhole;
        case FindingCode::tangentsNotUnit:
        case FindingCode::signsNotOne: return repair::kValues;
        case FindingCode::tangentsNotOrthogonal: return repair::kStraighten;
        case FindingCode::signsWrong:
        case FindingCode::signsInverted: return repair::kTurnSign;
        case FindingCode::signsMixed:
        case FindingCode::mirroredSeamAveraged: return repair::kSides;
        case FindingCode::morphTangentsWrong: return repair::kDeltas;
        default: return 0;
    }
}

/// Faults of one primitive.
struct Verdict {
    Repairs repairs = {};
    std::string why = {};   ///< description of the faults; empty if there are none
    std::string kept = {};  ///< description of the checks, for primitives without a fault
    bool is_free = false;   ///< no texture uses the tangents
};

/// Returns whether the vertices that the finding counts are repaired. Values that the format forbids are always
/// repaired, whatever the severity.
bool needsRepair(const Finding& finding) {
    const std::uint8_t parts = partsOf(finding.code);
    const bool is_of_values = parts == repair::kValues || finding.code == FindingCode::tangentsNotFinite;
    return parts != 0 && (finding.severity == Severity::error || is_of_values);
}

/// Returns a clause about tangents that are kept.
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
        return "its tangents are kept: no texture uses them, so only their values were checked" +
               (warnings.empty() ? "" : "; " + warnings);
    }
    if (!warnings.empty()) return "its tangents are kept, because none of the faults is certain; but " + warnings;
    if (judgement.compared_share == 0)
        return "its tangents are kept: its UVs have no area, so only their values were checked";
    if (judgement.compared_share >= kNearlyAll) return "its tangents are correct";
    return "no fault was found in its tangents; on " + shareText(1 - judgement.compared_share) +
           " of the surface the UVs have no area, so only the tangent values were checked";
}

Verdict verdictOf(const PrimitiveJudgement& judgement, bool is_free) {
    Verdict verdict{.kept = whyKept(judgement, is_free), .is_free = is_free};
    verdict.repairs.inverted_signs = judgement.signs_stay;
    std::vector<std::pair<std::uint32_t, std::uint8_t>> rules;  // fault bits, and the parts of the tangent to repair
    for (const Finding& finding : judgement.findings) {
        if (!needsRepair(finding)) continue;
        const bool is_inverted = finding.code == FindingCode::signsInverted;
        rules.emplace_back(is_inverted ? faultBit(FindingCode::signsWrong) | kUndecidedSign : faultBit(finding.code),
                           partsOf(finding.code));
        // If signs are flipped, seams at which mirrored and unmirrored triangles share a tangent are repaired too,
        // however short they are.
        if (is_inverted) rules.emplace_back(faultBit(FindingCode::mirroredSeamAveraged), repair::kSides);
        verdict.why += (verdict.why.empty() ? "" : "; and ") + finding.message;
    }
    // Authored tangents are not recomputed: only their invalid values are repaired.
    if (rules.empty() || !judgement.faults || is_free) return verdict;
    for (const VertexFaults& faults : *judgement.faults) {
        std::uint8_t parts = 0;
        for (const auto& [bits, asked] : rules) parts |= (faults.bits & bits) != 0 ? asked : 0;
        if (parts != 0) verdict.repairs.vertices.push_back({faults.vertex, parts});
    }
    return verdict;
}

/// Adapts the texture uses of the scene to the options.
void applyReadingOptions(const GenerateOptions& options, Scene& scene) {
    for (ScenePrimitive& primitive : scene.primitives) {
        // With the option 'all', tangents are judged as if a texture used them.
        if (primitive.uses.empty() && options.selection.all)
            primitive.uses.push_back({.needed_by = "the option 'all'", .has_texture = primitive.other_reader.empty()});
        if (options.tangents.texture_transform == TextureTransform::apply) continue;
        for (TangentUse& use : primitive.uses) use.transform = {};
    }
}

/// Judges all primitives. The memory for this is returned to the budget at the end, but the model keeps its scene.
std::vector<Verdict> judge(Model& model, const GenerateOptions& options) {
    const Document& document = model.document();
    Scene scene = model.scene();
    const std::int64_t left = document.memory->left();
    CheckOptions check;
    check.convention = options.tangents.compute.convention;
    check.execution = options.execution;
    check.execution.allocator = nullptr;
    applyReadingOptions(options, scene);
    std::vector<PrimitiveJudgement> judgements = judgePrimitives(scene, check, true);
    if (dependOnImages(judgements)) {
        ImageFindings images;
        if (options.maps.read) {
            readImages(document, scene);
            images = checkImages(scene, check);
        }
        applyImageVerdicts(scene, check, images, judgements);
    }
    std::vector<Verdict> verdicts;
    for (std::size_t i = 0; i < judgements.size(); ++i)
        verdicts.push_back(verdictOf(judgements[i], scene.primitives[i].mayHaveAuthoredTangents()));
    document.memory->restore(left);
    return verdicts;
}

void keep(const Verdict& verdict, PrimitiveReport& report) {
    report.action = PrimitiveAction::kept;
    report.reason = verdict.kept;
    // The note states which UVs computed tangents follow; for kept tangents this is unknown.
    std::erase_if(report.notes, [](const std::string& note) { return note.rfind(kTransformNote, 0) == 0; });
}

/// Returns whether the primitive has tangents with normals, but they cannot be recomputed.
bool hasIrreplaceableTangents(const Primitive& primitive, const PrimitiveReport& report) {
    return report.action == PrimitiveAction::impossible && primitive.find("TANGENT") && primitive.find("NORMAL");
}

/// Returns the pool with some of its primitives, grouped by equal repairs. `repairsOf`: returns the repairs of a
/// primitive, or null to omit the primitive.
template <class RepairsOf>
PoolPlan selected(const PoolPlan& pool, std::span<const Primitive> primitives, const RepairsOf& repairsOf) {
    PoolPlan result = pool;
    result.geometries.clear();
    result.primitives.clear();
    result.corner_count = 0;
    for (const GeometryPlan& geometry : pool.geometries) {
        const std::size_t first = result.geometries.size();
        for (const std::size_t number : geometry.primitives) {
            const Repairs* const repairs = repairsOf(number);
            if (repairs == nullptr) continue;
            result.primitives.push_back(number);
            const auto same =
                std::find_if(result.geometries.begin() + static_cast<std::ptrdiff_t>(first), result.geometries.end(),
                             [&](const GeometryPlan& other) { return other.repairs == *repairs; });
            if (same != result.geometries.end()) {
                same->primitives.push_back(number);
                continue;
            }
            result.geometries.push_back({.primitives = {number}, .repairs = *repairs});
            result.corner_count += std::uint64_t{3} * primitives[number].triangleCount();
        }
    }
    sortList(result.primitives.begin(), result.primitives.end());
    return result;
}

}  // namespace

void planRepair(Model& model, const GenerateOptions& options, GeneratePlan& plan) {
    const std::span<const Primitive> primitives = model.primitives();
    // If normals are recomputed, their tangents are recomputed too, so they are not judged.
    const auto isJudged = [](const PoolPlan& pool) {
        return pool.has_tangents && pool.makes_tangents && !pool.overwrites_normals;
    };
    bool is_needed = std::any_of(plan.pools.begin(), plan.pools.end(), isJudged);
    for (std::size_t i = 0; i < primitives.size(); ++i)
        is_needed = is_needed || hasIrreplaceableTangents(primitives[i], plan.reports[i]);
    if (!is_needed) return;
    // Judges all primitives, because the verdict on a normal map depends on all primitives of the file.
    const std::vector<Verdict> verdicts = judge(model, options);
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (verdicts[i].is_free && hasIrreplaceableTangents(primitives[i], plan.reports[i]))
            keep(verdicts[i], plan.reports[i]);
    }
    std::vector<PoolPlan> pools;
    for (PoolPlan& pool : plan.pools) {
        if (!isJudged(pool)) {
            pools.push_back(std::move(pool));
            continue;
        }
        const auto verdictOn = [&](std::size_t number) -> const Verdict& { return verdicts[number]; };
        static const Repairs kNothing;
        PoolPlan wrong = selected(pool, primitives, [&](std::size_t number) {
            const Verdict& verdict = verdictOn(number);
            return verdict.repairs.vertices.empty() ? nullptr : &verdict.repairs;
        });
        PoolPlan good = selected(pool, primitives, [&](std::size_t number) {
            return verdictOn(number).repairs.vertices.empty() ? &kNothing : nullptr;
        });
        for (const std::size_t number : good.primitives) keep(verdictOn(number), plan.reports[number]);
        for (const std::size_t number : wrong.primitives)
            plan.reports[number].notes.push_back(kWrongNote + verdictOn(number).why);
        if (!wrong.primitives.empty()) pools.push_back(std::move(wrong));
        if (!good.primitives.empty() && (lacksDeltas(primitives[good.primitives[0]]) || !good.morph_normals.empty())) {
            good.keeps_tangents = true;
            pools.push_back(std::move(good));
        }
    }
    plan.pools = std::move(pools);
}

namespace {

/// Returns whether most signs are the opposite of what the UVs require, based on a sample of triangles.
bool seemInverted(const ScenePrimitive& primitive, const Convention& convention) {
    constexpr std::size_t kTriangles = 1024;
    if (primitive.tangents.empty() || primitive.uses.empty()) return false;
    const UvReading reading = readingOf(primitive, primitive.uses.front());
    if (reading.uvs.empty()) return false;
    const std::size_t count = primitive.corners.size() / 3, step = count / kTriangles + 1;
    std::int64_t inverted = 0;
    for (std::size_t t = 0; t < count; t += step) {
        std::array<Vec3, 3> positions;
        std::array<Vec2, 3> uvs;
        for (std::size_t k = 0; k < 3; ++k) {
            positions[k] = primitive.positions[primitive.corners[3 * t + k]];
            uvs[k] = reading.uvs[primitive.corners[3 * t + k]];
        }
        const auto expected = static_cast<float>(describeFace(positions, &uvs).orientation) * signFactor(convention);
        const float sign = primitive.tangents[primitive.corners[3 * t]].w;
        if (expected != 0) inverted += sign * expected < 0 ? 1 : -1;
    }
    return inverted > 0;
}

/// Returns the indices of primitives that use a normal map, and whose tangents are replaced.
std::vector<std::size_t> replacedPrimitives(Model& model, const GeneratePlan& plan) {
    const std::span<const Primitive> primitives = model.primitives();
    std::vector<bool> is_replaced(primitives.size());
    for (const PoolPlan& pool : plan.pools) {
        for (const std::size_t number : pool.primitives) is_replaced[number] = pool.has_tangents;
    }
    std::vector<std::size_t> replaced;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (!is_replaced[i]) continue;
        const std::vector<TangentUse> uses = tangentUses(model.document(), primitives[i]);
        if (std::any_of(uses.begin(), uses.end(), [](const TangentUse& use) { return use.image.has_value(); }))
            replaced.push_back(i);
    }
    return replaced;
}

bool showsFlipped(const ScenePrimitive& primitive, const MapFlips& flips) {
    return std::any_of(primitive.uses.begin(), primitive.uses.end(), [&](const TangentUse& use) {
        return use.image && std::any_of(flips.reports.begin(), flips.reports.end(), [&](const NormalMapReport& report) {
                   return report.image == *use.image && report.flipped;
               });
    });
}

std::string primitivesText(std::uint64_t count) {
    return std::to_string(count) + (count == 1 ? " primitive" : " primitives");
}

}  // namespace

std::string warnOfInvertedSigns(Model& model, const GeneratePlan& plan, const MapFlips& flips,
                                const GenerateOptions& options) {
    if (options.selection.existing != ExistingTangents::replace || options.maps.convert) return {};
    const std::vector<std::size_t> replaced = replacedPrimitives(model, plan);
    if (replaced.empty()) return {};
    MemoryBudget& memory = *model.document().memory;
    const std::int64_t left = memory.left();
    std::uint64_t inverted = 0;
    const std::optional<Error> failure = tryFile([&] {
        for (const ScenePrimitive& primitive : model.sceneOf(replaced).primitives)
            inverted +=
                seemInverted(primitive, options.tangents.compute.convention) && !showsFlipped(primitive, flips) ? 1 : 0;
    });
    memory.restore(left);
    if (failure && failure->code != ErrorCode::tooLarge) throw FileError{*failure};
    if (failure) return "the signs of the replaced tangents were not examined, because the memory limit is too low";
    if (inverted == 0) return {};
    return "the tangents of " + primitivesText(inverted) +
           " had inverted signs. Their normal maps were not examined: if green points down in them, the two inversions "
           "canceled out, and with the new tangents bumps look like dents along v. Run `tspace check` on the input; if "
           "green points down, invert it too (--overwrite together with --flip-green), or keep the tangents (omit "
           "--overwrite)";
}

namespace {

bool isRead(const Document& document, const Primitive& primitive) {
    return hasTriangles(primitive.mode) && primitive.find("NORMAL") && !tangentUses(document, primitive).empty();
}

/// Returns the first of the primitives whose tangents a material reads; if there is none, the first primitive.
std::size_t representativeOf(const Document& document, std::span<const Primitive> primitives,
                             const std::vector<std::size_t>& numbers) {
    const auto read = std::find_if(numbers.begin(), numbers.end(),
                                   [&](std::size_t number) { return isRead(document, primitives[number]); });
    return read == numbers.end() ? numbers.front() : *read;
}

/// Reads the attributes of a primitive that the repair needs.
OwnedMesh readStored(const Document& document, const Primitive& primitive) {
    OwnedMesh stored{.tangents = readTangents(document, primitive)};
    if (primitive.find("NORMAL")) stored.normals = readVec3(document, primitive, "NORMAL");
    if (!hasTriangles(primitive.mode) || !primitive.find("POSITION")) return stored;
    stored.positions = readVec3(document, primitive, "POSITION");
    stored.indices = readTriangleCorners(document, primitive);
    return stored;
}

bool areBroken(Model& model, const Primitive& primitive) {
    const SharedArray<Vec4> tangents = model.arrays().borrowTangents(primitive);
    SharedArray<Vec3> normals;
    if (isRead(model.document(), primitive)) normals = model.arrays().borrowVec3(primitive, "NORMAL");
    for (std::size_t v = 0; v < tangents.size(); ++v) {
        if (!hasValidValues(tangents[v]) || (!normals.empty() && !hasDirection(tangents[v], normals[v]))) return true;
    }
    return false;
}

}  // namespace

std::vector<std::vector<std::size_t>> findBrokenValues(Model& model, const GeneratePlan& plan) {
    const Document& document = model.document();
    const std::span<const Primitive> primitives = model.primitives();
    std::vector<bool> is_computed(primitives.size(), false);
    for (const PoolPlan& pool : plan.pools) {
        for (const std::size_t number : pool.primitives) is_computed[number] = !pool.keeps_tangents;
    }
    // Indices of the primitives that share an accessor; key: accessor.
    std::map<std::size_t, std::vector<std::size_t>> sharing;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const auto accessor = primitives[i].find("TANGENT");
        // Primitives without positions are not drawn, and have no accessor whose compression new elements could
        // inherit.
        if (!accessor || !primitives[i].find("POSITION") || is_computed[i]) continue;
        if (plan.reports[i].action == PrimitiveAction::removed) continue;
        if (hasData(document, readAccessor(document, *accessor))) sharing[*accessor].push_back(i);
    }
    std::vector<std::vector<std::size_t>> groups;
    for (const auto& [accessor, numbers] : sharing) {
        const Primitive& judge = primitives[representativeOf(document, primitives, numbers)];
        document.memory->require((sizeof(Vec4) + sizeof(Vec3)) * judge.vertex_count, judge.place());
        if (areBroken(model, judge)) groups.push_back(numbers);
    }
    return groups;
}

void repairInvalidValues(Editor& editor, const Document& document, std::span<const Primitive> primitives,
                         std::span<const std::vector<std::size_t>> groups, std::span<PrimitiveReport> reports) {
    for (const std::vector<std::size_t>& numbers : groups) {
        const Primitive& judge = primitives[representativeOf(document, primitives, numbers)];
        constexpr std::uint64_t kOfCorner = 48, kOfVertex = 128;
        document.memory->require(kOfCorner * 3 * judge.triangleCount() + kOfVertex * judge.vertex_count, judge.place());
        const OwnedMesh stored = readStored(document, judge);
        std::vector<Vec4> repaired = stored.tangents;
        valueOrThrow(repairValues(tangentView(stored), !isRead(document, judge), repaired));
        const Accessor accessor = readAccessor(document, *judge.find("TANGENT"));
        Bytes elements = copyElements(document, accessor);
        std::size_t count = 0;
        for (std::size_t v = 0; v < repaired.size(); ++v) {
            if (std::memcmp(&repaired[v], &stored.tangents[v], sizeof(Vec4)) == 0) continue;
            ++count;
            const std::vector<std::uint8_t> bytes =
                packUnits(std::span<const Vec4>(&repaired[v], 1), unitFormatOf(accessor));
            std::copy(bytes.begin(), bytes.end(), elements.data() + v * accessor.element_bytes);
        }
        setAttribute(editor, document, {.primitives = primitives, .numbers = numbers, .name = "TANGENT"},
                     {.component = accessor.component,
                      .type = accessor.type,
                      .normalized = accessor.normalized,
                      .count = accessor.count,
                      .element_bytes = accessor.element_bytes,
                      .bytes = std::move(elements)});
        for (const std::size_t number : numbers) {
            PrimitiveReport& report = reports[number];
            report.mended_vertex_count = count;
            if (report.action == PrimitiveAction::kept) report.action = PrimitiveAction::replaced;
            report.notes.push_back("its tangents were kept, but at " + std::to_string(count) + " of " +
                                   std::to_string(repaired.size()) +
                                   " vertices they were repaired, because they were not finite, not of unit length, "
                                   "parallel to the normal, or had a sign other than +1 and -1");
        }
    }
}

}  // namespace tspace::gltf
