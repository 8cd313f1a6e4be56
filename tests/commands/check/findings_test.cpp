// SPDX-License-Identifier: MIT
#include "commands/check/findings.h"

#include <gtest/gtest.h>

namespace tspace::test {
namespace {

using Vertices = std::vector<std::uint32_t>;

TEST(Tally, NamesEachVertexOnceAndCountsItsCorners) {
    Tally first, second;
    for (const std::uint32_t vertex : {4U, 4U, 7U, 4U}) first.add(vertex, 1);
    for (const std::uint32_t vertex : {7U, 2U, 2U}) second.add(vertex, 1);
    EXPECT_EQ(first.vertices, (Vertices{4, 7}));
    first.include(second);
    EXPECT_EQ(first.count, 7U);
    EXPECT_EQ(first.vertices, (Vertices{2, 4, 7}));
}

TEST(Tally, NamesTheFirstEight) {
    Tally tally;
    for (std::uint32_t corner = 0; corner < 60; ++corner) tally.add(corner / 3, 1);
    EXPECT_EQ(tally.vertices, (Vertices{0, 1, 2, 3, 4, 5, 6, 7}));
}

}  // namespace
}  // namespace tspace::test
