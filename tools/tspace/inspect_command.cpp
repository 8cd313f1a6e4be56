// SPDX-License-Identifier: MIT
// tspace inspect: file after file, one bad file does not stop the others.
#include "commands.h"
#include "console.h"
#include "report.h"

namespace tspace::tool {

ExitCode runInspect(const InspectArguments& arguments) {
    const bool wants_text = !arguments.json && !arguments.quiet;
    ExitCode exit_code = ExitCode::done;
    std::vector<InspectOutcome> outcomes;
    for (Job& job : inputJobs(arguments.inputs)) {
        Result<Inspection> result = job.error.code == ErrorCode::ok ? inspectFile(job.input, arguments.file)
                                                                    : Result<Inspection>(job.error);
        outcomes.push_back({std::move(job), std::move(result), 0});
        const InspectOutcome& outcome = outcomes.back();
        if (!outcome.result) {
            exit_code = worse(exit_code, printError(outcome.job.input, outcome.result.error()));
        } else if (wants_text) {
            const std::string gap = outcomes.size() > 1 ? "\n" : "";
            if (!printResult(gap + inspectText(outcome))) return ExitCode::cannotReadOrWrite;
        }
    }
    if (!arguments.json) return exit_code;
    return printResult(inspectJson(outcomes, exit_code)) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
