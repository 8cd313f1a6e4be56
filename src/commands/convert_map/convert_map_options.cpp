// SPDX-License-Identifier: MIT
// How a normal map is converted.
#include <string_view>

#include "commands/shared/file_options.h"
#include "commands/shared/request.h"

namespace tspace::options {
namespace {

constexpr Named<MapFileSpace> kSpaces[] = {
    {"tangent", MapFileSpace::tangent},
    {"object", MapFileSpace::object},
    {"world", MapFileSpace::world},
};
constexpr Named<BitangentPlace> kBitangents[] = {
    {"pixel", BitangentPlace::perPixel},
    {"vertex", BitangentPlace::perVertex},
};
constexpr Named<unsigned> kBitCounts[] = {{"8", 8}, {"16", 16}, {"32", 32}};

/// "bgr": z, y and x. A capital letter is an inverted channel. With two letters z is computed.
std::string takeChannels(const std::string& letters, MapLayout& layout) {
    constexpr const char* kWrong =
        "must be two or three of r, g, b and a, such as rg, ag or bgr; a capital letter stands for an inverted channel";
    constexpr std::string_view kLetters = "rgbaRGBAxyzwXYZW";
    if (letters.size() != 2 && letters.size() != 3) return kWrong;
    MapComponent* const components[] = {&layout.x, &layout.y, &layout.z};
    layout.z = {MapChannel::none, false};
    for (std::size_t i = 0; i < letters.size(); ++i) {
        const std::size_t at = kLetters.find(letters[i]);
        if (at == std::string_view::npos || letters.find(letters[i], i + 1) != std::string::npos) return kWrong;
        *components[i] = {static_cast<MapChannel>(at % 4), at % 8 >= 4};
    }
    return {};
}

}  // namespace

OptionList convertMapOptions(ConvertMapFileOptions& options) {
    OptionList list;
    add(list, kInputAndOutput,
        text("--mesh", "FILE", options.mesh,
             "The model that the map was made for. Its own tangents count; where it has none they are made."))
        .is_file = true;
    add(list, kInputAndOutput,
        text("--to-mesh", "FILE", options.to_mesh,
             "The model that the map is to be shown on: the same surface and UVs, other tangents, normals, splits or "
             "triangles. Default: that of --mesh."))
        .is_file = true;
    addMaterialOfMap(list, options.material);
    add(list, kInputAndOutput,
        number("--tile", options.tile, 9999,
               "Takes the triangles of this UDIM tile, whose file the map is: 1001 and on. 0: all."));
    add(list, kInputAndOutput, flag("--dry-run", options.dry_run, "Do everything but write."));
    addAllowExternal(list, options.file);
    const char* group = "Map";
    add(list, group,
        choice("--from", "SPACE", kSpaces, options.from,
               "What the map's vectors are told in. object: the coordinates of the mesh; world: those of the scene, as "
               "the mesh's node turns it."));
    add(list, group, choice("--to", "SPACE", kSpaces, options.to, "What those of the output are to be told in."));
    add(list, group,
        readingOption("--from-convention", options.from_reading, "The program that the map was made for."));
    add(list, group, readingOption("--to-convention", options.to_reading, "The program that will show the output."));
    add(list, group,
        choice("--from-bitangent", "WHERE", kBitangents, options.from_reading.bitangent,
               "Where that program computes bitangents. Default: as its convention says; pixel for gltf."))
        .default_text.clear();
    add(list, group,
        choice("--to-bitangent", "WHERE", kBitangents, options.to_reading.bitangent, "Where the other one does."))
        .default_text.clear();
    add(list, group,
        option(
            "--channels", "LETTERS",
            [&options](const std::string& value) { return takeChannels(value, options.layout); },
            "The channels of IN that x, y and z are in: bgr for red and blue exchanged. Of two letters z is made of x "
            "and y: rg for maps whose blue says nothing, ag for DXT5nm. A capital letter stands for an inverted "
            "channel. Default: rgb."));
    add(list, group,
        setting("--srgb", options.layout.curve, MapCurve::srgb,
                "The values of IN were stored as colors, with the sRGB curve; it is taken off."));
    add(list, group,
        setting("--linearised", options.layout.curve, MapCurve::linearised,
                "The values of IN were taken for colors, and their sRGB curve taken off; it is put on again."))
        .excludes = {"--srgb"};
    add(list, group,
        option(
            "--flip-red", "", [](const std::string&) { return std::string(); },
            "Red of the output points the other way: for maps whose x was inverted."));
    add(list, group,
        option(
            "--flip-green", "", [](const std::string&) { return std::string(); },
            "Green of the output points the other way than --to-convention says."));
    add(list, group,
        choice(
            "--bits", "BITS", kBitCounts, options.bits,
            "Of a channel of the output: 8 or 16 in a PNG; 16 (half) or 32 (float) in an EXR. Default: the most that "
            "the format has."));
    add(list, group,
        number(
            "--padding", options.padding, 65536,
            "Texels around the triangles that are converted as well. 0: those that filtering reads. All further ones "
            "are background and stay as they are."));
    addMakingAnImage(list, group, options.tangents.method, options.execution, options.file);
    return list;
}

std::string finish(const Given& given, ConvertMapFileOptions& options) {
    // Whatever their order on the command line, conventions come first.
    for (const Given::Item& item : given.items) {
        const std::string& name = item.option->name();
        if (name == "--from-bitangent" || name == "--to-bitangent") item.option->take(item.value);
    }
    if (given.has("--flip-red")) options.layout.x.is_inverted = !options.layout.x.is_inverted;
    if (given.has("--flip-green")) {
        options.to_reading.green = options.to_reading.green == Green::up ? Green::down : Green::up;
    }
    if (!options.to_mesh.empty() && options.mesh.empty() && options.from == MapFileSpace::tangent) {
        return "--to-mesh needs --mesh: the model that the map was made for";
    }
    const bool same_kind = options.from == options.to;
    if (!same_kind && options.mesh.empty() && options.to_mesh.empty()) {
        return "from one space to another takes the frames of a model: --mesh";
    }
    const bool same_frames = options.from_reading.bitangent == options.to_reading.bitangent &&
                             options.from_reading.unit_vectors == options.to_reading.unit_vectors;
    if (options.from == MapFileSpace::tangent && same_kind && !same_frames && options.mesh.empty()) {
        return "these conventions interpolate frames in different ways, so the frames of a model are needed: --mesh";
    }
    return {};
}

}  // namespace tspace::options
