// SPDX-License-Identifier: MIT
// Operating system calls (system_posix.cpp, system_windows.cpp); those on files are in model/io/system_files.h.
#pragma once

#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

namespace tspace::tool {

/// Opens a dummy for each standard stream that is closed when the program starts: otherwise the next opened file would
/// get its descriptor, and receive printed text. Must be called before all else.
void openStandardStreams();

/// Returns the arguments of the command line in UTF-8. Must be called once, first: it also switches standard input and
/// output to binary mode.
std::vector<char*> commandLine(int argc, char** argv);

bool isTerminal(std::FILE* file);
/// Returns the number of terminal columns; 0 if it is not a terminal, or unknown.
std::size_t terminalColumns(std::FILE* file);
/// Returns whether stdout is a terminal with colors.
bool terminalHasColors();

/// Returns whether a name matches a pattern with *, ? and [...], which do not match a leading dot.
bool matchesName(const std::string& pattern, const std::string& name);

std::tm utcTime(std::time_t time);

}  // namespace tspace::tool
