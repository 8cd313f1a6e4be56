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

using ConvertMapArguments = ImageArguments<ConvertMapFileOptions>;

ExitCode runConvertMap(const ConvertMapArguments& arguments) {
    const Result<Done> fit =
        prepareOutputs({arguments.output}, {arguments.input, arguments.options.mesh, arguments.options.to_mesh},
                       arguments.options.dry_run);
    const auto convert = [](const std::string& input, const std::string& output, ConvertMapFileOptions options) {
        options.progress = progressOf(input);
        return convertMapFile(input, output, options);
    };
    return makeFromImage(arguments, fit, convert, report::convertMapJson,
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
        .examples = {"tspace convert-map normal.png --mesh baked.glb --to-mesh best.glb -o best.png",
                     "tspace convert-map normal.png --mesh helmet.glb --to object -o object.png",
                     "tspace convert-map normal.png --flip-green --bits 8 -o normal-dx.png"},
        .finish = [&arguments](const Given& given) { return finish(given, arguments.options); },
    };
    addImageArguments(
        command, arguments, InputKind::image, "A normal map: PNG, JPEG, WebP, EXR, KTX2, DDS or TGA; '-': from stdin.",
        "Output file: .png, .exr or .tga (8 bits), or .ktx2 or .dds (BC5 with all mip levels); '-': PNG to stdout.",
        convertMapOptions(arguments.options));
    command.file = &owned->options.file;
    command.run = [owned] { return runConvertMap(*owned); };
    return command;
}

}  // namespace tspace::tool
