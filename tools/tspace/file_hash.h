// SPDX-License-Identifier: MIT
// Fingerprint of a file's contents, to detect whether a processed file has changed. Not for security.
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

/// Reads a file and returns its hash, or nullopt if it cannot be read.
std::optional<FileHash> hashFile(const std::string& path);

/// Returns the hash of a text, which is equal on all machines.
std::uint64_t hashText(std::string_view text);

}  // namespace tspace::tool
