// SPDX-License-Identifier: MIT
// The arc cosine on lanes. Included after lanes_*.h, with TSPACE_LANES set to its namespace.
#pragma once

namespace tspace::simd::TSPACE_LANES {

/// acos of three cosines, rounded to float: the bits of the C library's double acos rounded to float (compared
/// for every float). Three at a time, step by step, because each step waits for the one before it.
///
/// y = min(c^2, (1 - |c|) / 2), which is at most 1/4, and s = sqrt(y) is |c| or, from 1/2 on, the sine of
/// half the angle. asin(s) = s + s y P(y). Then acos(c) is pi/2 -+ asin(s), or 2 asin(s), or pi - 2 asin(s).
inline void arcCosines(const Floats (&cosines)[3], Floats (&angles)[3]) {
    // Minimax, of degree 11: the error of y P(y) is below 2^-55.
    constexpr double kHighest = 0x1.030c9deb668f4p-5;
    constexpr double kCoefficients[] = {-0x1.026fe5933eb78p-6, 0x1.3aea7222cb789p-6, 0x1.b3bf2c44e47e8p-8,
                                        0x1.8dc3f723da505p-7,  0x1.c728512876979p-7, 0x1.1c697e5b02bbap-6,
                                        0x1.6e8a21d60a180p-6,  0x1.f1c72a0b08729p-6, 0x1.6db6db4a71a6fp-5,
                                        0x1.333333335f5c3p-4,  0x1.555555555543cp-3};
    constexpr std::size_t kParts = 3 * kDoubleParts;
    const Doubles half = broadcastDouble(0.5);
    Doubles x[kParts], y[kParts], p[kParts];
    for (std::size_t i = 0; i < kParts; ++i) {
        const Floats c = larger(broadcast(-1.0f), smaller(broadcast(1.0f), cosines[i / kDoubleParts]));
        x[i] = part(c, i % kDoubleParts);
        const Doubles a = absolute(x[i]);
        y[i] = smaller(a * a, half - half * a);
        p[i] = broadcastDouble(kHighest);
    }
    for (const double coefficient : kCoefficients) {
        const Doubles k = broadcastDouble(coefficient);
        for (std::size_t i = 0; i < kParts; ++i) p[i] = p[i] * y[i] + k;
    }
    const Doubles quarter = broadcastDouble(0x1.921fb54442d18p+0);
    for (std::size_t i = 0; i < kParts; ++i) {
        const DoubleMask steep = absolute(x[i]) > half;
        const Doubles s = squareRoot(y[i]);
        const Doubles arc = s + s * y[i] * p[i];
        const Doubles turned = withSignOf(negateUnless(steep, arc + keepWhere(steep, arc)), x[i]);
        x[i] = quarter - keepWhere(steep, withSignOf(quarter, x[i])) + turned;
    }
    for (std::size_t k = 0; k < 3; ++k) angles[k] = join(x + k * kDoubleParts);
}

}  // namespace tspace::simd::TSPACE_LANES
