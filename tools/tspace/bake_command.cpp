// SPDX-License-Identifier: MIT
// tspace bake: one low poly, one high poly.
#include <chrono>
#include <memory>

#include "command_table.h"
#include "commands/bake/bake_report.h"
#include "commands/shared/request.h"
#include "common_options.h"
#include "console.h"
#include "interrupt.h"
#include "jobs.h"
#include "output_files.h"

namespace tspace::tool {
namespace {

struct BakeArguments {
    std::string low = {}, high = {}, output = {};
    std::string report = {};  ///< a file for the JSON; empty: none
    BakeFileOptions options = {};
    bool json = false;
    bool quiet = false;
};

Result<BakeFileReport> bake(const BakeArguments& arguments, InputFiles& read) {
    BakeFileOptions options = arguments.options;
    read.watch(options.file);
    ProgressLine progress(1, !arguments.quiet);
    options.progress = [&](const char* what, std::uint64_t done, std::uint64_t total) {
        if (wasInterrupted()) throw Cancelled{};
        progress.update(arguments.low, what, done, total);
    };
    const KeptFiles kept({arguments.report});
    return bakeFile(arguments.low, arguments.high, arguments.output, options);
}

ExitCode runBake(const BakeArguments& arguments) {
    const BakeFileOptions& options = arguments.options;
    const Result<Done> fit =
        prepareOutputs({arguments.output, options.misses, options.heat, options.out_mesh, arguments.report},
                       {arguments.low, arguments.high, options.cage, options.skew});
    if (!fit) return printUsageError(fit.error().message);
    catchInterrupts();
    InputFiles read;
    const auto start = std::chrono::steady_clock::now();
    const Result<BakeFileReport> result = bake(arguments, read);
    if (!result && wasInterrupted()) endByInterrupt();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    ExitCode exit_code =
        result ? (result->findings.empty() ? ExitCode::done : ExitCode::findings)
               : printErrorOfFiles({arguments.low, arguments.high, options.cage, "", options.skew}, result.error());
    // Who reads no report shall see why there is no map.
    if (result && result->output_files.empty()) {
        for (const std::string& finding : result->findings) printRemark(finding);
    }
    const report::Outcome<BakeFileReport> outcome{
        .input = arguments.low, .output = arguments.output, .result = result, .seconds = took.count()};
    if (!arguments.report.empty()) {
        const Result<Done> written =
            writeTextFile(arguments.report, report::bakeJson(outcome, arguments.high, exit_code), &read);
        if (!written) exit_code = worse(exit_code, printError(arguments.report, written.error()));
    }
    std::string text;
    if (arguments.json) {
        text = report::bakeJson(outcome, arguments.high, exit_code);
    } else if (!arguments.quiet && result) {
        text = report::bakeText(outcome, options.out_mesh);
    }
    return printResult(text) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace

Command bakeCommand() {
    const auto owned = std::make_shared<BakeArguments>();
    BakeArguments& arguments = *owned;
    arguments.options.execution.thread_count = kAllThreads;
    Command command{
        .summary = "bake the normal map of a low poly from a high poly",
        .operands = "LOW --high HIGH -o OUT.png",
        .description =
            "Makes a normal map that lets a low poly look like a high poly: right for the frames that the low poly has "
            "in its file, filtered as renderers filter, and measured in degrees when it is done. Models of several "
            "meshes are matched by name (Body_low with Body_high); several materials give a file each.",
        .examples = {"tspace bake low.glb --high high.glb -o normal.png --size 2048",
                     "tspace bake low.glb --high scan.ply -o normal.png --size 1024 --bits 8 --convention unreal",
                     "tspace bake low.glb --high high.obj -o normal.png --misses misses.png --heat heat.png --report "
                     "bake.json"},
    };
    const char* group = kInputAndOutput;
    command.add(group, operand("LOW", arguments.low, "The model that the map is for. It needs UVs."));
    Option& high = command.add(group, text("--high", "HIGH", arguments.high,
                                           "The model with the detail, in the same place. It needs no UVs."));
    high.is_file = high.is_required = true;
    Option& output =
        command.add(group, text("-o, --output", "OUT", arguments.output,
                                "Where to write: a file that ends in .png; or in .ktx2 or .dds: BC5 with all levels."));
    output.is_file = output.is_required = true;
    command.add(bakeOptions(arguments.options));
    command.add(kReporting, text("--report", "JSON", arguments.report, "Also write the result as JSON to this file."))
        .is_file = true;
    addReporting(command, arguments.json, arguments.quiet);
    command.run = [owned] {
        owned->options.file.importer = importerPath();
        return runBake(*owned);
    };
    return command;
}

}  // namespace tspace::tool
