// SPDX-License-Identifier: MIT
// Results of the MikkTSpace reference for meshes of the benchmark.
#pragma once

#include <cstdint>

namespace tspace::bench {

/// Returns the hash of the reference's tangents and signs for the mesh with that hash; 0: unknown, for example because
/// the sine function of this machine has other last bits.
std::uint64_t referenceResult(std::uint64_t mesh_hash);

}  // namespace tspace::bench
