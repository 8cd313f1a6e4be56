// SPDX-License-Identifier: MIT
// Conversion of ASCII letters, as file formats use them, independent of the locale.
#pragma once

#include <string>

namespace tspace {

/// Returns the text with the ASCII letters A to Z in lower case; all other bytes are unchanged.
inline std::string lowerAscii(std::string text) {
    for (char& c : text) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return text;
}

}  // namespace tspace
