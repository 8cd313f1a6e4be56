// SPDX-License-Identifier: MIT
// tspace flip-green: inverts the green channel of one image.
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

struct FlipGreenArguments : ImageArguments<FlipGreenOptions> {
    bool in_place = false;  ///< `output` is the input
};

std::string finish(FlipGreenArguments& arguments) {
    if (arguments.in_place && arguments.input == "-")
        return "--in-place cannot be used with standard input; use -o OUT";
    if (arguments.output.empty() && !arguments.in_place) return "--output is missing: use -o OUT, or --in-place";
    if (arguments.in_place) arguments.output = arguments.input;
    return {};
}

ExitCode runFlipGreen(const FlipGreenArguments& arguments) {
    if (!arguments.in_place && isOneFile(arguments.input, arguments.output))
        return printUsageError("the output " + arguments.output + " is the input; use --in-place to overwrite it");
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
        .operands = "IN {-o OUT | --in-place}",
        .description =
            "Converts a normal map between DirectX (green points down) and OpenGL or glTF (green points up). Every "
            "texel gets exactly 255 - G (65535 - G with 16 bits); other channels, bit depth, palettes and chunks are "
            "preserved. A JPEG is recompressed unless the output is a PNG. For maps inside a model use tspace generate "
            "--flip-green.",
        .examples = {"tspace flip-green normal.png -o normal-gl.png", "tspace flip-green --in-place normal.png",
                     "tspace flip-green normal.jpg -o normal-gl.png"},
        .finish = [&arguments](const Given&) { return finish(arguments); },
    };
    const char* group = kInputAndOutput;
    command.add(group, operand("IN", arguments.input, InputKind::image,
                               "An image: PNG, JPEG, WebP, KTX2, DDS, or TGA (for TGA the output must be a PNG); '-': "
                               "from stdin."));
    command.add(group,
                fileOption("-o, --output", "OUT", arguments.output,
                           "Output file: .png, .jpg, .jpeg, .webp, .ktx2 or .dds; '-': to stdout. The format must be "
                           "that of the input, or PNG."));
    Option& in_place = command.add(group, flag("--in-place", arguments.in_place,
                                               "Overwrite the input once the result is complete. Without this option, "
                                               "an output that is also the input is rejected."));
    in_place.excludes = {"--output"};
    command.add(flipGreenOptions(arguments.options));
    addReporting(command, arguments.json, arguments.quiet);
    command.run = [owned] { return runFlipGreen(*owned); };
    return command;
}

}  // namespace tspace::tool
