// SPDX-License-Identifier: MIT
// The files that a model names: those in its folder, or what the caller gives for a model in memory.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "model/io/file_io.h"
#include "model/io/path.h"
#include "tspace/asset.h"

namespace tspace {

class NamedFiles {
  public:
    enum class Kind { file, folder, missing };

    NamedFiles() = default;
    /// Of the model `model`, a path or, with FileOptions::content, what it is called.
    NamedFiles(const Path& model, const FileOptions& options);

    /// The model is not in a file.
    [[nodiscard]] bool areInMemory() const { return is_in_memory_; }
    /// No file can be had: the model is not in a file, and nobody gives those that it names.
    [[nodiscard]] bool areNone() const { return is_in_memory_ && !find_file_; }
    /// The folder of the model; empty where it is in memory.
    [[nodiscard]] const Path& folder() const { return folder_; }

    /// The file that `uri` names, for the other functions. Fails as resolveUri; with invalidFile where there are none.
    [[nodiscard]] Path resolve(std::string_view uri, const std::string& place) const {
        return resolve(folder_, uri, place);
    }
    /// The same of a URI that stands in a file of another folder.
    [[nodiscard]] Path resolve(const Path& folder, std::string_view uri, const std::string& place) const;

    [[nodiscard]] Kind kindOf(const Path& file) const;
    /// Says of a file that is not read, or not yet, that the model names it.
    void note(const Path& file) const;
    /// Fails as readFile.
    [[nodiscard]] Bytes read(const Path& file, const std::string& place = {}) const;

  private:
    [[nodiscard]] Result<std::span<const std::uint8_t>> find(const Path& file) const;

    Path folder_ = {};
    FindFile find_file_ = {};
    std::function<void(const std::string&)> opened_ = {};
    bool is_in_memory_ = false;
    bool allow_external_ = false;
};

}  // namespace tspace
