// SPDX-License-Identifier: MIT
// Welding: search for equal vertices, for any comparison, and for vertices at the same position.
#pragma once

#include <cstdint>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "tspace/mesh.h"

namespace tspace {

/// Vertices to compare. The implementation defines which vertices are equal, also if they contain a NaN.
class Weldable {
  public:
    static constexpr std::uint32_t kNoRoot = 0xffffffffu;

    /// Writes hashes[v] for the vertices in [begin, end): equal for equal vertices.
    virtual void hash(std::size_t begin, std::size_t end, std::uint32_t* hashes) = 0;
    /// For the entries in [begin, end): sets roots[i] to kNoRoot if that vertex does not equal vertex list[i] (vertex i
    /// without a list). Returns whether any was set. All vertices have been hashed before.
    virtual bool compare(const std::uint32_t* list, std::size_t begin, std::size_t end, std::uint32_t* roots) = 0;
    /// Compares vertices a and b: negative, 0 or positive. Any total order is allowed in which equal vertices are
    /// adjacent.
    [[nodiscard]] virtual int order(std::uint32_t a, std::uint32_t b) const = 0;

  protected:
    ~Weldable() = default;
};

/// Returns the root of each vertex: the equal vertex with the lowest index. May be empty if no two are equal. Linear
/// for any usual input, O(n log n) for input made to defeat the hash. `is_indexed`: few vertices are expected to have
/// duplicates. Uses 10 to 12 bytes per vertex, up to 24 with four threads, and up to 32 if most vertices have
/// duplicates. `transient` allocates everything except the result.
Buffer<std::uint32_t> findRoots(Weldable& vertices, std::size_t count, bool is_indexed, const Allocator* allocator,
                                const Allocator* transient, Parallel& parallel);

/// Computes findRoots for positions. Coordinates are compared exactly, but -0 equals 0; a position with a NaN equals no
/// other.
Buffer<std::uint32_t> weldPositions(const MeshView& mesh, const Allocator* allocator, Parallel& parallel);

}  // namespace tspace
