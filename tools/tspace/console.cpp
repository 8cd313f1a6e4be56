// SPDX-License-Identifier: MIT
// What goes to the terminal.
#include "console.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "system.h"

namespace tspace::tool {
namespace {

/// Writes the line in one piece, as several threads may print.
void printLine(const std::string& line) { printPlain(line + "\n"); }

}  // namespace

void printPlain(std::string_view text) noexcept {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

ExitCode printError(const std::string& file, const Error& error) {
    // A wrong option is no fault of the file.
    const std::string about = error.code == ErrorCode::invalidOption ? "" : printable(file) + ": ";
    std::string line = "tspace: " + about + printable(error.message);
    if (!error.place.empty() && error.place != file) line += " (at " + printable(error.place) + ")";
    printLine(line);
    return report::exitCodeOf(error.code);
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
