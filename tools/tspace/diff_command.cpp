// SPDX-License-Identifier: MIT
// tspace diff: two models, corner by corner.
#include "commands.h"
#include "commands/shared/page/diff_page.h"
#include "console.h"
#include "output_files.h"
#include "report.h"

namespace tspace::tool {

ExitCode runDiff(const DiffArguments& arguments) {
    if (const Result<Done> fit = prepareOutputs({arguments.html}, {arguments.a, arguments.b}); !fit)
        return printUsageError(fit.error().message);
    DiffOptions options = arguments.request.options;
    InputFiles read;
    read.watch(options.file);
    const Result<FrameDiff> diff = diffFiles(arguments.a, arguments.b, options);
    ExitCode exit_code = ExitCode::done;
    if (!diff) {
        exit_code = printError(diff.error().element == 1 ? arguments.b : arguments.a, diff.error());
        if (!arguments.json) return exit_code;
    } else if (!diff->isWithin(arguments.request.tolerance_deg)) {
        exit_code = ExitCode::findings;
    }
    if (diff && !arguments.html.empty()) {
        const Result<Done> written =
            writeTextFile(arguments.html, diffPage(arguments.a, arguments.b, *diff, options), &read);
        if (!written) exit_code = worse(exit_code, printError(arguments.html, written.error()));
    }
    std::string text;
    if (arguments.json) {
        text = report::diffJson(arguments.a, arguments.b, arguments.request.tolerance_deg, diff, exit_code);
    } else if (!arguments.quiet) {
        text = diffText(arguments, *diff);
    }
    return printResult(text) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
