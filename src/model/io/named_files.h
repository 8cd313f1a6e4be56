// SPDX-License-Identifier: MIT
// Files that a model references: in its folder, or provided by the callback of the caller for a model in memory.
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
    enum class Kind { file, folder, other, missing };  ///< other: a pipe or device

    NamedFiles() = default;
    /// `model`: the path of the model or, with FileOptions::content, its name.
    NamedFiles(const Path& model, const FileOptions& options);
    /// Returns the files of a model in memory whose caller provided no callback: none can be read.
    [[nodiscard]] static NamedFiles none() {
        NamedFiles files;
        files.is_in_memory_ = true;
        return files;
    }

    /// Returns whether the model is in memory.
    [[nodiscard]] bool areInMemory() const { return is_in_memory_; }
    /// Returns whether no file can be read: the model is in memory, and the caller provided no callback.
    [[nodiscard]] bool areNone() const { return is_in_memory_ && !find_file_; }
    /// Returns the folder of the model; empty if it is in memory.
    [[nodiscard]] const Path& folder() const { return folder_; }

    /// Returns the path of the file that `uri` refers to, as argument of the other functions. Fails like resolveUri,
    /// and with invalidFile if areNone().
    [[nodiscard]] Path resolve(std::string_view uri, const std::string& place) const {
        return resolve(folder_, uri, place);
    }
    /// Returns the path of the file that `uri` refers to, in a file of the folder `folder`. Fails as resolve(uri,
    /// place).
    [[nodiscard]] Path resolve(const Path& folder, std::string_view uri, const std::string& place) const;

    [[nodiscard]] Kind kindOf(const Path& file) const;
    /// Returns why the file that `uri` refers to cannot be read; empty if it exists. Must not be called if areNone().
    [[nodiscard]] std::string whyNotRead(std::string_view uri, const std::string& place) const;
    /// Reports a referenced file that is not read, or not yet.
    void note(const Path& file) const;
    /// Reads a file. Fails like readFile.
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
