// SPDX-License-Identifier: MIT
// Functions of an optional library, looked up by name at run time.
#pragma once

#include <dlfcn.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstddef>
#include <cstring>

#include "core/base/memory.h"

namespace tspace {

/// Returns whether this many bytes can be mapped now.
inline bool canMap(std::size_t bytes) {
    void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return memory != MAP_FAILED && munmap(memory, bytes) == 0;
}

/// Throws OutOfMemory unless this many bytes can be mapped now. Call it before libraries that may not handle failed
/// allocations correctly, with more bytes than they need.
inline void requireMemory(std::size_t bytes) {
    if (!canMap(bytes)) throwOutOfMemory();
}

/// Library that stays loaded until the process ends.
class LoadedLibrary {
  public:
    /// `needed_bytes`: upper limit of the address space of the library and its dependencies. Throws OutOfMemory if that
    /// is not available, or if the loader reports anything but an absent or unusable library. If the constructor of a
    /// static variable throws, the next call initializes the variable again.
    LoadedLibrary(const char* name, std::size_t needed_bytes) {
        requireMemory(needed_bytes);
        library_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
        // The loader skips folders for whose names it has no memory, and then reports an absent library.
        if (library_ == nullptr) library_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
        if (library_ != nullptr) return;
        const char* const reason = dlerror();
        const auto mentions = [reason](const char* part) {
            return reason != nullptr && std::strstr(reason, part) != nullptr;
        };
        if (mentions("ELF") || mentions("symbol") || mentions("version") || mentions("no such")) return;
        if (mentions(std::strerror(ENOENT)) || mentions(std::strerror(EACCES))) return;
        throwOutOfMemory();
    }

    /// Converts to a function pointer of the type that the caller expects.
    class Address {
      public:
        explicit Address(void* address) : address_(address) {}
        template <typename Function>
        operator Function*() const {
            return reinterpret_cast<Function*>(address_);
        }

      private:
        void* address_;
    };

    /// Returns null if the function does not exist.
    Address find(const char* name) {
        void* const address = library_ == nullptr ? nullptr : dlsym(library_, name);
        has_all_ = has_all_ && address != nullptr;
        return Address(address);
    }

    /// Returns whether the library exists, with every requested function.
    [[nodiscard]] bool hasAll() const { return library_ != nullptr && has_all_; }

  private:
    void* library_ = nullptr;
    bool has_all_ = true;
};

}  // namespace tspace
