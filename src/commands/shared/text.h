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

/// "318 B", "6.8 MB".
std::string byteText(std::uint64_t bytes);

/// Rows of cells, printed with aligned columns two spaces apart. Cells of numbers are aligned right.
class Table {
  public:
    void addRow(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
    [[nodiscard]] std::string text(const std::string& margin) const;

  private:
    std::vector<std::vector<std::string>> rows_ = {};
};

}  // namespace tspace::report
