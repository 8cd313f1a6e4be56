// SPDX-License-Identifier: MIT
// tspace identify: finds the method that computed the tangents of models.
#include <memory>

#include "command_table.h"
#include "commands/identify/identify_report.h"
#include "commands/shared/request.h"
#include "common_options.h"
#include "console.h"
#include "read_files.h"
#include "standard_input.h"

namespace tspace::tool {
namespace {

struct IdentifyArguments {
    std::vector<std::string> inputs = {};
    IdentifyOptions options = {};
    BatchArguments batch = {};
    bool json = false;
    bool quiet = false;
};

ExitCode runIdentify(const IdentifyArguments& arguments) {
    std::vector<Job> jobs = inputJobs(arguments.inputs);
    takeShard(jobs, arguments.batch.shard);
    const unsigned workers = workerCount(arguments.batch, jobs.size());
    IdentifyOptions options = arguments.options;
    options.execution.thread_count = threadsPerFile(options.execution.thread_count, workers);
    const auto files = readFiles<Identification>(
        jobs, arguments.batch, !arguments.json && !arguments.quiet,
        [&](const Job& job) -> Result<Identification> {
            StandardInput standard_input;
            IdentifyOptions own = options;
            if (const Result<Done> opened = standard_input.open(job.input, own.file); !opened) return opened.error();
            return identifyFile(job.input, own);
        },
        report::identifyText);
    if (files.output_is_closed) return ExitCode::cannotReadOrWrite;
    if (!arguments.json) return files.exit_code;
    return printResult(report::identifyJson(files.outcomes, files.exit_code)) ? files.exit_code
                                                                              : ExitCode::cannotReadOrWrite;
}

}  // namespace

Command identifyCommand() {
    const auto owned = std::make_shared<IdentifyArguments>();
    IdentifyArguments& arguments = *owned;
    arguments.options.execution.thread_count = kAllThreads;
    Command command{
        .summary = "identify the method that computed the tangents of a model",
        .operands = "IN...",
        .description =
            "Runs every method on the positions, normals and UVs of the model, for each UV set. Reports what share of "
            "the stored tangents each method reproduces, and whether the signs follow glTF or are all inverted. No "
            "input is changed.",
        .examples = {"tspace identify helmet.glb", "tspace identify --json models/ > methods.json"},
    };
    addInputs(command, arguments.inputs, InputKind::model);
    command.add(identifyOptions(arguments.options));
    addBatch(command, arguments.batch, false);
    addReporting(command, arguments.json, arguments.quiet);
    command.file = &owned->options.file;
    command.run = [owned] { return runIdentify(*owned); };
    return command;
}

}  // namespace tspace::tool
