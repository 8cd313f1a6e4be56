// SPDX-License-Identifier: MIT
// Numbers in sentences, with a point in every locale. (Not std::to_chars: emscripten's library has none for floats.)
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>

namespace tspace {

/// Three digits that count, without zeros behind: "0.125", "17", "1.2e+30".
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
    const int point = is_far ? 1 : exponent + 1;  // digits before it
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
