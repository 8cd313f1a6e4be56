// SPDX-License-Identifier: MIT
// Names of temporary files, which tell whose they are.
#pragma once

#include <filesystem>

namespace tspace {

inline constexpr const char* kTemporaryEnding = ".tmp";

/// A name beside `target` that no other run and no other thread uses: TARGET.tspace-MACHINE-PROCESS-NUMBER and the
/// ending. Two models that share an image may copy it at the same time.
std::filesystem::path besideName(const std::filesystem::path& target, const char* ending);

}  // namespace tspace
