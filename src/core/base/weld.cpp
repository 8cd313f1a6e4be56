// SPDX-License-Identifier: MIT
// Welding by hashes, in three steps. Most vertices of an indexed mesh equal no other vertex. Step 1 counts hashes in a
// small table by their upper bits (0, 1, or more); only vertices whose counter is 2 are looked up, or all vertices if
// most have duplicates. Step 2 finds the first vertex with the same hash for each. Step 3 compares the data of both, in
// memory order; the few that differ are sorted by their data.
//
// Threads share no data: each counts its own vertices, and looks up the vertices of its own range of hashes.
#include "core/base/weld.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>

#include "core/base/sort.h"
#include "tspace/span.h"

namespace tspace {
namespace {

constexpr std::size_t kPrefetchAhead = 32;  // lookups in flight, whose data must fit into the L1 cache

constexpr std::size_t kGrain = 16384;  // vertices per task: for fewer, starting threads costs more than it saves

/// Finds the few vertices that may have duplicates, without accessing most vertices: counts the occurrences of the
/// hashes' upper bits as 0, 1, or more. Two bits per counter: bit 0 means at least once, bit 1 more than once.
class RepeatedHashes {
  public:
    static constexpr unsigned kMostRanges = 4;  ///< vertex ranges counted at the same time, each in its own table

    /// Returns the number of vertex ranges to count separately: at most one per thread and kMostRanges, with at least
    /// kGrain vertices each.
    static std::size_t rangesFor(std::size_t vertex_count, const Parallel& parallel) {
        return std::clamp<std::size_t>(vertex_count / kGrain, 1, std::min(parallel.width(), kMostRanges));
    }

    RepeatedHashes(const Allocator* allocator, std::size_t vertex_count, std::size_t ranges)
        : log2_(static_cast<unsigned>(std::clamp<std::size_t>(std::bit_width(kPlacesPerVertex * vertex_count), 6, 32))),
          words_((std::size_t{1} << log2_) / kPlacesPerWord), ranges_(ranges),
          table_(allocator, words_ * ranges, std::uint64_t{0}) {}

    void add(std::size_t range, const std::uint32_t* hashes, std::size_t count) {
        auto* table = reinterpret_cast<std::uint8_t*>(table_.data() + range * words_);
        const unsigned shift = 32 - log2_;  // local copy: the bytes that are written might alias the member
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t place = hashes[i] >> shift;
            std::uint8_t& byte = table[place / kPlacesPerByte];
            const unsigned once = 1u << 2 * (place % kPlacesPerByte), now = byte;
            byte = static_cast<std::uint8_t>(now | (now & once) << 1 | once);
        }
    }

    /// Sums all ranges into the first one. Returns the number of counters in use.
    std::size_t sum(Parallel& parallel) {
        return sumRanges(parallel, words_, kGrain, [&](std::size_t begin, std::size_t end) {
            constexpr std::uint64_t kOnce = 0x5555555555555555u;
            std::uint64_t taken = 0;
            for (std::size_t i = begin; i < end; ++i) {
                std::uint64_t total = table_[i];
                for (std::size_t other = i + words_; other < table_.size(); other += words_)
                    total |= table_[other] | (total & table_[other] & kOnce) << 1;
                table_[i] = total;
                taken += pairsSet(total & kOnce);
            }
            return taken;
        });
    }

    /// Writes the vertices in [0, count) whose hash may occur twice to `list`, ascending, and returns their number.
    /// `list` has room for all.
    std::size_t collect(const std::uint32_t* hashes, std::size_t count, std::uint32_t* list, Parallel& parallel) const {
        const auto* table = reinterpret_cast<const std::uint8_t*>(table_.data());
        std::size_t found[kMostRanges] = {};
        parallel.forTasks(ranges_, [&](std::size_t range) {
            const std::size_t begin = count * range / ranges_, end = count * (range + 1) / ranges_;
            const unsigned shift = 32 - log2_;
            std::uint32_t* const mine = list + begin;
            std::size_t n = 0;  // mine[n] is always written, but kept only if n is then incremented
            for (std::size_t v = begin; v < end; ++v) {
                const std::uint32_t place = hashes[v] >> shift;
                mine[n] = static_cast<std::uint32_t>(v);
                n += table[place / kPlacesPerByte] >> (2 * (place % kPlacesPerByte) + 1) & 1u;
            }
            found[range] = n;
        });
        std::size_t total = found[0];
        for (std::size_t range = 1; range < ranges_; ++range) {
            std::copy_n(list + count * range / ranges_, found[range], list + total);
            total += found[range];
        }
        return total;
    }

  private:
    /// With n counters per vertex, at most 1 of n + 1 vertices is found without having a duplicate. With four, 1 of 5
    /// vertices is looked up, in a table that stays in the cache.
    static constexpr std::size_t kPlacesPerVertex = 4;
    static constexpr std::size_t kPlacesPerByte = 4, kPlacesPerWord = 32;

    /// Counts the set bits among the bits 0, 2, 4, ... (std::popcount is a function call on baseline x86-64.)
    static std::uint64_t pairsSet(std::uint64_t x) {
        x = (x & 0x3333333333333333u) + (x >> 2 & 0x3333333333333333u);
        x = (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0fu;
        return (x * 0x0101010101010101u) >> 56;
    }

    unsigned log2_;
    std::size_t words_, ranges_;  ///< words per range, and number of ranges
    Buffer<std::uint64_t> table_;
};

class Welder {
  public:
    Welder(Weldable& vertices, std::size_t count, const Allocator* allocator, const Allocator* transient,
           Parallel& parallel)
        : vertices_(vertices), count_(count), allocator_(allocator), transient_(transient), parallel_(parallel),
          hashes_(transient, count) {}

    Buffer<std::uint32_t> run(bool is_indexed) {
        std::size_t distinct = count_;
        parallel_.forRanges(count_, kGrain,
                            [&](std::size_t begin, std::size_t end) { vertices_.hash(begin, end, hashes_.data()); });
        if (count_ >= kFew) distinct = is_indexed ? listCandidates() : estimateDistinct();
        entry_count_ = list_.empty() ? count_ : distinct;
        roots_ = Buffer<std::uint32_t>(list_.empty() ? allocator_ : transient_, entry_count_);
        std::uint64_t different = 1;
        if (count_ < kFew ? matchFew() : matchHashes(distinct)) {
            different = sumRanges(parallel_, entry_count_, kGrain, [&](std::size_t begin, std::size_t end) {
                return vertices_.compare(list_.data(), begin, end, roots_.data()) ? 1u : 0u;
            });
        } else {
            std::fill_n(roots_.data(), entry_count_, Weldable::kNoRoot);
        }
        if (different != 0) matchBySorting();
        return list_.empty() ? std::move(roots_) : rootOfEach();
    }

  private:
    static constexpr std::size_t kFew = 4096;  // up to this number of vertices, all are looked up

    struct Slot {
        std::uint32_t hash = 0, vertex = Weldable::kNoRoot;
    };
    struct Item {
        std::uint32_t hash, vertex;
        std::size_t index;
    };

    [[nodiscard]] std::uint32_t vertexOf(std::size_t i) const {
        return list_.empty() ? static_cast<std::uint32_t>(i) : list_[i];
    }

    /// Lists vertices that may have duplicates, unless most do. Returns the number of listed vertices, or an estimate
    /// of the number of different vertices.
    std::size_t listCandidates() {
        const std::size_t ranges = RepeatedHashes::rangesFor(count_, parallel_);
        RepeatedHashes counting(transient_, count_, ranges);
        parallel_.forTasks(ranges, [&](std::size_t range) {
            const std::size_t begin = count_ * range / ranges, end = count_ * (range + 1) / ranges;
            counting.add(range, hashes_.data() + begin, end - begin);
        });
        const std::size_t distinct = counting.sum(parallel_);
        if (distinct < count_ - count_ / 4) return distinct;
        list_ = Buffer<std::uint32_t>(transient_, count_);
        return counting.collect(hashes_.data(), count_, list_.data(), parallel_);
    }

    /// Estimates the number of different vertices from a sample of the hashes, selected by value, so that equal
    /// vertices are either all in it or none.
    std::size_t estimateDistinct() {
        constexpr std::uint32_t kShare = 32;
        RepeatedHashes counting(transient_, count_ / kShare, 1);
        for (std::size_t v = 0; v < count_; ++v) {
            if (hashes_[v] % kShare == 0) counting.add(0, hashes_.data() + v, 1);
        }
        return std::min(count_, kShare * counting.sum(parallel_));
    }

    /// Finds the roots of few vertices, using only hashes: the table fits into the L1 cache.
    bool matchFew() {
        Buffer<std::uint32_t> table(transient_, std::bit_ceil(2 * count_), Weldable::kNoRoot);
        for (std::uint32_t v = 0, mask = static_cast<std::uint32_t>(table.size() - 1); v < count_; ++v) {
            std::uint32_t at = hashes_[v] & mask;
            while (table[at] != Weldable::kNoRoot && hashes_[table[at]] != hashes_[v]) at = (at + 1) & mask;
            if (table[at] == Weldable::kNoRoot) table[at] = v;
            roots_[v] = table[at];
        }
        return true;
    }

    /// Finds the roots of many vertices, using only hashes: each task has the vertices of one range of hashes and a
    /// part of the table. Returns false if hashes collide more often than by chance.
    bool matchHashes(std::size_t distinct) {
        const std::size_t tasks =
            entry_count_ < 2 * kGrain
                ? 1
                : std::min<std::size_t>(parallel_.width(), std::size_t{2} * RepeatedHashes::kMostRanges);
        // The table grows if the estimate `distinct` was too low.
        for (std::size_t slots = std::bit_ceil(2 * distinct / tasks + 2 * kPrefetchAhead);; slots *= 4) {
            Buffer<Slot> table(transient_, tasks * slots);
            std::atomic<std::size_t> done{0};
            parallel_.forTasks(tasks, [&](std::size_t task) {
                Slot* part = table.data() + task * slots;
                std::fill_n(part, slots, Slot{});
                if (matchRange(task, tasks, part, slots)) ++done;
            });
            if (done == tasks) return true;
            if (slots > 2 * entry_count_) return false;
        }
    }

    /// Finds the roots of one range of hashes. Returns false if the table is too small, or its probe sequences are too
    /// long.
    bool matchRange(std::size_t task, std::size_t tasks, Slot* table, std::size_t slots) {
        const std::size_t mask = slots - 1;
        std::size_t room = slots - slots / 4, steps = 16 * entry_count_ + 1024;
        Item items[kPrefetchAhead];
        for (std::size_t begin = 0; begin < entry_count_; begin += kPrefetchAhead) {
            const std::size_t end = std::min(begin + kPrefetchAhead, entry_count_);
            std::size_t count = 0;
            for (std::size_t i = begin; i < end; ++i) {
                const std::uint32_t vertex = vertexOf(i), hash = hashes_[vertex];
                items[count] = {hash, vertex, i};
                count += (std::uint64_t{hash} * tasks) >> 32 == task ? 1 : 0;
            }
            if (room < count) return false;
            for (std::size_t i = 0; i < count; ++i) __builtin_prefetch(&table[items[i].hash & mask]);
            for (std::size_t i = 0; i < count; ++i) {
                const Item& item = items[i];
                std::size_t at = item.hash & mask;
                for (; table[at].vertex != Weldable::kNoRoot && table[at].hash != item.hash; at = (at + 1) & mask) {
                    if (--steps == 0) return false;
                }
                if (table[at].vertex == Weldable::kNoRoot) {
                    table[at] = {item.hash, item.vertex};
                    --room;
                }
                roots_[item.index] = table[at].vertex;
            }
        }
        return true;
    }

    /// Finds the roots of vertices that share their hash with different vertices, by sorting. A vertex that does not
    /// equal its predecessor in the order becomes its own root.
    [[gnu::cold]] void matchBySorting() {
        std::uint32_t* const roots = roots_.data();
        Buffer<std::uint32_t> rest(
            transient_, static_cast<std::size_t>(std::count(roots, roots + entry_count_, Weldable::kNoRoot)));
        for (std::size_t i = 0, n = 0; i < entry_count_; ++i) {
            if (roots[i] == Weldable::kNoRoot) rest[n++] = static_cast<std::uint32_t>(i);
        }
        sortList(rest.begin(), rest.end(), [&](std::uint32_t a, std::uint32_t b) { return isBefore(a, b); });
        for (std::size_t n = 0; n < rest.size(); ++n) {
            const std::size_t i = rest[n];
            roots[i] = n == 0 ? vertexOf(i) : roots[rest[n - 1]];
            if (vertices_.compare(list_.data(), i, i + 1, roots)) roots[i] = vertexOf(i);
        }
    }

    [[nodiscard]] Buffer<std::uint32_t> rootOfEach() const {
        Buffer<std::uint32_t> root_of;
        for (std::size_t i = 0; i < entry_count_; ++i) {
            if (roots_[i] == list_[i]) continue;
            if (root_of.empty()) {
                root_of = Buffer<std::uint32_t>(allocator_, count_);
                for (std::size_t v = 0; v < count_; ++v) root_of[v] = static_cast<std::uint32_t>(v);
            }
            root_of[list_[i]] = roots_[i];
        }
        return root_of;
    }

    /// Never inlined: a sort calls it in nine places.
    [[nodiscard, gnu::noinline]] bool isBefore(std::uint32_t a, std::uint32_t b) const {
        const int order = vertices_.order(vertexOf(a), vertexOf(b));
        return order != 0 ? order < 0 : a < b;
    }

    Weldable& vertices_;
    std::size_t count_, entry_count_ = 0;  // number of vertices, and number of vertices that are looked up
    const Allocator *allocator_, *transient_;
    Parallel& parallel_;
    Buffer<std::uint32_t> hashes_;
    Buffer<std::uint32_t> list_;   // vertices to weld, ascending; empty: all
    Buffer<std::uint32_t> roots_;  // roots of the vertices in list_
};

std::uint32_t bitsOf(float f) { return std::bit_cast<std::uint32_t>(f + 0.0f); }  // adding +0 converts -0 to +0

class Positions final : public Weldable {
  public:
    explicit Positions(StridedSpan<const Vec3> positions) : positions_(positions) {}

    /// Hashes positions so that every bit affects the high bits.
    void hash(std::size_t begin, std::size_t end, std::uint32_t* hashes) override {
        for (std::size_t v = begin; v < end; ++v) {
            const Vec3& p = positions_[v];
            const std::uint64_t xy = bitsOf(p.x) | std::uint64_t{bitsOf(p.y)} << 32;
            std::uint64_t h = (xy ^ bitsOf(p.z) * 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
            h = (h ^ h >> 32) * 0x94d049bb133111ebu;
            hashes[v] = static_cast<std::uint32_t>(h >> 32);
        }
    }
    bool compare(const std::uint32_t* list, std::size_t begin, std::size_t end, std::uint32_t* roots) override {
        bool different = false;
        for (std::size_t i = begin; i < end; ++i) {
            if (i + kPrefetchAhead < end) __builtin_prefetch(&positions_[roots[i + kPrefetchAhead]]);
            const std::size_t vertex = list == nullptr ? i : list[i];
            if (roots[i] == vertex || positions_[vertex] == positions_[roots[i]]) continue;
            roots[i] = kNoRoot;
            different = true;
        }
        return different;
    }
    [[nodiscard]] int order(std::uint32_t a, std::uint32_t b) const override {
        const Vec3 &p = positions_[a], &q = positions_[b];
        for (float Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
            const std::uint32_t here = bitsOf(p.*axis), there = bitsOf(q.*axis);
            if (here != there) return here < there ? -1 : 1;
        }
        return 0;
    }

  private:
    StridedSpan<const Vec3> positions_;
};

}  // namespace

Buffer<std::uint32_t> findRoots(Weldable& vertices, std::size_t count, bool is_indexed, const Allocator* allocator,
                                const Allocator* transient, Parallel& parallel) {
    return Welder(vertices, count, allocator, transient, parallel).run(is_indexed);
}

Buffer<std::uint32_t> weldPositions(const MeshView& mesh, const Allocator* allocator, Parallel& parallel) {
    Positions positions(mesh.positions);
    const bool is_indexed = mesh.indices.type != IndexType::none;
    return findRoots(positions, mesh.vertexCount(), is_indexed, allocator, allocator, parallel);
}

}  // namespace tspace
