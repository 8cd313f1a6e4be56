// SPDX-License-Identifier: MIT
// Report of tspace finish as text.
#include <fmt/format.h>

#include "commands/bake/bake_report.h"
#include "commands/finish/finish_report.h"
#include "commands/shared/text.h"

namespace tspace::report {
namespace {

void addModel(const char* what, const FinishedModel& model, Table& table) {
    const std::vector<std::string> done = doneTo(model);
    for (std::size_t i = 0; i < done.size(); ++i) table.addRow({i == 0 ? what : "", printable(done[i])});
    for (const std::string& warning : model.made.warnings) table.addRow({"warning", printable(warning)});
}

/// Adds the remaining errors, each with its fix.
void addErrors(const CheckReport& check, Table& table) {
    constexpr std::size_t kMaxErrors = 5;
    std::size_t count = 0;
    for (const Finding& finding : check.findings) {
        if (finding.severity != Severity::error || count++ >= kMaxErrors) continue;
        table.addRow({"error", fmt::format("{}: {}", findingName(finding.code), printable(finding.message))});
        table.addRow({"", printable(finding.remedy)});
    }
    if (count > kMaxErrors)
        table.addRow({"", fmt::format("{} (--json lists all)", counted(count - kMaxErrors, "more error"))});
}

}  // namespace

std::string finishText(const Outcome<FinishReport>& outcome) {
    const FinishReport& report = *outcome.result;
    Table table;
    addModel(report.low ? "high" : "done", report.model, table);
    if (report.low) addModel("low", *report.low, table);
    if (report.bake) addBakedRows(*report.bake, "", table);
    for (const std::string& remark : report.remarks) table.addRow({"note", printable(remark)});
    if (!report.output_files.empty()) {
        table.addRow({"check", findingCounts(report.model.before) + (report.low ? " in the high poly" : " before")});
        if (report.low) table.addRow({"", findingCounts(report.low->before) + " in the low poly"});
        table.addRow({"", findingCounts(report.check) + " in " + printable(report.output_files.front())});
        addErrors(report.check, table);
        table.addRow(
            {"written", fmt::format("{} ({}){}", printable(report.output_files.front()), byteText(report.output_bytes),
                                    report.output_files.size() > 1
                                        ? fmt::format(" and {}", counted(report.output_files.size() - 1, "other file"))
                                        : "")});
    }
    table.addRow({"time", fmt::format("{:.2f} s", outcome.seconds)});
    return fmt::format("{} -> {}\n{}", unbroken(outcome.input), unbroken(outcome.output), table.text("  "));
}

}  // namespace tspace::report
