// SPDX-License-Identifier: MIT
// Intercepts the C library's pthread_create, which std::thread calls, and counts the calls.
#include "thread_count.h"

#include <dlfcn.h>
#include <pthread.h>

#include <atomic>

namespace {

std::atomic<std::size_t> started{0};

}  // namespace

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                              void* argument) noexcept {
    using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
    static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
    ++started;
    return create(thread, attributes, run, argument);
}

namespace tspace::bench {

std::size_t startedThreads() { return started; }

}  // namespace tspace::bench
