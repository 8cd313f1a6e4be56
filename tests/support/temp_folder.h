// SPDX-License-Identifier: MIT
// A folder for one test, gone with it.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

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

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// Writes a file, with the folders above it, and returns its path.
    std::string write(const std::string& relative, const std::string& bytes) const {
        const std::filesystem::path file = path_ / relative;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << bytes;
        return file.string();
    }
    [[nodiscard]] std::string read(const std::string& relative) const {
        std::ostringstream text;
        text << std::ifstream(path_ / relative, std::ios::binary).rdbuf();
        return text.str();
    }
    [[nodiscard]] bool has(const std::string& relative) const {
        return std::filesystem::exists(path_ / relative);
    }

    /// Relative paths of all files below `relative`.
    [[nodiscard]] std::set<std::string> files(const std::string& relative = ".") const {
        std::set<std::string> names;
        const std::filesystem::path folder = path_ / relative;
        if (!std::filesystem::exists(folder)) return names;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
            if (entry.is_regular_file()) names.insert(entry.path().lexically_relative(folder).string());
        }
        return names;
    }

  private:
    std::filesystem::path path_;
};

}  // namespace tspace::test
