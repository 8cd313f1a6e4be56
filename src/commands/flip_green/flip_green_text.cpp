// SPDX-License-Identifier: MIT
// Report of an image with inverted green as text.
#include <fmt/format.h>

#include "commands/flip_green/flip_green_report.h"
#include "commands/shared/text.h"

namespace tspace::report {

std::string flipGreenText(const Outcome<FlipGreenReport>& outcome) {
    const FlipGreenReport& done = *outcome.result;
    Table table;
    table.addRow({"image", fmt::format("{}, {} x {}, {} bits per channel", imageFormatName(done.format), done.width,
                                       done.height, done.bits)});
    table.addRow({"green", done.is_exact                          ? "inverted exactly"
                           : done.format == ImageFileFormat::jpeg ? "inverted, and recompressed"
                                                                  : "inverted, and rounded"});
    for (const std::string& warning : done.warnings) table.addRow({"warning", printable(warning)});
    return fmt::format("{} -> {}{}\n{}", unbroken(outcome.input), unbroken(outcome.output),
                       outcome.is_dry_run ? " (not written)" : "", table.text("  "));
}

}  // namespace tspace::report
