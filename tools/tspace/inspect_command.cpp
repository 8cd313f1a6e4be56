// SPDX-License-Identifier: MIT
// tspace inspect
#include "commands.h"
#include "read_files.h"
#include "standard_input.h"

namespace tspace::tool {

ExitCode runInspect(const InspectArguments& arguments) {
    std::vector<Job> jobs = inputJobs(arguments.inputs);
    takeShard(jobs, arguments.batch.shard);
    const auto files = readFiles<Inspection>(
        jobs, arguments.batch, {.progress = !arguments.quiet, .text = !arguments.json && !arguments.quiet},
        [&](const std::string& input) -> Result<Inspection> {
            StandardInput standard_input;
            FileOptions own = arguments.file;
            if (const Result<Done> opened = standard_input.open(input, own); !opened) return opened.error();
            return inspectFile(input, own);
        },
        inspectText);
    if (files.output_is_closed) return ExitCode::cannotReadOrWrite;
    if (!arguments.json) return files.exit_code;
    return printResult(report::inspectJson(files.outcomes, files.exit_code)) ? files.exit_code
                                                                             : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
