// SPDX-License-Identifier: MIT
// How a height map becomes a normal map.
#include "commands/shared/file_options.h"
#include "commands/shared/request.h"

namespace tspace::options {
namespace {

constexpr Named<unsigned> kPngBits[] = {{"8", 8}, {"16", 16}};

}  // namespace

OptionList heightToNormalOptions(HeightToNormalFileOptions& options) {
    OptionList list;
    const auto take_strength = [&options](const std::string& value) {
        return parseReal(value, options.strength) ? std::string() : std::string("must be a number");
    };
    Option strength =
        option("--strength", "S", take_strength,
               "How high white stands above black: with --mesh in the units of the model, else in texels. "
               "Below 0 white lies deeper.");
    strength.default_text = std::to_string(1);
    add(list, "Map", strength);
    add(list, kInputAndOutput,
        text("--mesh", "FILE", options.mesh,
             "The model that shows the map. Slopes are then those on its surface, whatever the size of the image and "
             "of the UVs, and the normals are told in its tangent frames; missing tangents are made."))
        .is_file = true;
    addMaterialOfMap(list, options.material);
    add(list, kInputAndOutput, flag("--dry-run", options.dry_run, "Do everything but write."));
    addAllowExternal(list, options.file);
    add(list, "Map",
        flag("--clamp", options.clamp,
             "The image ends at its borders. By default it goes on at the other side, as textures that repeat do; with "
             "--mesh as the mesh's texture does."));
    const auto take_convention = [&options](const std::string& name) {
        options.green = findMapReading(name.c_str())->green;
        return std::string();
    };
    Option convention = option("--convention", "NAME", take_convention,
                               "The program that will show the output: green points up, or, for directx and unreal, "
                               "down.");
    convention.choices = {"gltf", "opengl", "directx", "unreal", "unity", "blender", "godot", "three"};
    convention.default_text = "gltf";
    add(list, "Map", convention);
    add(list, "Map", choice("--bits", "BITS", kPngBits, options.bits, "Of a channel of the output."));
    addMakingAnImage(list, "Map", options.tangents.method, options.execution, options.file);
    return list;
}

}  // namespace tspace::options
