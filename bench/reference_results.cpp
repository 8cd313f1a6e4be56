// SPDX-License-Identifier: MIT
#include "reference_results.h"

namespace tspace::bench {

namespace {

struct Known {
    std::uint64_t mesh, result;
};

constexpr Known kKnown[] = {{1, 1}};

}  // namespace

std::uint64_t referenceResult(std::uint64_t mesh_hash) {
    for (const Known& known : kKnown) {
        if (known.mesh == mesh_hash) return known.result;
    }
    return 0;
}

}  // namespace tspace::bench
