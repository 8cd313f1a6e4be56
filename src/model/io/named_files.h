// SPDX-License-Identifier: MIT
// The files that a model names: in its folder, or given by the callback of the caller for a model in memory.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "model/io/bytes.h"
#include "model/io/path.h"
#include "tspace/file_options.h"
#include "tspace/result.h"

namespace tspace {

class NamedFiles {
  public:
    enum class Kind { file, folder, missing };

    NamedFiles() = default;
    /// `model`: the path of the model or, with FileOptions::content, its name.
    NamedFiles(const Path& model, const FileOptions& options);

    /// Whether the model is in memory.
    [[nodiscard]] bool areInMemory() const { return is_in_memory_; }
    /// Whether no file can be read: the model is in memory, and the caller gave no callback.
    [[nodiscard]] bool areNone() const { return is_in_memory_ && !find_file_; }
    /// The folder of the model; empty where it is in memory.
    [[nodiscard]] const Path& folder() const { return folder_; }

    /// The path of the file that `uri` names, for the other functions. Fails as resolveUri; with invalidFile if areNone().
    [[nodiscard]] Path resolve(std::string_view uri, const std::string& place) const {
        return resolve(folder_, uri, place);
    }
    /// resolve() for a URI in a file of another folder.
    [[nodiscard]] Path resolve(const Path& folder, std::string_view uri, const std::string& place) const;

    [[nodiscard]] Kind kindOf(const Path& file) const;
    /// Why the file that `uri` names cannot be read; empty: it is there. Not if areNone().
    [[nodiscard]] std::string whyNotRead(std::string_view uri, const std::string& place) const;
    /// Reports a named file that is not read, or not yet.
    void note(const Path& file) const;
    /// Fails as readFile.
    [[nodiscard]] Bytes read(const Path& file, const std::string& place = {}) const;

  private:
    [[nodiscard]] Result<std::span<const std::uint8_t>> find(const Path& file) const;

    Path folder_ = {};
    FindFile find_file_ = {};
    std::function<void(const std::string&)> opened_ = {}, named_ = {};
    bool is_in_memory_ = false;
    bool allow_external_ = false;
};

}  // namespace tspace
