// SPDX-License-Identifier: MIT
// Formats the report of render as text.
#include <fmt/format.h>

#include "commands/render/render_report.h"
#include "commands/shared/text.h"

namespace tspace::report {

std::string renderText(const Outcome<RenderReport>& outcome, Method method) {
    const RenderReport& done = *outcome.result;
    Table table;
    const std::string turn = done.picture_count > 1 ? fmt::format(", {} in a turntable", done.picture_count) : "";
    table.addRow({"picture", fmt::format("{}, {} x {}{}, {}", renderShowName(done.show), done.width, done.height, turn,
                                         counted(done.triangle_count, "triangle"))});
    if (done.computed_count > 0 && done.show != RenderShow::error) {
        table.addRow({"tangents", fmt::format("computed for {} by {}", counted(done.computed_count, "primitive"),
                                              methodName(method))});
    }
    if (done.without_tangents_count > 0)
        table.addRow({"gray", counted(done.without_tangents_count, "primitive") + " without tangents"});
    if (done.error_sample_count > 0) {
        table.addRow({"error", fmt::format("mean {:.4g}, maximum {:.4g} degrees from {}", done.mean_error_deg,
                                           done.max_error_deg, methodName(method))});
    }
    for (const std::string& warning : done.warnings) table.addRow({"warning", printable(warning)});
    return fmt::format("{} -> {}{}\n{}", unbroken(outcome.input), unbroken(outcome.output),
                       outcome.is_dry_run ? " (not written)" : "", table.text("  "));
}

}  // namespace tspace::report
