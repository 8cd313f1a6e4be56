// SPDX-License-Identifier: MIT
// Drops the privileges of a process that reads an untrusted file.
#pragma once

#include <string>
#include <vector>

namespace tspace::import {

/// Restrictions in effect, in addition to the resource limits. A kernel may support both, one or none of them.
struct Confinement {
    /// Landlock: only allowed files can be read; nothing can be written, created, renamed or executed.
    bool of_files = false;
    /// Seccomp: no other program, process, connection or signal; no file can be opened for writing.
    bool of_calls = false;
};

/// Confines this process, which must have one thread, and all its children; this cannot be undone. Open files stay
/// open. `readable`: files, and folders including their contents; all others appear not to exist.
Confinement confine(const std::vector<std::string>& readable);

}  // namespace tspace::import
