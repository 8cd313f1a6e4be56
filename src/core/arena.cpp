// SPDX-License-Identifier: MIT
// An arena is a list of regions; each is one reserved piece of address space that memory is put behind from its begin,
// as it is needed.
#include "tspace/arena.h"

#include <algorithm>
#include <cstdint>
#include <list>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/mman.h>
#define TSPACE_HAS_MMAP 1
#endif

#include "core/memory.h"

namespace tspace {

namespace {

/// Sizes are multiples of this, so that every place is aligned.
constexpr std::size_t kUnit = kMemoryAlignment;
/// Memory is put behind a region in steps of this.
constexpr std::size_t kStep = kHugePage;

std::size_t roundUp(std::size_t value, std::size_t unit) { return (value + unit - 1) / unit * unit; }

#ifdef TSPACE_HAS_MMAP

/// More than the largest mesh needs, and nothing compared with the addresses that a process has.
constexpr std::size_t kReserved = sizeof(void*) < 8 ? std::size_t{1} << 28 : std::size_t{1} << 36;
/// Where addresses are limited, several small regions leave some to others.
constexpr std::size_t kReservedWhereLimited = std::size_t{1} << 26;

/// Address space without memory behind it; null when there is none. `bytes` comes back larger where that works.
std::byte* reserveSpace(std::size_t& bytes) {
    for (const std::size_t size : {kReserved, kReservedWhereLimited}) {
        const std::size_t wanted = std::max(size, bytes);
        void* space = mmap(nullptr, wanted + kStep, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (space == MAP_FAILED) continue;
        bytes = wanted;
        return static_cast<std::byte*>(space);
    }
    return nullptr;
}
bool putMemoryBehind(std::byte* begin, std::size_t bytes) {
    if (mprotect(begin, bytes, PROT_READ | PROT_WRITE) != 0) return false;
    askForPages(begin, bytes);
    return true;
}
/// The address space stays reserved. A new mapping over it also gives its share of the system's limit back.
bool takeMemoryAway(std::byte* begin, std::size_t bytes) {
    return mmap(begin, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) != MAP_FAILED;
}
void endSpace(std::byte* space, std::size_t bytes) { munmap(space, bytes + kStep); }

#else

// Without address space that can be reserved, a region has all of its memory from the start.
std::byte* reserveSpace(std::size_t& bytes) {
    bytes = roundUp(bytes, kStep);
    return static_cast<std::byte*>(::operator new(bytes + kStep, std::align_val_t(kUnit), std::nothrow));
}
bool putMemoryBehind(std::byte*, std::size_t) { return true; }
bool takeMemoryAway(std::byte*, std::size_t) { return false; }
void endSpace(std::byte* space, std::size_t) { ::operator delete(space, std::align_val_t(kUnit)); }

#endif

/// Which parts of a line of bytes are free. The line has no end: behind the last allocation all is free.
/// Allocations take the smallest hole that fits, the first one of several, else the place behind everything. So the
/// same calls on an empty line end in the same places.
class FreeRanges {
  public:
    struct Place {
        std::size_t begin = 0;
        bool is_last = false;  ///< behind everything
    };

    /// Where `bytes` fit. Never fails; commits nothing.
    [[nodiscard]] Place find(std::size_t bytes) const {
        const Hole* best = nullptr;
        for (const Hole& hole : holes_) {
            if (hole.bytes >= bytes && (best == nullptr || hole.bytes < best->bytes)) best = &hole;
        }
        return best != nullptr ? Place{best->begin, false} : Place{end_, true};
    }

    /// Takes `bytes` at a place that find() gave.
    void take(const Place& place, std::size_t bytes) {
        // Each hole lies before an allocation, so this is all the room that release() can need, with the one that it adds.
        holes_.reserve(live_ + 2);
        ++live_;
        if (place.is_last) {
            end_ += bytes;
            return;
        }
        const auto hole = at(place.begin);
        if (hole->bytes == bytes) {
            holes_.erase(hole);
        } else {
            hole->begin += bytes;
            hole->bytes -= bytes;
        }
    }

    void release(std::size_t begin, std::size_t bytes) noexcept {
        --live_;
        auto hole = holes_.insert(at(begin), {begin, bytes});
        if (hole + 1 != holes_.end() && (hole + 1)->begin == begin + bytes) {
            hole->bytes += (hole + 1)->bytes;
            holes_.erase(hole + 1);
        }
        if (hole != holes_.begin() && (hole - 1)->begin + (hole - 1)->bytes == begin) {
            (hole - 1)->bytes += hole->bytes;
            holes_.erase(hole);
        }
        if (!holes_.empty() && holes_.back().begin + holes_.back().bytes == end_) {
            end_ = holes_.back().begin;
            holes_.pop_back();
        }
    }

    /// Behind the last allocation.
    [[nodiscard]] std::size_t end() const { return end_; }

  private:
    struct Hole {
        std::size_t begin = 0, bytes = 0;
    };

    /// The first hole at or behind `begin`.
    std::vector<Hole>::iterator at(std::size_t begin) {
        return std::lower_bound(holes_.begin(), holes_.end(), begin,
                                [](const Hole& hole, std::size_t value) { return hole.begin < value; });
    }

    std::vector<Hole> holes_;  ///< in order; no two touch, and none touches the end
    std::size_t end_ = 0;
    std::size_t live_ = 0;
};

class Region {
  public:
    /// Room for `least_bytes` or more; for nothing when the system has none.
    explicit Region(std::size_t least_bytes)
        : space_bytes_(roundUp(least_bytes, kStep)), space_(reserveSpace(space_bytes_)) {
        // Huge pages lie at multiples of their size.
        begin_ = space_ + -reinterpret_cast<std::uintptr_t>(space_) % kStep;
    }
    Region(const Region&) = delete;
    Region& operator=(const Region&) = delete;
    ~Region() {
        if (space_ != nullptr) endSpace(space_, space_bytes_);
    }

    [[nodiscard]] bool contains(const void* memory) const { return memory >= begin_ && memory < begin_ + space_bytes_; }
    [[nodiscard]] std::size_t heldBytes() const { return held_; }

    /// Null when the region is full, or the system out of memory.
    void* allocate(std::size_t bytes) {
        const FreeRanges::Place place = ranges_.find(bytes);
        if (space_ == nullptr || bytes > space_bytes_ || place.begin > space_bytes_ - bytes) return nullptr;
        const std::size_t needed = roundUp(place.begin + bytes, kStep);
        if (needed > held_) {
            if (!putMemoryBehind(begin_ + held_, needed - held_)) return nullptr;
            held_ = needed;
        }
        ranges_.take(place, bytes);
        return begin_ + place.begin;
    }

    void release(void* memory, std::size_t bytes) noexcept {
        ranges_.release(static_cast<std::size_t>(static_cast<std::byte*>(memory) - begin_), bytes);
    }

    void trim() {
        const std::size_t needed = roundUp(ranges_.end(), kStep);
        if (needed < held_ && takeMemoryAway(begin_ + needed, held_ - needed)) held_ = needed;
    }
    [[nodiscard]] bool isEmpty() const { return ranges_.end() == 0; }

  private:
    std::size_t space_bytes_;
    std::byte* space_;
    std::byte* begin_ = nullptr;
    std::size_t held_ = 0;
    FreeRanges ranges_;
};

}  // namespace

class Arena::Impl {
  public:
    void* allocate(std::size_t bytes) noexcept {
        if (bytes > SIZE_MAX - 2 * kStep) return nullptr;
        try {
            bytes = roundUp(bytes, kUnit);
            for (Region& region : regions_) {
                if (void* memory = region.allocate(bytes)) return use(memory, bytes);
            }
            void* memory = regions_.emplace_back(bytes).allocate(bytes);
            if (memory == nullptr) {
                regions_.pop_back();
                return nullptr;
            }
            return use(memory, bytes);
        } catch (...) {
            return nullptr;  // for the lists of free ranges
        }
    }

    void release(void* memory, std::size_t bytes) noexcept {
        bytes = roundUp(bytes, kUnit);
        const auto region = std::find_if(regions_.begin(), regions_.end(),
                                         [memory](const Region& candidate) { return candidate.contains(memory); });
        region->release(memory, bytes);
        used_ -= bytes;
    }

    void trim() {
        regions_.remove_if([](const Region& region) { return region.isEmpty(); });
        for (Region& region : regions_) region.trim();
    }

    [[nodiscard]] std::size_t heldBytes() const {
        std::size_t sum = 0;
        for (const Region& region : regions_) sum += region.heldBytes();
        return sum;
    }
    [[nodiscard]] std::size_t usedBytes() const { return used_; }

  private:
    void* use(void* memory, std::size_t bytes) {
        used_ += bytes;
        return memory;
    }

    std::list<Region> regions_;  ///< one, but where the system limits addresses
    std::size_t used_ = 0;
};

Arena::Arena()
    : impl_(new Impl),
      allocator_{.allocate = [](void* user, std::size_t bytes,
                                std::size_t) { return static_cast<Impl*>(user)->allocate(bytes); },
                 .release = [](void* user, void* memory, std::size_t bytes,
                               std::size_t) { static_cast<Impl*>(user)->release(memory, bytes); },
                 .user = impl_} {}

Arena::~Arena() { delete impl_; }

std::size_t Arena::heldBytes() const { return impl_->heldBytes(); }
std::size_t Arena::usedBytes() const { return impl_->usedBytes(); }
void Arena::trim() { impl_->trim(); }

}  // namespace tspace
