// SPDX-License-Identifier: MIT
// The options of tspace convert-map.
#include "common_options.h"
#include "options.h"

namespace tspace::tool {

Command convertMapCommand(ConvertMapArguments& arguments) {
    Command command{
        .name = "convert-map",
        .summary = "carry a normal map from one set of tangent frames to another",
        .operands = "IN -o OUT",
        .description =
            "A normal map is right only for the tangent frames that it was made with. This writes it anew for those of "
            "another model of the same surface and UVs, for object space, or for the program that is to show it, such "
            "that the picture stays as it was. Texels that no triangle shows stay as they are.",
        .examples = {"tspace convert-map normal.png --mesh baked.glb --to-mesh best.glb -o normal-best.png",
                     "tspace convert-map normal.png --mesh helmet.glb --to object -o normal-object.png",
                     "tspace convert-map normal.png --flip-green --bits 8 -o normal-dx.png"},
        .finish = [&arguments](const Given& given) { return finish(given, arguments.options); },
    };
    const char* group = kInputAndOutput;
    command.add(group, operand("IN", arguments.input, "An image: PNG, JPEG, WebP or EXR; - for stdin."));
    Option output = text("-o, --output", "OUT", arguments.output,
                         "Where to write: a file that ends in .png or .exr; - for stdout, a PNG.");
    output.is_file = output.is_required = true;
    command.add(group, output);
    command.add(convertMapOptions(arguments.options));
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

}  // namespace tspace::tool
