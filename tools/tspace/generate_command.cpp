// SPDX-License-Identifier: MIT
// tspace generate: file after file, one bad file does not stop the others.
#include <chrono>

#include "commands.h"
#include "console.h"
#include "interrupt.h"
#include "report.h"

namespace tspace::tool {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Thrown out of the library's progress callback: it unwinds, takes its temporary files away, and reports an
/// error.
struct Interrupted {};

Result<GenerateReport> generateOne(const Job& job, const GenerateArguments& arguments) {
    if (job.error.code != ErrorCode::ok) return job.error;
    ProgressLine progress(job.input, !arguments.quiet);
    GenerateOptions options = arguments.options;
    options.progress = [&progress](const char* what, std::uint64_t done, std::uint64_t total) {
        if (wasInterrupted()) throw Interrupted{};
        progress.update(what, done, total);
    };
    return generateFile(job.input, job.output, options);
}

}  // namespace

ExitCode runGenerate(const GenerateArguments& arguments) {
    Result<std::vector<Job>> jobs = generateJobs(arguments);
    if (!jobs) return printUsageError(jobs.error().message);

    catchInterrupts();
    const Clock::time_point start = Clock::now();
    const bool wants_text = !arguments.json && !arguments.quiet;
    ExitCode exit_code = ExitCode::done;
    std::vector<GenerateOutcome> outcomes;
    for (Job& job : *jobs) {
        const Clock::time_point job_start = Clock::now();
        Result<GenerateReport> result = generateOne(job, arguments);
        if (wasInterrupted()) {
            const char* outcome = result ? "done, then interrupted" : "interrupted; nothing was written";
            printError(job.input, {ErrorCode::internal, outcome});
            endByInterrupt();
        }
        outcomes.push_back({std::move(job), std::move(result), secondsSince(job_start)});
        const GenerateOutcome& outcome = outcomes.back();
        if (!outcome.result) {
            exit_code = worse(exit_code, printError(outcome.job.input, outcome.result.error()));
        } else if (wants_text && !printResult(generateText(outcome))) {
            return ExitCode::cannotReadOrWrite;
        }
    }
    std::string last;
    if (arguments.json) {
        last = generateJson(outcomes, exit_code, secondsSince(start));
    } else if (wants_text && outcomes.size() > 1) {
        last = generateSummary(outcomes, secondsSince(start));
    }
    return printResult(last) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
