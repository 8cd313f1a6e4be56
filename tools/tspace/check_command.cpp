// SPDX-License-Identifier: MIT
// tspace check
#include <algorithm>

#include "commands.h"
#include "read_files.h"
#include "standard_input.h"
#include "text_file.h"

namespace tspace::tool {
namespace {

/// Takes away what the user does not want to hear of, and counts anew.
void leaveOut(CheckReport& report, const CheckArguments& arguments) {
    const auto is_unwanted = [&](const Finding& finding) {
        const auto& ignored = arguments.ignored;
        return finding.severity < arguments.least_severity ||
               std::find(ignored.begin(), ignored.end(), finding.code) != ignored.end();
    };
    std::erase_if(report.findings, is_unwanted);
    const auto count = [&](Severity severity) {
        return static_cast<std::uint64_t>(std::count_if(report.findings.begin(), report.findings.end(),
                                                        [&](const Finding& f) { return f.severity == severity; }));
    };
    report.error_count = count(Severity::error);
    report.warning_count = count(Severity::warning);
    report.note_count = count(Severity::note);
}

Result<CheckReport> check(const std::string& input, CheckOptions options, const CheckArguments& arguments) {
    StandardInput standard_input;
    if (const Result<Done> opened = standard_input.open(input, options.file); !opened) return opened.error();
    Result<CheckReport> report = checkFile(input, options);
    if (report) leaveOut(*report, arguments);
    return report;
}

bool hasFindings(const CheckReport& report, Severity least) {
    return std::any_of(report.findings.begin(), report.findings.end(),
                       [&](const Finding& finding) { return finding.severity >= least; });
}

}  // namespace

ExitCode runCheck(const CheckArguments& arguments) {
    const bool sarif_to_stdout = arguments.sarif == "-";
    const bool wants_text = !arguments.json && !arguments.quiet && !sarif_to_stdout;
    const bool in_color = wantsColor(arguments.color);
    std::vector<Job> jobs = inputJobs(arguments.inputs);
    takeShard(jobs, arguments.batch.shard);
    const unsigned workers = workerCount(arguments.batch, jobs.size());
    CheckOptions options = arguments.options;
    options.execution.thread_count = threadsPerFile(options.execution.thread_count, workers);
    const auto files = readFiles<CheckReport>(
        jobs, arguments.batch, {.progress = !arguments.quiet, .text = wants_text},
        [&](const std::string& input) { return check(input, options, arguments); },
        [&](const CheckOutcome& outcome) { return checkText(outcome, in_color); });
    if (files.output_is_closed) return ExitCode::cannotReadOrWrite;
    ExitCode exit_code = files.exit_code;
    for (const CheckOutcome& outcome : files.outcomes) {
        if (outcome.result && hasFindings(*outcome.result, arguments.fail_on))
            exit_code = worse(exit_code, ExitCode::findings);
    }
    if (!arguments.sarif.empty() && !sarif_to_stdout) {
        const Result<Done> written = writeTextFile(arguments.sarif, checkSarif(files.outcomes, exit_code));
        if (!written) exit_code = worse(exit_code, printError(arguments.sarif, written.error()));
    }
    std::string last;
    if (sarif_to_stdout) {
        last = checkSarif(files.outcomes, exit_code);
    } else if (arguments.json) {
        last = checkJson(files.outcomes, exit_code, arguments.fail_on);
    } else if (wants_text && files.outcomes.size() > 1) {
        last = checkSummary(files.outcomes, in_color);
    }
    return printResult(last) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
