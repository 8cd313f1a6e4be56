// SPDX-License-Identifier: MIT
// A folder for one test, removed when the test ends.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "asset/file_io.h"

namespace tspace::test {

class TempFolder {
  public:
    TempFolder() {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        std::string name =
            std::string(info->test_suite_name()) + "_" + info->name() + "_" + std::to_string(::getpid());
        for (char& c : name) {
            if (c == '/') c = '_';
        }
        path_ = std::filesystem::temp_directory_path() / ("tspace_" + name);
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~TempFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    [[nodiscard]] std::filesystem::path path(const std::string& name = {}) const {
        return name.empty() ? path_ : path_ / name;
    }
    std::string write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories(path(name).parent_path());
        std::ofstream(path(name), std::ios::binary) << text;
        return path(name).string();
    }
    std::string write(const std::string& name, const Bytes& bytes) const {
        return write(name, std::string(bytes.begin(), bytes.end()));
    }
    [[nodiscard]] std::size_t fileCount() const {
        const auto entries = std::filesystem::recursive_directory_iterator(path_);
        return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
    }

  private:
    std::filesystem::path path_;
};

}  // namespace tspace::test
