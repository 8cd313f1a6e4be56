// SPDX-License-Identifier: MIT
// bakeFile: reads, bakes, and writes maps and their pictures; its report as JSON. The steps of baking, in the order of
// this file:
//
//   1. setLimits, checkOutput, checkOutMesh: what the options and the names of outputs allow
//   2. noteNoise: a warning about the positions of the high poly
//   3. bakedPart, beyondEdges: which triangles of an image of the low poly are baked
//   4. bakeImage: the maps of an image or UDIM tile, with findings and warnings
//   5. bakeTiles: all tiles of an image
//   6. bakeModels: all images, then the model with its maps
#include "tspace/bake_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "commands/bake/all_maps.h"
#include "commands/bake/bake_outputs.h"
#include "commands/bake/bake_report.h"
#include "commands/bake/bake_step.h"
#include "commands/bake/model_surfaces.h"
#include "commands/compress_map/pack_texture.h"
#include "commands/shared/map_image_file.h"
#include "commands/shared/reportable_noise.h"
#include "core/base/numbers.h"
#include "images/float_image.h"
#include "maps/rays/map_surfaces.h"
#include "maps/rays/missed_cause.h"
#include "model/io/atomic_output.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/output_name.h"

namespace tspace {
namespace {

/// Encodes an image as TGA or PNG, chosen by the extension of `name` (default: PNG).
std::vector<std::uint8_t> imageFileOf(const std::string& name, std::uint32_t width, std::uint32_t height,
                                      std::vector<Vec3> texels, unsigned bits) {
    std::optional<std::vector<std::uint8_t>> file =
        encodeByName(name, {.width = width, .height = height, .bits = bits, .texels = std::move(texels)}, bits);
    if (!file) failFile(ErrorCode::unsupportedFile, "this build of tspace cannot write PNG");
    return *std::move(file);
}

std::vector<std::uint8_t> pngOf(std::uint32_t width, std::uint32_t height, std::vector<Vec3> texels, unsigned bits) {
    return imageFileOf(".png", width, height, std::move(texels), bits);
}

/// State that all steps of a bake share.
struct FileBaking {
    const std::string& output;
    std::string high = {};
    bool is_without_map = false;  ///< all rays of an image missed
    BakeFileOptions options;
    const BakeStep& step;
    BakeModels models = {};
    SharedRays shared = {};                 ///< rays on the high poly, shared by all images
    std::optional<HighDetail> detail = {};  ///< attributes of the high poly; refers to `models`
    AtomicOutput& files = step.map_files;
    std::vector<ModelMap> maps = {};
    BakeFileReport report = {};
};

// -- 1. checks --

void setLimits(FileBaking& state) {
    state.step.inputs.watch(state.options.file);
    state.options.map.reading.two_channels = state.options.map.reading.two_channels || state.options.unit;
    // The memory depends on the size of the map, which is an option, so the default limit is not derived from the
    // input.
    constexpr std::uint64_t kUsualLimit = std::uint64_t{16} << 30;
    std::uint64_t& limit = state.options.map.memory_limit_bytes;
    if (limit == 0) limit = state.options.file.memory_limit_bytes;
    if (limit == 0) limit = kUsualLimit;
}

/// Checks the extension of the output, and sets the bits per channel: 8 for .tga; 16 for a texture, whose blocks are
/// fitted to the filtered texels.
void checkOutput(FileBaking& state) {
    if (lowerExtension(state.output) == ".png") return;
    if (isTgaName(state.output)) {
        if (!state.options.out_mesh.empty())
            failFile(ErrorCode::invalidOption, "a glTF model cannot contain a TGA; bake a .png to use --out-mesh");
        state.options.map.bits = 8;
        return;
    }
    if (!isTextureName(state.output)) failEnding(state.output, {".png", ".tga", ".ktx2", ".dds"});
    if (!state.options.layers.layers.empty() || !state.options.layers.has_normal)
        failFile(ErrorCode::invalidOption, "maps other than the normal map can only be written as .png");
    if (!state.options.out_mesh.empty())
        failFile(ErrorCode::invalidOption,
                 "a glTF model cannot contain a two-channel texture; bake a .png to use --out-mesh");
    if (state.options.map.space == MapSpace::object)
        failFile(ErrorCode::invalidOption, "two-channel textures can only store normals in tangent space; bake a .png");
    state.options.map.bits = 16;
}

/// If a model is written, rejects options that glTF does not allow for normal maps.
void checkOutMesh(const FileBaking& state) {
    if (state.options.out_mesh.empty()) return;
    if (!isGltfName(state.options.out_mesh)) failEnding(state.options.out_mesh, {".glb", ".vrm", ".gltf"});
    if (state.options.udim)
        failFile(ErrorCode::invalidOption,
                 "a glTF model has one image per material and cannot use UDIM tiles; --out-mesh and --udim cannot "
                 "be combined");
    if (state.options.map.space == MapSpace::object)
        failFile(ErrorCode::invalidOption,
                 "normal maps of glTF models must be in tangent space; --out-mesh requires --space tangent");
    if (state.options.map.reading.green == Green::down)
        failFile(ErrorCode::invalidOption,
                 "green must point up in the normal maps of glTF models; use another --convention with --out-mesh");
}

// -- 2. noise --

void noteNoise(FileBaking& state) {
    const HighPoly high = state.models.high.view();
    MeshView mesh;
    mesh.positions = high.positions;
    mesh.indices = high.corners;
    if (const double noise = reportableNoise(mesh, state.models.high.position_step); noise > 0)
        state.report.warnings.push_back(
            "the positions of the high poly are noisy (" + shortNumber(noise) +
            " of an edge length), and the map shows this noise; use --denoise auto to bake normals without it");
}

// -- 3. triangles --

std::string nameOf(const LowModel::Image& image) {
    return image.material.empty() ? "the low poly" : inQuotes(image.material);
}

/// Returns the part to bake. Triangles outside the 0-1 UV range are only added to its rest (LowPoly::rest_positions);
/// `outside` receives their number. Triangles with non-finite UVs stay in the part, and the bake counts them.
LowPart bakedPart(FileBaking& state, const LowModel::Image& image, std::uint64_t& outside) {
    const auto isOutside = [&](std::size_t triangle) {
        const Vec2* const uvs = &image.part.corners.uvs[3 * triangle];
        const float u = uvs[0].x + uvs[1].x + uvs[2].x, v = uvs[0].y + uvs[1].y + uvs[2].y;
        // A clamped texture does not repeat, so triangles beyond its edge are not offset copies of others.
        const auto isBeside = [](TextureWrap wrap, float sum) {
            return wrap != TextureWrap::clamp && (sum < 0 || sum > 3);
        };
        return std::isfinite(u + v) && (isBeside(image.wrap_u, u) || isBeside(image.wrap_v, v));
    };
    const std::size_t count = image.part.triangleCount();
    for (std::size_t i = 0; !state.options.wrap && i < count; ++i) outside += isOutside(i) ? 1 : 0;
    if (outside == count) {
        state.report.warnings.push_back("all triangles of " + nameOf(image) +
                                        " lie outside the 0-1 UV range and were baked as with --wrap");
        outside = 0;
    }
    if (outside == 0) return image.part;
    state.report.warnings.push_back(std::to_string(outside) + " of " + std::to_string(count) + " triangles of " +
                                    nameOf(image) +
                                    " lie outside the 0-1 UV range and were ignored, because they are assumed to be "
                                    "offset copies; use --wrap to bake them too, or --udim to write one file per tile");
    LowPart part;
    for (std::size_t i = 0; i < count; ++i) {
        if (isOutside(i)) {
            part.addToRest(image.part, i);
        } else {
            part.addTriangle(image.part, i);
        }
    }
    return part;
}

/// Returns the number of triangles that extend more than half a texel beyond a clamped image.
std::size_t beyondEdges(const FileBaking& state, const LowModel::Image& image, const LowPart& part) {
    const auto isBeyond = [](TextureWrap wrap, float at, std::uint32_t size) {
        return wrap == TextureWrap::clamp && std::fabs(at - 0.5F) > 0.5F + 0.5F / static_cast<float>(size);
    };
    std::size_t count = 0;
    const std::vector<Vec2>& uvs = part.corners.uvs;
    for (auto corner = uvs.begin(); corner != uvs.end(); corner += 3) {
        count += std::any_of(corner, corner + 3, [&](const Vec2& uv) {
            return isBeyond(image.wrap_u, uv.x, state.options.map.width) ||
                   isBeyond(image.wrap_v, uv.y, state.options.map.height);
        });
    }
    return count;
}

// -- 4. one image --

/// Adds a finding with the cause if the map is unusable.
void findCause(FileBaking& state, const BakedFile& file, const LowPart& part) {
    const BakedMap& map = file.map;
    const auto add = [&](const std::string& what, const std::string& why) {
        state.report.findings.push_back(pathInQuotes(state.high) + ": " + what + (why.empty() ? "" : "; " + why));
    };
    constexpr std::uint64_t kFew = 50;  // "few" means fewer than one in 50
    if (map.missed_count > map.hit_count) {
        add("the rays of " + std::to_string(map.missed_count) + " of " +
                std::to_string(map.missed_count + map.hit_count) + " texels of " + pathInQuotes(file.path) +
                " did not hit any front face of the high poly" + (map.hit_count == 0 ? ", so no map was written" : ""),
            causeOfMisses(part.view(), state.models.high.view(), *state.shared.surface, map.error.reach));
    } else if (2 * map.error.inward_count > map.error.point_count) {
        add("the normals of the high poly point inward, opposite to its faces, at " +
                std::to_string(map.error.inward_count) + " of " + std::to_string(map.error.point_count) + " samples",
            "");
    } else if (kFew * map.missed_count > map.hit_count) {
        const std::string why = likelyPlacementOf(part.view(), state.models.high.view(), *state.shared.surface);
        if (!why.empty())
            add("the rays of " + std::to_string(map.missed_count) + " texels of " + pathInQuotes(file.path) +
                    " did not hit any front face of the high poly",
                why);
    }
}

/// Adds a map to the outputs, or to the model that is written with it.
void addMap(FileBaking& state, const std::string& path, const std::vector<std::uint8_t>& png,
            std::optional<MapSlot> slot, const LowModel::Image& image) {
    // A new bake may overwrite the map that the low poly references.
    state.step.inputs.allowReplacing(path);
    if (state.options.out_mesh.empty() || !slot) {
        state.files.add(path, png);
    } else {
        state.maps.push_back(
            {path, Bytes(png.begin(), png.end()), image.primitives, image.wrap_u, image.wrap_v, *slot});
    }
}

/// Encodes the normal map, and frees its texels.
std::vector<std::uint8_t> takeNormalFile(const FileBaking& state, BakedMap& map) {
    std::vector<Vec3> texels = std::exchange(map.texels, {});
    if (isTextureName(state.output))
        return packTexture(state.output, map.width, map.height, texels, state.options.execution);
    return imageFileOf(state.output, map.width, map.height, std::move(texels), map.bits);
}

/// Returns the texture slot of a glTF material for a layer. If `ao` and `orm` are both baked, red of `orm` is the
/// occlusion, so one image is used for both slots.
std::optional<MapSlot> slotOf(const FileBaking& state, MapLayer layer) {
    switch (layer) {
        case MapLayer::ao:
            return shows(state.options.layers, MapLayer::orm) ? std::nullopt : std::optional(MapSlot::occlusion);
        case MapLayer::orm:
            return shows(state.options.layers, MapLayer::ao) ? MapSlot::occlusion_and_metal : MapSlot::metal;
        case MapLayer::color: return MapSlot::color;
        case MapLayer::emission: return MapSlot::emission;
        default: return {};
    }
}

void addLayers(FileBaking& state, const LowModel::Image& image, const std::string& suffix,
               std::vector<BakedLayer>& layers, BakedFile& file) {
    for (BakedLayer& layer : layers) {
        const std::string& base = state.step.layers_output.empty() ? state.output : state.step.layers_output;
        BakedLayerFile made{.path = withSuffix(withLayer(base, layer.layer), suffix)};
        const std::vector<std::uint8_t> png =
            layerPng(layer, file.map, state.options.map.bits, state.models.low.origin, made);
        if (layer.layer == MapLayer::id) {
            made.id_count = state.detail->idCount();
            made.ids = state.detail->ids();
        }
        addMap(state, made.path, png, slotOf(state, layer.layer), image);
        file.layers.push_back(std::move(made));
    }
}

/// Warns about surfaces that rays with the settings of the bake did not hit.
void warnOfRays(FileBaking& state, const BakedFile& file) {
    const MapError& own = file.map.own_error;
    if (own.hidden_count == 0) return;
    state.report.warnings.push_back(
        "at " + std::to_string(own.hidden_count) + " of " + std::to_string(own.point_count + own.missed_count) +
        " samples, another front face of the high poly lies farther out and hides the surface that was baked into " +
        pathInQuotes(file.path) + "; use --rays outermost to bake the outer one");
}

void bakeImage(FileBaking& state, const LowModel::Image& image, const std::string& suffix, std::uint32_t tile,
               const LowPart& part, std::uint64_t outside = 0) {
    BakeOptions options = state.options.map;
    options.heat = options.heat || !state.options.heat.empty();
    if (!state.options.udim) {
        options.wrap_u = image.wrap_u;
        options.wrap_v = image.wrap_v;
    }
    options.rays = state.models.rays(options.rays, options.wrap_u, options.wrap_v);
    BakedMaps maps = tagInput(BakeInput::low, [&] {
        return valueOrThrow(bakeAllowingMisses(part.view(), state.models.high.view(), options, state.detail->layers(),
                                               state.options.execution, state.options.progress, state.shared));
    });
    BakedFile file{
        .path = state.options.layers.has_normal ? withSuffix(state.output, suffix) : "",
        .material = image.material,
        .tile = tile,
        .triangle_count = part.triangleCount(),
        .outside_count = outside,
        .rays = {options.rays.target, options.rays.directions, !options.rays.skew.texels.empty(), !part.cage.empty()},
        .map = std::move(maps.normal)};
    BakedMap& map = file.map;
    findCause(state, file, part);
    if (map.hit_count == 0) {
        state.is_without_map = true;
        map.origins = {};
        map.overlaps = {};
        state.report.files.push_back(std::move(file));
        return;
    }
    if (state.options.layers.has_normal) addMap(state, file.path, takeNormalFile(state, map), MapSlot::normal, image);
    addLayers(state, image, suffix, maps.layers, file);
    if (!state.options.misses.empty())
        state.files.add(withSuffix(state.options.misses, suffix),
                        pngOf(map.width, map.height, pictureOfOrigins(map), 8));
    if (!state.options.heat.empty()) {
        file.heat_top_deg = map.error.p99_deg;
        state.files.add(withSuffix(state.options.heat, suffix),
                        pngOf(map.width, map.height, pictureOfHeat(map.error.heat, file.heat_top_deg), 8));
    }
    map.origins = {};
    map.overlaps = {};
    map.error.heat = {};
    warnOfRays(state, file);
    state.report.files.push_back(std::move(file));
}

// -- 5. tiles --

void bakeTiles(FileBaking& state, const LowModel::Image& image, const std::string& suffix) {
    const auto addOtherImages = [&](LowPart& part) {
        for (const LowModel::Image& other : state.models.low.images) {
            for (std::size_t i = 0; &other != &image && i < other.part.triangleCount(); ++i)
                part.addToRest(other.part, i);
        }
    };
    if (!state.options.udim) {
        std::uint64_t outside = 0;
        LowPart part = bakedPart(state, image, outside);
        if (const std::size_t count = beyondEdges(state, image, part))
            state.report.warnings.push_back(report::counted(count, "triangle") + (count == 1 ? " extends" : " extend") +
                                            " beyond the texture of " + nameOf(image) +
                                            ", whose wrap mode is clamp, so its edge texels show there");
        addOtherImages(part);
        bakeImage(state, image, suffix, 0, part, outside);
        return;
    }
    std::map<std::uint32_t, LowPart> tiles;
    std::uint64_t outside = 0;
    for (std::size_t i = 0; i < image.part.triangleCount(); ++i) {
        const std::uint32_t tile = tileOf(&image.part.corners.uvs[3 * i]);
        if (tile == 0) {
            ++outside;
            continue;
        }
        LowPart& part = tiles[tile];
        part.addTriangle(image.part, i);
        std::vector<Vec2>& uvs = part.corners.uvs;
        for (auto uv = uvs.end() - 3; uv != uvs.end(); ++uv) {
            uv->x -= static_cast<float>((tile - 1001) % 10);
            uv->y += static_cast<float>((tile - 1001) / 10);
        }
    }
    if (outside > 0)
        state.report.warnings.push_back("ignored " + report::counted(outside, "triangle") + " outside all UDIM tiles");
    if (tiles.empty()) failFile(ErrorCode::missingAttribute, "the UVs of the low poly are outside all UDIM tiles");
    for (auto& [tile, part] : tiles) {
        for (std::size_t i = 0; i < image.part.triangleCount(); ++i) {
            if (tileOf(&image.part.corners.uvs[3 * i]) != tile) part.addToRest(image.part, i);
        }
        addOtherImages(part);
        bakeImage(state, image, tileSuffix(suffix, tile), tile, part);
    }
}

// -- 6. models --

BakeFileReport bakeModels(FileBaking& state, const std::string& low, const std::string& high) {
    setLimits(state);
    state.high = high;
    checkOutput(state);
    checkOutMesh(state);
    requireEndingIfAny(state.options.misses, {".png"});
    requireEndingIfAny(state.options.heat, {".png"});
    if (!state.options.layers.has_normal && !state.options.heat.empty())
        failFile(ErrorCode::invalidOption, "--heat requires the normal map; add normal to --maps");
    if (Error error = checkBakeOptions(state.options.map, 0, 0); error.code != ErrorCode::ok) throw FileError{error};
    state.models = readBakeModels(low, high, state.options, state.step.sources);
    state.report.frames_made = state.models.low.frames_made;
    state.report.matched_by_name = state.models.matched_by_name;
    state.report.low_triangle_count = state.models.low.triangleCount();
    state.report.high_triangle_count = state.models.high.triangleCount();
    state.report.warnings = state.models.low.warnings;
    state.report.warnings.insert(state.report.warnings.end(), state.models.high.warnings.begin(),
                                 state.models.high.warnings.end());
    state.report.high_maps = state.models.high.shown.reports;
    if (state.options.denoise == 0 && state.step.notes_noise) noteNoise(state);
    state.options.map.reach = state.models.reach(state.options.map.reach);
    tagInput(BakeInput::high, [&] { return &state.detail.emplace(state.models, high, state.options); });
    const std::vector<std::string>& seen = state.detail->warnings();
    state.report.warnings.insert(state.report.warnings.end(), seen.begin(), seen.end());
    const std::vector<std::string> suffixes = imageSuffixes(state.models.low);
    for (std::size_t i = 0; i < suffixes.size(); ++i) bakeTiles(state, state.models.low.images[i], suffixes[i]);
    if (!state.options.out_mesh.empty() && !state.is_without_map)
        addModelWithMaps({*std::move(state.models.low_model), state.options.out_mesh, std::move(state.maps)},
                         state.step.model_files, state.files, state.report.warnings);
    if (!state.is_without_map) state.report.output_files = state.files.files();
    return std::move(state.report);
}

}  // namespace

Result<BakeFileReport> bakeFile(const std::string& low, const std::string& high, const std::string& output,
                                const BakeFileOptions& options) {
    return atFileBorder([&]() -> Result<BakeFileReport> {
        InputFiles inputs;
        AtomicOutput files({.sync = options.file.sync, .inputs = &inputs});
        const BakeStep whole{.inputs = inputs, .map_files = files, .model_files = files};
        BakeFileReport report = bakeAsStep(low, high, output, options, whole);
        if (!report.output_files.empty()) files.commit();
        return report;
    });
}

BakeFileReport bakeAsStep(const std::string& low, const std::string& high, const std::string& output,
                          const BakeFileOptions& options, const BakeStep& step) {
    FileBaking state{.output = output, .options = options, .step = step};
    return bakeModels(state, low, high);
}

std::vector<Vec3> pictureOfOrigins(const BakedMap& map) {
    constexpr Vec3 kBackground{0, 0, 0}, kPadding{0.1F, 0.25F, 0.15F}, kHit{0.2F, 0.6F, 0.3F}, kMissed{1, 0.1F, 0.1F},
        kOverlap{1, 0.85F, 0.1F};
    std::vector<Vec3> picture;
    picture.reserve(map.origins.size());
    for (std::size_t i = 0; i < map.origins.size(); ++i) {
        switch (map.origins[i]) {
            case TexelOrigin::background: picture.push_back(kBackground); break;
            case TexelOrigin::padding: picture.push_back(kPadding); break;
            case TexelOrigin::hit: picture.push_back(map.overlaps[i] ? kOverlap : kHit); break;
            case TexelOrigin::missed: picture.push_back(kMissed); break;
        }
    }
    return picture;
}

std::vector<Vec3> pictureOfHeat(const std::vector<float>& heat, double top_deg) {
    constexpr std::array<Vec3, 5> kRamp{
        {{0, 0, 0}, {0.2F, 0.1F, 0.6F}, {0.85F, 0.15F, 0.3F}, {1, 0.75F, 0.1F}, {1, 1, 1}}};
    constexpr Vec3 kNothing{0.2F, 0.2F, 0.2F};
    std::vector<Vec3> picture;
    picture.reserve(heat.size());
    for (const float degrees : heat) {
        if (degrees < 0) {
            picture.push_back(kNothing);
            continue;
        }
        const double part = top_deg > 0 ? std::clamp(static_cast<double>(degrees) / top_deg, 0.0, 1.0) : 0;
        const double place = part * (kRamp.size() - 1);
        const std::size_t step = std::min<std::size_t>(static_cast<std::size_t>(place), kRamp.size() - 2);
        const auto rest = static_cast<float>(place - static_cast<double>(step));
        const Vec3 &a = kRamp[step], &b = kRamp[step + 1];
        picture.push_back({a.x + rest * (b.x - a.x), a.y + rest * (b.y - a.y), a.z + rest * (b.z - a.z)});
    }
    return picture;
}

}  // namespace tspace

namespace tspace::report {

// Baked maps as JSON.

Json errorOfMapJson(const MapError& error) {
    return {{"points", error.point_count},
            {"missed", error.missed_count},
            {"hidden", error.hidden_count},
            {"backs", error.back_count},
            {"inward", error.inward_count},
            {"meanDeg", error.mean_deg},
            {"metMeanDeg", error.met_mean_deg},
            {"p99Deg", error.p99_deg},
            {"maxDeg", error.max_deg},
            {"seamPoints", error.seam_point_count},
            {"seamMeanDeg", error.seam_mean_deg},
            {"insideMeanDeg", error.inside_mean_deg}};
}

Json highMapJson(const BakedHighMap& map) {
    return {{"image", map.image},
            {"material", map.material},
            {"scale", map.scale},
            {"green", map.green == Green::down ? "down" : "up"},
            {"greenIs", greenSourceWord(map.green_is)},
            {"triangles", map.triangle_count}};
}

const char* greenSourceWord(GreenSource source) {
    static constexpr const char* kWords[] = {"assumed", "told", "declared", "seen"};
    return kWords[static_cast<std::size_t>(source)];
}

const char* raysWord(const UsedRays& rays) {
    if (rays.has_cage) return "cage";
    return rays.target == RayTarget::nearest ? "nearest" : "outermost";
}

const char* directionsWord(const UsedRays& rays) {
    if (rays.has_cage) return "cage";
    if (rays.has_skew) return "skew";
    switch (rays.directions) {
        case RayDirections::automatic: return "auto";
        case RayDirections::averaged: return "averaged";
        case RayDirections::normals: break;
    }
    return "normals";
}

namespace {

Json bakedFileJson(const BakedFile& file) {
    const BakedMap& map = file.map;
    return {{"path", file.path},
            {"material", file.material},
            {"tile", file.tile},
            {"width", map.width},
            {"height", map.height},
            {"bits", map.bits},
            {"triangles", file.triangle_count},
            {"texels",
             {{"baked", map.hit_count},
              {"missed", map.missed_count},
              {"padding", map.padding_count},
              {"overlapping", map.overlap_count},
              {"conflicting", map.conflict_count}}},
            {"conflictMeanDeg", map.conflict_mean_deg},
            {"conflictMaxDeg", map.conflict_max_deg},
            {"outsideTriangles", file.outside_count},
            {"degenerateUvs", map.degenerate_uv_count},
            {"rays", raysWord(file.rays)},
            {"directions", directionsWord(file.rays)},
            {"reach", map.error.reach},
            {"cageOffset", map.error.cage_offset},
            {"error", file.path.empty() ? Json() : errorOfMapJson(map.error)},
            {"ownError", map.own_error.point_count > 0 ? errorOfMapJson(map.own_error) : Json()},
            {"heatTopDeg", file.heat_top_deg},
            {"maps", listJson(file.layers, layerJson)}};
}

}  // namespace

Json bakeDocument(const Outcome<BakeFileReport>& outcome, const std::string& high, ExitCode exit_code) {
    const Result<BakeFileReport>& result = outcome.result;
    Json json = documentJson("tspace.bake/1", result.ok(), exit_code);
    json["low"] = outcome.input;
    json["high"] = high;
    json["output"] = outcome.output;
    json["seconds"] = outcome.seconds;
    json["error"] = errorJson(result ? nullptr : &result.error());
    if (!result) return json;
    json["lowTriangles"] = result->low_triangle_count;
    json["highTriangles"] = result->high_triangle_count;
    json["framesMade"] = result->frames_made;
    json["matchedByName"] = result->matched_by_name;
    json["highMaps"] = listJson(result->high_maps, highMapJson);
    json["files"] = listJson(result->files, bakedFileJson);
    json["outputFiles"] = result->output_files;
    json["findings"] = result->findings;
    json["warnings"] = result->warnings;
    return json;
}

std::string bakeJson(const Outcome<BakeFileReport>& outcome, const std::string& high, ExitCode exit_code) {
    return jsonText(bakeDocument(outcome, high, exit_code));
}

std::string bakedPairsJson(const std::vector<BakedPair>& pairs, ExitCode exit_code, double seconds) {
    Json json = documentJson("tspace.bake-pairs/1", exit_code == ExitCode::done, exit_code);
    json["seconds"] = seconds;
    json["pairs"] = listJson(pairs, [](const BakedPair& pair) {
        Json entry = {{"low", pair.outcome.input},
                      {"high", pair.high},
                      {"output", pair.outcome.output},
                      {"skipped", pair.outcome.was_done_before}};
        entry["report"] = pair.outcome.was_done_before ? Json() : bakeDocument(pair.outcome, pair.high, pair.exit_code);
        return entry;
    });
    return jsonText(json);
}

}  // namespace tspace::report
