// SPDX-License-Identifier: MIT
// Formats the report of diff as text.
#include <algorithm>

#include "commands/diff/diff_report.h"
#include "commands/shared/text.h"

namespace tspace::report {
namespace {

std::string tableText(const TextTable& rows) {
    Table table;
    for (std::vector<std::string> row : rows) {
        for (std::string& cell : row) cell = printable(cell);
        table.addRow(std::move(row));
    }
    return table.text("  ");
}

std::string bar(std::uint64_t count, std::uint64_t most) {
    constexpr std::uint64_t kColumns = 32;
    if (count == 0) return "";
    return std::string(std::max<std::uint64_t>(1, count * kColumns / most), '#');
}

std::string histogramText(const AngleStatistics& tangents) {
    if (tangents.count == 0) return "";
    const std::uint64_t most = *std::max_element(tangents.histogram.begin(), tangents.histogram.end());
    Table table;
    for (std::size_t i = 0; i < kAngleBins.size(); ++i)
        table.addRow({binText(i), std::to_string(tangents.histogram[i]), bar(tangents.histogram[i], most)});
    return "  corners by the angle between their tangents, in degrees\n" + table.text("    ");
}

}  // namespace

std::string diffText(const std::string& a, const std::string& b, const FrameDiff& diff) {
    const DiffWords words = diffWords(a, b, diff);
    std::string text = printable(words.summary) + "\n";
    for (const std::string& remark : words.remarks) text += "  " + printable(remark) + "\n";
    for (const std::string& part :
         {tableText(words.angles), histogramText(diff.tangents), tableText(words.primitives), tableText(words.worst)}) {
        if (!part.empty()) text.append("\n").append(part);
    }
    return text;
}

}  // namespace tspace::report
