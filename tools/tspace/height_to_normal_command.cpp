// SPDX-License-Identifier: MIT
// tspace height-to-normal: one height map as a normal map.
#include <fmt/format.h>

#include "commands.h"
#include "console.h"
#include "image_command.h"
#include "model/io/file_io.h"
#include "output_files.h"
#include "report.h"

namespace tspace::tool {
namespace {

std::string textOf(const HeightToNormalArguments& arguments, const HeightToNormalFileReport& done) {
    const HeightToNormalFileOptions& options = arguments.options;
    Table table;
    table.addRow({"image", fmt::format("{} x {}, {} bits a channel, from {}", done.width, done.height, done.bits,
                                       done.bits_before)});
    if (options.mesh.empty()) {
        table.addRow({"strength", fmt::format("white stands {:.4g} texels high", options.strength)});
    } else {
        table.addRow({"strength", fmt::format("white stands {:.4g} units high; a texel is {:.3g} units wide",
                                              options.strength, done.texels.texel_size)});
        table.addRow({"mesh", fmt::format("{}: {} triangles in {} primitives{}, on {} texels", printable(options.mesh),
                                          done.mesh.triangle_count, done.mesh.primitive_count,
                                          done.mesh.tangents_made ? ", tangents made" : "", done.texels.on_mesh)});
    }
    table.addRow({"slopes", fmt::format("{:.3g} degrees in the mean, {:.3g} at most", done.texels.mean_lean_deg,
                                        done.texels.max_lean_deg)});
    for (const std::string& warning : done.warnings) table.addRow({"warning", printable(warning)});
    return fmt::format("{} -> {}{}\n{}", printable(arguments.input), printable(arguments.output),
                       options.dry_run ? " (not written)" : "", table.text("  "));
}

}  // namespace

ExitCode runHeightToNormal(const HeightToNormalArguments& arguments) {
    const Result<Done> fit =
        prepareOutputs({arguments.output}, {arguments.input, arguments.options.mesh}, arguments.options.dry_run);
    if (!fit) return printUsageError(fit.error().message + "; name another file");
    if (goesToTerminal(arguments)) return printUsageError(kNoTextForATerminal);
    const Result<HeightToNormalFileReport> result =
        callOnImage(arguments.input, arguments.output, arguments.options.file.memory_limit_bytes, arguments.options,
                    [&](const HeightToNormalFileOptions& options) {
                        return heightToNormalFile(arguments.input, arguments.output, options);
                    });
    return printOutcome(arguments, result, report::heightToNormalJson, textOf);
}

}  // namespace tspace::tool
