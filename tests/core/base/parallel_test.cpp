// SPDX-License-Identifier: MIT
#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "tspace/indexed_frames.h"
#include "tspace/normals.h"
#include "tspace/tangents.h"

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
        // Two tasks wait for each other, so both threads must run.
        std::atomic<int> met{0};
        parallel.forTasks(2, [&](std::size_t) {
            ++met;
            while (met < 2) std::this_thread::yield();
        });
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

TEST(Parallel, StartsNoThreadForLittleWork) {
    const Execution eight{.thread_count = 8};
    EXPECT_EQ(Parallel(eight, 0).width(), 1u);
    EXPECT_EQ(Parallel(eight, 75'000).width(), 1u);  // corners of 25,000 triangles: too few for two threads
    EXPECT_EQ(Parallel(eight, 120'000).width(), 2u);
    EXPECT_EQ(Parallel(eight, 30'000'000).width(), 8u);
    const Executor team{.run = [](void*, std::size_t, void (*)(void*, std::size_t), void*) {}, .concurrency = 8};
    EXPECT_EQ(Parallel(Execution{.executor = &team}, 0).width(), 8u);
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

TEST(Parallel, PropagatesExceptionsToTheCaller) {
    struct Thrown {
        std::size_t task;
    };
    const Executor executor{.run =
                                [](void*, std::size_t count, void (*task)(void*, std::size_t), void* context) {
                                    for (std::size_t i = 0; i < count; ++i) task(context, i);
                                },
                            .concurrency = 4};
    for (const Execution& execution : {Execution{}, Execution{.thread_count = 4}, Execution{.executor = &executor}}) {
        for (int round = 0; round < 50; ++round) {
            Parallel parallel(execution);
            // The vector is destroyed when the exception arrives, so no thread may still use it.
            auto seen = std::make_unique<std::vector<std::atomic<int>>>(64);
            try {
                parallel.forTasks(seen->size(), [&](std::size_t task) {
                    ++(*seen)[task];
                    if (task % 7 == 3) throw Thrown{task};
                });
                ADD_FAILURE() << "nothing was thrown";
            } catch (const Thrown& thrown) {
                EXPECT_EQ(thrown.task % 7, 3u);
                for (const std::atomic<int>& n : *seen) EXPECT_LE(n, 1);
            }
            seen.reset();
            // The object still works afterwards.
            std::atomic<int> count{0};
            parallel.forTasks(10, [&](std::size_t) { ++count; });
            EXPECT_EQ(count, 10);
        }
    }
}

TEST(Parallel, IsNotUsedForAMeshOf200Triangles) {
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t y = 0; y <= 10; ++y) {
        for (std::uint32_t x = 0; x <= 10; ++x) {
            positions.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(x * y % 3)});
            normals.push_back({0, 0, 1});
            uvs.push_back({static_cast<float>(x % 7), static_cast<float>(y)});
            if (x == 10 || y == 10) continue;
            const std::uint32_t a = 11 * y + x;
            indices.insert(indices.end(), {a, a + 1, a + 12, a, a + 12, a + 11});
        }
    }
    MeshView mesh;
    mesh.positions = positions;
    mesh.normals = normals;
    mesh.uvs = uvs;
    mesh.indices = IndexView(std::span<const std::uint32_t>(indices));
    int runs = 0;
    const Executor executor{.run =
                                [](void* user, std::size_t count, void (*task)(void*, std::size_t), void* context) {
                                    ++*static_cast<int*>(user);
                                    for (std::size_t i = 0; i < count; ++i) task(context, i);
                                },
                            .user = &runs,
                            .concurrency = 8};
    const Execution execution{.executor = &executor};
    std::vector<Vec3> made_normals(indices.size());
    ASSERT_TRUE(generateNormals(mesh, {.crease_angle_deg = 30}, made_normals, execution));
    for (const Method method : {Method::mikktspace, Method::lengyel, Method::uniform, Method::angle, Method::area,
                                Method::flat, Method::basis, Method::fast, Method::best}) {
        std::vector<Vec4> tangents(indices.size());
        ASSERT_TRUE(generateTangents(mesh, {.method = method, .convention = conventions::opengl},
                                     {.tangents = tangents}, execution));
        tangents[7] = {};
        ASSERT_TRUE(sanitizeTangents(mesh, {}, tangents, execution));
        const CornerAttribute attribute = cornerAttribute(StridedSpan<const Vec4>(tangents));
        ASSERT_TRUE(splitVertices(mesh.indices, positions.size(), indices.size(), {&attribute, 1}, execution));
    }
    EXPECT_EQ(runs, 0);
}

}  // namespace
}  // namespace tspace
