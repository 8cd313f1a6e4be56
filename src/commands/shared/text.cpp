// SPDX-License-Identifier: MIT
#include "commands/shared/text.h"

#include <fmt/format.h>

#include <algorithm>

#include "commands/shared/hidden_characters.h"

namespace tspace::report {
namespace {

/// Marks in texts: a non-breaking space, and the end of a table cell. printable() replaces both in its input.
constexpr char kNoBreak = '\x1f', kCellEnd = '\x1d';

bool isNumber(const std::string& cell) {
    return !cell.empty() && cell.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

std::string printable(std::string_view text) {
    std::string clean;
    while (!text.empty()) {
        const HiddenCharacter hidden = hiddenCharacter(text);
        if (hidden.length == 0) {
            clean += text.front();
        } else if (hidden.code < 0xA0) {
            clean += ' ';
        } else {
            clean += fmt::format("\\u{:04x}", hidden.code);
        }
        text.remove_prefix(std::max<std::size_t>(hidden.length, 1));
    }
    return clean;
}

std::size_t columnCount(std::string_view text) {
    std::size_t columns = 0;
    bool is_escape = false;  // inside of a color escape sequence: ESC [ ... m
    for (const char c : text) {
        if (c == '\033') is_escape = true;
        columns += !is_escape && (static_cast<unsigned char>(c) & 0xC0) != 0x80;
        if (c == 'm') is_escape = false;
    }
    return columns;
}

std::string lastColumns(std::string_view text, std::size_t columns) {
    constexpr std::string_view kCut = "...";
    std::size_t left = columnCount(text);
    if (left <= columns) return std::string(text);
    if (columns <= kCut.size()) return std::string(kCut.substr(0, columns));
    while (left > columns - kCut.size()) {
        text.remove_prefix(1);
        while (!text.empty() && (static_cast<unsigned char>(text.front()) & 0xC0) == 0x80) text.remove_prefix(1);
        --left;
    }
    return std::string(kCut) + std::string(text);
}

std::string byteText(std::uint64_t bytes) {
    if (bytes < 1000) return fmt::format("{} B", bytes);
    const double kilo = static_cast<double>(bytes) / 1e3;
    if (kilo < 1000) return fmt::format("{:.1f} kB", kilo);
    if (kilo < 1e6) return fmt::format("{:.1f} MB", kilo / 1e3);
    return fmt::format("{:.1f} GB", kilo / 1e6);
}

std::string unbroken(std::string_view text) {
    std::string marked = printable(text);
    std::replace(marked.begin(), marked.end(), ' ', kNoBreak);
    return marked;
}

namespace {

bool endsCommand(std::string_view word) {
    return word.empty() || std::string_view(".,;:)'\"").find(word.back()) != std::string_view::npos;
}

/// Returns whether a word belongs to the same command as the previous word `before`: it is an option, the value of an
/// option, or a name such as IN or OUT.png. Choices in a usage line do not belong to it.
bool continuesCommand(std::string_view before, std::string_view word) {
    if (word.starts_with('{') || word.starts_with('[')) return false;
    if (word.starts_with('-') || before.starts_with('-')) return true;
    const bool is_path =
        word.find('/') != std::string_view::npos || word.substr(0, word.size() - 1).find('.') != std::string_view::npos;
    return is_path || std::all_of(word.begin(), word.end(), [](char c) { return c < 'a' || c > 'z'; });
}

/// Replaces the spaces inside each command ("tspace check IN") by non-breaking spaces.
void keepCommandsUnbroken(std::string& line) {
    constexpr std::string_view kTool = "tspace ";
    for (std::size_t at = line.find(kTool); at != std::string::npos; at = line.find(kTool, at + 1)) {
        std::string_view before = "--";  // the first word, the name of the command, may follow anything
        for (std::size_t space = at + kTool.size() - 1; space < line.size() && line[space] == ' ';) {
            const std::size_t end = std::min(line.find(' ', space + 1), line.size());
            const std::string_view word = std::string_view(line).substr(space + 1, end - space - 1);
            if (word.empty() || !continuesCommand(before, word)) break;
            line[space] = kNoBreak;
            if (endsCommand(word)) break;
            before = before == "--" ? std::string_view("tspace") : word;
            space = end;
        }
    }
}

/// Returns the number of columns by which continuation lines are indented.
std::size_t hangingIndentOf(std::string_view line, std::size_t width, std::size_t hang) {
    const std::size_t start = std::min(line.find_first_not_of(' '), line.size()), gap = line.find("  ", start);
    if (gap == std::string_view::npos) return start + hang;
    const std::size_t text = columnCount(line.substr(0, std::min(line.find_first_not_of(' ', gap), line.size())));
    return text <= width / 2 ? text : start + hang;
}

void appendFitted(std::string& out, std::string line, std::size_t width, std::size_t hang) {
    keepCommandsUnbroken(line);
    const std::string margin(hangingIndentOf(line, width, hang), ' ');
    std::string_view rest = line;
    while (columnCount(rest) > width) {
        // Breaks at the last space that fits, or at the first space if none fits.
        const std::size_t start = rest.find_first_not_of(' ');
        std::size_t cut = std::string_view::npos;
        for (std::size_t space = rest.find(' ', start); space != std::string_view::npos;
             space = rest.find(' ', space + 1)) {
            if (cut != std::string_view::npos && columnCount(rest.substr(0, space)) > width) break;
            cut = space;
        }
        if (cut == std::string_view::npos) break;
        const std::string_view kept = rest.substr(0, rest.find_last_not_of(' ', cut) + 1);
        out.append(kept).append("\n");
        rest.remove_prefix(std::min(rest.find_first_not_of(' ', cut), rest.size()));
        if (rest.empty()) return;
        line = margin + std::string(rest);
        rest = line;
    }
    out.append(rest).append("\n");
}

std::vector<std::string_view> cellsOf(std::string_view row) {
    std::vector<std::string_view> cells;
    while (!row.empty()) {
        const std::size_t end = std::min(row.find(kCellEnd), row.size());
        cells.push_back(row.substr(0, end));
        row.remove_prefix(std::min(end + 1, row.size()));
    }
    return cells;
}

/// Appends the rows of one table. Columns that do not fit in a line are printed on indented lines below it.
void appendTable(std::string& out, const std::vector<std::string_view>& rows, std::size_t width) {
    constexpr std::size_t kIndent = 6;
    std::vector<std::size_t> widths;
    for (const std::string_view row : rows) {
        const std::vector<std::string_view> cells = cellsOf(row);
        widths.resize(std::max(widths.size(), cells.size()), 0);
        for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], columnCount(cells[i]));
    }
    std::vector<bool> begins_line(widths.size(), false);
    std::size_t column = 0;
    for (std::size_t i = 0; i < widths.size(); ++i) {
        begins_line[i] = i > 0 && column + 2 + widths[i] > width;
        column = begins_line[i] ? kIndent + widths[i] : column + (i > 0 ? 2 : 0) + widths[i];
    }
    for (const std::string_view row : rows) {
        const std::vector<std::string_view> cells = cellsOf(row);
        std::string line;
        const auto flush = [&] {
            line.erase(line.find_last_not_of(' ') + 1);
            // A line is wider only if one cell is.
            if (!line.empty()) appendFitted(out, line, width, 2);
        };
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (begins_line[i]) {
                flush();
                line = std::string(kIndent, ' ');
            } else if (i > 0) {
                line += "  ";
            }
            line += cells[i];
        }
        flush();
    }
}

}  // namespace

std::string fitText(std::string_view text, std::size_t width, std::size_t hang) {
    std::string out;
    std::vector<std::string_view> table;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        const std::string_view line = text.substr(0, end);
        const bool is_row = line.find(kCellEnd) != std::string_view::npos;
        if (!is_row && !table.empty()) {
            appendTable(out, table, width);
            table.clear();
        }
        if (is_row)
            table.push_back(line);
        else
            appendFitted(out, std::string(line), width, hang);
        if (end == std::string_view::npos) {
            out.pop_back();
            break;
        }
        text.remove_prefix(end + 1);
    }
    if (!table.empty()) appendTable(out, table, width);
    std::replace(out.begin(), out.end(), kNoBreak, ' ');
    return out;
}

std::string Table::text(const std::string& margin) const {
    constexpr std::size_t kLongest = 40;
    std::vector<std::vector<std::string>> rows = rows_;
    std::vector<std::string> sentences;
    std::vector<std::size_t> widths;
    for (auto& row : rows) {
        if (row.size() > 2 && columnCount(row.back()) > kLongest && row.back().find(' ') != std::string::npos) {
            const auto known = std::find(sentences.begin(), sentences.end(), row.back());
            const auto number = static_cast<std::size_t>(known - sentences.begin());
            if (known == sentences.end()) sentences.push_back(row.back());
            row.back() = fmt::format("[{}]", number + 1);
        }
        widths.resize(std::max(widths.size(), row.size()), 0);
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columnCount(row[i]));
    }
    std::string out;
    for (const auto& row : rows) {
        std::string line = margin;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string space(widths[i] - columnCount(row[i]), ' ');
            line += isNumber(row[i]) ? space + row[i] : row[i] + space;
            if (i + 1 < row.size()) line += widths.size() > 2 ? std::string(1, kCellEnd) : "  ";
        }
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + "\n";
    }
    for (std::size_t i = 0; i < sentences.size(); ++i) out += fmt::format("{}[{}]  {}\n", margin, i + 1, sentences[i]);
    return out;
}

}  // namespace tspace::report
