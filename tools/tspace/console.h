// SPDX-License-Identifier: MIT
// Output to the terminal: results to stdout, error lines and progress to stderr.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "commands/shared/exit_code.h"
#include "commands/shared/text.h"
#include "tspace/callbacks.h"
#include "tspace/result.h"

namespace tspace::tool {

using report::byteText;
using report::ExitCode;
using report::printable;
using report::worse;

/// Use of colors for severities. automatic: on a terminal, unless NO_COLOR is set.
enum class Color { automatic, always, never };

/// Writes the text to stderr unchanged. All stderr output of the tool uses this function. Does not throw, since an
/// error of stderr could not be reported.
void printPlain(std::string_view text) noexcept;

/// Prints "tspace: FILE: message (at PLACE)" to stderr as exactly one line, and returns the exit code for the error.
ExitCode printError(const std::string& file, const Error& error);
/// Prints an error of a call on several files: names the file whose index is the error's element, otherwise the first
/// file.
ExitCode printErrorOfFiles(const std::vector<std::string>& files, const Error& error);
/// Prints "tspace: message" for an invalid command line, and returns the exit code for it.
ExitCode printUsageError(const std::string& message);

/// Prints "tspace: message" for a remark that is not an error.
void printRemark(const std::string& message);

inline constexpr const char* kCannotPrint = "tspace: cannot write to standard output\n";

/// Writes text to stdout, or to stderr if a model is written to stdout. If stdout cannot be written (closed pipe, full
/// disk), prints the line `failure` to stderr and returns false.
bool printResult(std::string_view text, std::FILE* to = stdout, std::string_view failure = kCannotPrint);

/// Wraps a text to terminalWidth(). If the width is unknown, lines stay unwrapped, for programs that search them.
std::string fitted(std::string_view text, std::FILE* to = stdout);
bool printText(std::string_view text, std::FILE* to = stdout);
/// Prints a help page, wrapped to the terminal, and returns the exit code.
ExitCode printPage(std::string_view page);

/// Returns whether stdout gets colors. automatic: if it is a terminal with colors, and NO_COLOR is not set.
bool wantsColor(Color color);

/// Returns the columns of the terminal on `file`: COLUMNS if set, otherwise the terminal's width; nullopt if there is
/// no terminal.
std::optional<std::size_t> terminalWidth(std::FILE* file);

/// Status line of the run on stderr: number of finished files, stage of a file in progress, and time since the start. A
/// thread draws it, so it is also updated during stages without reports. It is not shown if stderr is not a terminal,
/// and during the first half second. Text printed by the functions above replaces the line. Thread-safe.
class ProgressLine {
  public:
    ProgressLine() = default;
    ~ProgressLine() { stop(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Does nothing if stderr is not a terminal, or the system has no thread to draw the line.
    void start();
    void stop();
    void setFileCount(std::size_t count);
    /// Sets the stage of a file. If `total` is 0, the progress within the stage is unknown.
    void update(const std::string& file, const char* what, std::uint64_t done, std::uint64_t total);
    void fileDone(bool succeeded);
    /// Writes text in place of the line. Does not throw.
    std::size_t write(std::string_view text, std::FILE* to) noexcept;

  private:
    using Clock = std::chrono::steady_clock;
    void drawUntilStopped();
    void draw();
    void erase() noexcept;

    std::mutex mutex_ = {};  ///< guards everything except `thread_`
    std::condition_variable stopped_ = {};
    std::thread thread_ = {};
    bool is_running_ = false, is_shown_ = false;
    std::size_t file_count_ = 0, done_count_ = 0, failed_count_ = 0;
    std::string file_ = {}, what_ = "reading";
    std::uint64_t done_ = 0, total_ = 0;
    Clock::time_point start_ = {};
};

/// Returns the only status line of the program.
ProgressLine& progressLine();
/// Returns a callback for the library that shows the stages of a file.
Progress progressOf(const std::string& file);

}  // namespace tspace::tool
