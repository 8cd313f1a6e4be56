// SPDX-License-Identifier: MIT
// Formats the report of convert-map as text.
#include <fmt/format.h>

#include "commands/convert_map/convert_map_report.h"
#include "commands/shared/text.h"

namespace tspace::report {
namespace {

std::string meshText(const std::string& file, const MapMeshReport& mesh) {
    return fmt::format("{}: {} in {}{}{}", printable(file), counted(mesh.triangle_count, "triangle"),
                       counted(mesh.primitive_count, "primitive"), mesh.tangents_made ? ", tangents computed" : "",
                       mesh.scale == 1 ? "" : fmt::format(", map scaled by {:.4g}", mesh.scale));
}

}  // namespace

std::string convertMapText(const Outcome<ConvertMapFileReport>& outcome, const ConvertMapFileOptions& options) {
    const ConvertMapFileReport& done = *outcome.result;
    const ConvertMapReport& texels = done.texels;
    Table table;
    table.addRow({"image", fmt::format("{} x {}, {} bits per channel, from {}", done.width, done.height, done.bits,
                                       done.bits_before)});
    if (done.from.triangle_count > 0) table.addRow({"from", meshText(options.mesh, done.from)});
    if (done.to.triangle_count > 0)
        table.addRow({"to", meshText(options.to_mesh.empty() ? options.mesh : options.to_mesh, done.to)});
    table.addRow({"texels", fmt::format("{} changed, {} unchanged inside triangles, {} background", texels.changed,
                                        texels.converted - texels.changed + texels.without_frame + texels.unmatched,
                                        texels.background)});
    table.addRow(
        {"change", fmt::format("mean {:.3g} degrees, maximum {:.3g}", texels.mean_change_deg, texels.max_change_deg)});
    for (const std::string& warning : done.warnings) table.addRow({"warning", printable(warning)});
    return fmt::format("{} -> {}{}\n{}", unbroken(outcome.input), unbroken(outcome.output),
                       outcome.is_dry_run ? " (not written)" : "", table.text("  "));
}

}  // namespace tspace::report
