// SPDX-License-Identifier: MIT
// The path of a file or folder: UTF-8, with slashes, on every system. It converts from and to std::filesystem::path, whose
// header takes most of a second to compile, so only files that access the disk or take paths apart include that. Convert
// text by way of Path: on Windows, std::filesystem reads char strings in the system's code page.
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
    /// From std::filesystem::path, and to it.
    template <class T>
    requires requires(const T& path) { path.lexically_normal().native(); }
    Path(const T& path) : text_(textOf(path)) {}
    template <class T>
    requires requires(const T& path) { path.lexically_normal().native(); }
    operator T() const { return T(std::u8string_view(reinterpret_cast<const char8_t*>(text_.data()), text_.size())); }

    /// A file in this folder, or `name` itself where that is absolute.
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

/// The folder that a file lies in; "." for a bare name.
Path folderOf(const Path& file);

/// The name of a file without its folder and extension.
std::string stemOf(const Path& file);

/// The extension in lower case with its dot, or "".
std::string lowerExtension(const Path& path);

/// Names of GLB files end in .glb, and those of avatars in .vrm.
bool isGlbName(const Path& path);
/// isGlbName, or .gltf.
bool isGltfName(const Path& path);
/// Names of images end in .png, .jpg, .jpeg, .webp, .exr, .tga, .ktx2 or .dds.
bool isImageName(const Path& path);

}  // namespace tspace
