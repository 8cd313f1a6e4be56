// SPDX-License-Identifier: MIT
// What the MikkTSpace reference gave for meshes of the benchmark.
#pragma once

#include <cstdint>

namespace tspace::bench {

/// The hash of the reference's tangents and signs for the mesh with that hash; 0: not known, for example
/// because this machine's sine has other last bits.
std::uint64_t referenceResult(std::uint64_t mesh_hash);

}  // namespace tspace::bench
