// SPDX-License-Identifier: MIT
// tspace identify: many files, one after the other; each is worked on by all threads.
#include "batch.h"
#include "commands.h"
#include "console.h"
#include "report.h"

namespace tspace::tool {

ExitCode runIdentify(const IdentifyArguments& arguments) {
    const bool wants_text = !arguments.json && !arguments.quiet;
    std::vector<Job> jobs = inputJobs(arguments.inputs);
    takeShard(jobs, arguments.batch.shard);
    const unsigned workers = workerCount(arguments.batch, jobs.size());
    IdentifyOptions options = arguments.options;
    options.execution.thread_count = threadsPerFile(options.execution.thread_count, workers);
    std::vector<IdentifyOutcome> outcomes(jobs.size());
    ExitCode exit_code = ExitCode::done;
    const auto work = [&](std::size_t number) {
        const Job& job = jobs[number];
        outcomes[number].job = job;
        outcomes[number].result =
            job.error.code == ErrorCode::ok ? identifyFile(job.input, options) : Result<Identification>(job.error);
    };
    bool output_is_closed = false;
    const auto finished = [&](std::size_t number) {
        const IdentifyOutcome& outcome = outcomes[number];
        if (!outcome.result) {
            exit_code = worse(exit_code, printError(outcome.job.input, outcome.result.error()));
        } else if (wants_text && !output_is_closed) {
            const std::string gap = number > 0 ? "\n" : "";
            output_is_closed = !printResult(gap + identifyText(outcome));
        }
    };
    runBatch(jobs.size(), workers, work, finished, [] { return false; });
    if (output_is_closed) return ExitCode::cannotReadOrWrite;
    if (!arguments.json) return exit_code;
    return printResult(identifyJson(outcomes, exit_code)) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
