// SPDX-License-Identifier: MIT
// Search for equal vertices with poor hashes.
#include "core/base/weld.h"

#include <gtest/gtest.h>

#include <vector>

namespace tspace {
namespace {

/// Vertices represented by numbers, with a hash that may be poor. Like NaN, negative numbers are not equal to anything.
class Numbers final : public Weldable {
  public:
    Numbers(std::vector<int> values, std::uint32_t factor) : values_(std::move(values)), factor_(factor) {}

    void hash(std::size_t begin, std::size_t end, std::uint32_t* hashes) override {
        for (std::size_t v = begin; v < end; ++v) hashes[v] = static_cast<std::uint32_t>(values_[v]) * factor_;
    }
    bool compare(const std::uint32_t* list, std::size_t begin, std::size_t end, std::uint32_t* roots) override {
        bool different = false;
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t v = list == nullptr ? i : list[i];
            if (roots[i] == v || (values_[v] >= 0 && values_[v] == values_[roots[i]])) continue;
            roots[i] = kNoRoot;
            different = true;
        }
        return different;
    }
    [[nodiscard]] int order(std::uint32_t a, std::uint32_t b) const override { return values_[a] - values_[b]; }

  private:
    std::vector<int> values_;
    std::uint32_t factor_;
};

void expectRoots(std::size_t count, int distinct, std::uint32_t factor) {
    std::vector<int> values;
    std::vector<std::uint32_t> want, first(static_cast<std::size_t>(distinct), Weldable::kNoRoot);
    for (std::uint32_t v = 0; v < count; ++v) {
        values.push_back(static_cast<int>(std::uint64_t{v} * 7919 % static_cast<unsigned>(distinct)) - 1);
        std::uint32_t& root = first[static_cast<std::size_t>(values.back() + 1)];
        if (root == Weldable::kNoRoot) root = v;
        want.push_back(values.back() < 0 ? v : root);
    }
    Numbers numbers(values, factor);
    for (const unsigned threads : {1u, 3u}) {
        for (const bool is_indexed : {false, true}) {
            Parallel parallel(Execution{.thread_count = threads});
            const Buffer<std::uint32_t> found = findRoots(numbers, count, is_indexed, nullptr, nullptr, parallel);
            std::vector<std::uint32_t> roots(found.begin(), found.end());
            for (std::uint32_t v = 0; found.empty() && v < count; ++v) roots.push_back(v);
            EXPECT_EQ(roots, want) << count << " " << distinct << " " << factor;
        }
    }
}

TEST(Welding, FindsTheLowestEqualVertex) {
    for (const std::size_t count : {0u, 1u, 100u, 5000u, 100000u}) {
        for (const int distinct : {1, 10, 4000, 99999}) expectRoots(count, distinct, 0x9e3779b9u);
    }
}

/// All vertices have hashes for the same table slot, or all have the same hash. Comparing all pairs would take hours.
TEST(Welding, TakesLinearTimeIfHashesCollide) {
    for (const int distinct : {99999, 300000}) {
        expectRoots(300000, distinct, 1u << 20);
        expectRoots(300000, distinct, 0);
    }
}

}  // namespace
}  // namespace tspace
