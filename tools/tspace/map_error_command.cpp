// SPDX-License-Identifier: MIT
// tspace map-error: one normal map.
#include <fmt/format.h>

#include <algorithm>

#include "commands.h"
#include "console.h"
#include "interrupt.h"
#include "output_files.h"
#include "report.h"

namespace tspace::tool {
namespace {

std::string readingText(const ExplainedReading& reading) {
    if (reading.frames == "object") return "object space";
    const std::string frames = reading.frames == "file"    ? "tangents of the file"
                               : reading.frames == "quads" ? "mikktspace on quads"
                                                           : reading.frames;
    return fmt::format("{}, green {}{}{}", frames, reading.reading.green == Green::up ? "up" : "down",
                       reading.reading.bitangent == BitangentPlace::perVertex ? ", bitangent per vertex" : "",
                       reading.reading.two_channels ? ", two channels" : "");
}

std::string textOf(const MapErrorArguments& arguments, const MapErrorFileReport& done) {
    constexpr std::size_t kShown = 4;
    Table table;
    const MapError& error = done.error;
    table.addRow(
        {"error", fmt::format("mean {:.4f} degrees, 99 % below {:.4f}, largest {:.4f}; at seams {:.4f} in the mean",
                              error.mean_deg, error.p99_deg, error.max_deg, error.seam_mean_deg)});
    for (std::size_t i = 0; i < std::min(kShown, done.readings.size()); ++i)
        table.addRow({i == 0 ? "readings" : "", fmt::format("{:.4f} degrees: {}", done.readings[i].error.mean_deg,
                                                            readingText(done.readings[i]))});
    if (error.missed_count > 0)
        table.addRow({"note", fmt::format("{} of {} points met no high poly within {:.4g}", error.missed_count,
                                          error.missed_count + error.point_count, error.reach)});
    for (const std::string& warning : done.warnings) table.addRow({"warning", printable(warning)});
    return fmt::format("{}: {}\n{}", printable(arguments.map), done.verdict, table.text("  "));
}

}  // namespace

ExitCode runMapError(const MapErrorArguments& arguments) {
    const Result<Done> fit = prepareOutputs({arguments.options.heat},
                                            {arguments.map, arguments.low, arguments.high, arguments.options.cage});
    if (!fit) return printUsageError(fit.error().message);
    catchInterrupts();
    MapErrorFileOptions options = arguments.options;
    ProgressLine progress(1, !arguments.quiet);
    options.progress = [&](const char* what, std::uint64_t done, std::uint64_t total) {
        if (wasInterrupted()) throw Cancelled{};
        progress.update(arguments.map, what, done, total);
    };
    const Result<MapErrorFileReport> result = mapErrorFile(arguments.map, arguments.low, arguments.high, options);
    progress.clear();
    if (!result && wasInterrupted()) endByInterrupt();
    const ExitCode exit_code =
        result
            ? ExitCode::done
            : printErrorOfFiles({arguments.low, arguments.high, arguments.options.cage, arguments.map}, result.error());
    std::string text;
    if (arguments.json) {
        text =
            report::mapErrorJson({.input = arguments.map, .result = result}, arguments.low, arguments.high, exit_code);
    } else if (!arguments.quiet && result) {
        text = textOf(arguments, *result);
    }
    return printResult(text) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
