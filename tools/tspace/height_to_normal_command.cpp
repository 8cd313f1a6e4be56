// SPDX-License-Identifier: MIT
// tspace height-to-normal: converts one height map to a normal map.
#include <memory>

#include "command_table.h"
#include "commands/height_to_normal/height_to_normal_report.h"
#include "commands/shared/request.h"
#include "common_options.h"
#include "image_command.h"
#include "output_files.h"

namespace tspace::tool {
namespace {

using HeightToNormalArguments = ImageArguments<HeightToNormalFileOptions>;

ExitCode runHeightToNormal(const HeightToNormalArguments& arguments) {
    const Result<Done> fit =
        prepareOutputs({arguments.output}, {arguments.input, arguments.options.mesh}, arguments.options.dry_run);
    return makeFromImage(arguments, fit, heightToNormalFile, report::heightToNormalJson,
                         [&](const auto& outcome) { return report::heightToNormalText(outcome, arguments.options); });
}

}  // namespace

Command heightToNormalCommand() {
    const auto owned = std::make_shared<HeightToNormalArguments>();
    HeightToNormalArguments& arguments = *owned;
    arguments.options.execution.thread_count = kAllThreads;
    Command command{
        .summary = "convert a height map to a normal map",
        .operands = "IN -o OUT",
        .description =
            "Computes a normal map from a height map: a gray image in which white is high and black is low (a bump "
            "map), or an image with encoded elevations (--encoding). The normals show the slopes of the heights, "
            "multiplied by --strength. With --mesh, the strength is in model units, and slopes are measured on the "
            "surface of the model.",
        .examples = {"tspace height-to-normal height.png -o normal.png --strength 4",
                     "tspace height-to-normal height.png -o map.png --mesh wall.glb --strength 0.02",
                     "tspace height-to-normal height.png -o map.png --convention directx --bits 8"},
    };
    addImageArguments(command, arguments, InputKind::image,
                      "A height map: PNG (8 or 16 bits), JPEG, WebP, EXR, KTX2, DDS or TGA; '-': from stdin. With "
                      "--encoding gray, the color channels are averaged.",
                      "Output file: .png; '-': to stdout.", heightToNormalOptions(arguments.options));
    command.file = &owned->options.file;
    command.run = [owned] { return runHeightToNormal(*owned); };
    return command;
}

}  // namespace tspace::tool
