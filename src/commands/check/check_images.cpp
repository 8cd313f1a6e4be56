// SPDX-License-Identifier: MIT
// Examines the content of normal maps, and finds green channels that point down in all or part of a map.
#include "commands/check/scene_checks.h"

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "commands/check/findings.h"
#include "commands/check/map_alpha.h"
#include "commands/check/map_slopes.h"
#include "commands/shared/uv_reading.h"
#include "core/base/numbers.h"
#include "core/base/vec_math.h"
#include "images/float_image.h"
#include "images/image.h"
#include "images/texture_vectors.h"
#include "maps/layout/uv_coverage.h"
#include "maps/texels/texture_sample.h"
#include "model/io/file_error.h"
#include "model/io/memory_budget.h"

namespace tspace {
namespace {

/// Part of an image that one texture use samples: its triangles, and the primitives that contain them.
struct MapPart {
    const ScenePrimitive* primitive = nullptr;  ///< first primitive that uses the part
    const TangentUse* use = nullptr;
    std::vector<std::size_t> followers = {};  ///< primitives whose tangents are meant for this use
    GreenTest test = {};
};

/// A normal map, and the parts of it that the scene uses.
struct NormalMap {
    std::size_t image = 0;
    std::vector<MapPart> parts = {};
    bool is_of_unknown = false;  ///< only unknown material extensions use the map
    MapAnalysis analysis = {};
    std::optional<GreenTest> test = {};
    std::string why_not = {};
    std::uint64_t not_finite = 0;  ///< texels that were not finite and were filled from their neighbors
    std::string layer_text = {};   ///< see FloatImage
    double packing_deg = 0;        ///< approximate error of the vectors of an image with lossy color compression
};

/// Key of a part: parts with equal keys cover the same texels.
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

class MapCollection {
  public:
    void add(const ScenePrimitive& primitive, std::size_t number, const TangentUse& use) {
        if (!use.image || use.needed_by == "anisotropy") return;
        const auto [map_number, is_new_map] = map_of_.try_emplace(*use.image, maps.size());
        if (is_new_map) maps.push_back({.image = *use.image});
        std::vector<MapPart>& parts = maps[map_number->second].parts;
        const auto [part_number, is_new_part] = part_of_.try_emplace(keyOf(primitive, use), parts.size());
        if (is_new_part) parts.push_back({.primitive = &primitive, .use = &use});
        if (!primitive.uses.empty() && &use == &primitive.uses.front())
            parts[part_number->second].followers.push_back(number);
    }

    std::vector<NormalMap> maps = {};

  private:
    std::map<std::size_t, std::size_t> map_of_ = {};
    std::map<PartKey, std::size_t> part_of_ = {};
};

/// Returns the normal maps of known uses, and then those that only unknown extensions use.
std::vector<NormalMap> collectNormalMaps(const Scene& scene) {
    MapCollection known, unknown;
    std::set<std::size_t> images;
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        for (const TangentUse& use : scene.primitives[i].uses) known.add(scene.primitives[i], i, use);
    }
    for (const NormalMap& map : known.maps) images.insert(map.image);
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        for (const TangentUse& use : scene.primitives[i].unknown_maps) {
            if (use.image && images.count(*use.image) == 0) unknown.add(scene.primitives[i], i, use);
        }
    }
    for (NormalMap& map : unknown.maps) {
        map.is_of_unknown = true;
        known.maps.push_back(std::move(map));
    }
    return std::move(known.maps);
}

/// Marks the texels that a part covers: none if the primitive has no triangles or no UVs. Returns false if the step
/// limit was reached.
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
    for (const MapPart& part : map.parts)
        vertices = std::max<std::uint64_t>(vertices, part.primitive->positions.size());
    return imageWorkBytes(bytes) + 2 * TexelMask::bytesOf(size.width, size.height) +
           GreenBlocks::bytesOf(size.width, size.height) + sizeof(Vec2) * vertices;
}

/// Determines the direction of green for each part. `mask`: scratch memory with the size of the image.
void examineParts(const GreenBlocks& blocks, TexelMask&& mask, NormalMap& map) {
    // Parts beyond this number, or beyond the step limit, get the verdict of the whole map.
    constexpr std::size_t kMaxParts = 4096;
    std::uint64_t steps = kCoverSteps;
    bool is_exact = map.parts.size() > 1;
    for (std::size_t i = 0; i < map.parts.size(); ++i) {
        MapPart& part = map.parts[i];
        mask.clear();
        is_exact = is_exact && i < kMaxParts && cover(part, mask, steps);
        part.test = is_exact ? blocks.within(mask) : *map.test;
    }
}

/// Returns whether the green channel stores y linearly, so that inverting the channel inverts y of the normals.
bool hasOwnGreen(const MapLayout& layout) { return layout.y == MapLayout{}.y && layout.curve == MapCurve::none; }

/// Samples the map at a point of a triangle, with the mesh normal at that point.
void showPoint(const ScenePrimitive& primitive, const MapPart& part, std::span<const Vec2> uvs, const RgbImage& image,
               const std::uint32_t* corners, const std::array<double, 3>& weights, double area,
               std::vector<TexelOnSurface>& surface) {
    double u = 0, v = 0;
    DVec3 normal{};
    for (std::size_t k = 0; k < 3; ++k) {
        u += weights[k] * static_cast<double>(uvs[corners[k]].x);
        v += weights[k] * static_cast<double>(uvs[corners[k]].y);
        normal = normal + weights[k] * toDouble(primitive.normals[corners[k]]);
    }
    const double column = std::floor(u * image.width), row = std::floor(v * image.height);
    if (!normalize(normal) || !(std::fabs(column) < 1e9) || !(std::fabs(row) < 1e9)) return;
    const std::size_t x = wrappedTexel(static_cast<std::int64_t>(column), image.width, part.use->wrap_u);
    const std::size_t y = wrappedTexel(static_cast<std::int64_t>(row), image.height, part.use->wrap_v);
    const std::uint8_t* rgb = image.rgb.data() + 3 * (y * image.width + x);
    const Vec2 uv{static_cast<float>(u), static_cast<float>(v)};
    surface.push_back({toFloat(normal), {rgb[0], rgb[1], rgb[2], 255}, area, uv});
}

/// Samples the map on the triangles of a part, with the mesh normals.
void showPoints(const MapPart& part, const RgbImage& image, std::vector<TexelOnSurface>& surface) {
    constexpr std::size_t kMaxOfAPart = 4096, kMaxRows = 32;
    const ScenePrimitive& primitive = *part.primitive;
    const std::size_t set = part.use->uv_set;
    if (set >= primitive.uv_sets.size() || primitive.uv_sets[set].empty() || primitive.normals.empty()) return;
    const std::vector<Vec2> uvs = textureUvs(primitive.uv_sets[set].span(), part.use->transform);
    const std::size_t triangles = primitive.corners.size() / 3, step = triangles / kMaxOfAPart + 1;
    // With few triangles, many samples of each are taken, because relief makes single samples unreliable.
    std::uint32_t rows = 1;
    while (rows < kMaxRows && triangles / step * rows * rows < kMaxOfAPart) ++rows;
    for (std::size_t t = step / 2; t < triangles; t += step) {
        const std::uint32_t* const corners = primitive.corners.data() + 3 * t;
        const auto at = [&](std::size_t k) { return toDouble(primitive.positions[corners[k]]); };
        const double area = length(cross(at(1) - at(0), at(2) - at(0)));
        if (!(area > 0)) continue;
        for (std::uint32_t i = 0; i < rows; ++i) {
            for (std::uint32_t j = 0; i + j < rows; ++j) {
                const double b = (i + 1.0 / 3) / rows, c = (j + 1.0 / 3) / rows;
                showPoint(primitive, part, uvs, image, corners, {1 - b - c, b, c}, area, surface);
            }
        }
    }
}

/// Returns whether a transform changes directions, as opposed to only translating and scaling.
bool turns(const Affine& place) {
    constexpr double kMin = 1e-4;
    for (const DVec3& axis : {DVec3{1, 0, 0}, DVec3{0, 1, 0}, DVec3{0, 0, 1}}) {
        DVec3 turned = place.normal(axis);
        if (normalize(turned) && length(turned - axis) > kMin) return true;
    }
    return false;
}

/// Returns the sampled points with their normals in world space, using the first transform of each primitive that
/// changes directions. `parts`: index of the first point of each part. Empty if no transform changes directions.
std::vector<TexelOnSurface> placedInWorld(const NormalMap& map, std::span<const std::size_t> parts,
                                          std::span<const TexelOnSurface> surface) {
    std::vector<TexelOnSurface> in_world;
    for (std::size_t i = 0; i < map.parts.size(); ++i) {
        const std::vector<Affine>& places = map.parts[i].primitive->places;
        const auto place = std::find_if(places.begin(), places.end(), turns);
        if (place == places.end()) continue;
        if (in_world.empty()) in_world.assign(surface.begin(), surface.end());
        const std::size_t end = i + 1 < parts.size() ? parts[i + 1] : surface.size();
        for (std::size_t k = parts[i]; k < end; ++k) in_world[k].normal = normalAt(*place, in_world[k].normal);
    }
    return in_world;
}

/// Returns alpha, which is decoded only if it may contain x or y.
std::vector<std::uint8_t> alphaOf(const Scene& scene, const SceneImage& image, std::span<const TexelBytes> texels,
                                  bool is_texture) {
    if (!is_texture && !mayHaveXInAlpha(texels)) return {};
    const std::uint64_t bytes = imageWorkBytes(image.bytes) + 5 * claimedSize(image.bytes).pixels();
    if (scene.memory && !scene.memory->has(bytes)) return {};
    return decodeAlpha(image.bytes);
}

/// Detects what the image contains, and converts it to the channel layout of glTF.
void analyzeContent(const Scene& scene, const TexelMask& inside, NormalMap& map, RgbImage& image) {
    const std::optional<TextureFacts> facts = textureFacts(scene.images[map.image].bytes);
    const std::vector<std::uint8_t> alpha =
        alphaOf(scene, scene.images[map.image], sampleTexels(image, {}, inside), facts.has_value());
    std::vector<TexelOnSurface> surface;
    std::vector<std::size_t> parts;
    for (const MapPart& part : map.parts) {
        parts.push_back(surface.size());
        showPoints(part, image, surface);
    }
    map.analysis = analyzeMap({image, alpha, inside, facts ? &facts->layout : nullptr}, surface,
                              placedInWorld(map, parts, surface));
    const MapContent content = map.analysis.content;
    map.analysis.is_marked_srgb = facts && facts->is_srgb && map.analysis.layout.curve == MapCurve::none &&
                                  content != MapContent::picture && content != MapContent::height;
    if (holdsNormals(content) && !(map.analysis.layout == MapLayout{})) readByLayout(image, alpha, map.analysis.layout);
}

bool isEtc1s(const std::optional<TextureFacts>& facts) { return facts && facts->name.starts_with("ETC1S"); }

/// Returns the approximate RMS angular error, in degrees, of vectors compressed as lossy WebP. The error along a vector
/// is visible as a deviation from unit length, and the errors in the two directions across it are equally large. On
/// five kinds of maps, at qualities of 50 to 98, the estimate is 0.67 to 1.10 times the true error.
double webpDegrees(const RgbImage& image) {
    double sum = 0;
    for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3) {
        const auto part = [&](std::size_t k) { return image.rgb[i + k] / 127.5 - 1; };
        const double off = length(DVec3{part(0), part(1), part(2)}) - 1;
        sum += off * off;
    }
    return 180 / kPi * std::sqrt(2 * sum / std::max(1.0, static_cast<double>(image.rgb.size() / 3)));
}

/// Returns the approximate RMS angular error, in degrees, of vectors compressed as ETC1S. A block has one color at
/// several brightnesses, so it keeps only the component along gray. If x and y are independent with variance s, the
/// gray value (x + y + z) / sqrt(3) has the variance g = 2/3 s, and the lost part of x and y has the variance 10/9 s.
/// Rounding the color to 5 bits adds 0.9 degrees on flat areas. On ten kinds of maps, compressed by basisu at two
/// qualities, the estimate is 0.77 to 1.05 times the true error.
double etc1sDegrees(const RgbImage& image) {
    constexpr std::size_t kBlock = 4;
    constexpr double kLostOfKept = 10.0 / 9 / (2.0 / 3), kRoundedDeg = 0.9;
    double sum = 0, count = 0;
    for (std::size_t top = 0; top + kBlock <= image.height; top += kBlock) {
        for (std::size_t left = 0; left + kBlock <= image.width; left += kBlock) {
            double sums = 0, squares = 0;
            for (std::size_t k = 0; k < kBlock * kBlock; ++k) {
                const std::size_t at = 3 * ((top + k / kBlock) * image.width + left + k % kBlock);
                const double gray = (image.rgb[at] + image.rgb[at + 1] + image.rgb[at + 2]) / (127.5 * std::sqrt(3.0));
                sums += gray;
                squares += gray * gray;
            }
            sum += squares - sums * sums / (kBlock * kBlock);
            count += kBlock * kBlock;
        }
    }
    const double lost = 180 / kPi * std::sqrt(kLostOfKept * std::max(0.0, sum) / std::max(1.0, count));
    return std::sqrt(lost * lost + kRoundedDeg * kRoundedDeg);
}

void examine(const Scene& scene, const CheckOptions& options, NormalMap& map) {
    const SceneImage& image = scene.images[map.image];
    if (image.bytes.empty()) {
        map.why_not = image.why_empty;
        return;
    }
    const std::uint64_t bytes = workBytes(scene, map);
    if (scene.memory && !scene.memory->has(bytes)) {
        map.why_not = "it " + scene.memory->whyNot(bytes);
        return;
    }
    std::optional<RgbImage> decoded = decodeImage(image.bytes, options.most_pixels, map.why_not);
    if (!decoded) return;
    map.not_finite = decoded->not_finite;
    map.layer_text = decoded->layer_text;
    TexelMask inside(decoded->width, decoded->height);
    std::uint64_t steps = kCoverSteps;
    for (const MapPart& part : map.parts) cover(part, inside, steps);
    if (map.parts.empty()) inside.fillAll();
    if (isLossyWebp(image.bytes)) map.packing_deg = webpDegrees(*decoded);
    if (isEtc1s(textureFacts(image.bytes))) map.packing_deg = etc1sDegrees(*decoded);
    analyzeContent(scene, inside, map, *decoded);
    map.test = GreenTest{};
    if (!holdsNormals(map.analysis.content)) return;
    const GreenBlocks blocks(*decoded, inside);
    map.test = blocks.all();
    examineParts(blocks, std::move(inside), map);
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

/// Returns the part of the map that a finding names: the first part whose verdict is `down` or `mixed`, otherwise the
/// first part.
const MapPart& partOf(const NormalMap& map) {
    for (const MapPart& part : map.parts) {
        if (part.test.verdict == GreenVerdict::down || part.test.verdict == GreenVerdict::mixed) return part;
    }
    return map.parts.front();
}

Finding unreadable(const std::string& name, const std::string& why_not) {
    return makeFinding(FindingCode::normalMapUnreadable, Severity::note, Tally::all(1), "images",
                       {.cause = "the normal map " + name + " was not examined: " + why_not});
}

Finding flipped(const std::string& name, const GreenTest& test) {
    const Tally blocks{.count = test.down_block_count, .total = test.block_count};
    return makeFinding(FindingCode::greenFlipped, Severity::warning, blocks, "blocks",
                       {.symptom = "bumps probably look like dents",
                        .cause = "red or green is inverted in the normal map " + name +
                                 "; nearly always it is green, which then points down as in DirectX. Found in " +
                                 countText(blocks, "blocks") + " of 16 x 16 pixels with relief"});
}

Finding mixed(const std::string& name, const GreenTest& test) {
    const Tally blocks{.count = test.down_block_count, .total = test.block_count};
    return makeFinding(
        FindingCode::greenMixed, Severity::warning, blocks, "blocks",
        {.symptom = "bumps probably look like dents in one part",
         .cause = "green seems to point down in one part of the normal map " + name + " (" + rectText(test.down_part) +
                  " from the top left) and up in another (" + rectText(test.up_part) + "): green points down in " +
                  countText(blocks, "blocks") + " of 16 x 16 pixels with relief (" + shareText(blocks.share()) + ")"});
}

NamedImage namedImage(const Scene& scene, const NormalMap& map) {
    const std::string& uri = scene.images[map.image].uri;
    const bool is_word = uri.find_first_of(" '\"%\\$`&;|<>()*?[]{}~#!") == std::string::npos;
    return {imageName(scene, map.image), uri.empty() || !is_word ? kUnnamed : uri,
            map.parts.empty() || map.is_of_unknown};
}

bool isDown(const NormalMap& map) { return map.test && map.test->verdict == GreenVerdict::down; }

/// Returns whether all uses of the map declare that green points down, so that readers of the file invert it
/// themselves.
bool isDeclared(const NormalMap& map) {
    return !map.parts.empty() && std::all_of(map.parts.begin(), map.parts.end(),
                                             [](const MapPart& part) { return part.use->is_declared_down; });
}

bool mayBeHeights(const NormalMap& map) {
    return !map.parts.empty() && std::all_of(map.parts.begin(), map.parts.end(),
                                             [](const MapPart& part) { return part.use->may_be_heights; });
}

bool readsLevels(const NormalMap& map) {
    return std::any_of(map.parts.begin(), map.parts.end(), [](const MapPart& part) { return part.use->reads_levels; });
}

/// Reports texels that are not finite, and layers that were not read. `conversion`: the remedy that converts the image.
void describeReading(const Scene& scene, const NormalMap& map, const std::string& name, Remedy conversion,
                     std::vector<Finding>& findings) {
    if (map.not_finite > 0) {
        const Tally texels{.count = map.not_finite, .total = claimedSize(scene.images[map.image].bytes).pixels()};
        findings.push_back(makeFinding(FindingCode::fileRemark, Severity::warning, texels, "texels",
                                       {.cause = "the normal map " + name + ": " + notFiniteText(map.not_finite)}));
        conversion.text =
            "Find the program that wrote NaN or infinity, and export the map again; or keep the filled "
            "texels. " +
            conversion.text;
        setRemedy(findings.back(), std::move(conversion));
    }
    if (map.layer_text.empty()) return;
    findings.push_back(makeFinding(FindingCode::fileRemark, Severity::note, Tally::all(1), "images",
                                   {.cause = "the normal map " + name + ": " + map.layer_text}));
    setRemedy(findings.back(), Remedy{"No action is needed if these channels are the normal map. Otherwise export the "
                                      "layer of the normal map alone.",
                                      {}});
}

/// Reports how the file stores the map: lossy compression, declared sRGB, and missing mip levels. `conversion`: the
/// remedy that converts the map.
void describeStorage(const Scene& scene, const NormalMap& map, const std::string& name, const Remedy& conversion,
                     std::vector<Finding>& findings) {
    const SceneImage& image = scene.images[map.image];
    const std::optional<TextureFacts> facts = textureFacts(image.bytes);
    const MapContent content = map.analysis.content;
    const auto add = [&](FindingCode code, Severity severity, std::string text) -> Finding& {
        return findings.emplace_back(makeFinding(code, severity, Tally::all(1), "images",
                                                 {.cause = "the normal map " + name + std::move(text)}));
    };
    if (isEtc1s(facts) || isLossyWebp(image.bytes)) {
        std::string text =
            isEtc1s(facts) ? " is " + facts->name + ", which stores a color and four brightness levels per 4 x 4 texels"
                           : " is a lossy WebP, which stores colors at half the width and height";
        if (content == MapContent::normals)
            text += std::string(isEtc1s(facts) ? ", so" : "; judging by the lengths of its vectors,") +
                    " its texels are off by about " +
                    shortNumber(std::max(0.1, std::round(10 * map.packing_deg) / 10)) +
                    " degrees (root mean square error" +
                    (isEtc1s(facts) ? "; in our measurements UASTC has at most a third of that error)"
                                    : "; a lossless 8-bit image: 0.2)");
        add(FindingCode::normalMapLossy, Severity::note, std::move(text));
    }
    if (!facts) return;
    if (map.analysis.is_marked_srgb) {
        Finding& finding = add(FindingCode::normalMapIsSrgb, Severity::warning,
                               " (" + facts->name +
                                   ") is declared as sRGB, but its values are linear: renderers that follow the "
                                   "declaration, such as three.js, tilt all its normals");
        setRemedy(finding,
                  {"Compress the texture again as linear, or use a PNG. " + conversion.text, conversion.commands});
    }
    if (facts->has_blocks && facts->level_count == 1 && claimedSize(image.bytes).pixels() > 1 && readsLevels(map))
        add(FindingCode::normalMapLevels, Severity::note,
            " (" + facts->name +
                ") is block-compressed and has no mip levels, which renderers cannot generate for compressed blocks: "
                "the relief flickers in the distance");
}

/// Returns the findings on the content of the channels and on green.
std::vector<Finding> describe(const Scene& scene, const NormalMap& map) {
    const std::string name = imageName(scene, map.image);
    std::vector<Finding> findings;
    if (!map.test) {
        findings.push_back(unreadable(name, map.why_not));
        if (scene.images[map.image].is_unavailable) {
            findings.back().severity = Severity::warning;
            // An unavailable image has a URI in the file; SceneImage::uri is empty if that is a data URI.
            setRemedy(findings.back(),
                      scene.images[map.image].uri.empty()
                          ? "Embed the image again: its data URI is broken."
                          : "Put the image where the model references it, or correct its path in the model.");
        }
    } else {
        const bool has_own_green = hasOwnGreen(map.analysis.layout);
        const std::optional<TextureFacts> facts = textureFacts(scene.images[map.image].bytes);
        const NamedImage named = namedImage(scene, map);
        const bool green_is_down = isDown(map) && !(has_own_green && isDeclared(map));
        std::optional<Finding> content = contentFinding(named, map.analysis, green_is_down);
        if (content && facts) extendCause(*content, " (format: " + facts->name + ")");
        if (content && map.analysis.content == MapContent::height && mayBeHeights(map)) {
            content->severity = Severity::note;
            content->message = content->cause = name + " is a height map (map_bump), not a normal map";
            setRemedy(*content, {"No action is needed: generate makes a normal map from it, with -bm as its height in "
                                 "model units. To convert the image alone: {}.",
                                 {toCommand("height-to-normal MAP -o OUT.png --strength S")}});
        }
        if (content) findings.push_back(*std::move(content));
        if (has_own_green && isDown(map) && !isDeclared(map)) {
            findings.push_back(flipped(name, *map.test));
            setRemedy(findings.back(), greenRemedy(named, map.analysis));
        }
        if (map.test->verdict == GreenVerdict::mixed) findings.push_back(mixed(name, *map.test));
        NamedImage alone = named;
        alone.is_alone = true;
        describeReading(scene, map, name, conversionRemedy(alone, map.analysis, green_is_down), findings);
        describeStorage(scene, map, name, conversionRemedy(named, map.analysis, green_is_down), findings);
        for (Finding& finding : findings) {
            if (finding.unit == "blocks") finding.confidence = map.test->confidence();
        }
    }
    if (map.parts.empty()) return findings;
    const MapPart& part = partOf(map);
    for (Finding& finding : findings) {
        placeAt(*part.primitive, part.use->place, finding);
        if (!map.is_of_unknown) continue;
        finding.severity = Severity::note;
        extendCause(finding, " (the map was checked like a normalTexture, because only " + part.use->needed_by +
                                 ", which tspace does not know, uses it)");
    }
    return findings;
}

GreenSide sideOf(const NormalMap& map, const GreenTest& test) {
    if (!hasOwnGreen(map.analysis.layout)) return GreenSide::unknown;
    const bool is_declared = isDeclared(map);
    switch (test.verdict) {
        case GreenVerdict::up: return is_declared ? GreenSide::down : GreenSide::up;
        case GreenVerdict::down: return is_declared ? GreenSide::up : GreenSide::down;
        case GreenVerdict::mixed: return GreenSide::mixed;
        case GreenVerdict::unknown: break;
    }
    return GreenSide::unknown;
}

}  // namespace

ImageFindings checkImages(const Scene& scene, const CheckOptions& options) {
    std::vector<NormalMap> maps = collectNormalMaps(scene);
    Parallel parallel(options.execution);
    workTogether(
        scene.memory.get(), maps.size(), parallel, [&](std::size_t i) { return workBytes(scene, maps[i]); },
        [&](std::size_t i) { examine(scene, options, maps[i]); });
    ImageFindings result;
    result.image_green.assign(scene.images.size(), GreenSide::noMap);
    result.primitive_green.assign(scene.primitives.size(), GreenSide::noMap);
    result.analyses.resize(scene.images.size());
    result.is_y_inverted.resize(scene.images.size());
    result.is_declared.resize(scene.images.size());
    for (const NormalMap& map : maps) {
        result.examined_count += map.test.has_value();
        result.green_known_count += map.test && map.test->verdict != GreenVerdict::unknown;
        // No verdict on tangents or on other maps depends on maps of unknown extensions, and generate keeps them.
        if (!map.is_of_unknown) {
            result.analyses[map.image] = map.analysis;
            result.is_y_inverted[map.image] = isDown(map) && !hasOwnGreen(map.analysis.layout);
            result.is_declared[map.image] = isDeclared(map);
            result.image_green[map.image] = map.test ? sideOf(map, *map.test) : GreenSide::unread;
        }
        for (const MapPart& part : map.parts) {
            for (const std::size_t primitive : part.followers)
                result.primitive_green[primitive] = map.test ? sideOf(map, part.test) : GreenSide::unread;
        }
        for (Finding& finding : describe(scene, map)) {
            result.findings.push_back(std::move(finding));
            result.images.push_back(map.image);
        }
    }
    return result;
}

LoneMap checkLoneMap(const Scene& scene, const CheckOptions& options) {
    NormalMap map;
    examine(scene, options, map);
    if (!map.test) failFile(ErrorCode::invalidFile, map.why_not);
    LoneMap lone{.analysis = map.analysis, .test = *map.test, .findings = describe(scene, map)};
    lone.pixels = *decodeImage(scene.images[0].bytes, options.most_pixels, map.why_not);
    return lone;
}

std::vector<Finding> checkMapScales(const Scene& scene) {
    std::vector<Finding> findings;
    std::set<std::string> places;
    for (const ScenePrimitive& primitive : scene.primitives) {
        for (const TangentUse& use : primitive.uses) {
            if (use.needed_by == "anisotropy" || use.scale > 0 || !places.insert(use.place).second) continue;
            findings.push_back(makeFinding(
                FindingCode::normalMapScale, Severity::note, Tally::all(1), "textures",
                use.scale == 0
                    ? FindingText{.symptom = "no bumps are visible", .cause = "the scale of the normal map is 0"}
                    : FindingText{.symptom = "bumps look like dents",
                                  .cause = "the scale of the normal map is negative, which inverts red and green"}));
            placeAt(primitive, use.place, findings.back());
        }
    }
    return findings;
}

}  // namespace tspace
