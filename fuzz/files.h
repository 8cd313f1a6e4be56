// SPDX-License-Identifier: MIT
// Temporary files for calls that cannot read from memory.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>

#include "byte_reader.h"

namespace tspace::fuzz {

/// Creates a temporary folder, in memory rather than on disk if possible.
inline std::filesystem::path makeFolder() {
    std::error_code failed;
    const std::filesystem::path shm = "/dev/shm";
    const std::filesystem::path base =
        std::filesystem::is_directory(shm, failed) ? shm : std::filesystem::temp_directory_path();
    std::string name = (base / "tspace_fuzz_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    return name;
}

inline void writeFile(const std::string& path, std::span<const std::uint8_t> bytes) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    const bool written =
        file != nullptr && (bytes.empty() || std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size());
    require(written && std::fclose(file) == 0, "a file can be written");
}

}  // namespace tspace::fuzz
