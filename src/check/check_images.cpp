// SPDX-License-Identifier: MIT
// Green channels that point down, throughout or in parts.
#include "check/check_images.h"

#include <array>
#include <map>
#include <optional>
#include <tuple>

#include "asset/work_together.h"
#include "check/findings.h"
#include "check/uv_reading.h"
#include "maps/uv_coverage.h"

namespace tspace {

namespace {

/// Triangles that show a part of an image, and the primitives that have them.
struct MapPart {
    const ScenePrimitive* primitive = nullptr;  ///< the first
    const TangentUse* use = nullptr;
    std::vector<std::size_t> followers = {};  ///< primitives whose tangents are for this use
    GreenTest test = {};
};

/// A normal map, and what shows it.
struct NormalMap {
    std::size_t image = 0;
    std::vector<MapPart> parts = {};
    std::optional<GreenTest> test = {};
    std::string why_not = {};
};

/// Parts with one key show the same texels.
using PartKey = std::tuple<std::size_t, const void*, const void*, std::array<double, 5>, TextureWrap, TextureWrap>;

PartKey keyOf(const ScenePrimitive& primitive, const TangentUse& use) {
    const UvTransform& transform = use.transform;
    const Vec2* uvs = use.uv_set < primitive.uv_sets.size() ? primitive.uv_sets[use.uv_set].data() : nullptr;
    return {*use.image,
            primitive.corners.data(),
            uvs,
            {transform.offset[0], transform.offset[1], transform.rotation, transform.scale[0], transform.scale[1]},
            use.wrap_u,
            use.wrap_v};
}

std::vector<NormalMap> collectNormalMaps(const Scene& scene) {
    std::map<std::size_t, std::size_t> map_of;
    std::map<PartKey, std::size_t> part_of;
    std::vector<NormalMap> maps;
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        const ScenePrimitive& primitive = scene.primitives[i];
        for (const TangentUse& use : primitive.uses) {
            if (!use.image || use.needed_by == "anisotropy") continue;
            const auto [map_number, is_new_map] = map_of.try_emplace(*use.image, maps.size());
            if (is_new_map) maps.push_back({.image = *use.image});
            std::vector<MapPart>& parts = maps[map_number->second].parts;
            const auto [part_number, is_new_part] = part_of.try_emplace(keyOf(primitive, use), parts.size());
            if (is_new_part) parts.push_back({.primitive = &primitive, .use = &use});
            if (&use == &primitive.uses.front()) parts[part_number->second].followers.push_back(i);
        }
    }
    return maps;
}

/// Where a primitive has no triangles or no UVs it shows nothing. False: the steps ran out.
bool cover(const MapPart& part, TexelMask& mask, std::uint64_t& steps) {
    const ScenePrimitive& primitive = *part.primitive;
    const std::size_t set = part.use->uv_set;
    if (set >= primitive.uv_sets.size() || primitive.uv_sets[set].empty()) return true;
    const std::vector<Vec2> uvs = textureUvs(primitive.uv_sets[set].span(), part.use->transform);
    return coverTexels({primitive.corners.span(), uvs, part.use->wrap_u, part.use->wrap_v}, mask, steps);
}

std::uint64_t workBytes(const Scene& scene, const NormalMap& map) {
    const ByteSpan bytes = scene.images[map.image].bytes;
    const ImageSize size = claimedSize(bytes);
    std::uint64_t vertices = 0;
    for (const MapPart& part : map.parts) {
        vertices = std::max<std::uint64_t>(vertices, part.primitive->positions.size());
    }
    return imageWorkBytes(bytes) + 2 * TexelMask::bytesOf(size.width, size.height) +
           GreenBlocks::bytesOf(size.width, size.height) + sizeof(Vec2) * vertices;
}

/// `mask`: as many texels as the image has; what it holds does not matter.
void lookAtParts(const GreenBlocks& blocks, TexelMask&& mask, NormalMap& map) {
    // Files with more, or with hostile UVs, get no answer for the rest of their parts but that of the whole map.
    constexpr std::size_t kMostParts = 4096;
    std::uint64_t steps = kCoverSteps;
    bool is_exact = map.parts.size() > 1;
    for (std::size_t i = 0; i < map.parts.size(); ++i) {
        MapPart& part = map.parts[i];
        mask.clear();
        is_exact = is_exact && i < kMostParts && cover(part, mask, steps);
        part.test = is_exact ? blocks.within(mask) : *map.test;
    }
}

void lookAt(const Scene& scene, const CheckOptions& options, NormalMap& map) {
    const SceneImage& image = scene.images[map.image];
    if (image.bytes.empty()) {
        map.why_not = "it cannot be read";
        return;
    }
    const std::uint64_t bytes = workBytes(scene, map);
    if (scene.memory && !scene.memory->has(bytes)) {
        map.why_not = "it " + scene.memory->whyNot(bytes);
        return;
    }
    const std::optional<RgbImage> decoded = decodeImage(image.bytes, options.most_pixels, map.why_not);
    if (!decoded) return;
    TexelMask inside(decoded->width, decoded->height);
    std::uint64_t steps = kCoverSteps;
    for (const MapPart& part : map.parts) cover(part, inside, steps);
    const GreenBlocks blocks(*decoded, inside);
    map.test = blocks.all();
    lookAtParts(blocks, std::move(inside), map);
}

std::string imageName(const Scene& scene, std::size_t image) {
    const SceneImage& entry = scene.images[image];
    const std::string& name = entry.uri.empty() ? entry.name : entry.uri;
    return name.empty() ? "image " + std::to_string(image) : "'" + name + "'";
}

std::string rectText(const TexelRect& rect) {
    const auto range = [](std::uint32_t begin, std::uint32_t end) {
        return std::to_string(begin) + " to " + std::to_string(end - 1);
    };
    return "columns " + range(rect.left, rect.right) + ", rows " + range(rect.top, rect.bottom);
}

/// The part of the map that a finding is about: where green points down, the first that shows some of it.
const MapPart& partOf(const NormalMap& map) {
    for (const MapPart& part : map.parts) {
        if (part.test.verdict == GreenVerdict::down || part.test.verdict == GreenVerdict::mixed) return part;
    }
    return map.parts.front();
}

Finding unreadable(const std::string& name, const std::string& why_not) {
    const Tally one{.count = 1, .total = 1};
    return makeFinding(FindingCode::normalMapUnreadable, Severity::note, one, "images",
                       "the normal map " + name + " was not looked at: " + why_not);
}

Finding flipped(const std::string& name, const GreenTest& test) {
    const Tally blocks{.count = test.down_block_count, .total = test.block_count};
    return makeFinding(FindingCode::greenFlipped, Severity::warning, blocks, "blocks",
                       "green seems to point down in the normal map " + name + ", as DirectX has it: so say " +
                           countText(blocks, "blocks") + " of 16 x 16 pixels with relief");
}

Finding mixed(const std::string& name, const GreenTest& test) {
    const Tally blocks{.count = test.down_block_count, .total = test.block_count};
    return makeFinding(FindingCode::greenMixed, Severity::warning, blocks, "blocks",
                       "green seems to point down in one part of the normal map " + name + " (" +
                           rectText(test.down_part) + " counted from the top left) and up in another (" +
                           rectText(test.up_part) + "): down say " + countText(blocks, "blocks") +
                           " of 16 x 16 pixels with relief, " + shareText(blocks.share()));
}

std::optional<Finding> describe(const Scene& scene, const NormalMap& map) {
    const std::string name = imageName(scene, map.image);
    std::optional<Finding> finding;
    if (!map.test) {
        finding = unreadable(name, map.why_not);
    } else if (map.test->verdict == GreenVerdict::down) {
        finding = flipped(name, *map.test);
    } else if (map.test->verdict == GreenVerdict::mixed) {
        finding = mixed(name, *map.test);
    } else {
        return {};
    }
    if (map.test) finding->confidence = map.test->confidence();
    const MapPart& part = partOf(map);
    finding->place = part.use->place;
    finding->mesh = part.primitive->mesh;
    finding->primitive = part.primitive->primitive;
    finding->mesh_name = part.primitive->mesh_name;
    finding->material_name = part.primitive->material_name;
    return finding;
}

GreenSide sideOf(const GreenTest& test) {
    switch (test.verdict) {
        case GreenVerdict::up:
            return GreenSide::up;
        case GreenVerdict::down:
            return GreenSide::down;
        case GreenVerdict::mixed:
            return GreenSide::mixed;
        case GreenVerdict::unknown:
            break;
    }
    return GreenSide::unknown;
}

}  // namespace

ImageFindings checkImages(const Scene& scene, const CheckOptions& options) {
    std::vector<NormalMap> maps = collectNormalMaps(scene);
    Parallel parallel(options.execution);
    workTogether(
        scene.memory.get(), maps.size(), parallel, [&](std::size_t i) { return workBytes(scene, maps[i]); },
        [&](std::size_t i) { lookAt(scene, options, maps[i]); });
    ImageFindings result;
    result.image_green.assign(scene.images.size(), GreenSide::noMap);
    result.primitive_green.assign(scene.primitives.size(), GreenSide::noMap);
    for (const NormalMap& map : maps) {
        result.looked_at += map.test.has_value();
        result.image_green[map.image] = map.test ? sideOf(*map.test) : GreenSide::unread;
        for (const MapPart& part : map.parts) {
            for (const std::size_t primitive : part.followers) {
                result.primitive_green[primitive] = map.test ? sideOf(part.test) : GreenSide::unread;
            }
        }
        std::optional<Finding> finding = describe(scene, map);
        if (!finding) continue;
        result.findings.push_back(*std::move(finding));
        result.images.push_back(map.image);
    }
    return result;
}

}  // namespace tspace
