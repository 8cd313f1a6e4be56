// SPDX-License-Identifier: MIT
// Formats the report of height-to-normal as text.
#include <fmt/format.h>

#include "commands/height_to_normal/height_to_normal_report.h"
#include "commands/shared/text.h"

namespace tspace::report {

std::string heightToNormalText(const Outcome<HeightToNormalFileReport>& outcome,
                               const HeightToNormalFileOptions& options) {
    const HeightToNormalFileReport& done = *outcome.result;
    Table table;
    table.addRow({"image", fmt::format("{} x {}, {} bits per channel, from {}", done.width, done.height, done.bits,
                                       done.bits_before)});
    const std::string unit = options.encoding == HeightEncoding::gray ? "units" : "m";
    const std::string scale = options.encoding == HeightEncoding::gray
                                  ? fmt::format("white is {:.4g} units high", options.strength)
                                  : fmt::format("heights in meters, times {:.4g}", options.strength);
    if (options.mesh.empty() && options.texel_size == 1 && options.encoding == HeightEncoding::gray) {
        table.addRow({"strength", fmt::format("white is {:.4g} texels high", options.strength)});
    } else {
        table.addRow({"strength", fmt::format("{}; a texel is {:.3g} {} wide", scale, done.texels.texel_size,
                                              options.mesh.empty() ? unit : "units")});
    }
    if (!options.mesh.empty()) {
        table.addRow({"mesh", fmt::format("{}: {} in {}{}, covering {} texels", printable(options.mesh),
                                          counted(done.mesh.triangle_count, "triangle"),
                                          counted(done.mesh.primitive_count, "primitive"),
                                          done.mesh.tangents_made ? ", tangents computed" : "", done.texels.on_mesh)});
    }
    table.addRow({"slopes", fmt::format("mean {:.3g} degrees, maximum {:.3g}", done.texels.mean_lean_deg,
                                        done.texels.max_lean_deg)});
    for (const std::string& warning : done.warnings) table.addRow({"warning", printable(warning)});
    return fmt::format("{} -> {}{}\n{}", unbroken(outcome.input), unbroken(outcome.output),
                       outcome.is_dry_run ? " (not written)" : "", table.text("  "));
}

}  // namespace tspace::report
