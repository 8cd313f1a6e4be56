// SPDX-License-Identifier: MIT
// tspace flip-green: one image, its green channel inverted.
#include <fmt/format.h>

#include "commands.h"
#include "console.h"
#include "image_command.h"
#include "model/io/file_io.h"
#include "output_files.h"
#include "report.h"

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

}  // namespace

ExitCode runFlipGreen(const FlipGreenArguments& arguments) {
    if (!arguments.in_place && isOneFile(arguments.input, arguments.output)) {
        return printUsageError("the output " + arguments.output + " is the input; --in-place writes over it");
    }
    const Result<Done> fit = prepareOutputs({arguments.output}, {}, arguments.options.dry_run);
    if (!fit) return printUsageError(fit.error().message);
    if (goesToTerminal(arguments)) return printUsageError(kNoTextForATerminal);
    const Result<FlipGreenReport> result = callOnImage(
        arguments.input, arguments.output, arguments.options.memory_limit_bytes, arguments.options,
        [&](const FlipGreenOptions& options) { return flipGreenFile(arguments.input, arguments.output, options); });
    return printOutcome(arguments, result, report::flipGreenJson, textOf);
}

}  // namespace tspace::tool
