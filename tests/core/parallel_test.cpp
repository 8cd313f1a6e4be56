// SPDX-License-Identifier: MIT
#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace tspace {
namespace {

TEST(Parallel, RunsEachItemExactlyOnceForAnyThreadCount) {
    for (const unsigned threads : {1u, 2u, 3u, 8u}) {
        Parallel parallel(Execution{.thread_count = threads});
        std::vector<int> seen(10007, 0);
        for (int round = 0; round < 3; ++round) {
            parallel.forRanges(seen.size(), 16, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) ++seen[i];
            });
        }
        for (const int n : seen) ASSERT_EQ(n, 3);
    }
}

TEST(Parallel, KeepsSmallLoopsOnTheCallingThread) {
    Parallel parallel(Execution{.thread_count = 8});
    int calls = 0;
    parallel.forRanges(100, 100, [&](std::size_t begin, std::size_t end) {
        ++calls;
        EXPECT_EQ(end - begin, 100u);
    });
    EXPECT_EQ(calls, 1);
}

TEST(Parallel, UsesTheCallersExecutor) {
    std::atomic<int> runs{0};
    const Executor executor{.run =
                                [](void* user, std::size_t count, void (*task)(void*, std::size_t), void* context) {
                                    ++*static_cast<std::atomic<int>*>(user);
                                    for (std::size_t i = count; i-- > 0;) task(context, i);
                                },
                            .user = &runs,
                            .concurrency = 4};
    Parallel parallel(Execution{.executor = &executor});
    std::vector<int> seen(1000, 0);
    parallel.forRanges(seen.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++seen[i];
    });
    EXPECT_EQ(runs, 1);
    for (const int n : seen) ASSERT_EQ(n, 1);
}

}  // namespace
}  // namespace tspace
