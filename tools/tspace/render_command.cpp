// SPDX-License-Identifier: MIT
// tspace render: one model, one picture.
#include <fmt/format.h>

#include "commands.h"
#include "console.h"
#include "image_command.h"
#include "model/io/file_io.h"
#include "output_files.h"
#include "report.h"
#include "standard_input.h"

namespace tspace::tool {
namespace {

std::string textOf(const RenderArguments& arguments, const RenderReport& done) {
    Table table;
    table.addRow({"picture", fmt::format("{}, {} x {}, {}", renderShowName(done.show), done.width, done.height,
                                         counted(done.triangle_count, "triangle"))});
    if (done.computed_count > 0 && done.show != RenderShow::error) {
        table.addRow({"tangents", fmt::format("computed for {} by {}", counted(done.computed_count, "primitive"),
                                              methodName(arguments.options.method))});
    }
    if (done.without_tangents_count > 0)
        table.addRow({"grey", counted(done.without_tangents_count, "primitive") + " without tangents"});
    if (done.error_sample_count > 0) {
        table.addRow({"error", fmt::format("mean {:.4g}, at most {:.4g} degrees from {}", done.mean_error_deg,
                                           done.max_error_deg, methodName(arguments.options.method))});
    }
    for (const std::string& warning : done.warnings) table.addRow({"warning", printable(warning)});
    return fmt::format("{} -> {}{}\n{}", printable(arguments.input), printable(arguments.output),
                       arguments.options.dry_run ? " (not written)" : "", table.text("  "));
}

Result<RenderReport> render(const RenderArguments& arguments) {
    RenderOptions options = arguments.options;
    StandardInput standard_input;
    if (const Result<Done> opened = standard_input.open(arguments.input, options.file); !opened) return opened.error();
    return callWithOutput(arguments.output, options, [&](const RenderOptions& with_output) {
        return renderFile(arguments.input, arguments.output, with_output);
    });
}

}  // namespace

ExitCode runRender(const RenderArguments& arguments) {
    const bool to_stdout = arguments.output == "-";
    if (goesToTerminal(arguments))
        return printUsageError("a picture is no text for a terminal; send stdout to a file or a pipe");
    if (!to_stdout && lowerExtension(arguments.output) != ".png")
        return printUsageError("the picture " + arguments.output + " must end in .png");
    const Result<Done> fit = prepareOutputs({arguments.output}, {arguments.input}, arguments.options.dry_run);
    if (!fit) return printUsageError(fit.error().message);
    const Result<RenderReport> result = render(arguments);
    return printOutcome(arguments, result, report::renderJson, textOf);
}

}  // namespace tspace::tool
