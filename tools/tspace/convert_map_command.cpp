// SPDX-License-Identifier: MIT
// tspace convert-map: one normal map, for other frames.
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

std::string meshText(const std::string& file, const MapMeshReport& mesh) {
    return fmt::format("{}: {} triangles in {} primitives{}{}", printable(file), mesh.triangle_count,
                       mesh.primitive_count, mesh.tangents_made ? ", tangents made" : "",
                       mesh.scale == 1 ? "" : fmt::format(", map scaled by {:.4g}", mesh.scale));
}

std::string textOf(const ConvertMapArguments& arguments, const ConvertMapFileReport& done) {
    const ConvertMapFileOptions& options = arguments.options;
    const ConvertMapReport& texels = done.texels;
    Table table;
    table.addRow({"image", fmt::format("{} x {}, {} bits a channel, from {}", done.width, done.height, done.bits,
                                       done.bits_before)});
    if (done.from.triangle_count > 0) table.addRow({"from", meshText(options.mesh, done.from)});
    if (done.to.triangle_count > 0) {
        table.addRow({"to", meshText(options.to_mesh.empty() ? options.mesh : options.to_mesh, done.to)});
    }
    table.addRow({"texels", fmt::format("{} changed, {} of those shown stay, {} are background", texels.changed,
                                        texels.converted - texels.changed + texels.without_frame + texels.unmatched,
                                        texels.background)});
    table.addRow({"change", fmt::format("{:.3g} degrees in the mean, {:.3g} at most", texels.mean_change_deg,
                                        texels.max_change_deg)});
    for (const std::string& warning : done.warnings) table.addRow({"warning", printable(warning)});
    return fmt::format("{} -> {}{}\n{}", printable(arguments.input), printable(arguments.output),
                       options.dry_run ? " (not written)" : "", table.text("  "));
}

/// Of any format: what it is, the library says better.
bool isAnyImage(std::string_view) { return true; }

Result<ConvertMapFileReport> convert(const ConvertMapArguments& arguments) {
    ConvertMapFileOptions options = arguments.options;
    std::vector<std::uint8_t> bytes;
    if (arguments.input == "-") {
        Result<std::vector<std::uint8_t>> read =
            readStandardInput("an image", options.file.memory_limit_bytes, isAnyImage, "");
        if (!read) return std::move(read).error();
        bytes = *std::move(read);
        options.content = bytes;
    }
    StandardOutput standard_output;
    if (arguments.output == "-")
        options.sink = [&](std::span<const std::uint8_t> part) { return standard_output.write(part); };
    Result<ConvertMapFileReport> report = convertMapFile(arguments.input, arguments.output, options);
    if (const Result<Done> closed = standard_output.close(); !closed) return closed.error();
    return report;
}

}  // namespace

ExitCode runConvertMap(const ConvertMapArguments& arguments) {
    const Result<Done> fit =
        prepareOutputs({arguments.output}, {arguments.input, arguments.options.mesh, arguments.options.to_mesh});
    if (!fit) return printUsageError(fit.error().message + "; name another file");
    const bool to_stdout = arguments.output == "-";
    if (to_stdout && !arguments.options.dry_run && isTerminal(stdout))
        return printUsageError("an image is no text for a terminal; send stdout to a file or a pipe");
    const Result<ConvertMapFileReport> result = convert(arguments);
    const ExitCode exit_code = result ? ExitCode::done : printError(arguments.input, result.error());
    std::string text;
    if (arguments.json) {
        text = report::convertMapJson({.input = arguments.input,
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
