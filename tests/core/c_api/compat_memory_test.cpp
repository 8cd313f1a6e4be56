// SPDX-License-Identifier: MIT
// Lets each allocation of a MikkTSpace call fail once: the call returns false and calls no setter. This program
// replaces operator new, so the test is in a separate file.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "tspace/compat/mikktspace.h"

namespace {

constexpr long kNoLimit = -1;
long allowed = kNoLimit;  ///< allocations before one fails (not atomic: the meshes are too small for threads)

void* allocateOrNull(std::size_t bytes, std::size_t alignment) {
    if (allowed == 0) return nullptr;
    if (allowed > 0) --allowed;
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

void* allocateOrThrow(std::size_t bytes, std::size_t alignment) {
    void* memory = allocateOrNull(bytes == 0 ? 1 : bytes, alignment);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

}  // namespace

void* operator new(std::size_t bytes) { return allocateOrThrow(bytes, alignof(std::max_align_t)); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return allocateOrThrow(bytes, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    return allocateOrNull(bytes, alignof(std::max_align_t));
}
void* operator new(std::size_t bytes, std::align_val_t alignment, const std::nothrow_t&) noexcept {
    return allocateOrNull(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace {

/// The following callbacks describe a strip of squares.
int numFaces(const SMikkTSpaceContext*) { return 10; }
int numVertices(const SMikkTSpaceContext*, const int) { return 4; }
void getPosition(const SMikkTSpaceContext*, float out[], const int face, const int vertex) {
    out[0] = static_cast<float>(face + (vertex == 1 || vertex == 2 ? 1 : 0));
    out[1] = vertex >= 2 ? 1.0f : 0.0f;
    out[2] = 0.0f;
}
void getNormal(const SMikkTSpaceContext*, float out[], const int, const int) {
    out[0] = out[1] = 0.0f;
    out[2] = 1.0f;
}
void getTexCoord(const SMikkTSpaceContext* context, float out[], const int face, const int vertex) {
    float position[3];
    getPosition(context, position, face, vertex);
    out[0] = position[0];
    out[1] = position[1];
}
void setBasic(const SMikkTSpaceContext* context, const float[], const float, const int, const int) {
    ++*static_cast<int*>(context->m_pUserData);
}

TEST(CompatMemory, EachAllocationThatFailsMakesTheCallFalse) {
    SMikkTSpaceInterface calls = {numFaces, numVertices, getPosition, getNormal, getTexCoord, setBasic, nullptr};
    int written = 0;
    const SMikkTSpaceContext context = {&calls, &written};
    tbool done = 0;
    long limit = 0;
    for (; !done && limit < 10000; ++limit) {
        ASSERT_EQ(written, 0) << "after " << limit << " allocations";
        allowed = limit;
        done = genTangSpaceDefault(&context);
        allowed = kNoLimit;
    }
    EXPECT_TRUE(done);
    EXPECT_EQ(written, 40);
    EXPECT_GT(limit, 5);
}

}  // namespace
