// SPDX-License-Identifier: MIT
// tspace convert-map: one normal map, for other frames.
#include <fmt/format.h>

#include "commands.h"
#include "console.h"
#include "image_command.h"
#include "model/io/file_io.h"
#include "output_files.h"
#include "report.h"

namespace tspace::tool {
namespace {

std::string meshText(const std::string& file, const MapMeshReport& mesh) {
    return fmt::format("{}: {} triangles in {} primitives{}{}", printable(file), mesh.triangle_count,
                       mesh.primitive_count, mesh.tangents_made ? ", tangents made" : "",
                       mesh.scale == 1 ? "" : fmt::format(", map scaled by {:.4g}", mesh.scale));
}

std::string textOf(const ConvertMapArguments& arguments, const ConvertMapFileReport& done) {
    const ConvertMapFileOptions& options = arguments.options;
    const ConvertMapReport& texels = done.texels;
    Table table;
    table.addRow({"image", fmt::format("{} x {}, {} bits a channel, from {}", done.width, done.height, done.bits,
                                       done.bits_before)});
    if (done.from.triangle_count > 0) table.addRow({"from", meshText(options.mesh, done.from)});
    if (done.to.triangle_count > 0) {
        table.addRow({"to", meshText(options.to_mesh.empty() ? options.mesh : options.to_mesh, done.to)});
    }
    table.addRow({"texels", fmt::format("{} changed, {} of those shown stay, {} are background", texels.changed,
                                        texels.converted - texels.changed + texels.without_frame + texels.unmatched,
                                        texels.background)});
    table.addRow({"change", fmt::format("{:.3g} degrees in the mean, {:.3g} at most", texels.mean_change_deg,
                                        texels.max_change_deg)});
    for (const std::string& warning : done.warnings) table.addRow({"warning", printable(warning)});
    return fmt::format("{} -> {}{}\n{}", printable(arguments.input), printable(arguments.output),
                       options.dry_run ? " (not written)" : "", table.text("  "));
}

}  // namespace

ExitCode runConvertMap(const ConvertMapArguments& arguments) {
    const Result<Done> fit =
        prepareOutputs({arguments.output}, {arguments.input, arguments.options.mesh, arguments.options.to_mesh},
                       arguments.options.dry_run);
    if (!fit) return printUsageError(fit.error().message + "; name another file");
    if (goesToTerminal(arguments)) return printUsageError(kNoTextForATerminal);
    const Result<ConvertMapFileReport> result =
        callOnImage(arguments.input, arguments.output, arguments.options.file.memory_limit_bytes, arguments.options,
                    [&](const ConvertMapFileOptions& options) {
                        return convertMapFile(arguments.input, arguments.output, options);
                    });
    return printOutcome(arguments, result, report::convertMapJson, textOf);
}

}  // namespace tspace::tool
