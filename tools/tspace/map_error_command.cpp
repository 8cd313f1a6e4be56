// SPDX-License-Identifier: MIT
// tspace map-error: measures one normal map.
#include <memory>
#include <set>

#include "command_table.h"
#include "commands/map_error/map_error_report.h"
#include "commands/shared/request.h"
#include "common_options.h"
#include "console.h"
#include "jobs.h"
#include "output_files.h"
#include "report_outputs.h"

namespace tspace::tool {
namespace {

struct MapErrorArguments {
    std::string map = {}, low = {}, high = {}, source = {};
    MapErrorFileOptions options = {};
    bool json = false;
    bool quiet = false;
};

ExitCode compareWithSource(const MapErrorArguments& arguments) {
    progressLine().update(arguments.map, "comparing", 0, 0);
    const Result<TextureErrorReport> result = textureErrorFile(arguments.map, arguments.source,
                                                               {.file = arguments.options.file,
                                                                .two_channels = arguments.options.two_channels,
                                                                .execution = arguments.options.execution});
    const ExitCode exit_code = result ? ExitCode::done : printError(arguments.map, result.error());
    const report::Outcome<TextureErrorReport> outcome{.input = arguments.map, .result = result};
    std::string text;
    if (arguments.json) {
        text = report::textureErrorJson(outcome, arguments.source, exit_code);
    } else if (!arguments.quiet && result) {
        text = report::textureErrorText(outcome);
    }
    return (arguments.json ? printResult(text) : printText(text)) ? exit_code : ExitCode::cannotReadOrWrite;
}

ExitCode runMapError(const MapErrorArguments& arguments) {
    if (!arguments.source.empty()) return compareWithSource(arguments);
    const Result<Done> fit = prepareOutputs({arguments.options.heat}, {arguments.map, arguments.low, arguments.high,
                                                                       arguments.options.cage, arguments.options.skew});
    if (!fit) return printUsageError(fit.error().message);
    MapErrorFileOptions options = arguments.options;
    options.progress = progressOf(arguments.map);
    HeldOutputs outputs;
    report::Outcome<MapErrorFileReport> outcome{
        .input = arguments.map, .result = mapErrorFile(arguments.map, arguments.low, arguments.high, options)};
    return commitAndPrint(outputs, [&](const Error* failure) {
        if (failure != nullptr) outcome.result = *failure;
        PreparedReport report;
        if (!outcome.result)
            report.exit_code = printErrorOfFiles(
                {arguments.low, arguments.high, options.cage, arguments.map, options.skew}, outcome.result.error());
        if (arguments.json) {
            report.text = report::mapErrorJson(outcome, arguments.low, arguments.high, report.exit_code);
        } else if (!arguments.quiet && outcome.result) {
            report.text = fitted(report::mapErrorText(outcome));
        }
        return report;
    });
}

/// Returns the options of a comparison with a high poly that do not apply to a comparison with a source.
std::vector<std::string> optionsOfHigh(const OptionList& of_high) {
    const std::set<std::string> shared = {"--two-channels", "--threads", "--no-sync", "--memory-limit",
                                          "--import-seconds"};
    std::vector<std::string> names = {"--high", "LOW"};
    for (const Option& option : of_high) {
        if (!shared.contains(option.name())) names.push_back(option.name());
    }
    return names;
}

}  // namespace

Command mapErrorCommand() {
    const auto owned = std::make_shared<MapErrorArguments>();
    MapErrorArguments& arguments = *owned;
    arguments.options.execution.thread_count = kAllThreads;
    Command command{
        .summary = "measure the error of a normal map against its high poly, and find its cause",
        .operands = "{MAP LOW --high HIGH | MAP --source IMAGE}",
        .description =
            "Measures a normal map made by any program: the angle, in degrees, between the normals that a renderer "
            "computes from the map and those of the high poly. Then tries other interpretations of the map (green "
            "down, tangents of other methods, quads, a bitangent per vertex, object space) and reports which fits "
            "best. With --source it compares a compressed texture with its original, both sampled with bilinear "
            "filtering. No input is changed.",
        .examples = {"tspace map-error normal.png low.glb --high high.glb",
                     "tspace map-error normal.png low.fbx --high scan.ply --heat heat.png --json",
                     "tspace map-error normal.ktx2 --source normal.png"},
    };
    const char* group = kInputAndOutput;
    command.add(group, operand("MAP", arguments.map, InputKind::image,
                               "A normal map: PNG, JPEG, WebP, EXR, KTX2, DDS or TGA."));
    Option& low =
        command.add(group, operand("LOW", arguments.low, InputKind::model, "Low-poly model that uses the map."));
    low.is_required = false;
    command.add(group,
                fileOption("--high", "HIGH", arguments.high, "High-poly model, aligned with LOW.", InputKind::model));
    Option source = fileOption(
        "--source", "IMAGE", arguments.source,
        "Normal map from which the texture MAP was made. MAP is compared with this image instead of a high poly.",
        InputKind::image);
    const OptionList of_high = mapErrorOptions(arguments.options);
    source.excludes = optionsOfHigh(of_high);
    command.add(group, source);
    command.add(of_high);
    addReporting(command, arguments.json, arguments.quiet);
    command.finish = [owned](const Given&) {
        if (!owned->source.empty()) return std::string();
        if (owned->low.empty()) return std::string("LOW is missing");
        return std::string(owned->high.empty() ? "--high is missing" : "");
    };
    command.file = &owned->options.file;
    command.run = [owned] { return runMapError(*owned); };
    return command;
}

}  // namespace tspace::tool
