// SPDX-License-Identifier: MIT
// Equal vertices are one: the search for them, whatever is compared, and vertices at the same position.
#pragma once

#include <cstdint>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "tspace/mesh.h"

namespace tspace {

/// Vertices to compare. A vertex that does not equal itself (a NaN) equals no other.
class Weldable {
  public:
    static constexpr std::uint32_t kNoRoot = 0xffffffffu;

    /// Writes hashes[v] for the vertices from `begin` to before `end`: the same for equal vertices.
    virtual void hash(std::size_t begin, std::size_t end, std::uint32_t* hashes) = 0;
    /// For the entries from `begin` to before `end`: roots[i] becomes kNoRoot where that vertex does not equal vertex list[i],
    /// or vertex i where there is no list. Returns whether that was so anywhere. All are hashed by then.
    virtual bool compare(const std::uint32_t* list, std::size_t begin, std::size_t end, std::uint32_t* roots) = 0;
    /// Less than 0, 0 or more, in any order in which equal vertices lie together.
    [[nodiscard]] virtual int order(std::uint32_t a, std::uint32_t b) const = 0;

  protected:
    ~Weldable() = default;
};

/// For each vertex its root: the lowest vertex that equals it. May be empty when no two are equal. Linear for any ordinary
/// input, O(n log n) for one made to defeat the hash. `is_indexed`: few vertices are equal to others, most likely. Takes 10
/// to 12 bytes per vertex while it works, up to 24 with four threads, and up to 32 when most vertices are equal to others.
/// `transient` allocates all but the result.
Buffer<std::uint32_t> findRoots(Weldable& vertices, std::size_t count, bool is_indexed, const Allocator* allocator,
                                const Allocator* transient, Parallel& parallel);

/// findRoots for positions. Coordinates are compared exactly, but -0 equals 0; a position with a NaN equals no other.
Buffer<std::uint32_t> weldPositions(const MeshView& mesh, const Allocator* allocator, Parallel& parallel);

}  // namespace tspace
