// SPDX-License-Identifier: MIT
// Numbers as text with a decimal point, regardless of the locale.
#pragma once

#include <charconv>
#include <string>
#include <string_view>

namespace tspace::import {

/// Returns the shortest text that is parsed as the same number.
inline std::string numberText(double number) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

/// Parses a number; returns 0 if it is invalid.
inline double readNumber(std::string_view text) {
    double number = 0;
    if (text.starts_with('+')) text.remove_prefix(1);
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

}  // namespace tspace::import
