// SPDX-License-Identifier: MIT
// tspace bake: one low poly, one high poly.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "commands.h"
#include "console.h"
#include "interrupt.h"
#include "model/io/file_io.h"
#include "output_files.h"
#include "report.h"

namespace tspace::tool {
namespace {

std::string degreesText(double degrees) { return fmt::format("{:.4f}", degrees); }

void addFile(const BakedFile& file, Table& table) {
    const BakedMap& map = file.map;
    table.addRow({"map", fmt::format("{}, {} x {}, {} bits", printable(file.path), map.width, map.height, map.bits)});
    table.addRow({"texels", fmt::format("{} baked, {} around them", map.hit_count, map.padding_count)});
    table.addRow({"error", fmt::format("mean {} degrees, 99 % below {}, largest {}; at seams {} in the mean",
                                       degreesText(map.error.mean_deg), degreesText(map.error.p99_deg),
                                       degreesText(map.error.max_deg), degreesText(map.error.seam_mean_deg))});
    table.addRow({"reach", fmt::format("{:.4g}", map.error.reach)});
    if (map.missed_count > 0)
        table.addRow(
            {"warning", fmt::format("{} met no high poly and {} filled from around; --reach looks further, "
                                    "--misses shows where",
                                    counted(map.missed_count, "texel"), map.missed_count == 1 ? "is" : "are")});
    if (map.overlap_count > 0)
        table.addRow({map.conflict_count > 0 ? "warning" : "note",
                      fmt::format("{} shown by several triangles{}", counted(map.overlap_count, "texel"),
                                  map.conflict_count > 0
                                      ? fmt::format(", which want different normals in {} of them", map.conflict_count)
                                      : std::string())});
    if (map.degenerate_uv_count > 0)
        table.addRow({"note", fmt::format("{} without UV area", counted(map.degenerate_uv_count, "triangle"))});
}

std::string textOf(const BakeArguments& arguments, const BakeFileReport& done) {
    Table table;
    for (const BakedFile& file : done.files) addFile(file, table);
    if (!arguments.options.out_mesh.empty())
        table.addRow({"model", fmt::format("{}, with its frames and maps", printable(arguments.options.out_mesh))});
    if (done.frames_made) table.addRow({"note", "the low poly lacks frames; they were made as generate makes them"});
    if (done.matched_by_name) table.addRow({"note", "meshes were matched by their names"});
    for (const std::string& warning : done.warnings) table.addRow({"warning", printable(warning)});
    return fmt::format("{} -> {}\n{}", printable(arguments.low), printable(arguments.output), table.text("  "));
}

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

}  // namespace

ExitCode runBake(const BakeArguments& arguments) {
    const BakeFileOptions& options = arguments.options;
    const Result<Done> fit =
        prepareOutputs({arguments.output, options.misses, options.heat, options.out_mesh, arguments.report},
                       {arguments.low, arguments.high, options.cage});
    if (!fit) return printUsageError(fit.error().message);
    catchInterrupts();
    InputFiles read;
    const auto start = std::chrono::steady_clock::now();
    const Result<BakeFileReport> result = bake(arguments, read);
    if (!result && wasInterrupted()) endByInterrupt();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    ExitCode exit_code =
        result ? ExitCode::done
               : printErrorOfFiles({arguments.low, arguments.high, arguments.options.cage}, result.error());
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
        text = textOf(arguments, *result);
    }
    return printResult(text) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
