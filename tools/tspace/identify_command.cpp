// SPDX-License-Identifier: MIT
// tspace identify
#include "commands.h"
#include "read_files.h"
#include "standard_input.h"

namespace tspace::tool {

ExitCode runIdentify(const IdentifyArguments& arguments) {
    std::vector<Job> jobs = inputJobs(arguments.inputs);
    takeShard(jobs, arguments.batch.shard);
    const unsigned workers = workerCount(arguments.batch, jobs.size());
    IdentifyOptions options = arguments.options;
    options.execution.thread_count = threadsPerFile(options.execution.thread_count, workers);
    const auto files = readFiles<Identification>(
        jobs, arguments.batch, {.progress = !arguments.quiet, .text = !arguments.json && !arguments.quiet},
        [&](const std::string& input) -> Result<Identification> {
            StandardInput standard_input;
            IdentifyOptions own = options;
            if (const Result<Done> opened = standard_input.open(input, own.file); !opened) return opened.error();
            return identifyFile(input, own);
        },
        identifyText);
    if (files.output_is_closed) return ExitCode::cannotReadOrWrite;
    if (!arguments.json) return files.exit_code;
    return printResult(report::identifyJson(files.outcomes, files.exit_code)) ? files.exit_code
                                                                              : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
