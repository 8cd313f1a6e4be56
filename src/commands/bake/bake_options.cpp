// SPDX-License-Identifier: MIT
// Options for baking and measuring normal maps.
#include <algorithm>
#include <cmath>

#include "commands/shared/axes_option.h"
#include "commands/shared/file_options.h"
#include "commands/shared/request.h"

namespace tspace::options {
namespace {

constexpr Named<MapSpace> kMapSpaces[] = {{"tangent", MapSpace::tangent}, {"object", MapSpace::object}};
constexpr Named<MapFit> kFits[] = {{"solve", MapFit::solve}, {"texel", MapFit::texel}};
constexpr Named<RayTarget> kTargets[] = {{"outermost", RayTarget::outermost}, {"nearest", RayTarget::nearest}};
constexpr Named<RayDirections> kDirections[] = {
    {"auto", RayDirections::automatic}, {"averaged", RayDirections::averaged}, {"normals", RayDirections::normals}};
constexpr Named<MapOverlap> kOverlaps[] = {
    {"mean", MapOverlap::mean}, {"first", MapOverlap::first}, {"larger", MapOverlap::larger}};
constexpr Named<unsigned> kMapBits[] = {{"8", 8}, {"16", 16}};

constexpr Named<BakeIds> kIds[] = {
    {"material", BakeIds::material}, {"object", BakeIds::object}, {"shell", BakeIds::shell}};

constexpr unsigned kMaxPadding = 256, kMaxSide = 16384;

Option lengthOption(const char* name, double& target, const char* help) {
    const auto take = [&target](const std::string& text) -> std::string {
        double given = 0;
        if (!parseReal(text, given) || !(given > 0) || !std::isfinite(given)) return "must be a number greater than 0";
        target = given;
        return {};
    };
    return option(name, "LENGTH", take, help);
}

Option mapSizeOption(BakeOptions& map) {
    const auto take = [&map](const std::string& text) -> std::string {
        const std::size_t cross = text.find('x');
        std::uint64_t width = 0, height = 0;
        const bool is_read = parseNumber(text.substr(0, cross), width) &&
                             parseNumber(cross == text.npos ? text : text.substr(cross + 1), height);
        if (!is_read || width == 0 || height == 0 || width > kMaxSide || height > kMaxSide)
            return "must be an integer from 1 to 16384, or two of them, such as 2048x1024";
        map.width = static_cast<std::uint32_t>(width);
        map.height = static_cast<std::uint32_t>(height);
        return {};
    };
    Option size =
        option("--size", "TEXELS", take, "Width and height of the map, 1 to 16384: one number, or two as 2048x1024.");
    size.default_text = std::to_string(map.width);
    return size;
}

Option mapsOption(LayerOptions& layers) {
    // The first name in the list replaces the default layers; later names are added.
    const auto take = [&layers, is_first = true](const std::string& name) mutable -> std::string {
        const bool is_normal = name == "normal";
        layers.has_normal = is_normal || (layers.has_normal && !is_first);
        if (is_first) layers.layers.clear();
        is_first = false;
        for (std::uint32_t i = 0; i < kMapLayerCount; ++i) {
            const auto layer = static_cast<MapLayer>(i);
            const bool is_new = std::find(layers.layers.begin(), layers.layers.end(), layer) == layers.layers.end();
            if (name == layerName(layer) && is_new) layers.layers.push_back(layer);
        }
        return {};
    };
    Option maps = option("--maps", "LIST", take,
                         "Comma-separated list of maps to bake: normal, ao, bent, curvature, height, position, "
                         "thickness, id, color, orm (occlusion, roughness, metalness) and emission. The normal map is "
                         "written to OUT, and the other maps to files next to it: OUT_ao.png, OUT_height.png etc. The "
                         "maps color, orm and emission are transferred from the materials of the high poly.");
    maps.choices.emplace_back("normal");
    for (std::uint32_t i = 0; i < kMapLayerCount; ++i) maps.choices.emplace_back(layerName(static_cast<MapLayer>(i)));
    maps.default_text = layers.layers.empty() ? "normal" : "all of them";
    maps.is_list = true;
    return maps;
}

Option samplesOption(std::uint32_t& target) {
    const auto take = [&target](const std::string& text) -> std::string {
        std::uint64_t count = 0;
        if (!parseNumber(text, count) || count == 0 || count > kMostLayerRays)
            return "must be an integer from 1 to 4096";
        target = static_cast<std::uint32_t>(count);
        return {};
    };
    Option samples =
        option("--samples", "RAYS", take, "Number of rays per texel for ao, bent and thickness: 1 to 4096.");
    samples.default_text = std::to_string(target);
    return samples;
}

void addLayerOptions(OptionList& list, LayerOptions& layers, BakeIds& ids) {
    const auto add = adder(list, "Map types");
    add(mapsOption(layers));
    add(samplesOption(layers.ray_count));
    add(lengthOption("--ao-distance", layers.sky_distance,
                     "Maximum occlusion distance for ao and bent, in model units. Default: no limit."));
    add(lengthOption("--height-range", layers.height_range,
                     "Height mapped to white, in model units; its negative maps to black. Default: the largest "
                     "absolute height found, which the report states."));
    add(lengthOption("--curvature-range", layers.curvature_range,
                     "Mean curvature (1/radius, with the radius in model units) mapped to white; its negative maps to "
                     "black. Default: the 99th percentile of the texels, which the report states."))
        .value = "CURVATURE";
    add(lengthOption("--thickness-range", layers.thickness_range,
                     "Thickness mapped to white, in model units. Default: the largest thickness found, which the "
                     "report states."));
    add(choice("--id", "BY", kIds, ids,
               "Content of the ID map: one color per material, per object (node name), or per shell (connected "
               "component by position)."));
}

void addRayOptions(OptionList& list, double& reach, RayOptions& rays, std::string& cage, std::string& skew) {
    const auto add = adder(list, "Rays");
    add(choice("--rays", "WHICH", kTargets, rays.target,
               "Ray hit to use on the high poly. outermost: the first front face from the cage inward, which is the "
               "visible one; if there is none, the nearest one outside the cage. nearest: the front face nearest to "
               "the low poly on either side, for fingers and thin parts."));
    add(choice("--directions", "HOW", kDirections, rays.directions,
               "Ray directions. averaged: along the mean of the normals at each position, which avoids gaps at hard "
               "edges but skews detail on flat faces; auto: averaged near edges where faces meet at more than 30 "
               "degrees, and along the face normal elsewhere; normals: along the stored normals."));
    add(lengthOption("--cage-offset", rays.cage_offset,
                     "Cage distance: distance from the low poly at which rays start, in model units. Default: the "
                     "value of --reach."));
    add(lengthOption(
        "--reach", reach,
        "Maximum search distance from the low poly, outward and inward, in model units. Default: the larger of 5% "
        "of D and 1.5 times the largest distance between corresponding sides of the two bounding boxes, but at "
        "most 25% of D, where D is the diagonal of the larger box. The report states the value."));
    add(weldOption(rays.weld_distance,
                   "Weld distance, in model units: positions that differ by at most this distance in each coordinate "
                   "are welded for ray directions, generated normals, curvature and ID maps. 0: only equal "
                   "positions; auto: twice the float spacing at the largest coordinate of the mesh."));
    add(fileOption("--skew", "IMAGE", skew,
                   "Skew map, used instead of --directions: an image in the UVs of the low poly. Ray directions are "
                   "averaged where it is black, and follow the face normals where it is white.",
                   InputKind::image))
        .excludes = {"--directions"};
    add(fileOption("--cage", "MODEL", cage,
                   "Cage mesh: the low poly with its vertices moved outward, in the same vertex order. Rays "
                   "run from the cage through the low poly to the first front face.",
                   InputKind::model))
        .excludes = {"--rays", "--directions", "--cage-offset", "--skew"};
}

void addBakedMapOptions(OptionList& list, BakeFileOptions& options) {
    const auto add = adder(list, "Image");
    BakeOptions& map = options.map;
    add(mapSizeOption(map));
    add(choice("--bits", "8|16", kMapBits, map.bits, "Bits per channel of the PNG: 8 or 16."));
    add(choice("--space", "SPACE", kMapSpaces, map.space,
               "Space of the output normals. tangent: the tangent frames of the low poly; object: the axes of the "
               "scene."));
    add(axesOption([&map](const MapAxes& axes) { map.axes = axes; }));
    add(readingOption(
        "--convention", map.reading,
        "Program whose shader will read the map: gltf, opengl, directx, unreal, unity, blender, godot or three. "
        "directx and unreal use green down; unity, unreal and godot reconstruct z from x and y, so texels are "
        "written with unit length, as with --unit; godot and three interpolate bitangents per vertex."));
    add(flag("--unit", options.unit,
             "Give all texels unit length, so that z can be reconstructed from x and y, for two-channel formats (BC5, "
             "DXT5nm). The reported error then assumes a reader that reconstructs z."));
    add(choice("--fit", "HOW", kFits, map.fit,
               "Computation of the texels. solve: all texels together, so that the filtered map is also accurate "
               "between texel centers; texel: each texel separately, accurate only at its center, which is faster."));
    add(lengthsOption(map.lengths));
    add(number("--padding", map.padding, kMaxPadding,
               "Padding around UV islands, in texels, so that filtering and the first smaller mip levels do not sample "
               "the background (16: about four levels)."));
    add(choice("--overlap", "HOW", kOverlaps, map.overlap,
               "Normal of texels where UVs overlap and the triangles need different normals, as on mirrored halves. "
               "mean: the mean of all; first: that of the UV island that comes first in the file; larger: that of the "
               "UV island with the larger surface. The report states the angles between the different normals."));
    add(flag("--udim", options.udim, "Write one file per UDIM tile: NAME.1001.png, NAME.1002.png, ..."));
    add(flag("--wrap", options.wrap,
             "Also bake triangles outside the 0-1 UV range, where the texture repeats. By default they are "
             "ignored, because they are assumed to be offset copies."))
        .excludes = {"--udim"};
}

void addHighMapOptions(OptionList& list, bool& ignore, std::optional<Green>& green) {
    const auto add = adder(list, "High poly");
    add(flag(
        "--ignore-high-maps", ignore,
        "Use only the vertex normals of the high poly. By default the normal maps of its materials are included."));
    const auto take = [&green](const std::string& text) -> std::string {
        if (text != "up" && text != "down") return "must be up or down";
        green = text == "down" ? Green::down : Green::up;
        return {};
    };
    add(option("--high-green", "up|down", take,
               "Green direction of the high poly's normal maps: up or down. Default: as declared in the "
               "file, else as detected from the map, else up."))
        .excludes = {"--ignore-high-maps"};
}

Option heatOption(std::string& target) {
    return fileOption(
        "--heat", "PNG", target,
        "Write a heat map of the error to this PNG, from black (0) through red to white (the 99th percentile).");
}

Option matchOption(std::string& target) {
    Option match =
        text("--match", "HOW", target,
             "Pairing of low-poly with high-poly objects. names: Body_low is paired with Body, Body_high, Body_hp, "
             "Body_high_001 and Body_high_buckle, and an object without a match uses the whole high poly; all: every "
             "object uses the whole high poly; any other value: a text file with lines LOW = HIGH.");
    match.default_text = "names";
    match.reads = InputKind::text;
    return match;
}

}  // namespace

OptionList bakeOptions(BakeFileOptions& options) {
    OptionList list;
    const auto add = adder(list, kInputAndOutput);
    add(fileOption("--out-mesh", "OUT", options.out_mesh,
                   "Also write the low poly to this .glb, .vrm or .gltf file, with the tangent frames "
                   "that were used and with the map as its normal texture."))
        .excludes = {"--udim"};
    add(fileOption(
        "--misses", "PNG", options.misses,
        "Write a picture of the texel states. green: baked; red: no hit; yellow: shared by several triangles."));
    add(heatOption(options.heat));
    add(matchOption(options.match));
    addAllowExternal(list, options.file);
    addLayerOptions(list, options.layers, options.ids);
    addBakedMapOptions(list, options);
    addHighMapOptions(list, options.ignore_high_maps, options.high_green);
    addRayOptions(list, options.map.reach, options.map.rays, options.cage, options.skew);
    options::add(list, "Frames",
                 choice("--method", "NAME", kMethods, options.tangents.method,
                        "Tangent method for a low poly without tangents, as in generate. Existing tangents are kept."));
    options::add(
        list, "High poly",
        numberOrAuto("--denoise", "FACTOR", "a number", options.denoise, NormalOptions::denoise_auto, 4,
                     "Denoising for a high poly with noisy positions, such as a scan: its normals are recomputed from "
                     "a larger neighborhood, so that noise is not baked. auto: strength from the measured noise "
                     "level, or off if the deviations look like real detail; 0: off; up to 4: multiple of the "
                     "measured noise level, applied even if the deviations look like real detail."));
    addRunning(list, options.execution, options.file);
    return list;
}

OptionList mapErrorOptions(MapErrorFileOptions& options) {
    OptionList list;
    const auto addFile = adder(list, kInputAndOutput), add = adder(list, "Map");
    addFile(heatOption(options.heat));
    addFile(text("--material", "NAME", options.material, "Measure only triangles of this material. Default: all."));
    addFile(number("--tile", options.tile, 9999,
                   "UDIM tile of the map (1001, ...): measure only the triangles in this tile. 0: all triangles."));
    addFile(matchOption(options.match));
    addAllowExternal(list, options.file);
    add(choice("--space", "SPACE", kMapSpaces, options.map.space,
               "Space of the vectors in the map. tangent: the tangent frames of the low poly; object: the axes of the "
               "scene."));
    add(axesOption([&options](const MapAxes& axes) { options.map.axes = axes; }));
    add(readingOption("--convention", options.map.reading,
                      "Program whose shading convention is assumed: gltf, opengl, directx, unreal, unity, blender, "
                      "godot or three."));
    add(flag("--two-channels", options.two_channels,
             "Reconstruct z from x and y, as for BC5 and DXT5nm, and ignore blue."));
    addHighMapOptions(list, options.ignore_high_maps, options.high_green);
    addRayOptions(list, options.map.reach, options.map.rays, options.cage, options.skew);
    addRunning(list, options.execution, options.file,
               "Number of threads; 0: one per core. The results are the same for any number of threads.");
    return list;
}

}  // namespace tspace::options
