// SPDX-License-Identifier: MIT
// Names of methods, as the tool and the docs spell them.
#include <iterator>

#include "tspace/tangents.h"

namespace tspace {

const char* methodName(Method method) {
    static constexpr const char* kNames[] = {"mikktspace", "lengyel", "uniform", "angle", "area",
                                             "flat",       "basis",   "fast",    "best"};
    static_assert(std::size(kNames) == static_cast<std::size_t>(Method::best) + 1);
    const auto number = static_cast<std::size_t>(method);
    return number < std::size(kNames) ? kNames[number] : "unknown";
}

}  // namespace tspace
