// SPDX-License-Identifier: MIT
// What the file layer asks an operating system for, and std::filesystem does not give: one file for each kind of system
// (system_files_posix.cpp, system_files_windows.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "asset/c_file.h"
#include "asset/path.h"

namespace tspace {

/// As fopen: null, with errno, where it cannot be opened.
CFile openFile(const Path& path, const char* mode);

/// Fills `to` with the bytes of an open file from `begin` on, whatever was read before; any thread may. False where there
/// are fewer.
bool readAt(std::FILE* file, std::size_t begin, std::span<std::uint8_t> to);

/// The path without links and "..", as far as there is something; what is not there yet follows as it is written.
Path canonicalPath(const Path& path);

/// The same text for all names of an existing file; empty where there is none.
std::string fileIdentity(const Path& path);

/// The number of this process.
std::uint32_t processNumber();
/// False only where there is surely no process of that number.
bool isRunning(std::uint32_t process);
/// Where numbers of processes mean something: another machine, start or container gives another text.
std::string processSpace();

/// The program that runs; empty where nobody can tell.
Path ownProgram();

}  // namespace tspace
