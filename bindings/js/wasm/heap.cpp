// SPDX-License-Identifier: MIT
// Allocator for the module that allocates many small blocks: the C library's allocator, which gets the memory of the
// WebAssembly instance.
#include <cstdint>
#include <cstdlib>

#include "codecs.h"
#include "exports.h"

extern "C" unsigned char __heap_base;  // set by the linker: the first free byte

namespace {

constexpr std::size_t kPage = 65536, kUnit = 16;
std::uintptr_t heap_end = 0;

}  // namespace

extern "C" {

/// Called by malloc to grow the heap.
void* sbrk(std::intptr_t more) {
    void* const none = reinterpret_cast<void*>(-1);
    if (heap_end == 0) heap_end = (reinterpret_cast<std::uintptr_t>(&__heap_base) + kUnit - 1) / kUnit * kUnit;
    if (more < 0) return none;
    const std::uintptr_t begin = heap_end, end = begin + static_cast<std::uintptr_t>(more);
    const std::size_t have = __builtin_wasm_memory_size(0);
    // The last page is unused, so that no end address is 2^32.
    if (end < begin || end > UINTPTR_MAX - kPage) return none;
    const std::size_t pages = (end + kPage - 1) / kPage;
    if (pages > have && __builtin_wasm_memory_grow(0, pages - have) == SIZE_MAX) return none;
    heap_end = end;
    return reinterpret_cast<void*>(begin);
}

bool tspace_js_can_stop = false;
/// Throws if the caller wants to stop the call.
TSPACE_JS_IMPORT(goOn) void tspace_js_goOn();

/// Checks whether the call should be stopped before allocating, because all work allocates at intervals.
void* tspace_js_allocate(std::size_t bytes) {
    constexpr std::size_t kLarge = 4096;
    constexpr unsigned kSmallOnes = 64;
    static unsigned count = 0;
    if (tspace_js_can_stop && (bytes >= kLarge || ++count % kSmallOnes == 0)) tspace_js_goOn();
    return std::malloc(bytes);
}
void tspace_js_release(void* memory) { std::free(memory); }

}  // extern "C"
