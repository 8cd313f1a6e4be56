// SPDX-License-Identifier: MIT
// The C API with the caller's executor and allocator: its allocations and releases, and its behavior when memory runs
// out.
#include <gtest/gtest.h>

#include <memory>
#include <new>
#include <vector>

#include "core/c_api/outputs.h"
#include "core/c_api/random_mesh.h"
#include "tspace/tspace.hpp"

namespace tspace::test {
namespace {

/// Counts allocations and releases, and fails after `allowed` allocations.
struct CountingMemory {
    std::size_t given = 0;
    std::size_t live = 0;
    std::size_t allowed = ~std::size_t{0};

    tspace_Allocator hooks() { return {allocate, release, this}; }

    static void* allocate(void* user, std::size_t bytes, std::size_t alignment) {
        auto& self = *static_cast<CountingMemory*>(user);
        if (self.given == self.allowed) return nullptr;
        ++self.given;
        ++self.live;
        return ::operator new(bytes, std::align_val_t(alignment));
    }
    static void release(void* user, void* memory, std::size_t, std::size_t alignment) {
        --static_cast<CountingMemory*>(user)->live;
        ::operator delete(memory, std::align_val_t(alignment));
    }
};

void runInReverse(void* user, std::size_t count, void (*task)(void*, std::size_t), void* context) {
    ++*static_cast<int*>(user);
    for (std::size_t i = count; i-- > 0;) task(context, i);
}

TEST(CApi, UsesTheCallersExecutorAndAllocator) {
    const RandomMesh mesh(6, 6000);
    CApiOutputs expected(mesh.cornerCount()), c(mesh.cornerCount());
    ASSERT_TRUE(generateTangents(mesh.view(), {.convention = conventions::opengl}, expected.view()));
    int run_count = 0;
    CountingMemory memory;
    const tspace_Executor executor = {runInReverse, &run_count, 4};
    const tspace_Allocator allocator = memory.hooks();
    tspace_TangentOptions options = tangentOptions();
    tspace_Execution execution;
    TSPACE_INIT(execution);
    execution.executor = &executor;
    execution.allocator = &allocator;
    const tspace_Mesh c_mesh = mesh.c();
    const tspace_TangentOutput out = c.c();
    ASSERT_EQ(TSPACE_OK, tspace_generateTangents(&c_mesh, &options, &out, &execution, nullptr, nullptr));
    expectSame(expected, c);
    EXPECT_GT(run_count, 0);
    EXPECT_GT(memory.given, 0u);
    EXPECT_EQ(memory.live, 0u);
}

TEST(CApi, AnArenaServesASecondCallFromItsMemory) {
    const RandomMesh mesh(8, 600);
    CApiOutputs expected(mesh.cornerCount()), c(mesh.cornerCount());
    ASSERT_TRUE(generateTangents(mesh.view(), {.convention = conventions::opengl}, expected.view()));
    tspace_Arena* arena = nullptr;
    ASSERT_EQ(TSPACE_OK, tspace_createArena(&arena, nullptr));
    EXPECT_EQ(tspace_arenaHeldBytes(arena), 0u);
    tspace_TangentOptions options = tangentOptions();
    tspace_Execution execution;
    TSPACE_INIT(execution);
    execution.allocator = tspace_arenaAllocator(arena);
    const tspace_Mesh c_mesh = mesh.c();
    const tspace_TangentOutput out = c.c();
    ASSERT_EQ(TSPACE_OK, tspace_generateTangents(&c_mesh, &options, &out, &execution, nullptr, nullptr));
    expectSame(expected, c);
    const std::size_t held = tspace_arenaHeldBytes(arena);
    EXPECT_GT(held, 0u);
    EXPECT_EQ(tspace_arenaUsedBytes(arena), 0u);
    tspace_TangentPlan* plan = nullptr;
    ASSERT_EQ(TSPACE_OK, tspace_planTangents(&c_mesh, &options, &execution, &plan, nullptr));
    EXPECT_GT(tspace_arenaUsedBytes(arena), 0u);
    tspace_destroyTangentPlan(plan);
    EXPECT_EQ(tspace_arenaUsedBytes(arena), 0u);
    ASSERT_EQ(TSPACE_OK, tspace_generateTangents(&c_mesh, &options, &out, &execution, nullptr, nullptr));
    expectSame(expected, c);
    EXPECT_EQ(tspace_arenaHeldBytes(arena), held);
    tspace_trimArena(arena);
    EXPECT_EQ(tspace_arenaHeldBytes(arena), 0u);
    tspace_destroyArena(arena);
    tspace_destroyArena(nullptr);
    EXPECT_EQ(TSPACE_ERROR_NULL_DATA, tspace_createArena(nullptr, nullptr));
}

TEST(CApi, APlanOutlivesTheStructsItWasMadeWith) {
    const RandomMesh mesh(7, 60);
    CApiOutputs expected(mesh.cornerCount()), c(mesh.cornerCount());
    ASSERT_TRUE(generateTangents(mesh.view(), {.convention = conventions::opengl}, expected.view()));
    CountingMemory memory;
    tspace_TangentPlan* plan = nullptr;
    {
        // These structs are on the heap and are freed, so that AddressSanitizer detects a plan that still refers to
        // them.
        const auto allocator = std::make_unique<tspace_Allocator>(memory.hooks());
        const auto c_mesh = std::make_unique<tspace_Mesh>(mesh.c());
        tspace_TangentOptions options = tangentOptions();
        const auto execution = std::make_unique<tspace_Execution>();
        TSPACE_INIT(*execution);
        execution->allocator = allocator.get();
        ASSERT_EQ(TSPACE_OK, tspace_planTangents(c_mesh.get(), &options, execution.get(), &plan, nullptr));
    }
    const tspace_Mesh c_mesh = mesh.c();
    tspace_Pose pose;
    TSPACE_INIT(pose);
    pose.positions = c_mesh.positions;
    pose.normals = c_mesh.normals;
    const tspace_TangentOutput out = c.c();
    ASSERT_EQ(TSPACE_OK, tspace_evaluateTangents(plan, &pose, &out, nullptr, nullptr, nullptr));
    expectSame(expected, c);
    EXPECT_GT(memory.live, 0u);

    pose.positions.count -= 1;
    EXPECT_EQ(TSPACE_ERROR_PLAN_MISMATCH, tspace_evaluateTangents(plan, &pose, &out, nullptr, nullptr, nullptr));
    tspace_destroyTangentPlan(plan);
    EXPECT_EQ(memory.live, 0u);
}

TEST(CApi, EveryAllocationThatFailsGivesOutOfMemoryAndLeaksNothing) {
    const RandomMesh mesh(8, 60);
    const tspace_Mesh c_mesh = mesh.c();
    CApiOutputs c(mesh.cornerCount());
    const tspace_TangentOutput out = c.c();
    tspace_ErrorCode code = TSPACE_ERROR_OUT_OF_MEMORY;
    std::size_t allowed = 0;
    for (; code != TSPACE_OK && allowed < 1000; ++allowed) {
        CountingMemory memory;
        memory.allowed = allowed;
        const tspace_Allocator allocator = memory.hooks();
        const tspace_TangentOptions options = tangentOptions();
        tspace_Execution execution;
        TSPACE_INIT(execution);
        execution.allocator = &allocator;
        code = tspace_generateTangents(&c_mesh, &options, &out, &execution, nullptr, nullptr);
        EXPECT_TRUE(code == TSPACE_OK || code == TSPACE_ERROR_OUT_OF_MEMORY) << code;
        EXPECT_EQ(memory.live, 0u);
    }
    EXPECT_EQ(TSPACE_OK, code);
    EXPECT_GT(allowed, 1u);
}

}  // namespace
}  // namespace tspace::test
