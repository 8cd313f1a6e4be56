// SPDX-License-Identifier: MIT
#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>
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

TEST(Parallel, RunsNoMoreTasksAtATimeThanALoopHas) {
    Parallel parallel(Execution{.thread_count = 64});
    std::mutex mutex;
    std::set<std::thread::id> threads;
    for (int loop = 0; loop < 200; ++loop) {
        parallel.forTasks(3, [&](std::size_t) {
            const std::lock_guard lock(mutex);
            threads.insert(std::this_thread::get_id());
        });
    }
    EXPECT_LE(threads.size(), 3u);
}

TEST(Parallel, LetsALoopWithMoreTasksFollowASmallerOne) {
    Parallel parallel(Execution{.thread_count = 4});
    for (std::size_t tasks : {2u, 4u, 3u, 100u, 1u, 2u}) {
        std::vector<int> seen(tasks, 0);
        parallel.forTasks(tasks, [&](std::size_t task) { ++seen[task]; });
        EXPECT_EQ(seen, std::vector<int>(tasks, 1));
    }
}

TEST(Parallel, ReturnsOnlyWhenAllTasksAreDone) {
    Parallel parallel(Execution{.thread_count = 3});
    for (int loop = 0; loop < 2000; ++loop) {
        std::vector<std::size_t> squares(7, 0);
        parallel.forTasks(squares.size(), [&](std::size_t task) { squares[task] = task * task; });
        ASSERT_EQ(squares, (std::vector<std::size_t>{0, 1, 4, 9, 16, 25, 36}));
    }
}

TEST(Parallel, WakesThreadsThatFellAsleepBetweenLoops) {
    Parallel parallel(Execution{.thread_count = 2});
    for (int loop = 0; loop < 3; ++loop) {
        // Two tasks that wait for each other need two threads.
        std::atomic<int> met{0};
        parallel.forTasks(2, [&](std::size_t) {
            ++met;
            while (met < 2) std::this_thread::yield();
        });
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
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
