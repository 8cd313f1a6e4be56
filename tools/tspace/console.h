// SPDX-License-Identifier: MIT
// What goes to the terminal: results to stdout, one line per error and the progress to stderr.
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

/// When severities are coloured. automatic: on a terminal, unless the user said no by NO_COLOR.
enum class Color { automatic, always, never };

/// Writes the text to stderr as it is. All output of the tool to stderr goes through here. Throws nothing, since an error of
/// stderr could not be reported.
void printPlain(std::string_view text) noexcept;

/// Prints "tspace: FILE: message (at PLACE)" on stderr as exactly one line, and returns the exit code it
/// stands for.
ExitCode printError(const std::string& file, const Error& error);
/// Like printError, for a call on several files: the error's element is the index of the file, or the first file is named.
ExitCode printErrorOfFiles(const std::vector<std::string>& files, const Error& error);
/// Prints "tspace: message" for a wrong command line, and returns the exit code for that.
ExitCode printUsageError(const std::string& message);

/// Prints "tspace: message" that is no error.
void printRemark(const std::string& message);

/// Writes text to stdout, or to stderr where a model goes to stdout. false when stdout cannot take it (closed pipe, full
/// disk), which is said on stderr.
bool printResult(std::string_view text, std::FILE* to = stdout);

/// A text for people, fitted to terminalWidth(). Lines stay whole where that is not known, for programs that search them.
std::string fitted(std::string_view text, std::FILE* to = stdout);
bool printText(std::string_view text, std::FILE* to = stdout);
/// Like printText(), for a help page.
ExitCode printPage(std::string_view page);

/// Whether stdout gets colours. automatic: it is a terminal that shows them, and the user did not say no by NO_COLOR.
bool wantsColor(Color color);

/// Columns of the terminal on `file`: COLUMNS where it is set, else what the terminal says; nothing where there is none.
std::optional<std::size_t> terminalWidth(std::FILE* file);

/// The status line of the run on stderr: how many files are done, the stage of a file in progress, and the time since the start.
/// A thread draws it, so it also appears in stages that report nothing. It stays silent when stderr is not a terminal, and during
/// the first half second. Whatever the functions above print replaces the line. Any thread may call.
class ProgressLine {
  public:
    ProgressLine() = default;
    ~ProgressLine() { stop(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Does nothing where stderr is not a terminal, or the system has no thread to draw the line.
    void start();
    void stop();
    void setFileCount(std::size_t count);
    /// total 0: the part that is done is unknown.
    void update(const std::string& file, const char* what, std::uint64_t done, std::uint64_t total);
    void fileDone(bool succeeded);
    /// Writes text in place of the line. Throws nothing.
    std::size_t write(std::string_view text, std::FILE* to) noexcept;

  private:
    using Clock = std::chrono::steady_clock;
    void drawUntilStopped();
    void draw();
    void erase() noexcept;

    std::mutex mutex_ = {};  ///< for everything but `thread_`
    std::condition_variable stopped_ = {};
    std::thread thread_ = {};
    bool is_running_ = false, is_shown_ = false;
    std::size_t file_count_ = 0, done_count_ = 0, failed_count_ = 0;
    std::string file_ = {}, what_ = {};
    std::uint64_t done_ = 0, total_ = 0;
    Clock::time_point start_ = {};
};

/// The one line of the program.
ProgressLine& progressLine();
/// A callback for the library that shows the stages of a file.
Progress progressOf(const std::string& file);

}  // namespace tspace::tool
