// SPDX-License-Identifier: MIT
// tspace compress-map: compresses one normal map to a texture for engines.
#include <memory>

#include "command_table.h"
#include "commands/compress_map/compress_map_report.h"
#include "commands/shared/request.h"
#include "common_options.h"
#include "image_command.h"
#include "jobs.h"
#include "output_files.h"

namespace tspace::tool {
namespace {

using CompressMapArguments = ImageArguments<CompressMapFileOptions>;

ExitCode runCompressMap(const CompressMapArguments& arguments) {
    // The first level represents a folder of PNGs.
    const auto fileOf = [](const std::string& path, const std::string& input) {
        return path.ends_with('/') ? levelPath(path, input, 0) : path;
    };
    const CompressMapFileOptions& wanted = arguments.options;
    const Result<Done> fit =
        prepareOutputs({fileOf(arguments.output, arguments.input), fileOf(wanted.roughness_output, wanted.roughness)},
                       {arguments.input, wanted.roughness}, wanted.dry_run);
    return makeFromImage(arguments, fit, compressMapFile, report::compressMapJson, report::compressMapText);
}

}  // namespace

Command compressMapCommand() {
    const auto owned = std::make_shared<CompressMapArguments>();
    CompressMapArguments& arguments = *owned;
    arguments.options.execution.thread_count = kAllThreads;
    Command command{
        .summary = "compress a normal map to a texture for engines (BC5, EAC RG11)",
        .operands = "IN -o OUT",
        .description =
            "Compresses a tangent-space normal map to a texture of x and y, from which the reader reconstructs z. BC5 "
            "and EAC RG11 store x in red and y in green, with 8 bits per texel in total. The encoder minimizes the "
            "error of the "
            "filtered texture and uses all bits of the image, so 16-bit input results in a smaller error than 8-bit "
            "input. Mip levels are computed by averaging the normals of the image. If a roughness texture is given, "
            "its mip levels are made rougher according to the spread of the normals. The report states the error of "
            "the texture.",
        .examples = {"tspace compress-map normal.png -o normal.ktx2", "tspace compress-map normal.exr -o normal.dds",
                     "tspace compress-map normal.png -o normal.ktx2 --roughness orm.png -o2 orm.ktx2"},
    };
    addImageArguments(command, arguments, InputKind::image,
                      "A normal map: PNG, JPEG, WebP, EXR, KTX2, DDS or TGA; '-': from stdin.",
                      "Output file: .ktx2 or .dds, or a folder of PNGs (a name that ends in /); '-': KTX2 to stdout.",
                      compressMapOptions(arguments.options));
    command.run = [owned] { return runCompressMap(*owned); };
    return command;
}

}  // namespace tspace::tool
