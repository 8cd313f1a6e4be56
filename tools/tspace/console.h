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

#include "arguments.h"
#include "commands/shared/counted.h"
#include "tspace/asset.h"

namespace tspace::tool {

/// Sends the text to stderr as it is. All that the tool prints there goes through here. Throws nothing: where stderr takes
/// nothing, there is nobody to tell.
void printPlain(std::string_view text) noexcept;

/// Prints "tspace: FILE: message (at PLACE)" on stderr as exactly one line, and returns the exit code it
/// stands for.
ExitCode printError(const std::string& file, const Error& error);
/// The same for a call on several files: the error's element says which of them it is about, or the first.
ExitCode printErrorOfFiles(const std::vector<std::string>& files, const Error& error);
/// The same for a wrong command line: "tspace: message".
ExitCode printUsageError(const std::string& message);

/// The same for what is no error.
void printRemark(const std::string& message);

/// Writes text to stdout, or to stderr where a model goes to stdout. false when stdout cannot take it (closed pipe, full
/// disk), which is said on stderr.
bool printResult(std::string_view text, std::FILE* to = stdout);

/// Whether stdout gets colours. automatic: it is a terminal that shows them, and the user did not say no by NO_COLOR.
bool wantsColor(Color color);

/// The text with control characters replaced, and characters escaped that turn the direction of text, so that a name from
/// a file can break neither lines nor the terminal, nor look like another one.
std::string printable(std::string_view text);

using report::counted;
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
