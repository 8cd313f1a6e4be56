// SPDX-License-Identifier: MIT
// Output to the terminal.
#include "console.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <system_error>

#include "commands/shared/option_table.h"
#include "system.h"

namespace tspace::tool {
namespace {

/// Writes the line with a single call, because several threads may print.
void printLine(const std::string& line) { printPlain(line + "\n"); }

}  // namespace

void printPlain(std::string_view text) noexcept {
    progressLine().write(text, stderr);
    std::fflush(stderr);
}

ExitCode printError(const std::string& file, const Error& error) {
    // Errors of options are printed without the name of the file, because they are not faults of the file.
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

bool printResult(std::string_view text, std::FILE* to, std::string_view failure) {
    if (to == stderr) {
        printPlain(text);
        return true;
    }
    const bool written = progressLine().write(text, to) == text.size() && std::fflush(to) == 0;
    if (!written) printPlain(failure);
    return written;
}

namespace {

/// Assumed terminal width in columns, if it is unknown.
constexpr std::size_t kUsualWidth = 80;

}  // namespace

std::string fitted(std::string_view text, std::FILE* to) {
    constexpr std::size_t kWhole = std::size_t{1} << 20;
    return report::fitText(text, terminalWidth(to).value_or(kWhole));
}

bool printText(std::string_view text, std::FILE* to) { return printResult(fitted(text, to), to); }

ExitCode printPage(std::string_view page) {
    // Maximum width of printed text: longer lines are hard to read.
    constexpr std::size_t kWidest = 100;
    const std::size_t width = std::min(terminalWidth(stdout).value_or(kUsualWidth), kWidest);
    return printResult(report::fitText(page, width, 0)) ? ExitCode::done : ExitCode::cannotReadOrWrite;
}

bool wantsColor(Color color) {
    if (color != Color::automatic) return color == Color::always;
    const char* refused = std::getenv("NO_COLOR");
    return isTerminal(stdout) && terminalHasColors() && (refused == nullptr || *refused == '\0');
}

std::optional<std::size_t> terminalWidth(std::FILE* file) {
    constexpr std::size_t kMin = 20;
    std::uint64_t columns = 0;
    const char* wanted = std::getenv("COLUMNS");
    if (wanted == nullptr || !options::parseNumber(wanted, columns) || columns == 0) columns = terminalColumns(file);
    if (columns == 0) return {};
    return std::max<std::size_t>(columns, kMin);
}

ProgressLine& progressLine() {
    static ProgressLine line;
    return line;
}

Progress progressOf(const std::string& file) {
    return [file](const char* what, std::uint64_t done, std::uint64_t total) {
        progressLine().update(file, what, done, total);
    };
}

void ProgressLine::start() {
    if (!isTerminal(stderr)) return;
    start_ = Clock::now();
    is_running_ = true;
    try {
        thread_ = std::thread([this] { drawUntilStopped(); });
    } catch (const std::system_error&) {
        is_running_ = false;
    }
}

void ProgressLine::stop() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        is_running_ = false;
    }
    stopped_.notify_all();
    thread_.join();
}

void ProgressLine::drawUntilStopped() {
    constexpr auto kPatience = std::chrono::milliseconds(500), kRefresh = std::chrono::milliseconds(200);
    std::unique_lock lock(mutex_);
    const auto isStopped = [this] { return !is_running_; };
    for (auto wait = kPatience; !stopped_.wait_for(lock, wait, isStopped); wait = kRefresh) {
        try {
            draw();
        } catch (const std::bad_alloc&) {
        }
    }
    erase();
}

void ProgressLine::draw() {
    std::string end = what_;
    if (total_ != 0) end += fmt::format(" {:.0f} %", 100.0 * static_cast<double>(done_) / static_cast<double>(total_));
    if (!end.empty()) end += ", ";
    end += fmt::format("{:.0f} s", std::chrono::duration<double>(Clock::now() - start_).count());
    std::string line;
    if (file_count_ > 1) {
        line = fmt::format("{} of {} files{}; ", done_count_, file_count_,
                           failed_count_ == 0 ? "" : fmt::format(", {} failed", failed_count_));
    }
    // A line wider than the terminal could not be erased.
    const std::size_t width = terminalWidth(stderr).value_or(kUsualWidth) - 1, taken = line.size() + end.size() + 2;
    const std::string file = taken < width ? report::lastColumns(printable(file_), width - taken) : "";
    line += (file.empty() ? "" : file + ": ") + end;
    erase();
    line = report::lastColumns(line, width);
    std::fwrite(line.data(), 1, line.size(), stderr);
    std::fflush(stderr);
    is_shown_ = true;
}

void ProgressLine::erase() noexcept {
    if (!is_shown_) return;
    is_shown_ = false;
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
}

void ProgressLine::setFileCount(std::size_t count) {
    const std::lock_guard lock(mutex_);
    file_count_ = count;
}

void ProgressLine::update(const std::string& file, const char* what, std::uint64_t done, std::uint64_t total) {
    const std::lock_guard lock(mutex_);
    if (!is_running_) return;
    if (file != file_) file_ = file;
    if (what != what_) what_ = what;
    done_ = std::min(done, total);
    total_ = total;
}

void ProgressLine::fileDone(bool succeeded) {
    const std::lock_guard lock(mutex_);
    ++done_count_;
    failed_count_ += !succeeded;
}

std::size_t ProgressLine::write(std::string_view text, std::FILE* to) noexcept {
    const std::lock_guard lock(mutex_);
    erase();
    return std::fwrite(text.data(), 1, text.size(), to);
}

}  // namespace tspace::tool
