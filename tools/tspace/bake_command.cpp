// SPDX-License-Identifier: MIT
// tspace bake: bakes one low poly and one high poly, or a table of pairs (bake_pairs.h).
#include <memory>
#include <string>
#include <vector>

#include "bake_pairs.h"
#include "command_table.h"
#include "commands/bake/bake_outputs.h"
#include "commands/bake/bake_report.h"
#include "commands/bake/match_meshes.h"
#include "commands/shared/request.h"
#include "common_options.h"
#include "console.h"
#include "jobs.h"
#include "model/io/system_files.h"
#include "output_files.h"
#include "report_outputs.h"

namespace tspace::tool {
namespace {

struct BakeArguments {
    std::string low = {}, high = {}, output = {};
    std::string report = {};  ///< path of the JSON report; empty: none
    BakeFileOptions options = {};
    std::string pairs = {};        ///< path of a table that replaces `low` and `high`
    std::string option_text = {};  ///< the given options that affect results
    BatchArguments batch = {};
    bool json = false;
    bool quiet = false;
};

Result<BakeFileReport> bake(const BakeArguments& arguments, InputFiles& read) {
    BakeFileOptions options = arguments.options;
    read.watch(options.file);
    options.progress = progressOf(arguments.low);
    const ProtectedFiles kept({arguments.report});
    return bakeFile(arguments.low, arguments.high, arguments.output, options);
}

ExitCode runBake(const BakeArguments& arguments) {
    const BakeFileOptions& options = arguments.options;
    std::vector<std::string> outputs =
        outputsToCompare({arguments.report}, arguments.low, {.output = arguments.output}, options);
    outputs.push_back(arguments.report);
    const Result<Done> fit = prepareOutputs(
        outputs, {arguments.low, arguments.high, options.cage, options.skew, matchFileOf(options.match)});
    if (!fit) return printUsageError(fit.error().message);
    return makeAndReport<BakeFileReport>(
        arguments, {.input = arguments.low, .output = arguments.output},
        {arguments.low, arguments.high, options.cage, "", options.skew},
        [&](InputFiles& read) { return bake(arguments, read); },
        [](const BakeFileReport& report) { return report::exitCodeOf(report); },
        [](const BakeFileReport& report) { return report.findings; },
        [&](const auto& outcome, ExitCode code) { return report::bakeJson(outcome, arguments.high, code); },
        [&](const auto& outcome) { return report::bakeText(outcome, options.out_mesh); });
}

ExitCode runPairs(const BakeArguments& arguments) {
    return runBakePairs({.table = arguments.pairs,
                         .output = arguments.output,
                         .report = arguments.report,
                         .options = arguments.options,
                         .option_text = arguments.option_text,
                         .batch = arguments.batch,
                         .json = arguments.json,
                         .quiet = arguments.quiet});
}

/// Returns an error message for an invalid combination of options, or an empty string.
std::string finish(const Given& given, BakeArguments& arguments) {
    arguments.option_text = resultOptions(given);
    if (arguments.pairs.empty())
        return arguments.low.empty() || arguments.high.empty()
                   ? "LOW and --high HIGH are missing; give both, or --pairs TABLE"
                   : std::string();
    if (!arguments.low.empty()) return "LOW cannot be combined with --pairs TABLE, which names the low polys";
    if (isModelFile(arguments.options.out_mesh)) return "with --pairs, --out-mesh must name a folder";
    return kindOf(arguments.output) == PathKind::file ? "with --pairs, the output must be a folder" : "";
}

}  // namespace

Command bakeCommand() {
    const auto owned = std::make_shared<BakeArguments>();
    BakeArguments& arguments = *owned;
    arguments.options.execution.thread_count = kAllThreads;
    Command command{
        .summary = "bake the normal map of a low poly from a high poly",
        .operands = "{LOW --high HIGH | --pairs TABLE} -o OUT",
        .description =
            "Bakes a normal map that makes a low poly look like a high poly. The map is made for the tangents stored "
            "in the low poly and is optimized for texture filtering; its error is reported in degrees. Models with "
            "several meshes are matched by name (Body_low with Body_high); each material gets its own file.",
        .examples = {"tspace bake low.glb --high high.glb -o normal.png --size 2048",
                     "tspace bake low.glb --high scan.ply -o normal.png --bits 8 --convention unreal",
                     "tspace bake low.glb --high high.obj -o normal.png --heat heat.png",
                     "tspace bake --pairs pairs.txt -o maps/ --jobs 4 --manifest done.jsonl --resume"},
        .finish = [&arguments](const Given& given) { return finish(given, arguments); },
    };
    const char* group = kInputAndOutput;
    command
        .add(group,
             operand("LOW", arguments.low, InputKind::model, "Low-poly model that receives the map. It needs UVs."))
        .is_required = false;
    command.add(group,
                fileOption("--high", "HIGH", arguments.high,
                           "High-poly model with the detail, aligned with LOW. It needs no UVs.", InputKind::model));
    Option& output = command.add(
        group, fileOption("-o, --output", "OUT", arguments.output,
                          "Output file: .png or .tga (8 bits), or .ktx2 or .dds (BC5 with all mip levels)."));
    output.is_required = true;
    Option& pairs = command.add(
        group, fileOption("--pairs", "TABLE", arguments.pairs,
                          "Run many bakes: a text file of lines LOW = HIGH, or LOW = HIGH = NAME.png, with paths "
                          "relative to the file; lines that begin with # are comments. OUT is then a folder; "
                          "each map is named after LOW, or NAME.png if given. --out-mesh is a folder too.",
                          InputKind::text));
    pairs.excludes = {"--high", "--misses", "--heat", "--cage", "--skew"};
    command.add(bakeOptions(arguments.options));
    addBatch(command, arguments.batch, true);
    for (Option& option : command.options) {
        if ((option.group == kManyFiles || option.name() == "--verbose") && option.needs.empty())
            option.needs = "--pairs";
        if (option.name() == "--manifest") option.excludes.clear();
        if (option.name() == "--resume")
            option.help =
                "Skip pairs that the manifest lists as done with the same options, if neither their files nor their "
                "outputs have changed since.";
        if (option.name() == "--shard")
            option.help =
                "Process only shard I of N (1-based), to split a batch across machines. The shard of a pair depends "
                "only on the name of LOW in TABLE, so adding or removing other pairs does not change it.";
    }
    command.add(kReporting, fileOption("--report", "JSON", arguments.report,
                                       "Also write the report as JSON to this file.", InputKind::text));
    addReporting(command, arguments.json, arguments.quiet);
    command.file = &owned->options.file;
    command.run = [owned] { return owned->pairs.empty() ? runBake(*owned) : runPairs(*owned); };
    return command;
}

}  // namespace tspace::tool
