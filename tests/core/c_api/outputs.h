// SPDX-License-Identifier: MIT
// Results of the C API compared with those of the C++ API.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "support/same_bits.h"
#include "tspace/tspace.h"
#include "tspace/tspace.hpp"

namespace tspace::test {

/// Results of all kinds for one mesh.
struct CApiOutputs {
    explicit CApiOutputs(std::size_t n)
        : tangents(n), bitangents(n), magnitudes_s(n), magnitudes_t(n), has_tangent(n) {}

    TangentOutput view() { return {tangents, bitangents, magnitudes_s, magnitudes_t, has_tangent}; }
    tspace_TangentOutput c() {
        tspace_TangentOutput out;
        TSPACE_INIT(out);
        out.tangents = {&tangents[0].x, tangents.size(), sizeof(Vec4)};
        out.bitangents = {&bitangents[0].x, bitangents.size(), 0};
        out.magnitudes_s = {magnitudes_s.data(), magnitudes_s.size(), 0};
        out.magnitudes_t = {magnitudes_t.data(), magnitudes_t.size(), 0};
        out.has_tangent = {has_tangent.data(), has_tangent.size(), 0};
        return out;
    }

    std::vector<Vec4> tangents;
    std::vector<Vec3> bitangents;
    std::vector<float> magnitudes_s, magnitudes_t;
    std::vector<std::uint8_t> has_tangent;
};

inline void expectSame(const CApiOutputs& a, const CApiOutputs& b) {
    EXPECT_TRUE(sameBits(a.tangents, b.tangents));
    EXPECT_TRUE(sameBits(a.bitangents, b.bitangents));
    EXPECT_TRUE(sameBits(a.magnitudes_s, b.magnitudes_s));
    EXPECT_TRUE(sameBits(a.magnitudes_t, b.magnitudes_t));
    EXPECT_EQ(a.has_tangent, b.has_tangent);
}

}  // namespace tspace::test
