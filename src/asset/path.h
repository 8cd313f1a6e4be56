// SPDX-License-Identifier: MIT
// The path of a file or folder. It converts from and to std::filesystem::path, whose header takes most of a second to
// compile: only the files that look at the disk, or take paths apart, include that.
#pragma once

#include <string>
#include <utility>

namespace tspace {

class Path {
  public:
    Path() = default;
    Path(std::string text) : text_(std::move(text)) {}
    Path(const char* text) : text_(text) {}
    /// From std::filesystem::path, and to it.
    template <class T>
    requires requires(const T& path) { path.lexically_normal().native(); }
    Path(const T& path) : text_(path.string()) {}
    template <class T>
    requires requires(const T& path) { path.lexically_normal().native(); }
    operator T() const { return T(text_); }

    /// A file in this folder, or `name` itself where that is absolute.
    [[nodiscard]] Path operator/(const std::string& name) const;
    [[nodiscard]] const std::string& string() const { return text_; }
    [[nodiscard]] bool empty() const { return text_.empty(); }

  private:
    std::string text_;
};

/// The folder that a file lies in; "." for a bare name.
Path folderOf(const Path& file);

/// The extension in lower case with its dot, or "".
std::string lowerExtension(const Path& path);

}  // namespace tspace
