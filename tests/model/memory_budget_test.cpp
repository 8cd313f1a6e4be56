// SPDX-License-Identifier: MIT
// The memory that a file may use, and the number of tasks that fit into it together.
#include "model/io/memory_budget.h"

#include <gtest/gtest.h>

namespace tspace {
namespace {

constexpr std::uint64_t kMegabyte = std::uint64_t{1} << 20;

TEST(MemoryBudget, GrowsWithTheFileUnlessTheUserSetsIt) {
    MemoryBudget by_size, by_user(100 * kMegabyte);
    EXPECT_TRUE(by_size.has(40 * kMegabyte));
    EXPECT_FALSE(by_size.has(41 * kMegabyte));
    by_size.allow(kMegabyte);
    EXPECT_TRUE(by_size.has(56 * kMegabyte));
    by_user.allow(kMegabyte);
    EXPECT_TRUE(by_user.has(76 * kMegabyte));
    EXPECT_FALSE(by_user.has(77 * kMegabyte));
}

TEST(MemoryBudget, WithoutLimitUsesTheAvailableMemory) {
    MemoryBudget budget(~std::uint64_t{0});
    for (int i = 0; i < 100; ++i) budget.take(1000 * 1000 * kMegabyte, {});
    EXPECT_TRUE(budget.has(1000 * 1000 * kMegabyte));
}

TEST(MemoryBudget, NamesRequiredAndAvailableMemory) {
    MemoryBudget budget(100 * kMegabyte);
    budget.take(26 * kMegabyte, {});
    EXPECT_EQ(budget.whyNot(60 * kMegabyte), "needs about 110 MB of memory, but --memory-limit is 100 MB");
    EXPECT_EQ(
        MemoryBudget().whyNot(60 * kMegabyte),
        "needs about 84 MB of memory, but the limit for a file of its size is 64 MB; use --memory-limit to raise it");
}

TEST(MemoryBudget, AllowsParallelTasksThatFit) {
    const MemoryBudget budget;
    const auto together = [&](std::vector<std::uint64_t> megabytes) {
        return budget.countTogether(megabytes.size(), [&](std::size_t i) { return megabytes[i] * kMegabyte; });
    };
    EXPECT_EQ(together({}), 0u);
    EXPECT_EQ(together({1, 2, 3}), 3u);
    EXPECT_EQ(together({20, 20, 1, 1}), 2u);
    EXPECT_EQ(together({1000, 1}), 1u) << "one at least";
}

}  // namespace
}  // namespace tspace
