// SPDX-License-Identifier: MIT
// Text that is not UTF-8. OBJ and MTL files do not declare their encoding; older programs write the encoding of their
// system.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tspace {

inline constexpr const char* kNotUtf8 =
    "the text is not UTF-8: files are looked up by the bytes of their names and may not be found, and the names in a "
    "glTF output have U+FFFD for bytes that are not UTF-8; to keep the names, convert the text to UTF-8";

/// Returns whether the text is valid UTF-8 (which includes ASCII). Linear.
inline bool isUtf8(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = static_cast<unsigned char>(text[i++]);
        if (byte < 0x80) continue;
        const int more = byte >= 0xc2 && byte < 0xe0   ? 1
                         : byte >= 0xe0 && byte < 0xf0 ? 2
                         : byte >= 0xf0 && byte < 0xf5 ? 3
                                                       : 0;
        if (more == 0) return false;
        for (int k = 0; k < more; ++k, ++i) {
            if (i == text.size() || (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return false;
        }
    }
    return true;
}

/// Returns whether the byte at `at`, which has the value of a backslash, is the second byte of a two-byte character:
/// whether an odd number of bytes directly before it are lead bytes of Shift-JIS, or of GBK, Big5 and similar
/// encodings. `text` must not be UTF-8.
inline bool isSecondByte(std::string_view text, std::size_t at) {
    const auto followsOddCount = [&](auto&& begins) {
        std::size_t leads = 0;
        while (leads < at && begins(static_cast<unsigned char>(text[at - leads - 1]))) ++leads;
        return leads % 2 != 0;
    };
    return followsOddCount([](int byte) { return (byte >= 0x81 && byte <= 0x9f) || (byte >= 0xe0 && byte <= 0xfc); }) ||
           followsOddCount([](int byte) { return byte >= 0x81 && byte <= 0xfe; });
}

/// Writes slashes for the backslashes of a path, but not for bytes that belong to a character of two bytes.
inline std::string withSlashes(std::string path) {
    const std::string given = path;
    const bool is_utf8 = isUtf8(given);
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (given[i] == '\\' && (is_utf8 || !isSecondByte(given, i))) path[i] = '/';
    }
    return path;
}

}  // namespace tspace
