// SPDX-License-Identifier: MIT
// Functions of a library that need not be there: found at run time, by their names.
#pragma once

#include <dlfcn.h>

namespace tspace {

/// Stays loaded as long as the process lives.
class LoadedLibrary {
  public:
    explicit LoadedLibrary(const char* name) : library_(dlopen(name, RTLD_NOW | RTLD_LOCAL)) {}

    template <typename Function>
    void find(Function& function, const char* name) {
        if (library_ != nullptr) function = reinterpret_cast<Function>(dlsym(library_, name));
        has_all_ = has_all_ && function != nullptr;
    }

    /// Whether the library is there, with every function that was looked for.
    [[nodiscard]] bool hasAll() const { return library_ != nullptr && has_all_; }

  private:
    void* library_;
    bool has_all_ = true;
};

}  // namespace tspace
