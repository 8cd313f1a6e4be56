// SPDX-License-Identifier: MIT
// Results of the MikkTSpace reference for meshes of the benchmark.
#pragma once

#include <cstdint>

namespace tspace::bench {

/// Returns the hash of the reference's tangents and signs for the mesh with this hash. Returns 0 if it is unknown, for
/// example because this machine's sine function has other last bits and so gives another mesh.
std::uint64_t referenceResult(std::uint64_t mesh_hash);

}  // namespace tspace::bench
