// SPDX-License-Identifier: MIT
// tspace check: many files, several at one time; one bad file does not stop the others.
#include <atomic>

#include "batch.h"
#include "commands.h"
#include "console.h"
#include "report.h"

namespace tspace::tool {
namespace {

Result<CheckReport> check(const Job& job, const CheckOptions& options) {
    if (job.error.code != ErrorCode::ok) return job.error;
    return checkFile(job.input, options);
}

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
    std::vector<CheckOutcome> outcomes(jobs.size());
    ExitCode exit_code = ExitCode::done;
    std::atomic<bool> output_is_closed = false;
    const auto work = [&](std::size_t number) {
        outcomes[number] = {.job = jobs[number], .result = check(jobs[number], options)};
    };
    const auto finished = [&](std::size_t number) {
        const CheckOutcome& outcome = outcomes[number];
        if (!outcome.result) {
            exit_code = worse(exit_code, printError(outcome.job.input, outcome.result.error()));
            return;
        }
        if (hasFindings(*outcome.result, arguments.fail_on)) exit_code = worse(exit_code, ExitCode::findings);
        if (wants_text && !output_is_closed) {
            const std::string gap = number > 0 ? "\n" : "";
            output_is_closed = !printResult(gap + checkText(outcome, in_color));
        }
    };
    runBatch(jobs.size(), workers, work, finished, [&] { return output_is_closed.load(); });
    if (output_is_closed) return ExitCode::cannotReadOrWrite;
    std::string last;
    if (arguments.json) {
        last = checkJson(outcomes, exit_code, arguments.fail_on);
    } else if (wants_text && outcomes.size() > 1) {
        last = checkSummary(outcomes);
    }
    return printResult(last) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
