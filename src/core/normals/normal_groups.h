// SPDX-License-Identifier: MIT
// Corners that share a normal are one vertex of a mesh that is cut open at its hard edges: positions, who is next to whom,
// and the rings around each.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/float4.h"
#include "core/base/memory.h"
#include "core/normals/normals_call.h"

namespace tspace {

// Three components; the fourth one is 0.
inline Float4 crossed(Float4 a, Float4 b) {
    const Float4 a_yzx = __builtin_shufflevector(a, a, 1, 2, 0, 3), b_yzx = __builtin_shufflevector(b, b, 1, 2, 0, 3);
    const Float4 c = a * b_yzx - a_yzx * b;
    return __builtin_shufflevector(c, c, 1, 2, 0, 3);
}
inline float dotted(Float4 a, Float4 b) {
    const Float4 c = a * b;
    return (c[0] + c[1]) + c[2];
}

/// The group of each corner: its point, or a dense number.
class CornerGroups {
  public:
    /// components: the lowest corner of each corner's component; empty where all corners of a point are one.
    CornerGroups(const NormalsCall& call, Buffer<std::uint32_t> components);

    [[nodiscard]] std::uint32_t of(std::uint32_t corner) const {
        return numbers_.empty() ? call_.items.pointOf(corner) : numbers_[corner];
    }
    [[nodiscard]] std::size_t count() const { return count_; }

  private:
    const NormalsCall& call_;
    Buffer<std::uint32_t> numbers_;
    std::size_t count_;
};

/// Triangles without area, or with a corner that is not finite, are left out. A polygon counts as `best` sees it: as a
/// triangle at each corner, with the corners before and after it.
class NormalGroups {
  public:
    /// `length`: positions here are in units of it. Takes 56 bytes per group and 16 per corner, and 4 per group
    /// and thread for marks. Throws OutOfMemory.
    NormalGroups(const NormalsCall& call, const CornerGroups& corner_groups, double length);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] Float4 position(std::size_t group) const { return loadFloat4(positions_.data() + 4 * group); }
    /// Unit mean of the faces by area, or zero.
    [[nodiscard]] Float4 areaNormal(std::size_t group) const { return loadFloat4(normals_.data() + 4 * group); }
    /// The variance of that mean's direction (of both its angles together, in rad^2), where noise moves all points but this one
    /// by 1 along the normal. Infinite where there is no mean.
    [[nodiscard]] float areaVariance(std::size_t group) const { return variances_[group]; }
    [[nodiscard]] std::span<const std::uint32_t> neighbours(std::size_t group) const {
        return {neighbours_.data() + begins_[group], counts_[group]};
    }

    /// body(i, group, marks) for i in [0, count), where group = groupOf(i), each group once at most. marks: one number per group,
    /// which is none of a group in the beginning.
    template <class GroupOf, class Body>
    void forSome(std::size_t count, const GroupOf& groupOf, const Body& body) const {
        constexpr std::size_t kChunk = 256;
        const std::size_t chunks = (count + kChunk - 1) / kChunk;
        const std::size_t tasks = std::min<std::size_t>(chunks, marks_.size() / std::max<std::size_t>(count_, 1));
        std::atomic<std::size_t> next{0};
        call_.parallel.forTasks(tasks, [&](std::size_t task) {
            std::uint32_t* const marks = marks_.data() + task * count_;
            std::fill_n(marks, count_, ~std::uint32_t{0});
            for (std::size_t chunk; (chunk = next.fetch_add(1, std::memory_order_relaxed)) < chunks;) {
                const std::size_t end = std::min(count, (chunk + 1) * kChunk);
                for (std::size_t i = chunk * kChunk; i < end; ++i) body(i, groupOf(i), marks);
            }
        });
    }
    template <class Body>
    void forAll(const Body& body) const {
        forSome(
            count_, [](std::size_t i) { return i; },
            [&](std::size_t, std::size_t group, std::uint32_t* marks) {
                body(static_cast<std::uint32_t>(group), marks);
            });
    }

    /// The groups that a corner's edges lead to, after and before it on its face.
    struct Ends {
        std::uint32_t next, previous;
    };
    [[nodiscard]] std::span<const Ends> corners(std::size_t group) const {
        return {corners_.data() + begins_[group] / 2, corners_.data() + begins_[group + 1] / 2};
    }

  private:
    void sortCorners(const CornerGroups& corner_groups, double length);
    void findNeighbours();
    void findNeighbours(std::uint32_t group, const Ends* begin, const Ends* end, std::uint32_t* places, float* turns);

    const NormalsCall& call_;
    std::size_t count_;
    std::size_t most_corners_ = 0;  ///< of any group
    Buffer<float> positions_, normals_, variances_;
    Buffer<Ends> corners_;
    Buffer<std::uint32_t> begins_, counts_, neighbours_;  ///< room for two neighbours per corner
    mutable Buffer<std::uint32_t> marks_;                 ///< of each task
};

/// The groups around one, ring by ring. Bounded, so that a point with any number of neighbours takes no more time than
/// others: of each group at most kFan neighbours are looked at, evenly spread, and there are at most kMost in all.
class RingWalk {
  public:
    static constexpr std::size_t kMost = 256, kFan = 32;

    /// marks: those of NormalGroups::forSome.
    RingWalk(const NormalGroups& groups, std::uint32_t* marks, std::uint32_t centre)
        : groups_(groups), marks_(marks), centre_(centre) {
        add(centre);
    }

    /// Adds the next ring. False if there are too many; then the last ring is not all here.
    bool grow();

    [[nodiscard]] std::size_t size() const { return size_; }
    /// Ring after ring, from the centre on. Three places behind them are anyone's.
    [[nodiscard]] std::uint32_t* list() { return list_; }

  private:
    /// Without a branch, which no CPU would foresee. There is room for one.
    void add(std::uint32_t group) {
        list_[size_] = group;
        size_ += marks_[group] != centre_ ? 1 : 0;
        marks_[group] = centre_;
    }

    const NormalGroups& groups_;
    std::uint32_t* marks_;
    std::uint32_t centre_;
    std::size_t size_ = 0, ring_ = 0;
    std::uint32_t list_[kMost + kFan + 1];
};

}  // namespace tspace
