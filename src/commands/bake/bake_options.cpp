// SPDX-License-Identifier: MIT
// How normal maps are baked and measured.
#include <cmath>

#include "commands/shared/file_options.h"
#include "commands/shared/request.h"

namespace tspace::options {
namespace {

constexpr Named<MapSpace> kMapSpaces[] = {{"tangent", MapSpace::tangent}, {"object", MapSpace::object}};
constexpr Named<MapFit> kFits[] = {{"solve", MapFit::solve}, {"texel", MapFit::texel}};
constexpr Named<RayTarget> kTargets[] = {{"outermost", RayTarget::outermost}, {"nearest", RayTarget::nearest}};
constexpr Named<RayDirections> kDirections[] = {
    {"auto", RayDirections::automatic}, {"averaged", RayDirections::averaged}, {"normals", RayDirections::normals}};
constexpr Named<unsigned> kMapBits[] = {{"8", 8}, {"16", 16}};

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
        std::uint64_t side = 0;
        if (!parseNumber(text, side) || side == 0 || side > kMostSide) return "must be a whole number from 1 to 16384";
        map.width = map.height = static_cast<std::uint32_t>(side);
        return {};
    };
    Option size = option("--size", "TEXELS", take, "Width and height of the map: 1 to 16384.");
    size.default_text = std::to_string(map.width);
    return size;
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
    add(list, group,
        number("--padding", map.padding, kMostPadding,
               "Texels around the triangles that continue them, so that filters and smaller mip levels meet no "
               "background."));
    add(list, group,
        flag(
            "--udim", options.udim,
            "A file per tile of the UV map, NAME.1001.png and on. Without this, the image goes on outside of 0 to 1."));
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
    addBakedMapOptions(list, options);
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
    addThreads(list, options.execution,
               "Number of threads; 0: as many as there are cores. Changes no bit of the result.");
    addLimits(list, options.file);
    addSync(list, options.file.sync);
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
    add(list, group, readingOption("--convention", options.map.reading, "Whose shader the map is taken to be for."));
    add(list, group,
        flag("--two-channels", options.two_channels,
             "z is made from x and y, as of BC5 and DXT5nm; blue is not read."));
    addRayOptions(list, options.map.reach, options.map.rays, options.cage, options.skew);
    addThreads(list, options.execution, "Number of threads; 0: as many as there are cores. Changes no figure.");
    addLimits(list, options.file);
    addSync(list, options.file.sync);
    return list;
}

}  // namespace tspace::options
