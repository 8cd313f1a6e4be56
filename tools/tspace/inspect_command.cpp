// SPDX-License-Identifier: MIT
// tspace inspect: describes the contents of models.
#include <memory>

#include "command_table.h"
#include "commands/inspect/inspect_report.h"
#include "commands/shared/request.h"
#include "common_options.h"
#include "console.h"
#include "read_files.h"
#include "standard_input.h"

namespace tspace::tool {
namespace {

struct InspectArguments {
    std::vector<std::string> inputs = {};
    FileOptions file = {};
    BatchArguments batch = {};
    bool json = false;
    bool quiet = false;
};

ExitCode runInspect(const InspectArguments& arguments) {
    std::vector<Job> jobs = inputJobs(arguments.inputs);
    takeShard(jobs, arguments.batch.shard);
    const auto files = readFiles<Inspection>(
        jobs, arguments.batch, !arguments.json && !arguments.quiet,
        [&](const Job& job) -> Result<Inspection> {
            StandardInput standard_input;
            FileOptions own = arguments.file;
            if (const Result<Done> opened = standard_input.open(job.input, own); !opened) return opened.error();
            return inspectFile(job.input, own);
        },
        report::inspectText);
    if (files.output_is_closed) return ExitCode::cannotReadOrWrite;
    if (!arguments.json) return files.exit_code;
    return printResult(report::inspectJson(files.outcomes, files.exit_code)) ? files.exit_code
                                                                             : ExitCode::cannotReadOrWrite;
}

}  // namespace

Command inspectCommand() {
    const auto owned = std::make_shared<InspectArguments>();
    InspectArguments& arguments = *owned;
    Command command{
        .summary = "list the contents of model files",
        .operands = "IN...",
        .description =
            "Prints for each primitive: triangles, vertices, attributes, UV sets, material, whether it needs tangents "
            "and why, triangles without UV area, and mirrored UV islands. No input is changed.",
        .examples = {"tspace inspect helmet.glb", "tspace inspect --json models/ > models.json"},
    };
    addInputs(command, arguments.inputs, InputKind::model);
    command.add(inspectOptions(arguments.file));
    addBatch(command, arguments.batch, false);
    addReporting(command, arguments.json, arguments.quiet);
    command.file = &owned->file;
    command.run = [owned] { return runInspect(*owned); };
    return command;
}

}  // namespace tspace::tool
