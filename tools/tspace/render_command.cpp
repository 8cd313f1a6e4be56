// SPDX-License-Identifier: MIT
// tspace render: renders one picture of one model.
#include <memory>

#include "command_table.h"
#include "commands/render/render_report.h"
#include "commands/shared/request.h"
#include "common_options.h"
#include "image_command.h"
#include "jobs.h"
#include "model/io/file_io.h"
#include "output_files.h"

namespace tspace::tool {
namespace {

using RenderArguments = ImageArguments<RenderOptions>;

Result<RenderReport> render(const RenderArguments& arguments) {
    RenderOptions options = arguments.options;
    options.progress = progressOf(arguments.input);
    StandardInput standard_input;
    if (const Result<Done> opened = standard_input.open(arguments.input, options.file); !opened) return opened.error();
    return callWithOutput(arguments.output, options, [&](const RenderOptions& with_output) {
        return renderFile(arguments.input, arguments.output, with_output);
    });
}

ExitCode runRender(const RenderArguments& arguments) {
    const bool to_stdout = arguments.output == "-";
    if (goesToTerminal(arguments))
        return printUsageError("a picture cannot be printed on a terminal; redirect stdout to a file or a pipe");
    if (!to_stdout && lowerExtension(arguments.output) != ".png")
        return printUsageError("the output '" + arguments.output + "' must end in .png");
    const Result<Done> fit = prepareOutputs({arguments.output}, {arguments.input}, arguments.options.dry_run);
    if (!fit) return printUsageError(fit.error().message);
    return makeAndPrint(
        arguments, [&] { return render(arguments); }, report::renderJson,
        [&](const auto& outcome) { return report::renderText(outcome, arguments.options.method); });
}

}  // namespace

Command renderCommand() {
    const auto owned = std::make_shared<RenderArguments>();
    RenderArguments& arguments = *owned;
    arguments.options.execution.thread_count = kAllThreads;
    Command command{
        .summary = "draw a picture of a model or of its tangent frames",
        .operands = "IN -o OUT",
        .description =
            "Draws a PNG of the model under one light, shaded with its normal maps and tangents, or of its data: "
            "normals, tangents, signs, the difference between its tangents and those of a method, or the UV map. It "
            "needs no display, and the output is byte-identical on all systems. The shading is a reference for "
            "comparing tangents and not a full renderer: there are no shadows, reflections or transparency.",
        .examples = {"tspace render helmet.glb -o helmet.png", "tspace render helmet.glb -o signs.png --show sign",
                     "tspace render helmet.glb -o error.png --show error --view front --size 512",
                     "tspace render helmet.glb -o right.png --frames computed"},
        .finish = [&arguments](const Given&) -> std::string {
            if (arguments.options.turntable == 0) return "--turntable must be from 1 to 999";
            if (arguments.options.turntable > 1 && arguments.output == "-")
                return "--turntable writes several files, so stdout cannot be the output";
            return arguments.options.samples == 0 ? "--samples must be from 1 to 4" : "";
        },
    };
    addImageArguments(command, arguments, InputKind::model, "A model file; '-': a GLB from stdin.",
                      "Output file: .png; '-': to stdout.", renderOptions(arguments.options));
    command.file = &owned->options.file;
    command.run = [owned] { return runRender(*owned); };
    return command;
}

}  // namespace tspace::tool
