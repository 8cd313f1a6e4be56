// SPDX-License-Identifier: MIT
// tspace convert-map: converts one normal map for other frames.
#include <memory>

#include "command_table.h"
#include "commands/convert_map/convert_map_report.h"
#include "commands/shared/request.h"
#include "common_options.h"
#include "image_command.h"
#include "jobs.h"
#include "output_files.h"

namespace tspace::tool {
namespace {

struct ConvertMapArguments {
    std::string input = {};
    std::string output = {};
    ConvertMapFileOptions options = {};
    bool json = false;
    bool quiet = false;
};

ExitCode runConvertMap(const ConvertMapArguments& arguments) {
    const Result<Done> fit =
        prepareOutputs({arguments.output}, {arguments.input, arguments.options.mesh, arguments.options.to_mesh},
                       arguments.options.dry_run);
    if (!fit) return printUsageError(fit.error().message + "; name another file");
    if (goesToTerminal(arguments)) return printUsageError(kNoTextForATerminal);
    const auto make = [&] {
        return callOnImage(arguments.input, arguments.output, arguments.options.file.memory_limit_bytes,
                           arguments.options, [&](ConvertMapFileOptions options) {
                               options.progress = progressOf(arguments.input);
                               return convertMapFile(arguments.input, arguments.output, options);
                           });
    };
    return makeAndPrint(arguments, make, report::convertMapJson,
                        [&](const auto& outcome) { return report::convertMapText(outcome, arguments.options); });
}

}  // namespace

Command convertMapCommand() {
    const auto owned = std::make_shared<ConvertMapArguments>();
    ConvertMapArguments& arguments = *owned;
    arguments.options.execution.thread_count = kAllThreads;
    Command command{
        .summary = "convert a normal map from one set of tangent frames to another",
        .operands = "IN -o OUT",
        .description =
            "A normal map is correct only for the tangent frames that it was made with. This command rewrites it for "
            "the frames of another model with the same surface and UVs, for object space, or for another program, so "
            "that the shading does not change. Texels outside all triangles are not changed.",
        .examples = {"tspace convert-map normal.png --mesh baked.glb --to-mesh best.glb -o normal-best.png",
                     "tspace convert-map normal.png --mesh helmet.glb --to object -o normal-object.png",
                     "tspace convert-map normal.png --flip-green --bits 8 -o normal-dx.png"},
        .finish = [&arguments](const Given& given) { return finish(given, arguments.options); },
    };
    const char* group = kInputAndOutput;
    command.add(group, operand("IN", arguments.input, InputKind::image,
                               "A normal map: PNG, JPEG, WebP, EXR, KTX2, DDS or TGA; '-': from stdin."));
    Option output = fileOption(
        "-o, --output", "OUT", arguments.output,
        "Output file: .png, .exr or .tga (8 bits), or .ktx2 or .dds (BC5 with all mip levels); '-': PNG to stdout.");
    output.is_required = true;
    command.add(group, output);
    command.add(convertMapOptions(arguments.options));
    addReporting(command, arguments.json, arguments.quiet);
    command.run = [owned] {
        owned->options.file.importer = importerPath();
        return runConvertMap(*owned);
    };
    return command;
}

}  // namespace tspace::tool
