// SPDX-License-Identifier: MIT
// The options of tspace height-to-normal.
#include "common_options.h"
#include "options.h"

namespace tspace::tool {

Command heightToNormalCommand(HeightToNormalArguments& arguments) {
    Command command{
        .name = "height-to-normal",
        .summary = "make a normal map of a height map",
        .operands = "IN -o OUT",
        .description =
            "Makes a normal map of a grey image in which white is high and black is low (a bump map): the slopes of "
            "the heights, times a strength that you know. With the model that shows the map, the strength is in its "
            "units, and slopes are those on its surface.",
        .examples = {"tspace height-to-normal height.png -o normal.png --strength 4",
                     "tspace height-to-normal height.png -o normal.png --mesh wall.glb --strength 0.02",
                     "tspace height-to-normal height.png -o normal-dx.png --convention directx --bits 8"},
    };
    const char* group = kInputAndOutput;
    command.add(group, operand("IN", arguments.input,
                               "A height map: PNG (8 or 16 bits), JPEG, WebP or EXR; - for stdin. Of colors the mean "
                               "counts."));
    Option output =
        text("-o, --output", "OUT", arguments.output, "Where to write: a file that ends in .png; - for stdout.");
    output.is_file = output.is_required = true;
    command.add(group, output);
    command.add(heightToNormalOptions(arguments.options));
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

}  // namespace tspace::tool
