// SPDX-License-Identifier: MIT
// Calls of the operating system (system_posix.cpp, system_windows.cpp); those on files are in model/io/system_files.h.
#pragma once

#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

namespace tspace::tool {

/// Call it before all else. Where the program was started without stdin, stdout or stderr, opens something that takes and
/// gives nothing in their places: else the next file that is opened would be one of them, and get what is printed.
void openStandardStreams();

/// The words of the command line, in UTF-8. Call it once, first: it also makes standard input and output carry bytes as
/// they are.
std::vector<char*> commandLine(int argc, char** argv);

bool isTerminal(std::FILE* file);
/// Columns of the terminal; 0 where it is not a terminal, or does not tell.
std::size_t terminalColumns(std::FILE* file);
/// Whether a terminal on stdout shows colours.
bool terminalHasColors();

/// Whether a name matches a pattern of *, ? and [...], none of which stand for a dot in front.
bool matchesName(const std::string& pattern, const std::string& name);

std::tm utcTime(std::time_t time);

}  // namespace tspace::tool
