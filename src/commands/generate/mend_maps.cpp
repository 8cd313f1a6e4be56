// SPDX-License-Identifier: MIT
#include "commands/generate/flip_maps.h"

#include <algorithm>
#include <optional>

#include "commands/check/map_slopes.h"
#include "commands/shared/map_image_file.h"
#include "images/texture_vectors.h"
#include "model/io/file_error.h"
#include "tspace/maps.h"

namespace tspace {
namespace {

/// Returns what the image contained, as a clause.
std::string formerContent(const MapAnalysis& analysis) {
    switch (analysis.content) {
        case MapContent::twoChannels: return "the map stored only x and y";
        case MapContent::unsignedZ: return "blue stored z itself, from 0 to 1, instead of (z + 1) / 2";
        case MapContent::xInAlpha:
            return std::string("the map stored x in ") + channelName(analysis.layout.x.channel) + " and y in " +
                   channelName(analysis.layout.y.channel);
        case MapContent::exchanged: return "the channels of the map were exchanged or inverted";
        case MapContent::encoded: return "the map was stored as a color image (sRGB)";
        case MapContent::objectSpace: return "the map was in object space";
        case MapContent::normals: return "the map was declared as sRGB, but its values are linear";
        case MapContent::height:
        case MapContent::picture:
        case MapContent::hemiOctahedral: break;
    }
    return "";
}

/// Returns why an image with such contents is not rewritten; empty if it is.
std::string whyUnchanged(const JudgedMap& map) {
    const MapAnalysis& analysis = map.analysis;
    if (analysis.content == MapContent::normals && !analysis.is_marked_srgb)
        return "the map is encoded as glTF requires";
    if (analysis.content == MapContent::height)
        return "the image is gray, so it is a height map of unknown strength; use tspace height-to-normal";
    if (analysis.content == MapContent::picture) return "the image is a color image, not a normal map";
    if (analysis.content == MapContent::objectSpace && !analysis.follows_mesh)
        return "the map is neither in tangent space nor in the object space of this mesh";
    if (analysis.content == MapContent::objectSpace && analysis.is_in_world)
        return "the map is in world space; use tspace convert-map --from world";
    if (analysis.content == MapContent::hemiOctahedral)
        return "the map is hemi-octahedrally encoded, which tspace does not decode";
    if (analysis.may_be_octahedral) return "its two channels may use octahedral encoding (see tspace check)";
    if (analysis.is_doubtful)
        return "its two channels may use another encoding, because they are not the slopes of any height field (see "
               "tspace check)";
    if (analysis.is_order_open)
        return std::string("its slopes do not show which of ") + channelName(analysis.layout.x.channel) + " and " +
               channelName(analysis.layout.y.channel) + " is x (see tspace check)";
    if (isRotated(analysis, map.is_y_inverted))
        return "the image was rotated by 90 or 270 degrees without its vectors, and its slopes do not show which (see "
               "tspace check)";
    return {};
}

bool isPicture(const FloatImage& image) {
    std::vector<TexelBytes> texels;
    texels.reserve(image.texels.size());
    for (const Vec3& texel : image.texels)
        texels.push_back({roundedChannel(texel.x), roundedChannel(texel.y), roundedChannel(texel.z), 255});
    return analyzeTexels(texels, false, {}).content == MapContent::picture;
}

/// Returns all triangles that use the image, with tangents that approximate those of the output. `isUser(TangentUse)`:
/// selects the uses.
template <class IsUser>
MapMesh meshOf(const Scene& scene, const GenerateOptions& options, const IsUser& isUser) {
    MapMesh mesh;
    Execution execution = options.execution;
    execution.allocator = nullptr;
    for (ScenePrimitive primitive : scene.primitives) {
        if (options.selection.existing == ExistingTangents::replace) primitive.tangents = {};
        for (const TangentUse& use : primitive.uses) {
            const bool has_uvs = use.uv_set < primitive.uv_sets.size() && !primitive.uv_sets[use.uv_set].empty();
            if (!isUser(use) || !showsNormals(use) || primitive.corners.empty() || !has_uvs) continue;
            addMapCorners(primitive, &use, options.tangents.compute, execution, mesh.corners);
            mesh.wrap_u = use.wrap_u;
            mesh.wrap_v = use.wrap_v;
            mesh.report.scale = use.scale;
        }
    }
    return mesh;
}

void toTangentSpace(const Scene& scene, std::size_t image_number, const GenerateOptions& options, FloatImage& image) {
    const MapMesh mesh = meshOf(scene, options, [&](const TangentUse& use) { return use.image == image_number; });
    const MapSide to = tangentSide(mesh.corners, mesh.report.scale);
    const MapImage map{image.width, image.height, image.texels, mesh.wrap_u, mesh.wrap_v};
    valueOrThrow(convertMap(map, {.space = MapSpace::object}, to, {.bits = image.bits, .padding = 16}, image.texels,
                            options.execution));
}

}  // namespace

Bytes rewriteMap(const Scene& scene, ByteSpan bytes, const GenerateOptions& options, JudgedMap& map) {
    map.report.reason = whyUnchanged(map);
    if (!map.report.reason.empty()) return {};
    if (!scene.memory->has(kMapPixelBytes * claimedSize(bytes).pixels())) {
        map.report.reason = "converting the map would exceed the memory limit";
        return {};
    }
    std::optional<FloatImage> image = decodeFloatImage(bytes, kMaxModelMapPixels, map.report.reason);
    if (!image) return {};
    MapLayout layout = map.analysis.layout;
    layout.y.is_inverted = layout.y.is_inverted != map.is_y_inverted;
    readTexels(layout, *image);
    if (map.analysis.content == MapContent::objectSpace) toTangentSpace(scene, map.image, options, *image);
    const auto file = encodePng(*image, std::min(image->bits, kMaxPngBits));
    if (!file) {
        map.report.reason = "the new map could not be encoded as PNG";
        return {};
    }
    map.report.mended = true;
    map.report.reason = formerContent(map.analysis);
    if (layout.curve != MapCurve::none && map.analysis.content != MapContent::encoded)
        map.report.reason += ", and was stored as a color image (sRGB)";
    if (const std::string remarks = takeRemarks(*image); !remarks.empty()) map.report.reason += "; " + remarks;
    return Bytes(file->begin(), file->end());
}

ConvertedHeights normalMapFromHeights(const Scene& scene, std::size_t material, std::size_t image, double strength,
                                      const GenerateOptions& options) {
    const ByteSpan bytes = scene.images[image].bytes;
    // Missing images and images in unsupported formats are skipped, or kept like other textures.
    if (bytes.empty() || whyNotRead(imageFormat(bytes)) != nullptr) return {};
    ConvertedHeights made{.is_height_map = true};
    if (!scene.memory->has(kMapPixelBytes * claimedSize(bytes).pixels())) {
        made.why_not = "converting the map would exceed the memory limit";
        return made;
    }
    std::optional<FloatImage> heights = decodeFloatImage(bytes, kMaxModelMapPixels, made.why_not, ImageUse::numbers);
    if (!heights) return made;
    made.remarks = takeRemarks(*heights);
    if (!isGrayImage(*heights)) {
        made.is_height_map = isPicture(*heights);
        made.why_not = "the image is a color image, neither a height map nor a normal map";
        return made;
    }
    const MapMesh mesh = meshOf(scene, options, [&](const TangentUse& use) { return use.material == material; });
    if (mesh.corners.uvs.empty()) {
        made.why_not = "its faces have no texture coordinates";
        return made;
    }
    Execution execution = options.execution;
    execution.allocator = nullptr;
    const std::vector<float> values = heightsOf(*heights);
    const unsigned bits = std::min(heights->bits, kMaxPngBits);
    const HeightToNormalReport report = valueOrThrow(
        heightToNormal({heights->width, heights->height, values, mesh.wrap_u, mesh.wrap_v}, tangentSide(mesh.corners),
                       {.strength = strength, .bits = bits}, heights->texels, execution));
    heights->alpha.clear();
    const auto file = encodePng(*heights, bits);
    if (!file) {
        made.why_not = "the normal map made from it could not be encoded as PNG";
        return made;
    }
    made.file.assign(file->begin(), file->end());
    made.mean_lean_deg = report.mean_lean_deg;
    return made;
}

}  // namespace tspace
