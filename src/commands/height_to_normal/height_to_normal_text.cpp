// SPDX-License-Identifier: MIT
// Formats the report of height-to-normal as text.
#include <fmt/format.h>

#include "commands/height_to_normal/height_to_normal_report.h"
#include "commands/shared/text.h"

namespace tspace::report {
namespace {

/// Formats a length with its unit: "1 texel", "0.5 texels". The symbol "m" has no plural.
std::string lengthText(const std::string& number, const std::string& unit) {
    return number + " " + unit + (number == "1" || unit == "m" ? "" : "s");
}

}  // namespace

std::string heightToNormalText(const Outcome<HeightToNormalFileReport>& outcome,
                               const HeightToNormalFileOptions& options) {
    const HeightToNormalFileReport& done = *outcome.result;
    Table table;
    table.addRow({"image", fmt::format("{} x {}, {} bits per channel, from {}", done.width, done.height, done.bits,
                                       done.bits_before)});
    const std::string unit = options.encoding == HeightEncoding::gray ? "unit" : "m";
    const std::string white = fmt::format("{:.4g}", options.strength);
    const std::string scale = options.encoding == HeightEncoding::gray
                                  ? "white is " + lengthText(white, "unit") + " high"
                                  : fmt::format("heights in meters, times {:.4g}", options.strength);
    if (options.mesh.empty() && options.texel_size == 1 && options.encoding == HeightEncoding::gray) {
        table.addRow({"strength", fmt::format("white is {} high", lengthText(white, "texel"))});
    } else {
        table.addRow({"strength", fmt::format("{}; a texel is {} wide", scale,
                                              lengthText(fmt::format("{:.3g}", done.texels.texel_size),
                                                         options.mesh.empty() ? unit : "unit"))});
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
