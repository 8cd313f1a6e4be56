// SPDX-License-Identifier: MIT
// Functions that format parts of reports as text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "commands/shared/report.h"

namespace tspace::report {

/// Replaces control characters, and escapes characters that change the text direction, so that a name from a file can
/// neither break lines or the terminal, nor look like another name.
std::string printable(std::string_view text);

/// Returns the number of columns of a UTF-8 text, approximately: one per code point.
std::size_t columnCount(std::string_view text);
/// Shortens a text to this many columns: "..." followed by its end.
std::string lastColumns(std::string_view text, std::size_t columns);

/// Returns printable(text) with non-breaking spaces for fitText(), for example for a path.
std::string unbroken(std::string_view text);

/// Wraps text to lines of at most `width` columns, and table rows to as many lines as necessary. Lines break at spaces,
/// but not inside commands (tspace ... --option) and unbroken() texts, which may therefore exceed `width`. Continuation
/// lines are indented to the text after a label that is followed by two spaces, otherwise by `hang` columns more than
/// the first line. All report texts are passed through this function before printing.
std::string fitText(std::string_view text, std::size_t width, std::size_t hang = 2);

/// Formats a number of bytes, as in "318 B" or "6.8 MB".
std::string byteText(std::uint64_t bytes);

/// Rows of cells with aligned columns, two spaces apart. Numbers are right-aligned. In tables of more than two columns,
/// a long sentence in the last cell is replaced by a number, and each such sentence is printed once below the rows.
class Table {
  public:
    void addRow(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
    [[nodiscard]] std::string text(const std::string& margin) const;

  private:
    std::vector<std::vector<std::string>> rows_ = {};
};

}  // namespace tspace::report
