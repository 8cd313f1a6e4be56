// SPDX-License-Identifier: MIT
// Takes the rights away from a process that reads an untrusted file.
#pragma once

#include <string>
#include <vector>

namespace tspace::import {

/// The restrictions that hold from now on. A kernel without both leaves only the limits of resources.
struct Confinement {
    bool of_files = false;  ///< Landlock: no file is read but those allowed, none is written, made, renamed or run
    bool of_calls =
        false;  ///< seccomp: no other program, process, connection or signal; no file is opened to be written
};

/// For this process, which has one thread, and all that it may start; there is no way back. Files that are open stay so.
/// `readable`: files, and folders with all that is below them; others are not there for it.
Confinement confine(const std::vector<std::string>& readable);

}  // namespace tspace::import
