// SPDX-License-Identifier: MIT
// What goes to the terminal: results to stdout, one line per error and the progress to stderr.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "commands/shared/exit_code.h"
#include "commands/shared/text.h"
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
/// As printError, for a call on several files: the error's element is the number of the file, or the first file is named.
ExitCode printErrorOfFiles(const std::vector<std::string>& files, const Error& error);
/// Prints "tspace: message" for a wrong command line, and returns the exit code for that.
ExitCode printUsageError(const std::string& message);

/// Prints "tspace: message" that is no error.
void printRemark(const std::string& message);

/// Writes text to stdout, or to stderr where a model goes to stdout. false when stdout cannot take it (closed pipe, full
/// disk), which is said on stderr.
bool printResult(std::string_view text, std::FILE* to = stdout);

/// Whether stdout gets colours. automatic: it is a terminal that shows them, and the user did not say no by NO_COLOR.
bool wantsColor(Color color);

/// A status line on stderr for the whole run: how many files are done, and what happens to one of those in work. Stays
/// silent when stderr is no terminal, when not wanted, and during the first half second. Any thread may call.
class ProgressLine {
  public:
    ProgressLine(std::size_t file_count, bool wanted);
    ~ProgressLine() { clear(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void update(const std::string& file, const char* what, std::uint64_t done, std::uint64_t total);
    void fileDone(bool succeeded);
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    std::size_t file_count_ = 0;
    std::size_t done_count_ = 0;
    std::size_t failed_count_ = 0;
    bool wanted_ = false;
    bool shown_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = {};
    std::mutex mutex_ = {};
};

}  // namespace tspace::tool
