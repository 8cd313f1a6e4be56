// SPDX-License-Identifier: MIT
// A temporary folder for one test, which is removed at the end.
#pragma once

#include <stdlib.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace tspace::test {

class TempFolder {
  public:
    TempFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "tspace_test_XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::filesystem::filesystem_error("mkdtemp", {});
        path_ = name;
    }
    ~TempFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    /// Returns the path of the folder, or of an entry in it.
    [[nodiscard]] std::filesystem::path path(const std::string& relative = {}) const {
        return relative.empty() ? path_ : path_ / relative;
    }

    /// Writes a file, creating its parent folders, and returns its path.
    std::string write(const std::string& relative, const std::string& bytes) const {
        const std::filesystem::path file = path_ / relative;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << bytes;
        return file.string();
    }
    std::string write(const std::string& relative, std::span<const std::uint8_t> bytes) const {
        return write(relative, std::string(bytes.begin(), bytes.end()));
    }
    [[nodiscard]] std::string read(const std::string& relative) const {
        std::ostringstream text;
        text << std::ifstream(path_ / relative, std::ios::binary).rdbuf();
        return text.str();
    }
    [[nodiscard]] bool has(const std::string& relative) const { return std::filesystem::exists(path_ / relative); }

    /// Returns the relative paths of all files below a subfolder.
    [[nodiscard]] std::set<std::string> files(const std::string& relative = ".") const {
        std::set<std::string> names;
        const std::filesystem::path folder = path_ / relative;
        if (!std::filesystem::exists(folder)) return names;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
            if (entry.is_regular_file()) names.insert(entry.path().lexically_relative(folder).string());
        }
        return names;
    }

    /// Returns the number of files and folders below the folder.
    [[nodiscard]] std::size_t entryCount() const {
        const auto entries = std::filesystem::recursive_directory_iterator(path_);
        return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
    }

  private:
    std::filesystem::path path_;
};

}  // namespace tspace::test
