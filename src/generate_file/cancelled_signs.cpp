// SPDX-License-Identifier: MIT
#include "generate_file/cancelled_signs.h"

#include <algorithm>

#include "asset/gltf/read_scene.h"
#include "check/scene_verdict.h"
#include "check/uv_reading.h"
#include "surface/surface.h"

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

}  // namespace

std::string warnOfCancelledSigns(const Document& document, std::span<const Primitive> primitives,
                                 const GeneratePlan& plan, const MapFlips& flips, const GenerateOptions& options) {
    if (options.existing != ExistingTangents::replace || options.convert_maps) return {};
    std::vector<bool> is_replaced(primitives.size());
    for (const Pool& pool : plan.pools) {
        for (const std::size_t number : pool.primitives) is_replaced[number] = pool.has_tangents;
    }
    std::vector<Primitive> judged;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (is_replaced[i]) judged.push_back(primitives[i]);
    }
    if (judged.empty()) return {};
    const std::int64_t left = document.memory->left();
    Scene scene = sceneOf(document, judged);
    std::uint64_t sure = 0, open = 0;
    if (std::any_of(scene.primitives.begin(), scene.primitives.end(), [&](const ScenePrimitive& primitive) {
            return looksInverted(primitive, options.tangents.convention);
        })) {
        CheckOptions check;
        check.convention = options.tangents.convention;
        check.execution = options.tangents.execution;
        check.execution.allocator = nullptr;
        readImages(document, scene);
        std::vector<PrimitiveJudgement> judgements = judgePrimitives(scene, check);
        ImageFindings images = checkImages(scene, check);
        weighImages(scene, check, images, judgements);
        for (std::size_t i = 0; i < judgements.size(); ++i) {
            const std::vector<TangentUse>& uses = scene.primitives[i].uses;
            const bool is_flipped = std::any_of(uses.begin(), uses.end(), [&](const TangentUse& use) {
                return use.image && std::any_of(flips.reports.begin(), flips.reports.end(), [&](const auto& report) {
                           return report.image == *use.image && report.flipped;
                       });
            });
            if (is_flipped || !judgements[i].signs_stay) continue;
            (judgements[i].signs == SignVerdict::cancelled ? sure : open) += 1;
        }
    }
    document.memory->giveBack(left);
    const auto primitivesText = [](std::uint64_t count) {
        return std::to_string(count) + (count == 1 ? " primitive" : " primitives");
    };
    const std::string ways =
        "invert green too (--overwrite together with --flip-green), or keep the tangents (without "
        "--overwrite)";
    if (sure > 0) {
        return "the tangents of " + primitivesText(sure) +
               " had inverted signs, and green of their normal maps points down: the two cancelled out. With the new "
               "tangents alone bumps are dents along v: " +
               ways;
    }
    if (open > 0) {
        return "the tangents of " + primitivesText(open) +
               " had inverted signs, and whether green of their normal maps points down, which would have made up for "
               "it, could not be seen. If they rendered right before, " +
               ways;
    }
    return {};
}

}  // namespace tspace::gltf
