// SPDX-License-Identifier: MIT
// What goes to the terminal.
#include "console.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "system.h"

namespace tspace::tool {
namespace {

/// In one piece, as several threads may print.
void printLine(const std::string& line) { printPlain(line + "\n"); }

bool isNumber(const std::string& cell) {
    return !cell.empty() && cell.find_first_not_of("0123456789") == std::string::npos;
}

/// Columns that a UTF-8 text takes, close enough for names: one per code point.
std::size_t columnCount(std::string_view text) {
    std::size_t columns = 0;
    for (const char c : text) columns += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    return columns;
}

/// The character that these bytes begin with, where it changes what stands around it and shows nothing itself: marks and
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

void printPlain(std::string_view text) noexcept {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

ExitCode printError(const std::string& file, const Error& error) {
    std::string line = "tspace: " + printable(file) + ": " + printable(error.message);
    if (!error.place.empty() && error.place != file) line += " (at " + printable(error.place) + ")";
    printLine(line);
    return exitCodeOf(error.code);
}

ExitCode printErrorOfFiles(const std::vector<std::string>& files, const Error& error) {
    return printError(error.element < files.size() ? files[error.element] : files.front(), error);
}

ExitCode printUsageError(const std::string& message) {
    printLine("tspace: " + printable(message));
    return ExitCode::usage;
}

void printRemark(const std::string& message) { printLine("tspace: " + printable(message)); }

bool printResult(std::string_view text, std::FILE* to) {
    if (to == stderr) {
        printPlain(text);
        return true;
    }
    const bool written = std::fwrite(text.data(), 1, text.size(), to) == text.size() && std::fflush(to) == 0;
    if (!written) printPlain("tspace: standard output: cannot write\n");
    return written;
}

bool wantsColor(Color color) {
    if (color != Color::automatic) return color == Color::always;
    const char* refused = std::getenv("NO_COLOR");
    return isTerminal(stdout) && terminalHasColors() && (refused == nullptr || *refused == '\0');
}

std::string printable(std::string_view text) {
    std::string clean;
    while (!text.empty()) {
        const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
        std::size_t length = 1;
        if (byte(0) < 0x20 || byte(0) == 0x7F) {
            clean += ' ';
        } else if (byte(0) == 0xC2 && byte(1) >= 0x80 && byte(1) < 0xA0) {
            // U+0080 to U+009F. U+009B alone starts what ESC [ starts.
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

ProgressLine::ProgressLine(std::size_t file_count, bool wanted)
    : file_count_(file_count), wanted_(wanted && isTerminal(stderr)) {}

void ProgressLine::update(const std::string& file, const char* what, std::uint64_t done, std::uint64_t total) {
    if (!wanted_) return;
    const std::lock_guard lock(mutex_);
    constexpr auto kPatience = std::chrono::milliseconds(500);
    constexpr auto kRefresh = std::chrono::milliseconds(100);
    const auto now = Clock::now();
    if (now - start_ < kPatience || now - last_ < kRefresh) return;
    last_ = now;
    shown_ = true;
    std::string line;
    if (file_count_ > 1) {
        line = fmt::format("{} of {} files{}; ", done_count_, file_count_,
                           failed_count_ == 0 ? "" : fmt::format(", {} failed", failed_count_));
    }
    line += fmt::format("{}: {}", printable(file), what);
    if (total != 0) line += fmt::format(" {:.0f} %", 100.0 * static_cast<double>(done) / static_cast<double>(total));
    printPlain("\r\033[K" + line);
}

void ProgressLine::fileDone(bool succeeded) {
    const std::lock_guard lock(mutex_);
    ++done_count_;
    failed_count_ += !succeeded;
}

void ProgressLine::clear() {
    const std::lock_guard lock(mutex_);
    if (!shown_) return;
    shown_ = false;
    printPlain("\r\033[K");
}

}  // namespace tspace::tool
