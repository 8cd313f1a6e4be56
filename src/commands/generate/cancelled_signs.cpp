// SPDX-License-Identifier: MIT
#include "commands/generate/cancelled_signs.h"

#include <algorithm>

#include "commands/check/scene_verdict.h"
#include "commands/shared/uv_reading.h"
#include "core/mesh/surface/surface.h"
#include "model/gltf/material_needs.h"
#include "model/gltf/read_scene.h"
#include "model/io/file_error.h"

namespace tspace::gltf {

namespace {

/// By some triangles: whether most signs are the opposite of what the UVs ask for.
bool looksInverted(const ScenePrimitive& primitive, const Convention& convention) {
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

/// Numbers of the primitives whose tangents are replaced, and that show a normal map.
std::vector<std::size_t> replacedPrimitives(Model& model, const GeneratePlan& plan) {
    const std::span<const Primitive> primitives = model.primitives();
    std::vector<bool> is_replaced(primitives.size());
    for (const Pool& pool : plan.pools) {
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

/// Primitives that rendered right with inverted signs, and those that may have.
struct Cancelled {
    std::uint64_t sure = 0, open = 0;
};

Cancelled countCancelled(Model& model, std::span<const std::size_t> primitives, const MapFlips& flips,
                         const GenerateOptions& options) {
    Cancelled cancelled;
    Scene scene = model.sceneOf(primitives);
    if (std::none_of(scene.primitives.begin(), scene.primitives.end(), [&](const ScenePrimitive& primitive) {
            return looksInverted(primitive, options.tangents.convention);
        })) {
        return cancelled;
    }
    CheckOptions check;
    check.convention = options.tangents.convention;
    check.execution = options.execution;
    check.execution.allocator = nullptr;
    readImages(model.document(), scene);
    std::vector<PrimitiveJudgement> judgements = judgePrimitives(scene, check);
    ImageFindings images = checkImages(scene, check);
    weighImages(scene, check, images, judgements);
    for (std::size_t i = 0; i < judgements.size(); ++i) {
        if (!judgements[i].signs_stay || showsFlipped(scene.primitives[i], flips)) continue;
        (judgements[i].signs == SignVerdict::cancelled ? cancelled.sure : cancelled.open) += 1;
    }
    return cancelled;
}

std::string primitivesText(std::uint64_t count) {
    return std::to_string(count) + (count == 1 ? " primitive" : " primitives");
}

}  // namespace

std::string warnOfCancelledSigns(Model& model, const GeneratePlan& plan, const MapFlips& flips,
                                 const GenerateOptions& options) {
    if (options.existing != ExistingTangents::replace || options.convert_maps) return {};
    const std::vector<std::size_t> replaced = replacedPrimitives(model, plan);
    if (replaced.empty()) return {};
    MemoryBudget& memory = *model.document().memory;
    const std::int64_t left = memory.left();
    Cancelled cancelled;
    const std::optional<Error> failure = tryFile([&] { cancelled = countCancelled(model, replaced, flips, options); });
    memory.giveBack(left);
    if (failure && failure->code != ErrorCode::tooLarge) throw FileError{*failure};
    if (failure) {
        return "whether the signs that are replaced and green of the normal maps cancelled out was not looked at: that "
               "takes more memory than the limit";
    }
    const std::string ways =
        "invert green too (--overwrite together with --flip-green), or keep the tangents (without --overwrite)";
    if (cancelled.sure > 0) {
        return "the tangents of " + primitivesText(cancelled.sure) +
               " had inverted signs, and green of their normal maps points down: the two cancelled out. With the new "
               "tangents alone bumps are dents along v: " +
               ways;
    }
    if (cancelled.open > 0) {
        return "the tangents of " + primitivesText(cancelled.open) +
               " had inverted signs, and whether green of their normal maps points down, which would have made up for "
               "it, could not be seen. If they rendered right before, " +
               ways;
    }
    return {};
}

}  // namespace tspace::gltf
