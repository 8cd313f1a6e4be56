// SPDX-License-Identifier: MIT
// The parts of reports as text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "commands/shared/report.h"

namespace tspace::report {

/// The text with control characters replaced, and characters escaped that turn the direction of text, so that a name from
/// a file can break neither lines nor the terminal, nor look like another one.
std::string printable(std::string_view text);

/// Columns that a UTF-8 text takes, close enough for names: one per code point.
std::size_t columnCount(std::string_view text);
/// The text, or "..." and its end, in this many columns.
std::string lastColumns(std::string_view text, std::size_t columns);

/// printable(), for a path or another text that fitText() must not break at its spaces.
std::string unbroken(std::string_view text);

/// The text with lines of at most `width` columns, and tables in as many lines per row as that takes. Lines break at spaces, but
/// not inside commands (tspace ... --option) and unbroken() texts, which may therefore be longer. The rest of a line is
/// indented: by its label, where it begins with one and two spaces, else by `hang` more columns than its start. Every text of this folder goes through
/// it before it is printed.
std::string fitText(std::string_view text, std::size_t width, std::size_t hang = 2);

/// "318 B", "6.8 MB".
std::string byteText(std::uint64_t bytes);

/// Rows of cells, printed with aligned columns two spaces apart. Cells of numbers are aligned right. In tables of more than two
/// columns, a last cell with a long sentence becomes a number, and each such sentence is printed once below the rows.
class Table {
  public:
    void addRow(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
    [[nodiscard]] std::string text(const std::string& margin) const;

  private:
    std::vector<std::vector<std::string>> rows_ = {};
};

}  // namespace tspace::report
