// SPDX-License-Identifier: MIT
// tspace flip-green: one image, its green channel inverted.
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

std::string textOf(const FlipGreenArguments& arguments, const FlipGreenReport& done) {
    Table table;
    table.addRow({"image", fmt::format("{}, {} x {}, {} bits a channel", report::imageFormatName(done.format),
                                       done.width, done.height, done.bits)});
    table.addRow({"green", done.is_exact ? "inverted exactly" : "inverted, and compressed once more"});
    for (const std::string& warning : done.warnings) table.addRow({"warning", printable(warning)});
    return fmt::format("{} -> {}{}\n{}", printable(arguments.input), printable(arguments.output),
                       arguments.options.dry_run ? " (not written)" : "", table.text("  "));
}

/// Of any format: what it is, the library says better.
bool isAnything(std::string_view) { return true; }

Result<FlipGreenReport> flip(const FlipGreenArguments& arguments) {
    FlipGreenOptions options = arguments.options;
    std::vector<std::uint8_t> bytes;
    if (arguments.input == "-") {
        Result<std::vector<std::uint8_t>> read =
            readStandardInput("an image", options.memory_limit_bytes, isAnything, "");
        if (!read) return std::move(read).error();
        bytes = *std::move(read);
        options.content = bytes;
    }
    StandardOutput standard_output;
    if (arguments.output == "-")
        options.sink = [&](std::span<const std::uint8_t> part) { return standard_output.write(part); };
    Result<FlipGreenReport> report = flipGreenFile(arguments.input, arguments.output, options);
    if (const Result<Done> closed = standard_output.close(); !closed) return closed.error();
    return report;
}

}  // namespace

ExitCode runFlipGreen(const FlipGreenArguments& arguments) {
    if (!arguments.in_place && isOneFile(arguments.input, arguments.output)) {
        return printUsageError("the output " + arguments.output + " is the input; --in-place writes over it");
    }
    if (!arguments.options.dry_run) {
        const Result<Done> fit = prepareOutputs({arguments.output}, {});
        if (!fit) return printUsageError(fit.error().message);
    }
    const bool to_stdout = arguments.output == "-";
    if (to_stdout && !arguments.options.dry_run && isTerminal(stdout))
        return printUsageError("an image is no text for a terminal; send stdout to a file or a pipe");
    const Result<FlipGreenReport> result = flip(arguments);
    const ExitCode exit_code = result ? ExitCode::done : printError(arguments.input, result.error());
    std::string text;
    if (arguments.json) {
        text = report::flipGreenJson({.input = arguments.input,
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
