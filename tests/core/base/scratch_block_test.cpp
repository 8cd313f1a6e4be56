// SPDX-License-Identifier: MIT
#include "core/base/memory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>

namespace tspace {
namespace {

/// Counts allocations, and fails after `most_calls` of them.
struct Source {
    int calls = 0, held = 0, most_calls = 1000;
    Allocator allocator{allocate, release, this};

    static void* allocate(void* user, std::size_t bytes, std::size_t alignment) {
        auto& self = *static_cast<Source*>(user);
        if (self.calls == self.most_calls) return nullptr;
        ++self.calls;
        ++self.held;
        return ::operator new(bytes, std::align_val_t(alignment));
    }
    static void release(void* user, void* memory, std::size_t, std::size_t alignment) {
        --static_cast<Source*>(user)->held;
        ::operator delete(memory, std::align_val_t(alignment));
    }
};

TEST(ScratchBlock, GivesAlignedBuffersThatDoNotOverlapFromOneAllocation) {
    Source source;
    {
        ScratchBlock scratch(&source.allocator, 4096);
        Buffer<std::uint8_t> a(scratch.allocator(), 65, std::uint8_t{1}), b(scratch.allocator(), 1, std::uint8_t{2}),
            c(scratch.allocator(), 200, std::uint8_t{3});
        EXPECT_EQ(source.calls, 1);
        for (const auto* buffer : {&a, &b, &c})
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(buffer->data()) % kMemoryAlignment, 0u);
        EXPECT_EQ(a[64], 1);
        EXPECT_EQ(b[0], 2);
        EXPECT_EQ(c[199], 3);
    }
    EXPECT_EQ(source.held, 0);
}

TEST(ScratchBlock, UsesMemoryAgainWhenTheLastBufferGoesFirst) {
    Source source;
    ScratchBlock scratch(&source.allocator, 1024);
    for (int i = 0; i < 100; ++i) {
        const Buffer<std::uint8_t> outer(scratch.allocator(), 500);
        const Buffer<std::uint8_t> inner(scratch.allocator(), 500);
    }
    EXPECT_EQ(source.calls, 1);
}

TEST(ScratchBlock, UsesTheCallersAllocatorIfABufferDoesNotFit) {
    Source source;
    {
        ScratchBlock scratch(&source.allocator, 1000);
        Buffer<std::uint8_t> large(scratch.allocator(), 1001), fits(scratch.allocator(), 1000),
            more(scratch.allocator(), 1);
        EXPECT_EQ(source.calls, 3);
        fits = {};
        const Buffer<std::uint8_t> again(scratch.allocator(), 900);
        EXPECT_EQ(source.calls, 3);
    }
    EXPECT_EQ(source.held, 0);
}

TEST(ScratchBlock, KeepsABufferThatGoesBeforeALaterOne) {
    Source source;
    ScratchBlock scratch(&source.allocator, 1024);
    std::optional<Buffer<std::uint8_t>> first(std::in_place, scratch.allocator(), 100);
    const Buffer<std::uint8_t> second(scratch.allocator(), 100, std::uint8_t{7});
    first.reset();
    const Buffer<std::uint8_t> third(scratch.allocator(), 100, std::uint8_t{8});
    EXPECT_EQ(second[0], 7);
    EXPECT_EQ(second[99], 7);
}

TEST(ScratchBlock, ReportsWhenTheCallersAllocatorFails) {
    Source source;
    source.most_calls = 1;
    ScratchBlock scratch(&source.allocator, 256);
    EXPECT_THROW(Buffer<std::uint8_t>(scratch.allocator(), 257), OutOfMemory);
    EXPECT_NO_THROW(Buffer<std::uint8_t>(scratch.allocator(), 256));
}

TEST(ScratchBlock, UsesExternalMemoryWithinItsBounds) {
    alignas(kMemoryAlignment) std::byte memory[512] = {};
    for (const std::size_t skip : {std::size_t{0}, std::size_t{4}, std::size_t{63}}) {
        Source source;
        {
            ScratchBlock scratch(&source.allocator, std::span(memory).subspan(skip, 300));
            const std::size_t usable = skip == 0 ? 300 : 300 - (64 - skip);
            EXPECT_TRUE(scratch.has(usable));
            EXPECT_FALSE(scratch.has(usable + 1));
            const Buffer<std::byte> inside(scratch.allocator(), usable, std::byte{1});
            EXPECT_EQ(inside.data(), memory + (skip == 0 ? 0 : 64));
            EXPECT_EQ(source.calls, 0);
            const Buffer<std::byte> beyond(scratch.allocator(), 1);
            EXPECT_EQ(source.calls, 1);
        }
        EXPECT_EQ(source.held, 0);
    }
}

TEST(ScratchBlock, UsesOnlyTheCallersAllocatorWithoutMemory) {
    Source source;
    std::byte few[8];
    for (const std::span<std::byte> memory : {std::span<std::byte>(), std::span<std::byte>(few)}) {
        ScratchBlock scratch(&source.allocator, memory);
        EXPECT_FALSE(scratch.has(65));
        const int calls = source.calls;
        const Buffer<std::byte> buffer(scratch.allocator(), 65);
        EXPECT_EQ(source.calls, calls + 1);
    }
    EXPECT_EQ(source.held, 0);
}

}  // namespace
}  // namespace tspace
