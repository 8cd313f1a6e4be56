// SPDX-License-Identifier: MIT
// The compact sort gives the same results as the standard library.
#include "core/base/sort.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <utility>

namespace tspace::test {
namespace {

TEST(CompactSort, EqualsStableSort) {
    std::mt19937 random(7);
    for (std::size_t count = 0; count < 200; ++count) {
        for (const std::uint32_t kinds : {1u, 3u, 1000000u}) {
            std::vector<std::pair<std::uint32_t, std::uint32_t>> rows;
            std::vector<std::pair<std::string, double>> texts;
            for (std::uint32_t i = 0; i < count; ++i) {
                rows.emplace_back(random() % kinds, i);
                texts.emplace_back(
                    "a text that is longer than those inside of a string " + std::to_string(random() % kinds), i);
            }
            const auto byFirst = [](const auto& a, const auto& b) { return a.first < b.first; };
            auto sorted_rows = rows;
            auto sorted_texts = texts;
            std::stable_sort(rows.begin(), rows.end(), byFirst);
            std::stable_sort(texts.begin(), texts.end(), byFirst);
            sortWithSharedCode(sorted_rows.begin(), sorted_rows.end(), byFirst);
            sortWithSharedCode(sorted_texts.begin(), sorted_texts.end(), byFirst);
            ASSERT_EQ(sorted_rows, rows) << count;
            ASSERT_EQ(sorted_texts, texts) << count;
        }
    }
}

TEST(CompactSort, KeepsSortedListsAndReversesReversedOnes) {
    std::vector<float> up, down;
    for (int i = 0; i < 1000; ++i) {
        up.push_back(static_cast<float>(i));
        down.push_back(static_cast<float>(999 - i));
    }
    std::vector<float> list = up;
    sortWithSharedCode(list.begin(), list.end(), std::less<>());
    EXPECT_EQ(list, up);
    sortWithSharedCode(down.begin(), down.end(), std::less<>());
    EXPECT_EQ(down, up);
}

}  // namespace
}  // namespace tspace::test
