// SPDX-License-Identifier: MIT
// Functions of a library that need not be there: found at run time, by their names.
#pragma once

#include <dlfcn.h>

namespace tspace {

/// Stays loaded as long as the process lives.
class LoadedLibrary {
  public:
    explicit LoadedLibrary(const char* name) : library_(dlopen(name, RTLD_NOW | RTLD_LOCAL)) {}

    /// Becomes a pointer to a function, whose type the caller knows.
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

    /// Null where it is not there.
    Address find(const char* name) {
        void* const address = library_ == nullptr ? nullptr : dlsym(library_, name);
        has_all_ = has_all_ && address != nullptr;
        return Address(address);
    }

    /// Whether the library is there, with every function that was looked for.
    [[nodiscard]] bool hasAll() const { return library_ != nullptr && has_all_; }

  private:
    void* library_;
    bool has_all_ = true;
};

}  // namespace tspace
