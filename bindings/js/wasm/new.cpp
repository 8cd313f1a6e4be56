// SPDX-License-Identifier: MIT
// operator new. If memory runs out, it calls JavaScript, which throws: the call ends, and the instance is discarded.
#include <cstddef>
#include <new>

#include "exports.h"

extern "C" {

void tspace_endCallOutOfMemory() { tspace_js_endCall(9); }
/// Called by the C++ standard library if a container would exceed its maximum size.
void abort() { tspace_js_endCall(9); }

}  // extern "C"

void* operator new(std::size_t bytes) {
    void* memory = tspace_js_allocate(bytes);
    if (memory == nullptr) tspace_endCallOutOfMemory();
    return memory;
}
void* operator new(std::size_t bytes, std::align_val_t, const std::nothrow_t&) noexcept {
    return tspace_js_allocate(bytes);
}
void operator delete(void* memory) noexcept { tspace_js_release(memory); }
void operator delete(void* memory, std::size_t) noexcept { tspace_js_release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { tspace_js_release(memory); }
