// SPDX-License-Identifier: MIT
// Formats the report of compress-map as text.
#include <fmt/format.h>

#include "commands/compress_map/compress_map_report.h"
#include "commands/shared/text.h"

namespace tspace::report {

std::string compressMapText(const Outcome<CompressMapFileReport>& outcome) {
    const CompressMapFileReport& done = *outcome.result;
    Table table;
    table.addRow(
        {"texture", fmt::format("{}, {} x {}, {} {}, {} bytes", done.format, done.width, done.height, done.level_count,
                                done.level_count == 1 ? "level" : "levels", done.output_bytes)});
    table.addRow({"error", fmt::format("mean {:.3g} degrees, 99th percentile {:.3g}, maximum {:.3g} (at texel {:.1f}, "
                                       "{:.1f}), of the filtered texture",
                                       done.mean_error_deg, done.p99_error_deg, done.max_error_deg, done.max_error_x,
                                       done.max_error_y)});
    if (done.roughness_bytes > 0)
        table.addRow(
            {"roughness", fmt::format("{} bytes; mean {:.3f}, and {:.3f} at the last mip level", done.roughness_bytes,
                                      done.mean_roughness, done.mean_widened_roughness)});
    for (const std::string& warning : done.warnings) table.addRow({"warning", printable(warning)});
    return fmt::format("{} -> {}{}\n{}", unbroken(outcome.input), unbroken(outcome.output),
                       outcome.is_dry_run ? " (not written)" : "", table.text("  "));
}

}  // namespace tspace::report
