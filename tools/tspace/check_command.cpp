// SPDX-License-Identifier: MIT
// tspace check
#include "commands.h"
#include "commands/shared/page/check_page.h"
#include "output_files.h"
#include "read_files.h"
#include "standard_input.h"

namespace tspace::tool {
namespace {

Result<CheckReport> check(const std::string& input, CheckOptions options, const CheckArguments& arguments) {
    StandardInput standard_input;
    if (const Result<Done> opened = standard_input.open(input, options.file); !opened) return opened.error();
    Result<CheckReport> report = checkFile(input, options);
    if (report) options::leaveOut(arguments.request, *report);
    return report;
}

}  // namespace

ExitCode runCheck(const CheckArguments& arguments) {
    const bool sarif_to_stdout = arguments.sarif == "-";
    const bool wants_text = !arguments.json && !arguments.quiet && !sarif_to_stdout;
    const bool in_color = wantsColor(arguments.color);
    std::vector<Job> jobs = inputJobs(arguments.inputs);
    std::vector<std::string> inputs;
    for (const Job& job : jobs) inputs.push_back(job.input);
    if (const Result<Done> fit = prepareOutputs({arguments.sarif, arguments.html}, inputs); !fit)
        return printUsageError(fit.error().message);
    takeShard(jobs, arguments.batch.shard);
    const unsigned workers = workerCount(arguments.batch, jobs.size());
    CheckOptions options = arguments.request.options;
    InputFiles read;
    if (!arguments.sarif.empty() || !arguments.html.empty()) read.watch(options.file);
    options.execution.thread_count = threadsPerFile(options.execution.thread_count, workers);
    const auto files = readFiles<CheckReport>(
        jobs, arguments.batch, {.progress = !arguments.quiet, .text = wants_text},
        [&](const std::string& input) { return check(input, options, arguments); },
        [&](const CheckOutcome& outcome) { return checkText(outcome, in_color); });
    if (files.output_is_closed) return ExitCode::cannotReadOrWrite;
    ExitCode exit_code = files.exit_code;
    for (const CheckOutcome& outcome : files.outcomes) {
        if (outcome.result && options::failsBy(arguments.request, *outcome.result))
            exit_code = worse(exit_code, ExitCode::findings);
    }
    if (!arguments.html.empty()) {
        const Result<Done> written = writeTextFile(arguments.html, checkPage(files.outcomes, options.file), &read);
        if (!written) exit_code = worse(exit_code, printError(arguments.html, written.error()));
    }
    if (!arguments.sarif.empty() && !sarif_to_stdout) {
        const Result<Done> written = writeTextFile(arguments.sarif, checkSarif(files.outcomes, exit_code), &read);
        if (!written) exit_code = worse(exit_code, printError(arguments.sarif, written.error()));
    }
    std::string last;
    if (sarif_to_stdout) {
        last = checkSarif(files.outcomes, exit_code);
    } else if (arguments.json) {
        last = report::checkJson(files.outcomes, exit_code, arguments.request.fail_on);
    } else if (wants_text && files.outcomes.size() > 1) {
        last = checkSummary(files.outcomes, in_color);
    }
    return printResult(last) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
