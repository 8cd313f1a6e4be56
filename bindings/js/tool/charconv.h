// SPDX-License-Identifier: MIT
// <charconv> for the C++ library of emscripten 3.1, which cannot format floats. Installed as "charconv", with priority
// over the library's header.
#pragma once
#pragma GCC system_header

#include_next <charconv>
#include <cstdio>
#include <cstring>

namespace std {

/// Formats floats with a precision, which the standard defines like printf in the C locale; the tool uses no other
/// locale.
inline to_chars_result to_chars(char* first, char* last, double value, chars_format format, int precision) {
    char text[512];
    const char* how = format == chars_format::fixed ? "%.*f" : format == chars_format::scientific ? "%.*e" : "%.*g";
    const auto count = static_cast<size_t>(snprintf(text, sizeof text, how, precision, value));
    if (count >= sizeof text || count > static_cast<size_t>(last - first)) return {last, errc::value_too_large};
    memcpy(first, text, count);
    return {first + count, errc()};
}

}  // namespace std
