// SPDX-License-Identifier: MIT
// tspace diff: compares two models corner by corner.
#include <memory>

#include "command_table.h"
#include "commands/diff/diff_report.h"
#include "commands/pages/diff_page.h"
#include "commands/shared/request.h"
#include "common_options.h"
#include "console.h"
#include "output_files.h"
#include "page_origin.h"
#include "report_outputs.h"

namespace tspace::tool {
namespace {

struct DiffArguments {
    std::string a = {};
    std::string b = {};
    options::DiffRequest request = {};
    std::string html = {};  ///< path of the HTML report; empty: none
    bool json = false;
    bool quiet = false;
};

ExitCode runDiff(const DiffArguments& arguments) {
    if (const Result<Done> fit = prepareOutputs({arguments.html}, {arguments.a, arguments.b}); !fit)
        return printUsageError(fit.error().message);
    const Result<PageOrigin> origin = pageOrigin();
    if (!arguments.html.empty() && !origin) return printUsageError(origin.error().message);
    DiffOptions options = arguments.request.options;
    InputFiles read;
    read.watch(options.file);
    progressLine().update(arguments.a, "comparing", 0, 0);
    const Result<FrameDiff> diff = diffFiles(arguments.a, arguments.b, options);
    ExitCode exit_code = ExitCode::done;
    if (!diff) {
        exit_code = printError(diff.error().element == 1 ? arguments.b : arguments.a, diff.error());
    } else if (!diff->isWithin(arguments.request.tolerance_deg)) {
        exit_code = ExitCode::findings;
    }
    HeldOutputs outputs;
    return commitAndPrint(outputs, [&](const Error* failure) {
        if (failure != nullptr) {
            exit_code = worse(exit_code, printError(arguments.html, *failure));
        } else if (diff && !arguments.html.empty()) {
            progressLine().update(arguments.html, "drawing", 0, 0);
            const Result<Done> written =
                writeTextFile(arguments.html, diffPage(arguments.a, arguments.b, *diff, options, *origin), &read);
            if (!written) exit_code = worse(exit_code, printError(arguments.html, written.error()));
        }
        PreparedReport report{.exit_code = exit_code};
        if (arguments.json) {
            report.text = report::diffJson(arguments.a, arguments.b, arguments.request.tolerance_deg, diff, exit_code);
        } else if (!arguments.quiet && diff) {
            report.text = fitted(report::diffText(arguments.a, arguments.b, *diff));
        }
        return report;
    });
}

}  // namespace

Command diffCommand() {
    const auto owned = std::make_shared<DiffArguments>();
    DiffArguments& arguments = *owned;
    Command command{
        .summary = "compare the frames of two models",
        .operands = "A B",
        .description =
            "Pairs the primitives and triangles of two models that show the same surface, even if vertices were split, "
            "merged or reordered. Prints the angles between their tangents (T), normals (N) and reconstructed "
            "bitangents (B), the number of corner pairs whose signs differ, and the vertices that differ most. No "
            "input is changed.",
        .examples = {"tspace diff before.glb after.glb",
                     "tspace diff mine.glb theirs.gltf --tolerance 0.5 --json > diff.json",
                     "tspace diff --html report.html before.glb after.glb"},
    };
    command.add(kInputAndOutput, operand("A", arguments.a, InputKind::model, "First model file."));
    command.add(kInputAndOutput,
                operand("B", arguments.b, InputKind::model, "Second model file, which is compared with A."));
    command.add(diffOptions(arguments.request));
    command.add(kReporting, htmlOutput("--html", "FILE", arguments.html,
                                       "Write a self-contained HTML report to this file, with a heat map of the angles "
                                       "and pictures of the largest differences."));
    addReporting(command, arguments.json, arguments.quiet);
    command.file = &owned->request.options.file;
    command.run = [owned] { return runDiff(*owned); };
    return command;
}

}  // namespace tspace::tool
