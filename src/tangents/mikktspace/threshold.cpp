// SPDX-License-Identifier: MIT
// The cosine of an angular threshold without the C library, so that it has the same bits everywhere. Any
// float is allowed, as in the reference: large angles are reduced exactly. Based on: Payne and Hanek, "Radian
// reduction for trigonometric functions", 1983.
#include <array>
#include <cmath>
#include <cstdint>

#include "tangents/mikktspace/splits.h"

namespace tspace::mikk {

namespace {

/// The first 288 bits of 2/pi after the binary point.
constexpr std::array<std::uint32_t, 9> kTwoOverPi{0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599,
                                                  0x3c439041, 0xfe5163ab, 0xdebbc561, 0xb7246e3a};

/// x = (quarter_turns + offset) * pi/2 with offset in [-1/2, 1/2].
struct Turn {
    unsigned quarter_turns = 0;
    double offset = 0;
};

/// Reduces x >= 1/2. x = mantissa * 2^exponent; of 2/pi only the 128 bits matter that neither give whole
/// turns nor fall below all precision. 128 bits: 24 for the mantissa, 2 for quarter turns, 30 that may
/// cancel, 72 for the result.
Turn reduce(double x) {
    int exponent = 0;
    const auto mantissa = static_cast<std::uint64_t>(std::frexp(x, &exponent) * 16777216.0);
    exponent -= 24;
    const unsigned skipped = exponent > 2 ? static_cast<unsigned>(exponent - 2) : 0;
    std::array<std::uint32_t, 5> product{};  // mantissa times the window, highest word first
    std::uint64_t carry = 0;
    for (unsigned word = 4; word-- > 0;) {
        const unsigned bit = skipped + 32 * word;
        const unsigned shift = bit % 32;
        const std::uint64_t pair = std::uint64_t{kTwoOverPi[bit / 32]} << 32 | kTwoOverPi[bit / 32 + 1];
        const std::uint64_t value = mantissa * ((pair << shift) >> 32) + carry;
        product[word + 1] = static_cast<std::uint32_t>(value);
        carry = value >> 32;
    }
    product[0] = static_cast<std::uint32_t>(carry);
    // The point lies `whole` bits into the 160 bits of the product.
    const auto whole = static_cast<unsigned>(32 + exponent - static_cast<int>(skipped));
    const auto bits = [&](unsigned from) {  // 32 bits from a position
        const unsigned word = from / 32, shift = from % 32;
        const std::uint64_t high = word < 5 ? product[word] : 0, low = word + 1 < 5 ? product[word + 1] : 0;
        return static_cast<std::uint32_t>(((high << 32 | low) << shift) >> 32);
    };
    Turn turn;
    turn.quarter_turns = bits(whole - 2) >> 30;
    std::uint64_t fraction = std::uint64_t{bits(whole)} << 32 | bits(whole + 32);
    std::uint64_t rest = std::uint64_t{bits(whole + 64)};
    double sign = 1;
    if (fraction >> 63 != 0) {  // above one half: count from the next quarter turn
        turn.quarter_turns = (turn.quarter_turns + 1) & 3;
        fraction = ~fraction;
        rest = ~rest & 0xffffffffu;
        sign = -1;
    }
    turn.offset = sign * (static_cast<double>(fraction) * 0x1p-64 + static_cast<double>(rest) * 0x1p-96);
    return turn;
}

/// Taylor series; |r| <= pi/4 leaves an error below 2^-56.
double sine(double r) {
    const double z = r * r;
    double p = 1.0 / 355687428096000.0;
    for (const double c : {-1.0 / 1307674368000.0, 1.0 / 6227020800.0, -1.0 / 39916800.0, 1.0 / 362880.0, -1.0 / 5040.0,
                           1.0 / 120.0, -1.0 / 6.0}) {
        p = p * z + c;
    }
    return r + r * z * p;
}

double cosine(double r) {
    const double z = r * r;
    double p = 1.0 / 20922789888000.0;
    for (const double c :
         {-1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800.0, 1.0 / 40320.0, -1.0 / 720.0, 1.0 / 24.0, -0.5}) {
        p = p * z + c;
    }
    return 1.0 + z * p;
}

}  // namespace

float thresholdCosine(float degrees) {
    if (degrees == 180.0f) return -1.0f;  // what nearly every call asks for, and what the rest gives
    const float angle = std::fabs((degrees * 3.14159274f) / 180.0f);
    if (!std::isfinite(angle)) return std::nanf("");
    const Turn turn = angle < 0.5f ? Turn{} : reduce(angle);
    const double r = angle < 0.5f ? angle : turn.offset * 0x1.921fb54442d18p+0;
    const std::array<double, 4> values{cosine(r), -sine(r), -cosine(r), sine(r)};
    return static_cast<float>(values[turn.quarter_turns]);
}

}  // namespace tspace::mikk
