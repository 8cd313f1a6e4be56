// SPDX-License-Identifier: MIT
// The kernels' arc cosine compared with the C library's in double, rounded to float. All floats from -1 to 1 were
// compared once; this test compares a sample.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "core/simd/lanes_scalar.h"
#define TSPACE_LANES scalar
#include "core/simd/vectors_kernel.h"

namespace tspace {
namespace {

float kernelArcCosine(float c) {
    const simd::scalar::Floats cosine = simd::scalar::broadcast(c), cosines[3] = {cosine, cosine, cosine};
    simd::scalar::Floats angles[3];
    simd::scalar::arcCosines(cosines, angles);
    return angles[0].v[0];
}

float arcCosine(float c) { return static_cast<float>(std::acos(static_cast<double>(c))); }

TEST(KernelArcCosine, EqualsTheRoundedDoubleFunction) {
    const std::uint32_t one = std::bit_cast<std::uint32_t>(1.0f);
    for (std::uint32_t word = 0; word <= one; word += 379) {
        const float c = std::bit_cast<float>(word), near_one = std::bit_cast<float>(one - word / 8192);
        ASSERT_EQ(kernelArcCosine(c), arcCosine(c)) << c;
        ASSERT_EQ(kernelArcCosine(-c), arcCosine(-c)) << -c;
        ASSERT_EQ(kernelArcCosine(near_one), arcCosine(near_one)) << near_one;
    }
}

TEST(KernelArcCosine, IsExactAtItsEnds) {
    EXPECT_EQ(kernelArcCosine(1.0f), 0.0f);
    EXPECT_EQ(kernelArcCosine(-1.0f), 3.14159274f);
    EXPECT_EQ(kernelArcCosine(0.0f), 1.57079637f);
}

TEST(KernelArcCosine, ClampsCosinesOutsideItsDomain) {
    EXPECT_EQ(kernelArcCosine(1.0000001f), 0.0f);
    EXPECT_EQ(kernelArcCosine(-1.0000001f), arcCosine(-1.0f));
    EXPECT_TRUE(std::isnan(kernelArcCosine(std::bit_cast<float>(0x7fc00000u))));
}

}  // namespace
}  // namespace tspace
