// SPDX-License-Identifier: MIT
// Numbers as bytes and as text, independent of machine and locale.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>

namespace tspace {

// Little-endian numbers, as in glTF, on machines of either byte order.

/// Converts numbers of `number_bytes` bytes each from native to little-endian byte order, or back.
inline void convertLittleEndian(std::span<std::uint8_t> bytes, std::size_t number_bytes) {
    if constexpr (std::endian::native == std::endian::little) return;
    for (std::size_t at = 0; at + number_bytes <= bytes.size(); at += number_bytes)
        std::reverse(bytes.data() + at, bytes.data() + at + number_bytes);
}

template <class Number>
Number loadLittleEndian(const std::uint8_t* from) {
    std::uint8_t bytes[sizeof(Number)];
    std::memcpy(bytes, from, sizeof bytes);
    convertLittleEndian(bytes, sizeof bytes);
    return std::bit_cast<Number>(bytes);
}

template <class Number>
void storeLittleEndian(Number number, std::uint8_t* to) {
    std::memcpy(to, &number, sizeof number);
    convertLittleEndian({to, sizeof number}, sizeof number);
}

// Formatting of numbers for messages, with a decimal point in every locale. std::to_chars is not used, because
// emscripten's library lacks it for floats.

/// Returns a number with three significant digits, without trailing zeros: "0.125", "17", "1.2e+30".
inline std::string shortNumber(double value) {
    if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value < 0 ? "-inf" : "inf";
    if (value == 0) return "0";
    constexpr int kDigits = 3, kMostZeros = 5, kMostDigits = 15;
    int exponent = static_cast<int>(std::floor(std::log10(std::fabs(value))));
    long long digits = std::llround(std::fabs(value) * std::pow(10.0, kDigits - 1 - exponent));
    if (digits >= 1000) {
        digits /= 10;
        ++exponent;
    }
    const bool is_far = exponent < -kMostZeros || exponent >= kMostDigits;
    const int point = is_far ? 1 : exponent + 1;  // digits before the point
    std::string text = std::to_string(digits);
    if (point <= 0) text.insert(0, static_cast<std::size_t>(1 - point), '0');
    if (point > kDigits) text.append(static_cast<std::size_t>(point - kDigits), '0');
    const auto before = static_cast<std::size_t>(point <= 0 ? 1 : point);
    std::string behind = text.substr(before);
    behind.erase(behind.find_last_not_of('0') + 1);
    text = text.substr(0, before) + (behind.empty() ? "" : "." + behind);
    if (is_far) text += (exponent < 0 ? "e-" : "e+") + std::to_string(std::abs(exponent));
    return (value < 0 ? "-" : "") + text;
}

}  // namespace tspace
