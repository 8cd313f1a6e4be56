// SPDX-License-Identifier: MIT
// tspace finish: prepares one model, optionally with a low poly.
#include <memory>
#include <string>
#include <vector>

#include "command_table.h"
#include "commands/bake/match_meshes.h"
#include "commands/finish/finish_report.h"
#include "commands/shared/request.h"
#include "common_options.h"
#include "console.h"
#include "jobs.h"
#include "output_files.h"
#include "page_origin.h"
#include "report_outputs.h"

namespace tspace::tool {
namespace {

struct FinishArguments {
    std::string input = {}, output = {};
    std::string report = {};  ///< path of the JSON report; empty: none
    FinishOptions options = {};
    bool json = false;
    bool quiet = false;
};

Result<FinishReport> finish(const FinishArguments& arguments, InputFiles& read, const PageOrigin& origin) {
    FinishOptions options = arguments.options;
    options.page_date = origin.date;
    options.page_command = origin.command;
    read.watch(options.file);
    options.progress = progressOf(arguments.input);
    const ProtectedFiles kept({arguments.report});
    return finishFile(arguments.input, arguments.output, options);
}

ExitCode runFinish(const FinishArguments& arguments) {
    const FinishOptions& options = arguments.options;
    std::vector<std::string> outputs = {options.page, arguments.report};
    const std::vector<std::string> made = finishOutputs(outputs, arguments.output, options);
    outputs.insert(outputs.begin(), made.begin(), made.end());
    const Result<Done> fit = prepareOutputs(
        outputs, {arguments.input, options.low, matchFileOf(options.bake.match), options.bake.cage, options.bake.skew});
    if (!fit) return printUsageError(fit.error().message);
    const Result<PageOrigin> origin = pageOrigin();
    if (!options.page.empty() && !origin) return printUsageError(origin.error().message);
    return makeAndReport<FinishReport>(
        arguments, {.input = arguments.input, .output = arguments.output},
        {options.low.empty() ? arguments.input : options.low, arguments.input},
        [&](InputFiles& read) { return finish(arguments, read, origin ? *origin : PageOrigin{}); },
        [](const FinishReport& report) { return report::exitCodeOf(report); },
        [](const FinishReport& report) { return report.bake->findings; },
        [&](const auto& outcome, ExitCode code) { return report::finishJson(outcome, options.low, code); },
        report::finishText);
}

}  // namespace

Command finishCommand() {
    const auto owned = std::make_shared<FinishArguments>();
    FinishArguments& arguments = *owned;
    arguments.options.execution.thread_count = kAllThreads;
    Command command{
        .summary = "repair a generated or scanned mesh (winding, normals, tangents), and bake maps onto a low poly",
        .operands = "IN -o OUT.glb",
        .description =
            "Fixes the winding, adds missing normals and recomputes wrong ones (the crease angle and the noise level "
            "are estimated from the mesh), repairs tangents, and reports the findings of check before and after. With "
            "--low, the output is that low poly, with all maps baked from IN. Correct data is kept. Retopology and "
            "unwrapping are not included: if UVs are missing, the report names tools that create them.",
        .examples = {"tspace finish scan.ply -o scan.glb --html scan.html",
                     "tspace finish sculpt.glb --low retopo.glb -o asset.glb --html asset.html",
                     "tspace finish generated.obj -o out.glb --normals all --report out.json"},
    };
    const char* group = kInputAndOutput;
    command.add(group, operand("IN", arguments.input, InputKind::model,
                               "A model file: .glb, .vrm, .gltf or .obj; also .fbx, .ply, .stl, .dae, .3ds and others "
                               "if tspace-import is installed."));
    Option& output =
        command.add(group, fileOption("-o, --output", "OUT", arguments.output,
                                      "Output file: .glb or .vrm. Maps are written to files next to it (OUT_normal.png "
                                      "etc.); maps for which glTF has a texture slot are also embedded."));
    output.is_required = true;
    command.add(finishOptions(arguments.options));
    command.add(kReporting, fileOption("--report", "JSON", arguments.report,
                                       "Also write the report as JSON to this file.", InputKind::text));
    addReporting(command, arguments.json, arguments.quiet);
    command.file = &owned->options.file;
    command.run = [owned] { return runFinish(*owned); };
    return command;
}

}  // namespace tspace::tool
