// SPDX-License-Identifier: MIT
// Terms and numbering of this folder:
//
// node            a welded vertex: all corners with equal position, normal and UV (weld.h)
// half-edge       3 * triangle + k: the edge of a triangle from its corner k to corner k+1, and also that corner itself
// slot            the corner of the mesh that receives a half-edge's result; the two corners at a quad's diagonal are
//                 slots of two half-edges each
// group           half-edges at one node that share tangents
// facing          the orientation of a triangle's UVs: kFacesUp with positive area, kFacesDown (mirrored) otherwise
// simple node     its triangles form one fan with the same facing, and no angular threshold can split them: one group.
//                 One pass (one_pass.cpp) finishes these nodes. All others are complex: vertex path (vertex_path.h)
// contested       a triangle without UV area whose nodes have groups of both orientations that may claim it (groups.h)
// representative  the corner that the reference keeps for a node: the first in its own search order (grid_order.cpp)
//
// The reference works face by face, with recursion; its "tri info" is a triangle, its "tangent space" a result. Here
// every node is grouped independently: groups.h proves that the result is the same.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/base/memory.h"
#include "tspace/tangents.h"

namespace tspace::mikk {

inline constexpr std::uint32_t kNone = 0xffffffffu;
/// Flag bit, which numbers of half-edges, corners and groups do not use. plan.cpp has a table of its meanings.
inline constexpr std::uint32_t kTopBit = 0x80000000u;
inline constexpr std::uint32_t kValue = 0x7fffffffu;
/// Maximum number of half-edges of a mesh: their indices share a 32-bit word with the flag kTopBit.
inline constexpr std::uint64_t kMaxHalfEdges = kValue;

struct Copy {
    std::uint32_t to = 0, from = 0;  ///< corners of the mesh: `to` gets the result of `from`
};

/// Returns the number of triangles after triangulation.
std::uint64_t countTriangles(const MeshView& mesh, Ngons ngons);

// List that grows, allocated by the caller's allocator. For the calling thread only, like every Buffer.

template <class T>
class Growing {
  public:
    explicit Growing(const Allocator* allocator) : allocator_(allocator) {}

    /// Reserves memory. `capacity` must not be less than size().
    [[gnu::noinline]] void reserve(std::size_t capacity) {
        Buffer<T> larger(allocator_, capacity);
        std::copy_n(buffer_.data(), count_, larger.data());
        buffer_ = std::move(larger);
    }
    void push(const T& value) {
        if (count_ == buffer_.size()) reserve(std::max<std::size_t>(16, 2 * count_));
        buffer_[count_++] = value;
    }
    /// Appends `more` uninitialized elements and returns a pointer to the first.
    T* extend(std::size_t more) {
        if (count_ + more > buffer_.size()) reserve(std::max(count_ + more, 2 * count_));
        count_ += more;
        return buffer_.data() + count_ - more;
    }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] bool empty() const { return count_ == 0; }
    T& operator[](std::size_t i) { return buffer_[i]; }
    const T& operator[](std::size_t i) const { return buffer_[i]; }
    T* begin() { return buffer_.data(); }
    T* end() { return buffer_.data() + count_; }
    const T* begin() const { return buffer_.data(); }
    const T* end() const { return buffer_.data() + count_; }

    /// Removes the last `count` elements.
    void drop(std::size_t count) { count_ -= count; }

    /// Returns a copy of the elements, as a Buffer of exactly their size.
    [[nodiscard, gnu::noinline]] Buffer<T> exact() const {
        Buffer<T> result(allocator_, count_);
        std::copy_n(buffer_.data(), count_, result.data());
        return result;
    }

  private:
    const Allocator* allocator_;
    Buffer<T> buffer_;
    std::size_t count_ = 0;
};

}  // namespace tspace::mikk
