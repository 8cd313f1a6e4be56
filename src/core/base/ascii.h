// SPDX-License-Identifier: MIT
// Letters of file formats, the same in every locale.
#pragma once

#include <string>

namespace tspace {

/// The text with the ASCII letters A to Z in lower case; all other bytes stay.
inline std::string lowerAscii(std::string text) {
    for (char& c : text) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return text;
}

}  // namespace tspace
