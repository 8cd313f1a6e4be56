// SPDX-License-Identifier: MIT
// Replaces all forms of operator new.
#include "failures/failing_memory.h"

#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

std::atomic<bool> is_armed = false;
std::atomic<long> call_count = 0;
long failing_call = 0;
bool fails_after = false;

/// Returns whether the caller is Embree or TBB. They terminate the program if memory runs out, even while they release
/// memory.
bool isOfOthers(void* caller) {
    Dl_info info = {};
    if (dladdr(caller, &info) == 0 || info.dli_fname == nullptr) return false;
    return std::strstr(info.dli_fname, "embree") != nullptr || std::strstr(info.dli_fname, "libtbb") != nullptr;
}

bool hasFailed(void* caller) {
    if (!is_armed || isOfOthers(caller)) return false;
    const long call = ++call_count;
    return call == failing_call || (fails_after && call > failing_call);
}

void* take(std::size_t bytes, std::size_t alignment, void* caller) noexcept {
    if (hasFailed(caller)) return nullptr;
    void* memory = nullptr;
    const std::size_t least = std::max(alignment, sizeof(void*));
    return posix_memalign(&memory, least, std::max<std::size_t>(bytes, 1)) == 0 ? memory : nullptr;
}

void* takeOrThrow(std::size_t bytes, std::size_t alignment, void* caller) {
    void* memory = take(bytes, alignment, caller);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

constexpr std::size_t kUsual = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

}  // namespace

void* operator new(std::size_t bytes) { return takeOrThrow(bytes, kUsual, __builtin_return_address(0)); }
void* operator new[](std::size_t bytes) { return takeOrThrow(bytes, kUsual, __builtin_return_address(0)); }
void* operator new(std::size_t bytes, std::align_val_t at) {
    return takeOrThrow(bytes, static_cast<std::size_t>(at), __builtin_return_address(0));
}
void* operator new[](std::size_t bytes, std::align_val_t at) {
    return takeOrThrow(bytes, static_cast<std::size_t>(at), __builtin_return_address(0));
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    return take(bytes, kUsual, __builtin_return_address(0));
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
    return take(bytes, kUsual, __builtin_return_address(0));
}
void* operator new(std::size_t bytes, std::align_val_t at, const std::nothrow_t&) noexcept {
    return take(bytes, static_cast<std::size_t>(at), __builtin_return_address(0));
}
void* operator new[](std::size_t bytes, std::align_val_t at, const std::nothrow_t&) noexcept {
    return take(bytes, static_cast<std::size_t>(at), __builtin_return_address(0));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace tspace::test {

void failAllocation(long k, bool all_after) {
    failing_call = k;
    fails_after = all_after;
    call_count = 0;
    is_armed = true;
}

bool stopFailing() {
    is_armed = false;
    return call_count >= failing_call;
}

}  // namespace tspace::test
