// SPDX-License-Identifier: MIT
// A call for many meshes: results equal those of single calls, each job has its own error, and threads reuse memory.
#include <gtest/gtest.h>

#include <atomic>

#include "core/tangents/golden_mesh.h"
#include "core/tangents/random_shapes.h"
#include "support/thread_team.h"

namespace tspace::test {
namespace {

constexpr TangentOptions kGltf{.convention = conventions::gltf};

/// Meshes with one output each, as jobs.
struct Batch {
    std::vector<SimpleMesh> meshes;
    std::vector<Outputs> outputs;
    std::vector<MeshJob> jobs;

    explicit Batch(std::vector<SimpleMesh> given, const TangentOptions& options = kGltf) : meshes(std::move(given)) {
        outputs.reserve(meshes.size());
        for (const SimpleMesh& mesh : meshes) {
            outputs.emplace_back(mesh.cornerCount());
            jobs.push_back({mesh.view(), options, outputs.back().view()});
        }
    }
};

std::vector<SimpleMesh> smallMeshes(std::size_t count) {
    std::vector<SimpleMesh> meshes;
    Dice dice(1);
    while (meshes.size() < count) {
        SimpleMesh mesh;
        const Faces faces = addSheet(dice, mesh, 2);
        for (const std::vector<std::uint32_t>& face : faces) mesh.addFace(face);
        if (mesh.cornerCount() != 0) meshes.push_back(std::move(mesh));
    }
    return meshes;
}

void expectSingleCalls(Batch& batch, const Execution& execution) {
    const auto results = generateTangents(batch.jobs, execution);
    ASSERT_TRUE(results);
    ASSERT_EQ(results->size(), batch.jobs.size());
    for (std::size_t i = 0; i < batch.jobs.size(); ++i) {
        const MeshJob& job = batch.jobs[i];
        Outputs single(batch.meshes[i].cornerCount());
        const Result<TangentReport> want = generateTangents(job.mesh, job.options, single.view());
        ASSERT_TRUE(want);
        ASSERT_TRUE((*results)[i]) << i;
        EXPECT_EQ((*results)[i]->group_count, want->group_count);
        EXPECT_TRUE(sameBits(single, batch.outputs[i])) << i;
    }
}

TEST(ManyMeshes, HaveTheResultsOfSingleCalls) {
    std::vector<SimpleMesh> meshes = smallMeshes(300);
    meshes.push_back(grid(40));
    meshes.insert(meshes.begin() + 100, grid(200));  // has more faces than one thread's share of all
    for (const unsigned threads : {1u, 2u, 3u}) {
        Batch batch(meshes);
        for (std::size_t i = 0; i < batch.jobs.size(); i += 3) batch.jobs[i].options.method = Method::best;
        expectSingleCalls(batch, {.thread_count = threads});
        expectSingleCalls(batch, {.executor = threadTeam(threads)});
    }
}

TEST(ManyMeshes, MayBeNone) {
    const auto results = generateTangents(std::span<const MeshJob>{});
    ASSERT_TRUE(results);
    EXPECT_TRUE(results->empty());
}

TEST(ManyMeshes, AJobThatFailsDoesNotAffectTheOthers) {
    Batch batch(smallMeshes(40));
    batch.jobs[7].options.convention = {};
    batch.jobs[20].out.tangents.count -= 1;
    batch.meshes[31].indices[2] = 1000;
    const auto results = generateTangents(batch.jobs, {.executor = threadTeam(2)});
    ASSERT_TRUE(results);
    for (std::size_t i = 0; i < results->size(); ++i) {
        const Result<TangentReport>& result = (*results)[i];
        const ErrorCode code = result ? ErrorCode::ok : result.error().code;
        EXPECT_EQ(code, i == 7    ? ErrorCode::invalidOption
                        : i == 20 ? ErrorCode::countMismatch
                        : i == 31 ? ErrorCode::indexOutOfRange
                                  : ErrorCode::ok);
        if (i == 31) {
            EXPECT_EQ(result.error().element, 2u);
        }
    }
}

/// Counts allocations, and detects concurrent calls.
struct WatchedAllocator {
    std::atomic<int> inside{0}, calls{0}, live{0};
    std::atomic<bool> overlapped{false};
    Allocator allocator{.allocate = [](void* user, std::size_t bytes, std::size_t alignment) -> void* {
                            auto& self = *static_cast<WatchedAllocator*>(user);
                            if (++self.inside != 1) self.overlapped = true;
                            ++self.calls, ++self.live;
                            void* const memory = ::operator new(bytes, std::align_val_t(alignment));
                            --self.inside;
                            return memory;
                        },
                        .release =
                            [](void* user, void* memory, std::size_t, std::size_t alignment) {
                                auto& self = *static_cast<WatchedAllocator*>(user);
                                if (++self.inside != 1) self.overlapped = true;
                                --self.live;
                                ::operator delete(memory, std::align_val_t(alignment));
                                --self.inside;
                            },
                        .user = this};
};

TEST(ManyMeshes, AnAllocatorIsCalledByOneThreadAtATime) {
    std::vector<SimpleMesh> meshes(60, grid(60));
    Batch batch(std::move(meshes));
    WatchedAllocator watched;
    expectSingleCalls(batch, {.executor = threadTeam(4), .allocator = &watched.allocator});
    EXPECT_GT(watched.calls, 60);
    EXPECT_EQ(watched.live, 0);
    EXPECT_FALSE(watched.overlapped);
}

TEST(ManyMeshes, ThreadsReuseTheirScratchMemory) {
    for (const std::size_t count : {50u, 500u}) {
        Batch batch(smallMeshes(count));
        WatchedAllocator watched;
        ASSERT_TRUE(generateTangents(batch.jobs, {.executor = threadTeam(2), .allocator = &watched.allocator}));
        EXPECT_LE(watched.calls, 2) << count;
    }
}

TEST(ManyMeshes, RunOutOfMemoryAsOneCall) {
    Batch batch(smallMeshes(20));
    const Allocator none{.allocate = [](void*, std::size_t, std::size_t) -> void* { return nullptr; },
                         .release = [](void*, void*, std::size_t, std::size_t) {}};
    const auto results = generateTangents(batch.jobs, {.allocator = &none});
    ASSERT_FALSE(results);
    EXPECT_EQ(results.error().code, ErrorCode::outOfMemory);
}

}  // namespace
}  // namespace tspace::test
