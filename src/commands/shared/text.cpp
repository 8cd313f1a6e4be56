// SPDX-License-Identifier: MIT
#include "commands/shared/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace tspace::report {
namespace {

bool isNumber(const std::string& cell) {
    return !cell.empty() && cell.find_first_not_of("0123456789") == std::string::npos;
}

/// Columns that a UTF-8 text takes, close enough for names: one per code point.
std::size_t columnCount(std::string_view text) {
    std::size_t columns = 0;
    for (const char c : text) columns += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    return columns;
}

/// The character that these bytes begin with, where it is invisible and changes the text around it: marks and
/// overrides of the direction of text, ends of lines, spaces without width. 0: it is none of them.
unsigned invisibleCharacter(unsigned first, unsigned second, unsigned third) {
    if (first == 0xD8 && second == 0x9C) return 0x061C;
    if (first != 0xE2 && first != 0xEF) return 0;
    const unsigned code = (first & 0xFU) << 12 | (second & 0x3FU) << 6 | (third & 0x3FU);
    const bool is_one = code == 0x200B || code == 0x200E || code == 0x200F || (code >= 0x2028 && code <= 0x202E) ||
                        (code >= 0x2060 && code <= 0x206F) || code == 0xFEFF;
    return is_one ? code : 0;
}

}  // namespace

std::string printable(std::string_view text) {
    std::string clean;
    while (!text.empty()) {
        const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
        std::size_t length = 1;
        if (byte(0) < 0x20 || byte(0) == 0x7F) {
            clean += ' ';
        } else if (byte(0) == 0xC2 && byte(1) >= 0x80 && byte(1) < 0xA0) {
            // U+0080 to U+009F. U+009B is ESC [ in one character.
            clean += ' ';
            length = 2;
        } else if (const unsigned code = invisibleCharacter(byte(0), byte(1), byte(2)); code != 0) {
            clean += fmt::format("\\u{:04x}", code);
            length = code < 0x800 ? 2 : 3;
        } else {
            clean += text.front();
        }
        text.remove_prefix(length);
    }
    return clean;
}

std::string byteText(std::uint64_t bytes) {
    if (bytes < 1000) return fmt::format("{} B", bytes);
    const double kilo = static_cast<double>(bytes) / 1e3;
    if (kilo < 1000) return fmt::format("{:.1f} kB", kilo);
    if (kilo < 1e6) return fmt::format("{:.1f} MB", kilo / 1e3);
    return fmt::format("{:.1f} GB", kilo / 1e6);
}

std::string Table::text(const std::string& margin) const {
    std::vector<std::size_t> widths;
    for (const auto& row : rows_) {
        widths.resize(std::max(widths.size(), row.size()), 0);
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columnCount(row[i]));
    }
    std::string out;
    for (const auto& row : rows_) {
        std::string line = margin;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string space(widths[i] - columnCount(row[i]), ' ');
            line += isNumber(row[i]) ? space + row[i] : row[i] + space;
            if (i + 1 < row.size()) line += "  ";
        }
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + "\n";
    }
    return out;
}

}  // namespace tspace::report
