// SPDX-License-Identifier: MIT
// The options of tspace render that are about command lines.
#include "common_options.h"
#include "options.h"

namespace tspace::tool {

Command renderCommand(RenderArguments& arguments) {
    Command command{
        .name = "render",
        .summary = "draw a model, or its frames, as a picture",
        .operands = "IN -o OUT",
        .description =
            "Draws a PNG: the model in the light of one lamp, as its normal maps and tangents say, or these "
            "themselves: "
            "normals, tangents, signs, how far the tangents are from those of a method, the UV map. Without a display "
            "and "
            "the same bytes everywhere. It is the shading reference made visible, no renderer: no shadows, no "
            "reflections.",
        .examples = {"tspace render helmet.glb -o helmet.png", "tspace render helmet.glb -o signs.png --show sign",
                     "tspace render helmet.glb -o error.png --show error --view front --size 512",
                     "tspace render helmet.glb -o right.png --frames computed"},
        .finish = [&arguments](const Given&) -> std::string {
            return arguments.options.samples == 0 ? "--samples must be 1 to 4" : "";
        },
    };
    const char* group = kInputAndOutput;
    command.add(group, operand("IN", arguments.input, "A model file; '-': a GLB on stdin."));
    Option& output = command.add(group, text("-o, --output", "OUT", arguments.output,
                                             "Where to write: a file that ends in .png, or - for stdout."));
    output.is_file = output.is_required = true;
    command.add(renderOptions(arguments.options));
    addReporting(command, arguments.json, arguments.quiet);
    return command;
}

}  // namespace tspace::tool
