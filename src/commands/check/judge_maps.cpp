// SPDX-License-Identifier: MIT
// Decides by the findings of `check` on green and on signs.
#include "commands/check/judge_maps.h"

#include <algorithm>
#include <optional>

#include "commands/check/check_images.h"
#include "commands/check/scene_verdict.h"
#include "images/flip_green.h"
#include "model/io/file_error.h"
#include "tspace/flip_green.h"

namespace tspace {

namespace {

/// Per image: tangents that stay are made for a green that points down, or may be.
std::vector<bool> findCancelled(const Scene& scene, ImageFindings& found, const std::vector<bool>& keeps_tangents,
                                const CheckOptions& check) {
    std::vector<bool> cancelled(scene.images.size());
    if (std::count(found.image_green.begin(), found.image_green.end(), GreenSide::down) == 0) return cancelled;
    if (std::count(keeps_tangents.begin(), keeps_tangents.end(), true) == 0) return cancelled;
    std::vector<PrimitiveJudgement> judgements = judgePrimitives(scene, check);
    weighImages(scene, check, found, judgements);
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        if (!keeps_tangents[i] || judgements[i].signs == SignVerdict::plain) continue;
        for (const TangentUse& use : scene.primitives[i].uses) {
            if (use.image) cancelled[*use.image] = true;
        }
    }
    return cancelled;
}

/// Why a map stays as it is, where FlipGreen::down is asked for; empty: it does not.
std::string whyItStays(GreenSide side, bool is_cancelled, bool is_declared, const Convention& convention) {
    if (is_declared) return "the file declares that green points down, and its readers turn it";
    switch (side) {
        case GreenSide::up:
            return "green points up already";
        case GreenSide::mixed:
            return "green points down in one part of it and up in another (see tspace check)";
        case GreenSide::unread:
            return "it could not be looked at (see tspace check)";
        case GreenSide::down:
            if (convention.green == Green::down) return "green points down, as the convention wants that was asked for";
            if (!is_cancelled) return {};
            return "green points down, but signs of tangents that stay are inverted too, and the two cancel out; "
                   "--overwrite mends both";
        case GreenSide::noMap:
        case GreenSide::unknown:
            break;
    }
    return "which way green points cannot be told";
}

/// Inverts the map. `why`: the reason where that is not possible.
Bytes flipSceneImage(const Scene& scene, std::size_t image, std::string& why) {
    const std::vector<std::uint8_t>& bytes = scene.images[image].bytes;
    if (bytes.empty()) {
        why = "it cannot be read";
        return {};
    }
    Bytes flipped = flipImage(bytes, *scene.memory, why);
    scene.memory->take(flipped.size(), "images");
    return flipped;
}

}  // namespace

Bytes flipImage(std::span<const std::uint8_t> bytes, const MemoryBudget& budget, std::string& why) {
    const std::uint64_t work_bytes = flipWorkBytes(bytes);
    if (!budget.has(work_bytes)) {
        why = "it " + budget.whyNot(work_bytes);
        return {};
    }
    Bytes made;
    const std::optional<Error> failure = tryFile([&] {
        const FlippedImage flipped = valueOrThrow(flipGreen(bytes, {.memory_limit_bytes = kNoMemoryLimit}));
        made.assign(flipped.bytes.begin(), flipped.bytes.end());
    });
    if (!failure) return made;
    if (failure->code == ErrorCode::outOfMemory) throw FileError{*failure};
    why = failure->message;
    return {};
}

std::vector<JudgedMap> judgeMaps(const Scene& scene, const std::vector<bool>& keeps_tangents,
                                 const GenerateOptions& options) {
    CheckOptions check;
    check.convention = options.tangents.convention;
    check.execution = options.execution;
    check.execution.allocator = nullptr;
    ImageFindings found = checkImages(scene, check);
    const std::vector<bool> cancelled = findCancelled(scene, found, keeps_tangents, check);
    std::vector<JudgedMap> maps;
    for (std::size_t i = 0; i < scene.images.size(); ++i) {
        if (found.image_green[i] == GreenSide::noMap) continue;
        JudgedMap& map = maps.emplace_back();
        const SceneImage& image = scene.images[i];
        map.image = i;
        map.report = {.image = static_cast<std::uint32_t>(i), .name = image.uri.empty() ? image.name : image.uri};
        std::string& why = map.report.reason;
        map.look = found.looks[i];
        map.is_y_inverted = found.is_y_inverted[i];
        if (options.flip_green == FlipGreen::none) continue;
        if (options.flip_green == FlipGreen::down)
            why = whyItStays(found.image_green[i], cancelled[i], found.is_declared[i], options.tangents.convention);
        if (why.empty()) map.flipped = flipSceneImage(scene, i, why);
        map.report.flipped = !map.flipped.empty();
    }
    return maps;
}

}  // namespace tspace
