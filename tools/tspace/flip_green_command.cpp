// SPDX-License-Identifier: MIT
// tspace flip-green: one image, its green channel inverted.
#include <memory>

#include "command_table.h"
#include "commands/flip_green/flip_green_report.h"
#include "commands/shared/request.h"
#include "common_options.h"
#include "image_command.h"
#include "model/io/file_io.h"
#include "output_files.h"

namespace tspace::tool {
namespace {

struct FlipGreenArguments {
    std::string input = {};
    std::string output = {};  ///< the input, where it is written over
    bool in_place = false;
    FlipGreenOptions options = {};
    bool json = false;
    bool quiet = false;
};

std::string finish(FlipGreenArguments& arguments) {
    if (arguments.in_place && arguments.input == "-") return "standard input cannot be written over; say -o OUT";
    if (arguments.output.empty() && !arguments.in_place) return "say where to write: -o OUT, or --in-place";
    if (arguments.in_place) arguments.output = arguments.input;
    return {};
}

ExitCode runFlipGreen(const FlipGreenArguments& arguments) {
    if (!arguments.in_place && isOneFile(arguments.input, arguments.output)) {
        return printUsageError("the output " + arguments.output + " is the input; --in-place writes over it");
    }
    const Result<Done> fit = prepareOutputs({arguments.output}, {}, arguments.options.dry_run);
    if (!fit) return printUsageError(fit.error().message);
    if (goesToTerminal(arguments)) return printUsageError(kNoTextForATerminal);
    const auto make = [&] {
        return callOnImage(
            arguments.input, arguments.output, arguments.options.memory_limit_bytes, arguments.options,
            [&](const FlipGreenOptions& options) { return flipGreenFile(arguments.input, arguments.output, options); });
    };
    return makeAndPrint(arguments, make, report::flipGreenJson, report::flipGreenText);
}

}  // namespace

Command flipGreenCommand() {
    const auto owned = std::make_shared<FlipGreenArguments>();
    FlipGreenArguments& arguments = *owned;
    Command command{
        .summary = "invert the green channel of a normal map",
        .operands = "IN -o OUT",
        .description =
            "Makes a normal map for OpenGL and glTF, where green points up, of one for DirectX, where it points down; "
            "and back. Every texel gets exactly 255 - G, with 16 bits 65535 - G; all other channels, bits, palettes "
            "and chunks stay. A JPEG is compressed once more, unless the output is a PNG. The maps in a model are "
            "mended by tspace generate --flip-green.",
        .examples = {"tspace flip-green normal.png -o normal-gl.png", "tspace flip-green --in-place normal.png",
                     "tspace flip-green normal.jpg -o normal-gl.png"},
        .finish = [&arguments](const Given&) { return finish(arguments); },
    };
    const char* group = kInputAndOutput;
    command.add(group, operand("IN", arguments.input,
                               "An image: PNG, JPEG, WebP, KTX2, DDS or TGA (which becomes a PNG); - for stdin."));
    command
        .add(group, text("-o, --output", "OUT", arguments.output,
                         "Where to write: a file that ends in .png, .jpg, .jpeg, .webp, .ktx2 or .dds, or - for "
                         "stdout. The format "
                         "is that of the input, or PNG."))
        .is_file = true;
    Option& in_place =
        command.add(group, flag("--in-place", arguments.in_place,
                                "Write over the input, once the result is complete. Without this, an output that "
                                "is the input is refused."));
    in_place.excludes = {"--output"};
    command.add(flipGreenOptions(arguments.options));
    addReporting(command, arguments.json, arguments.quiet);
    command.reads = Reads::images;
    command.run = [owned] { return runFlipGreen(*owned); };
    return command;
}

}  // namespace tspace::tool
