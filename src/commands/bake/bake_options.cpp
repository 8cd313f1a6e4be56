// SPDX-License-Identifier: MIT
// How normal maps are baked and measured.
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

constexpr unsigned kMostPadding = 256, kMostSide = 16384;

Option lengthOption(const char* name, double& target, const char* help) {
    const auto take = [&target](const std::string& text) -> std::string {
        double given = 0;
        if (!parseReal(text, given) || !(given > 0) || !std::isfinite(given)) return "must be a length above 0";
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
        if (!is_read || width == 0 || height == 0 || width > kMostSide || height > kMostSide)
            return "must be a whole number from 1 to 16384, or two as 2048x1024";
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
    // The first name that is given takes the place of the default.
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
    Option maps =
        option("--maps", "LIST", take,
               "Which maps, with commas between them. normal is the output itself, the others stand beside it: "
               "OUT_ao.png. color, orm (occlusion, roughness, metal) and emission are what the high poly's "
               "materials show.");
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
            return "must be a whole number from 1 to 4096";
        target = static_cast<std::uint32_t>(count);
        return {};
    };
    Option samples = option("--samples", "RAYS", take, "Rays from each texel for ao, bent and thickness: 1 to 4096.");
    samples.default_text = std::to_string(target);
    return samples;
}

void addLayerOptions(OptionList& list, LayerOptions& layers, BakeIds& ids) {
    const char* group = "Maps";
    add(list, group, mapsOption(layers));
    add(list, group, samplesOption(layers.ray_count));
    add(list, group,
        lengthOption("--ao-distance", layers.sky_distance,
                     "What is further away hides nothing, in units of the models. Default: everything does."));
    add(list, group,
        lengthOption("--height-range", layers.height_range,
                     "The height that white stands for, in units of the models; black is as far below. Default: the "
                     "largest that is met; the report says how much."));
    add(list, group,
        lengthOption("--curvature-range", layers.curvature_range,
                     "The mean curvature that white stands for, 1 / radius in units of the models; black is as much "
                     "inwards. Default: what 99 % of the texels are below; the report says how much."));
    add(list, group,
        lengthOption("--thickness-range", layers.thickness_range,
                     "The thickness that white stands for, in units of the models. Default: the largest that is met; "
                     "the report says how much."));
    add(list, group,
        choice(
            "--id", "BY", kIds, ids,
            "What has a colour of its own in the map of ids: material, object (nodes by their names), or shell (what "
            "hangs together by its positions)."));
}

Option fileOption(const char* name, const char* value, std::string& target, const char* help) {
    Option made = text(name, value, target, help);
    made.is_file = true;
    return made;
}

void addRayOptions(OptionList& list, double& reach, RayOptions& rays, std::string& cage, std::string& skew) {
    const char* group = "Rays";
    add(list, group,
        choice("--rays", "WHICH", kTargets, rays.target,
               "Which front of the high poly counts. outermost: the first one from the cage inwards, which is what is "
               "seen, and beyond the cage where there is none; nearest: the one nearest to the low poly, on either "
               "side, for fingers and thin parts."));
    add(list, group,
        choice("--directions", "HOW", kDirections, rays.directions,
               "Where rays point. averaged: along the mean of the normals at each position, which leaves no gaps at "
               "hard edges; auto: so near edges where faces meet at over 30 degrees, and straight at the faces away "
               "from them, where averaged detail would lean; normals: along the normals as stored."));
    add(list, group,
        lengthOption("--cage-offset", rays.cage_offset,
                     "How far from the faces of the low poly the cage is, where rays begin, in units of the models. "
                     "Default: as the reach; the report says how much."));
    add(list, group,
        lengthOption("--reach", reach,
                     "How far from the low poly the high poly is looked for, outwards and inwards, in units of the "
                     "models. Default: a twentieth of the size of the larger one, or more where their boxes differ by "
                     "more; the report says how much."));
    add(list, group,
        numberOrAuto("--weld-distance", "DISTANCE", "a distance", rays.weld_distance, NormalOptions::weld_auto,
                     1000000000,
                     "Positions that differ by no more than this in each coordinate are one point for ray directions, "
                     "curvature, shells and normals that are made, in units of the models. 0: only equal ones are. "
                     "auto: twice the spacing of floats at the largest coordinate of the mesh."));
    Option painted = fileOption("--skew", "IMAGE", skew,
                                "In place of --directions: an image by the UVs of the map, black where rays are "
                                "averaged and white where they go straight at the triangles.");
    painted.excludes = {"--directions"};
    add(list, group, std::move(painted));
    Option own = fileOption("--cage", "MODEL", cage,
                            "The low poly with its vertices moved outwards, in the same order: rays go from there to "
                            "the low poly and on, to the first front.");
    own.excludes = {"--rays", "--directions", "--cage-offset", "--skew"};
    add(list, group, std::move(own));
}

void addBakedMapOptions(OptionList& list, BakeFileOptions& options) {
    const char* group = "Map";
    BakeOptions& map = options.map;
    add(list, group, mapSizeOption(map));
    add(list, group, choice("--bits", "8|16", kMapBits, map.bits, "Bits of a channel of the PNG."));
    add(list, group,
        choice("--space", "SPACE", kMapSpaces, map.space,
               "What the map is told in. tangent: along the frames of the low poly; object: along the axes of the "
               "scene."));
    add(list, group, axesOption([&map](const MapAxes& axes) { map.axes = axes; })).default_text = "y-up";
    add(list, group,
        readingOption(
            "--convention", map.reading,
            "Whose shader the map is for. directx and unreal have green down; unity, unreal and godot read two "
            "channels, so that all texels have length 1; godot and three interpolate bitangents."));
    add(list, group,
        flag("--unit", options.unit,
             "All texels have length 1, so that z can be made from x and y: for formats of two channels (BC5, DXT5nm). "
             "The error is that of such a reader."));
    add(list, group,
        choice("--fit", "HOW", kFits, map.fit,
               "solve: all texels together, such that the filtered map is right between texels too; texel: each alone, "
               "right at its centre, which is faster."));
    addLengths(list, group, map.lengths);
    add(list, group,
        number("--padding", map.padding, kMostPadding,
               "Texels around the triangles that continue them, so that filters and smaller mip levels meet no "
               "background."));
    add(list, group,
        choice(
            "--overlap", "HOW", kOverlaps, map.overlap,
            "Whose normals count where triangles share texels and want different ones, as mirrored halves. mean: the "
            "mean of all; first: the piece of the UV map that comes first in the file; larger: the piece with the "
            "larger surface. The report says how far they are apart."));
    add(list, group, flag("--udim", options.udim, "A file per tile of the UV map, NAME.1001.png and on."));
    Option wrap = flag("--wrap", options.wrap,
                       "Also bake triangles whose UVs lie outside of 0 to 1, where the texture is shown again. Without "
                       "this they have no say, as copies that were moved there by 1.");
    wrap.excludes = {"--udim"};
    add(list, group, std::move(wrap));
}

void addHighMapOptions(OptionList& list, bool& ignore, std::optional<Green>& green) {
    const char* group = "High poly";
    add(list, group,
        flag("--ignore-high-maps", ignore,
             "Look at the high poly's own normals alone. Without this, the normal maps of its materials are baked "
             "through."));
    const auto take = [&green](const std::string& text) -> std::string {
        if (text != "up" && text != "down") return "must be up or down";
        green = text == "down" ? Green::down : Green::up;
        return {};
    };
    Option told = option("--high-green", "up|down", take,
                         "Which way green of these maps points. Default: as the file says or the slopes of the map "
                         "show, and up where neither does.");
    told.excludes = {"--ignore-high-maps"};
    add(list, group, std::move(told));
}

Option matchOption(std::string& target) {
    Option match =
        text("--match", "HOW", target,
             "Which objects of the low poly look at which of the high poly. names: Body_low at Body, Body_high, "
             "Body_hp, Body_high_001 and Body_high_buckle, and what has no partner at everything; all: each at "
             "everything; else a file with lines LOW = HIGH.");
    match.default_text = "names";
    return match;
}

}  // namespace

OptionList bakeOptions(BakeFileOptions& options) {
    OptionList list;
    Option out_mesh =
        fileOption("--out-mesh", "OUT", options.out_mesh,
                   "Also write the low poly to this .glb, .vrm or .gltf, with the frames that were used and "
                   "the map as its normal texture.");
    out_mesh.excludes = {"--udim"};
    add(list, kInputAndOutput, std::move(out_mesh));
    add(list, kInputAndOutput,
        fileOption(
            "--misses", "PNG", options.misses,
            "A picture of what each texel is: green is baked, red met nothing, yellow is shown by several triangles."));
    add(list, kInputAndOutput,
        fileOption("--heat", "PNG", options.heat,
                   "A picture of the error: from black over red to white, which is the 99th percentile."));
    add(list, kInputAndOutput, matchOption(options.match));
    addAllowExternal(list, options.file);
    addLayerOptions(list, options.layers, options.ids);
    addBakedMapOptions(list, options);
    addHighMapOptions(list, options.ignore_high_maps, options.high_green);
    addRayOptions(list, options.map.reach, options.map.rays, options.cage, options.skew);
    add(list, "Frames",
        choice("--method", "NAME", kMethods, options.tangents.method,
               "How tangents are made for a low poly that has none, as generate makes them. Those that are in the file "
               "stay."));
    add(list, "High poly",
        numberOrAuto("--denoise", "FACTOR", "a number", options.denoise, NormalOptions::denoise_auto, 4,
                     "For a high poly with noisy positions, such as a scan: its normals are made anew by more of the "
                     "surface around, so that noise is not baked. auto: as much as is measured, and nothing where that "
                     "is shape; 0 to 4: so many times the noise that is measured, also where it looks like shape."));
    addRunning(list, options.execution,
               "Number of threads; 0: as many as there are cores. Changes no bit of the result.", options.file);
    return list;
}

OptionList mapErrorOptions(MapErrorFileOptions& options) {
    OptionList list;
    add(list, kInputAndOutput,
        fileOption("--heat", "PNG", options.heat,
                   "A picture of the error: from black over red to white, which is the 99th percentile."));
    add(list, kInputAndOutput,
        text("--material", "NAME", options.material, "Look only at triangles of this material. Default: at all."));
    add(list, kInputAndOutput,
        number("--tile", options.tile, 9999,
               "Look only at triangles of this UDIM tile, whose file the map is: 1001 and on. 0: at all."));
    add(list, kInputAndOutput, matchOption(options.match));
    addAllowExternal(list, options.file);
    const char* group = "Map";
    add(list, group,
        choice("--space", "SPACE", kMapSpaces, options.map.space,
               "What the map is taken for: tangent, along the frames of the low poly; object, along the axes of the "
               "scene."));
    add(list, group, axesOption([&options](const MapAxes& axes) { options.map.axes = axes; })).default_text = "y-up";
    add(list, group, readingOption("--convention", options.map.reading, "Whose shader the map is taken to be for."));
    add(list, group,
        flag("--two-channels", options.two_channels,
             "z is made from x and y, as of BC5 and DXT5nm; blue is not read."));
    addHighMapOptions(list, options.ignore_high_maps, options.high_green);
    addRayOptions(list, options.map.reach, options.map.rays, options.cage, options.skew);
    addRunning(list, options.execution, "Number of threads; 0: as many as there are cores. Changes no figure.",
               options.file);
    return list;
}

}  // namespace tspace::options
