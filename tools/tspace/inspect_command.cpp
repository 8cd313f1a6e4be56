// SPDX-License-Identifier: MIT
// tspace inspect: many files, several at one time; one bad file does not stop the others.
#include <atomic>
#include <optional>

#include "batch.h"
#include "commands.h"
#include "console.h"
#include "report.h"

namespace tspace::tool {
namespace {

Result<Inspection> inspect(const Job& job, const FileOptions& options) {
    if (job.error.code != ErrorCode::ok) return job.error;
    return inspectFile(job.input, options);
}

}  // namespace

ExitCode runInspect(const InspectArguments& arguments) {
    const bool wants_text = !arguments.json && !arguments.quiet;
    std::vector<Job> jobs = inputJobs(arguments.inputs);
    takeShard(jobs, arguments.batch.shard);
    std::vector<InspectOutcome> outcomes(jobs.size());
    ExitCode exit_code = ExitCode::done;
    std::atomic<bool> output_is_closed = false;
    const auto work = [&](std::size_t number) {
        outcomes[number] = {.job = jobs[number], .result = inspect(jobs[number], arguments.file)};
    };
    const auto finished = [&](std::size_t number) {
        const InspectOutcome& outcome = outcomes[number];
        if (!outcome.result) {
            exit_code = worse(exit_code, printError(outcome.job.input, outcome.result.error()));
        } else if (wants_text && !output_is_closed) {
            const std::string gap = number > 0 ? "\n" : "";
            output_is_closed = !printResult(gap + inspectText(outcome));
        }
    };
    runBatch(jobs.size(), workerCount(arguments.batch, jobs.size()), work, finished, [&] { return output_is_closed.load(); });
    if (output_is_closed) return ExitCode::cannotReadOrWrite;
    if (!arguments.json) return exit_code;
    return printResult(inspectJson(outcomes, exit_code)) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
