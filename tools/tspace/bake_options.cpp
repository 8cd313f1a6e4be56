// SPDX-License-Identifier: MIT
// The options of tspace bake and map-error.
#include "common_options.h"
#include "options.h"

namespace tspace::tool {

Command bakeCommand(BakeArguments& arguments) {
    Command command{
        .name = "bake",
        .summary = "bake the normal map of a low poly from a high poly",
        .operands = "LOW --high HIGH -o OUT.png",
        .description =
            "Makes a normal map that lets a low poly look like a high poly: right for the frames that the low poly has "
            "in its "
            "file, filtered as renderers filter, and measured in degrees when it is done. Models of several meshes are "
            "matched "
            "by name (Body_low with Body_high); several materials give a file each.",
        .examples = {"tspace bake low.glb --high high.glb -o normal.png --size 2048",
                     "tspace bake low.glb --high scan.ply -o normal.png --size 1024 --bits 8 --convention unreal",
                     "tspace bake low.glb --high high.obj -o normal.png --misses misses.png --heat heat.png --report "
                     "bake.json"},
    };
    const char* group = kInputAndOutput;
    command.add(group, operand("LOW", arguments.low, "The model that the map is for. It needs UVs."));
    Option& high = command.add(group, text("--high", "HIGH", arguments.high,
                                           "The model with the detail, in the same place. It needs no UVs."));
    high.is_file = high.is_required = true;
    Option& output =
        command.add(group, text("-o, --output", "OUT", arguments.output, "Where to write: a file that ends in .png."));
    output.is_file = output.is_required = true;
    command.add(bakeOptions(arguments.options));
    command.add(kReporting, text("--report", "JSON", arguments.report, "Also write the result as JSON to this file."))
        .is_file = true;
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

Command mapErrorCommand(MapErrorArguments& arguments) {
    Command command{
        .name = "map-error",
        .summary = "say how far a normal map is from its high poly, and why",
        .operands = "MAP LOW --high HIGH",
        .description =
            "Measures anybody's normal map: the angle between what a renderer shades with it and the high poly, in "
            "degrees. Then "
            "reads it in other ways (green down, tangents of other methods, quads, a bitangent per vertex, object "
            "space) and says "
            "in one sentence which fits best. Changes nothing.",
        .examples = {"tspace map-error normal.png low.glb --high high.glb",
                     "tspace map-error normal.png low.fbx --high scan.ply --convention unreal --heat heat.png --json"},
    };
    const char* group = kInputAndOutput;
    command.add(group, operand("MAP", arguments.map, "A normal map: PNG, JPEG or WebP."));
    command.add(group, operand("LOW", arguments.low, "The model that the map is for."));
    Option& high =
        command.add(group, text("--high", "HIGH", arguments.high, "The model with the detail, in the same place."));
    high.is_file = high.is_required = true;
    command.add(mapErrorOptions(arguments.options));
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

}  // namespace tspace::tool
