// SPDX-License-Identifier: MIT
// Characters of untrusted text that a terminal obeys, or that change how the text around them is shown.
#pragma once

#include <cstddef>
#include <string_view>

namespace tspace::report {

struct HiddenCharacter {
    unsigned code = 0;       ///< Unicode code point
    std::size_t length = 0;  ///< bytes in UTF-8; 0: the text starts with another character
};

/// Returns the character at the start of a UTF-8 text if it is a control character (C0, DEL or C1; U+009B equals
/// ESC [), a mark or override of text direction, a line separator, or a zero-width space.
inline HiddenCharacter hiddenCharacter(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
    if (text.empty()) return {};
    if (byte(0) < 0x20 || byte(0) == 0x7F) return {byte(0), 1};
    if (byte(0) == 0xC2 && byte(1) >= 0x80 && byte(1) < 0xA0) return {byte(1), 2};
    if (byte(0) == 0xD8 && byte(1) == 0x9C) return {0x061C, 2};
    if (byte(0) != 0xE2 && byte(0) != 0xEF) return {};
    const unsigned code = (byte(0) & 0xFU) << 12 | (byte(1) & 0x3FU) << 6 | (byte(2) & 0x3FU);
    const bool is_one = code == 0x200B || code == 0x200E || code == 0x200F || (code >= 0x2028 && code <= 0x202E) ||
                        (code >= 0x2060 && code <= 0x206F) || code == 0xFEFF;
    return is_one ? HiddenCharacter{code, 3} : HiddenCharacter{};
}

}  // namespace tspace::report
