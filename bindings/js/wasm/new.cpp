// SPDX-License-Identifier: MIT
// Memory for C++, and what happens when there is none left: a call into JavaScript, which throws, so that the call ends
// there. The instance is then thrown away.
#include <cstddef>
#include <new>

#include "exports.h"

extern "C" {

void tspace_endCallOutOfMemory() { tspace_js_endCall(9); }
/// The C++ library comes here for lists that are longer than the address space.
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
