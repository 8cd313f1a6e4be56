// SPDX-License-Identifier: MIT
// What goes to the terminal.
#include "console.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "system.h"

namespace tspace::tool {
namespace {

void printLine(const std::string& line) { fmt::print(stderr, "{}\n", line); }

bool isNumber(const std::string& cell) {
    return !cell.empty() && cell.find_first_not_of("0123456789") == std::string::npos;
}

/// Columns that a UTF-8 text takes, close enough for names: one per code point.
std::size_t columnCount(std::string_view text) {
    std::size_t columns = 0;
    for (const char c : text) columns += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    return columns;
}

}  // namespace

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
    const bool written = std::fwrite(text.data(), 1, text.size(), to) == text.size() && std::fflush(to) == 0;
    if (!written) printLine("tspace: standard output: cannot write");
    return written;
}

bool wantsColor(Color color) {
    if (color != Color::automatic) return color == Color::always;
    const char* refused = std::getenv("NO_COLOR");
    return isTerminal(stdout) && terminalHasColors() && (refused == nullptr || *refused == '\0');
}

std::string printable(std::string_view text) {
    // U+0080 to U+009F in UTF-8. U+009B alone starts what ESC [ starts.
    const auto isLateControl = [](char lead, char next) {
        return static_cast<unsigned char>(lead) == 0xC2 && static_cast<unsigned char>(next) >= 0x80 &&
               static_cast<unsigned char>(next) < 0xA0;
    };
    std::string clean(text);
    for (std::size_t i = 0; i < clean.size(); ++i) {
        if (static_cast<unsigned char>(clean[i]) < 0x20 || clean[i] == 0x7F) clean[i] = ' ';
        if (i + 1 < clean.size() && isLateControl(clean[i], clean[i + 1])) clean.replace(i, 2, " ");
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
    fmt::print(stderr, "\r\033[K{}", line);
    std::fflush(stderr);
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
    fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
}

}  // namespace tspace::tool
