// SPDX-License-Identifier: MIT
// tspace check
#include "commands.h"
#include "read_files.h"

namespace tspace::tool {
namespace {

bool hasFindings(const CheckReport& report, Severity least) {
    switch (least) {
        case Severity::note:
            return !report.findings.empty();
        case Severity::warning:
            return report.error_count + report.warning_count > 0;
        case Severity::error:
            break;
    }
    return report.error_count > 0;
}

}  // namespace

ExitCode runCheck(const CheckArguments& arguments) {
    const bool wants_text = !arguments.json && !arguments.quiet;
    const bool in_color = wantsColor();
    std::vector<Job> jobs = inputJobs(arguments.inputs);
    takeShard(jobs, arguments.batch.shard);
    const unsigned workers = workerCount(arguments.batch, jobs.size());
    CheckOptions options = arguments.options;
    options.execution.thread_count = threadsPerFile(options.execution.thread_count, workers);
    const auto files = readFiles<CheckReport>(
        jobs, workers, wants_text, [&](const std::string& input) { return checkFile(input, options); },
        [&](const CheckOutcome& outcome) { return checkText(outcome, in_color); });
    if (files.output_is_closed) return ExitCode::cannotReadOrWrite;
    ExitCode exit_code = files.exit_code;
    for (const CheckOutcome& outcome : files.outcomes) {
        if (outcome.result && hasFindings(*outcome.result, arguments.fail_on))
            exit_code = worse(exit_code, ExitCode::findings);
    }
    std::string last;
    if (arguments.json) {
        last = checkJson(files.outcomes, exit_code, arguments.fail_on);
    } else if (wants_text && files.outcomes.size() > 1) {
        last = checkSummary(files.outcomes);
    }
    return printResult(last) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
