// SPDX-License-Identifier: MIT
// Green channels that point down.
#include "check/check_images.h"

#include "asset/work_together.h"
#include "check/findings.h"
#include "check/normal_map.h"

namespace tspace {

namespace {

/// A normal map, and what uses it first.
struct NormalMap {
    std::size_t image = 0;
    const ScenePrimitive* primitive = nullptr;
    const TangentUse* use = nullptr;
    std::optional<GreenTest> test = {};
    std::string why_not = {};
};

std::vector<NormalMap> collectNormalMaps(const Scene& scene) {
    constexpr std::size_t kNone = ~std::size_t{0};
    std::vector<std::size_t> number_of(scene.images.size(), kNone);
    std::vector<NormalMap> maps;
    for (const ScenePrimitive& primitive : scene.primitives) {
        for (const TangentUse& use : primitive.uses) {
            if (!use.image || use.needed_by == "anisotropy") continue;
            std::size_t& number = number_of[*use.image];
            if (number == kNone) {
                number = maps.size();
                maps.push_back({.image = *use.image, .primitive = &primitive, .use = &use});
            }
        }
    }
    return maps;
}

void lookAt(const Scene& scene, const CheckOptions& options, NormalMap& map) {
    const SceneImage& image = scene.images[map.image];
    if (image.bytes.empty()) {
        map.why_not = "it cannot be read";
        return;
    }
    const std::uint64_t bytes = imageWorkBytes(image.bytes);
    if (scene.memory && !scene.memory->has(bytes)) {
        map.why_not = "it " + scene.memory->whyNot(bytes);
        return;
    }
    const std::optional<RgbImage> decoded = decodeImage(image.bytes, options.most_pixels, map.why_not);
    if (decoded) map.test = testGreen(*decoded);
}

std::string imageName(const Scene& scene, std::size_t image) {
    const SceneImage& entry = scene.images[image];
    const std::string& name = entry.uri.empty() ? entry.name : entry.uri;
    return name.empty() ? "image " + std::to_string(image) : "'" + name + "'";
}

std::optional<Finding> describe(const Scene& scene, const NormalMap& map) {
    Finding finding;
    if (!map.test) {
        const Tally one{.count = 1, .total = 1};
        finding = makeFinding(FindingCode::normalMapUnreadable, Severity::note, one, "images",
                              "the normal map " + imageName(scene, map.image) + " was not looked at: " + map.why_not);
    } else if (map.test->verdict == GreenVerdict::down) {
        const Tally blocks{.count = map.test->down_block_count, .total = map.test->block_count};
        finding = makeFinding(FindingCode::greenFlipped, Severity::warning, blocks, "blocks",
                              "green seems to point down in the normal map " + imageName(scene, map.image) +
                                  ", as DirectX has it: so say " + countText(blocks, "blocks") +
                                  " of 16 x 16 pixels with relief");
        finding.confidence = map.test->confidence();
    } else {
        return {};
    }
    finding.place = map.use->place;
    finding.mesh = map.primitive->mesh;
    finding.primitive = map.primitive->primitive;
    finding.mesh_name = map.primitive->mesh_name;
    finding.material_name = map.primitive->material_name;
    return finding;
}

}  // namespace

ImageFindings checkImages(const Scene& scene, const CheckOptions& options) {
    std::vector<NormalMap> maps = collectNormalMaps(scene);
    Parallel parallel(options.execution);
    workTogether(
        scene.memory.get(), maps.size(), parallel,
        [&](std::size_t i) { return imageWorkBytes(scene.images[maps[i].image].bytes); },
        [&](std::size_t i) { lookAt(scene, options, maps[i]); });
    ImageFindings result;
    result.green_points_down.assign(scene.images.size(), false);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        result.looked_at += maps[i].test.has_value();
        result.green_points_down[maps[i].image] = maps[i].test && maps[i].test->verdict == GreenVerdict::down;
        std::optional<Finding> finding = describe(scene, maps[i]);
        if (!finding) continue;
        result.findings.push_back(*std::move(finding));
        result.images.push_back(maps[i].image);
    }
    return result;
}

bool isGreenDown(const ScenePrimitive& primitive, const ImageFindings& images) {
    if (primitive.uses.empty()) return false;
    const std::optional<std::size_t>& image = primitive.uses.front().image;
    return image && *image < images.green_points_down.size() && images.green_points_down[*image];
}

}  // namespace tspace
