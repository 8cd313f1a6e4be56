// SPDX-License-Identifier: MIT
// Welding by a hash table of vertices; and, for input that defeats the hash, by sorting. Few vertices of an indexed
// mesh share a position with another one: there only those are looked up whose hash occurs more than once.
#include "core/weld.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <compare>
#include <utility>

#include "core/repeated_hashes.h"
#include "core/sort.h"
#include "tspace/vec.h"

namespace tspace {

namespace {

constexpr std::uint32_t kFree = ~std::uint32_t{0};
constexpr std::size_t kBatch = 32;  ///< vertices whose places are fetched into the cache together
// In vertices. An estimate, from some 50 us for a thread to start; not yet measured on idle cores.
constexpr std::size_t kFew = 4096;           ///< vertices; so few are all looked up
constexpr std::size_t kHashBlock = 256;      ///< vertices; their hashes stay in the first cache
constexpr std::size_t kPlacesPerVertex = 4;  ///< of a counting table: leaves 1 vertex of 5 or fewer to be looked up

struct Key {
    std::uint32_t x, y, z;
    friend auto operator<=>(const Key&, const Key&) = default;
};

std::uint32_t bitsOf(float f) { return std::bit_cast<std::uint32_t>(f + 0.0f); }  // -0 as +0

Key keyOf(const Vec3& p) { return {bitsOf(p.x), bitsOf(p.y), bitsOf(p.z)}; }

bool hasNan(const Vec3& p) { return p.x != p.x || p.y != p.y || p.z != p.z; }

/// Good enough for meshes, and cheaper than hashPosition: every bit of the position reaches the high bits.
std::uint64_t hashOf(const Vec3& p) {
    const std::uint64_t xy = bitsOf(p.x) | std::uint64_t{bitsOf(p.y)} << 32;
    std::uint64_t h = (xy ^ bitsOf(p.z) * 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
    h = (h ^ h >> 32) * 0x94d049bb133111ebu;
    return h ^ h >> 29;
}

/// Linear probing over a power of two of places, cut into one part per task by the highest bits of the hash.
/// A place holds a vertex, and in the bits that vertices leave free some of its hash: so another vertex's
/// position is hardly ever read in vain. Vertices come in order, so the one that is found is the lowest.
class WeldTable {
  public:
    /// `candidates`: ascending vertices, which are looked up; null: all.
    WeldTable(StridedSpan<const Vec3> positions, const std::uint32_t* candidates, std::size_t count, unsigned part_bits,
              const Allocator* allocator)
        : positions_(positions),
          candidates_(candidates),
          count_(count),
          part_bits_(part_bits),
          vertex_mask_(static_cast<std::uint32_t>(std::bit_ceil(positions.count + 1) - 1)),
          places_(allocator, std::bit_ceil(std::max<std::size_t>(2 * count, 64)), kFree),
          part_mask_((places_.size() >> part_bits) - 1) {}

    /// False when the vertices of this part collide more than chance explains.
    bool weldPart(std::size_t part, std::uint32_t* lowest) {
        std::uint32_t* const places = places_.data() + part * (part_mask_ + 1);
        std::size_t steps = 16 * count_ + 1024;
        std::uint32_t entries[kBatch];
        std::uint32_t homes[kBatch];
        for (std::size_t first = 0; first < count_; first += kBatch) {
            const std::size_t end = std::min(first + kBatch, count_);
            std::size_t count = 0;
            for (std::size_t i = first; i < end; ++i) {
                const std::uint32_t v = candidates_ == nullptr ? static_cast<std::uint32_t>(i) : candidates_[i];
                const std::uint64_t hash = hashOf(positions_[v]);
                const auto mark = static_cast<std::uint32_t>(hash >> 26) & ~vertex_mask_;
                entries[count] = mark | v;
                homes[count] = static_cast<std::uint32_t>(hash & part_mask_);
                __builtin_prefetch(places + homes[count], 1);
                count += part_bits_ == 0 || hash >> (64 - part_bits_) == part ? 1 : 0;
            }
            for (std::size_t i = 0; i < count; ++i) {
                if (!insert(places, entries[i], homes[i], steps, lowest)) return false;
            }
        }
        return true;
    }

  private:
    bool insert(std::uint32_t* places, std::uint32_t entry, std::size_t place, std::size_t& steps,
                std::uint32_t* lowest) const {
        const std::uint32_t vertex = entry & vertex_mask_;
        const Vec3& here = positions_[vertex];
        lowest[vertex] = vertex;
        if (hasNan(here)) return true;
        for (; places[place] != kFree; place = (place + 1) & part_mask_) {
            const std::uint32_t other = places[place];
            if (((other ^ entry) & ~vertex_mask_) == 0 && positions_[other & vertex_mask_] == here) {
                lowest[vertex] = other & vertex_mask_;
                return true;
            }
            if (--steps == 0) return false;  // also the end of a part that is full
        }
        places[place] = entry;
        return true;
    }

    StridedSpan<const Vec3> positions_;
    const std::uint32_t* candidates_;
    std::size_t count_;
    unsigned part_bits_;
    std::uint32_t vertex_mask_;  ///< bits that hold a vertex; all of them are set in no vertex
    Buffer<std::uint32_t> places_;
    std::size_t part_mask_;
};

/// O(n log n) whatever the input.
void weldBySorting(StridedSpan<const Vec3> positions, const Allocator* allocator, std::uint32_t* lowest) {
    Buffer<std::uint32_t> order(allocator, positions.count);
    for (std::size_t v = 0; v < positions.count; ++v) order[v] = static_cast<std::uint32_t>(v);
    sortList(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const auto relation = keyOf(positions[a]) <=> keyOf(positions[b]);
        return relation != 0 ? relation < 0 : a < b;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::uint32_t v = order[i];
        const bool same = i > 0 && positions[v] == positions[order[i - 1]];
        lowest[v] = same ? lowest[order[i - 1]] : v;
    }
}

/// Vertices that may share a position with another one, ascending; their number in `count`. Writes its own number to
/// each vertex's place of `lowest`. Empty, and the count unchanged, when they would be too many.
Buffer<std::uint32_t> findCandidates(StridedSpan<const Vec3> positions, std::uint32_t* lowest, std::size_t& count,
                                     const Allocator* allocator, Parallel& parallel) {
    Buffer<std::uint32_t> hashes(allocator, positions.count);
    const std::size_t ranges = RepeatedHashes::rangesFor(positions.count, parallel);
    RepeatedHashes repeated(kPlacesPerVertex, allocator, positions.count, ranges);
    parallel.forTasks(ranges, [&](std::size_t range) {
        repeated.clear(range);
        const std::size_t end = positions.count * (range + 1) / ranges;
        for (std::size_t v = positions.count * range / ranges; v < end;) {
            const std::size_t first = v, stop = std::min(v + kHashBlock, end);
            for (; v < stop; ++v) {
                hashes[v] = static_cast<std::uint32_t>(hashOf(positions[v]) >> 32);
                lowest[v] = static_cast<std::uint32_t>(v);
            }
            repeated.add(range, hashes.data() + first, stop - first);
        }
    });
    if (repeated.sum(ranges, parallel) < positions.count - positions.count / 4) return {};
    count = repeated.collect(hashes.data(), positions.count, ranges, hashes.data(), parallel);
    return hashes;
}

/// Most candidates are there because a small table holds their hashes. Leaves those whose hash occurs more than once by
/// other bits as well, among so few; returns how many.
std::size_t lookAgain(StridedSpan<const Vec3> positions, std::uint32_t* candidates, std::size_t count,
                      const Allocator* allocator, Parallel& parallel) {
    Buffer<std::uint32_t> hashes(allocator, count);
    const std::size_t ranges = RepeatedHashes::rangesFor(count, parallel);
    RepeatedHashes repeated(2 * kPlacesPerVertex, allocator, count, ranges);
    parallel.forTasks(ranges, [&](std::size_t range) {
        repeated.clear(range);
        const std::size_t begin = count * range / ranges, end = count * (range + 1) / ranges;
        for (std::size_t i = begin; i < end; ++i)
            hashes[i] = static_cast<std::uint32_t>(hashOf(positions[candidates[i]]));
        repeated.add(range, hashes.data() + begin, end - begin);
    });
    if (ranges > 1) repeated.sum(ranges, parallel);
    const std::size_t left = repeated.collect(hashes.data(), count, ranges, hashes.data(), parallel);
    for (std::size_t i = 0; i < left; ++i) candidates[i] = candidates[hashes[i]];
    return left;
}

}  // namespace

Buffer<std::uint32_t> weldPositions(const MeshView& mesh, const Allocator* allocator, Parallel& parallel) {
    const StridedSpan<const Vec3> positions = mesh.positions;
    Buffer<std::uint32_t> lowest(allocator, positions.count), candidates;
    std::size_t count = positions.count;
    if (mesh.indices.type != IndexType::none && count >= kFew)
        candidates = findCandidates(positions, lowest.data(), count, allocator, parallel);
    if (!candidates.empty()) count = lookAgain(positions, candidates.data(), count, allocator, parallel);
    const bool shared = parallel.width() > 1 && count >= Parallel::kGrain;
    const unsigned part_bits = shared ? std::min(6u, static_cast<unsigned>(std::bit_width(parallel.width() - 1))) : 0;
    std::atomic<bool> crowded{false};
    {
        WeldTable table(positions, candidates.data(), count, part_bits, allocator);
        parallel.forTasks(std::size_t{1} << part_bits, [&](std::size_t part) {
            if (!table.weldPart(part, lowest.data())) crowded = true;
        });
    }
    if (crowded) weldBySorting(positions, allocator, lowest.data());
    const auto isRepeated = [&](std::uint32_t v) { return lowest[v] != v; };
    const bool none =
        !candidates.empty() && !crowded && std::none_of(candidates.begin(), candidates.begin() + count, isRepeated);
    return none ? Buffer<std::uint32_t>() : std::move(lowest);
}

}  // namespace tspace
