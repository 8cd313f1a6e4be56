// SPDX-License-Identifier: MIT
// tspace height-to-normal: one height map as a normal map.
#include <fmt/format.h>

#include "asset/file_io.h"
#include "commands.h"
#include "console.h"
#include "output_files.h"
#include "report.h"
#include "standard_input.h"
#include "system.h"

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

Result<HeightToNormalFileReport> convertHeights(const HeightToNormalArguments& arguments) {
    HeightToNormalFileOptions options = arguments.options;
    std::vector<std::uint8_t> bytes;
    if (arguments.input == "-") {
        const auto is_anything = [](std::string_view) { return true; };
        Result<std::vector<std::uint8_t>> read =
            readStandardInput("an image", options.file.memory_limit_bytes, is_anything, "");
        if (!read) return std::move(read).error();
        bytes = *std::move(read);
        options.content = bytes;
    }
    StandardOutput standard_output;
    if (arguments.output == "-")
        options.sink = [&](std::span<const std::uint8_t> part) { return standard_output.write(part); };
    Result<HeightToNormalFileReport> report = heightToNormalFile(arguments.input, arguments.output, options);
    if (const Result<Done> closed = standard_output.close(); !closed) return closed.error();
    return report;
}

}  // namespace

ExitCode runHeightToNormal(const HeightToNormalArguments& arguments) {
    if (const Result<Done> fit = prepareOutputs({arguments.output}, {arguments.input, arguments.options.mesh}); !fit)
        return printUsageError(fit.error().message + "; name another file");
    const bool to_stdout = arguments.output == "-";
    if (to_stdout && !arguments.options.dry_run && isTerminal(stdout))
        return printUsageError("an image is no text for a terminal; send stdout to a file or a pipe");
    const Result<HeightToNormalFileReport> result = convertHeights(arguments);
    const ExitCode exit_code = result ? ExitCode::done : printError(arguments.input, result.error());
    std::string text;
    if (arguments.json) {
        text = report::heightToNormalJson({.input = arguments.input,
                                           .output = arguments.output,
                                           .result = result,
                                           .is_dry_run = arguments.options.dry_run},
                                          exit_code);
    } else if (!arguments.quiet && result) {
        text = textOf(arguments, *result);
    }
    return printResult(text, to_stdout ? stderr : stdout) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
