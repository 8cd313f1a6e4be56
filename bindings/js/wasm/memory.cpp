// SPDX-License-Identifier: MIT
// A small allocator for modules that allocate few large arrays, in one thread and without an operating system.
#include <cstddef>
#include <cstdint>

#include "exports.h"

extern "C" unsigned char __heap_base;  // set by the linker: the first free byte

namespace {

/// Alignment that the core needs, size of a block's header, and size of a page of WebAssembly memory. Sizes of blocks
/// are multiples of kUnit, including the header.
constexpr std::size_t kUnit = 64, kHead = 16, kPage = 65536;

/// Free block in a list sorted by address; adjacent blocks are merged.
struct Block {
    std::size_t bytes;  // including the header
    Block* next;        // only while the block is free
};
Block* first_free = nullptr;
std::uintptr_t heap_end = 0;

char* placeOf(Block* block) { return reinterpret_cast<char*>(block) + kHead; }

void giveBack(Block* block) {
    Block* previous = nullptr;
    Block* next = first_free;
    while (next != nullptr && next < block) {
        previous = next;
        next = next->next;
    }
    block->next = next;
    (previous == nullptr ? first_free : previous->next) = block;
    if (next != nullptr && reinterpret_cast<char*>(block) + block->bytes == reinterpret_cast<char*>(next)) {
        block->bytes += next->bytes;
        block->next = next->next;
    }
    if (previous != nullptr && reinterpret_cast<char*>(previous) + previous->bytes == reinterpret_cast<char*>(block)) {
        previous->bytes += block->bytes;
        previous->next = block->next;
    }
}

/// Returns the first free block that is large enough (first fit), so that large blocks of one call are reused by the
/// next; null if there is none.
Block* take(std::size_t bytes) {
    for (Block** at = &first_free; *at != nullptr; at = &(*at)->next) {
        Block* block = *at;
        if (block->bytes < bytes) continue;
        if (block->bytes == bytes) {
            *at = block->next;
        } else {
            auto* rest = reinterpret_cast<Block*>(reinterpret_cast<char*>(block) + bytes);
            *rest = {block->bytes - bytes, block->next};
            *at = rest;
            block->bytes = bytes;
        }
        return block;
    }
    return nullptr;
}

bool growBy(std::size_t bytes) {
    if (heap_end == 0) {
        const auto base = reinterpret_cast<std::uintptr_t>(&__heap_base);
        heap_end = (base + kHead + kUnit - 1) / kUnit * kUnit - kHead;
    }
    const std::uintptr_t have = __builtin_wasm_memory_size(0) * kPage;
    const std::uintptr_t left = have > heap_end ? have - heap_end : 0;
    // One additional unit: memory ends at a multiple of kUnit, and blocks end kHead bytes before one.
    const std::size_t missing = bytes + kUnit > left ? bytes + kUnit - left : 0;
    if (missing != 0 && __builtin_wasm_memory_grow(0, (missing + kPage - 1) / kPage) == SIZE_MAX) return false;
    const std::uintptr_t end = __builtin_wasm_memory_size(0) * kPage;
    auto* block = reinterpret_cast<Block*>(heap_end);
    // `end` is 0 if memory ends at 4 GB, an address that 32 bits cannot represent.
    block->bytes = ((end == 0 ? std::uintptr_t{0} - kUnit : end) - heap_end) / kUnit * kUnit;
    heap_end += block->bytes;
    giveBack(block);
    return true;
}

}  // namespace

extern "C" {

void* tspace_js_allocate(std::size_t bytes) {
    constexpr std::size_t kMost = SIZE_MAX - 2 * kPage;
    if (bytes > kMost) return nullptr;
    const std::size_t needed = (bytes + kHead + kUnit - 1) / kUnit * kUnit;
    Block* block = take(needed);
    if (block == nullptr && growBy(needed)) block = take(needed);
    return block == nullptr ? nullptr : placeOf(block);
}

void tspace_js_release(void* memory) {
    if (memory != nullptr) giveBack(reinterpret_cast<Block*>(static_cast<char*>(memory) - kHead));
}

}  // extern "C"
