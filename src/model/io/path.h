// SPDX-License-Identifier: MIT
// Path of a file or folder: UTF-8, with slashes, on every system. It converts from and to std::filesystem::path, whose
// header takes most of a second to compile, so only files that access the disk or split paths include that header. Text
// must be converted through Path: on Windows, std::filesystem interprets char strings in the system's code page.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace tspace {

class Path {
  public:
    Path() = default;
    Path(std::string text) : text_(std::move(text)) {}
    Path(const char* text) : text_(text) {}
    /// Converts from and to std::filesystem::path.
    template <class T>
    requires requires(const T& path) { path.lexically_normal().native(); }
    Path(const T& path) : text_(textOf(path)) {}
    template <class T>
    requires requires(const T& path) { path.lexically_normal().native(); }
    operator T() const { return T(std::u8string_view(reinterpret_cast<const char8_t*>(text_.data()), text_.size())); }

    /// Returns a file in this folder, or `name` itself if it is absolute.
    [[nodiscard]] Path operator/(const std::string& name) const;
    [[nodiscard]] const std::string& string() const { return text_; }
    [[nodiscard]] bool empty() const { return text_.empty(); }

  private:
    template <class T>
    static std::string textOf(const T& path) {
        if constexpr (T::preferred_separator == '/') {
            return path.string();
        } else {
            const std::u8string text = path.generic_u8string();
            return std::string(text.begin(), text.end());
        }
    }

    std::string text_;
};

/// Returns the folder of a file; "." for a name without a folder.
Path folderOf(const Path& file);

/// Returns the name of a file without its folder and extension.
std::string stemOf(const Path& file);

/// Returns the extension in lower case with its dot, or "".
std::string lowerExtension(const Path& path);

/// Returns whether the name is that of a GLB: .glb, or .vrm (avatars).
bool isGlbName(const Path& path);
/// Returns whether isGlbName() or the extension is .gltf.
bool isGltfName(const Path& path);
/// Returns whether the extension is .png, .jpg, .jpeg, .webp, .exr, .tga, .ktx2 or .dds.
bool isImageName(const Path& path);

}  // namespace tspace
