// SPDX-License-Identifier: MIT
// tspace diff: two models, corner by corner.
#include "commands.h"
#include "console.h"
#include "report.h"

namespace tspace::tool {

ExitCode runDiff(const DiffArguments& arguments) {
    const Result<FrameDiff> diff = diffFiles(arguments.a, arguments.b, arguments.request.options);
    ExitCode exit_code = ExitCode::done;
    if (!diff) {
        exit_code = printError(diff.error().element == 1 ? arguments.b : arguments.a, diff.error());
        if (!arguments.json) return exit_code;
    } else if (!diff->isWithin(arguments.request.tolerance_deg)) {
        exit_code = ExitCode::findings;
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
