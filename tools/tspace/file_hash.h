// SPDX-License-Identifier: MIT
// A fingerprint of a file's bytes: tells whether a file is still the one that was worked on. Not for security.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tspace::tool {

struct FileHash {
    std::uint64_t bytes = 0;
    std::string hash = {};  ///< "xxh3:" and 32 hexadecimal digits (XXH3, 128 bits)

    bool operator==(const FileHash&) const = default;
};

/// Returns nothing if the file cannot be read.
std::optional<FileHash> hashFile(const std::string& path);

/// Hash of a text, equal on all machines.
std::uint64_t hashText(std::string_view text);

}  // namespace tspace::tool
