// SPDX-License-Identifier: MIT
// Evaluating plans repeatedly with an arena allocates nothing after the first evaluation.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "core/tangents/shapes.h"
#include "tspace/execution.h"

namespace {

std::size_t allocation_count = 0;  // calls of operator new in this program

void* counted(std::size_t bytes, std::size_t alignment) {
    ++allocation_count;
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

}  // namespace

void* operator new(std::size_t bytes) { return counted(bytes, alignof(std::max_align_t)); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    return counted(bytes, alignof(std::max_align_t));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return counted(bytes, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t bytes, std::align_val_t alignment, const std::nothrow_t&) noexcept {
    return counted(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace tspace::test {
namespace {

TEST(EvaluateMemory, FramesAfterTheFirstAllocateNothing) {
    const SimpleMesh character = torus(40, 30, false), folded = checkerboard(2000);
    for (const Method method : {Method::mikktspace, Method::lengyel, Method::angle, Method::fast, Method::best}) {
        for (const SimpleMesh& mesh : {character, folded}) {
            const Result<TangentPlan> plan =
                planTangents(mesh.view(), {.method = method, .convention = conventions::gltf});
            ASSERT_TRUE(plan);
            const Arena arena;
            std::vector<Vec4> tangents(mesh.cornerCount());
            const Pose pose{.positions = mesh.positions, .normals = mesh.normals};
            for (int frame = 0; frame < 3; ++frame) {
                const std::size_t before = allocation_count, held = arena.heldBytes();
                ASSERT_TRUE(evaluateTangents(*plan, pose, {.tangents = tangents}, {.allocator = arena.allocator()}));
                if (frame == 0) continue;
                EXPECT_EQ(allocation_count, before) << methodName(method);
                EXPECT_EQ(arena.heldBytes(), held) << methodName(method);
            }
        }
    }
    EXPECT_GT(allocation_count, 0u);
}

}  // namespace
}  // namespace tspace::test
