// SPDX-License-Identifier: MIT
// An arena is a reserved range of address space. Memory is committed from its start as needed, and divided into blocks.
// Allocations that do not fit come from operator new.
#include "tspace/execution.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/mman.h>
#endif

#include "core/base/border.h"
#include "core/base/memory.h"

#ifdef _WIN32
// These functions are declared here, because the system header defines common words as macros, and the core may be
// compiled as one file.
extern "C" __declspec(dllimport) void* __stdcall VirtualAlloc(void*, std::size_t, unsigned long, unsigned long);
extern "C" __declspec(dllimport) int __stdcall VirtualFree(void*, std::size_t, unsigned long);
#endif

namespace tspace {
namespace {

/// Granularity of allocations: sizes are rounded up to multiples of it, so that every block is aligned.
constexpr std::size_t kUnit = kMemoryAlignment;
/// Granularity in which memory is committed.
constexpr std::size_t kStep = kHugePage;
/// Reserved address space, in bytes: more than the largest mesh needs, but a small part of the address space of a
/// process.
constexpr std::size_t kReserved = sizeof(void*) < 8 ? std::size_t{1} << 28 : std::size_t{1} << 36;

/// Minimum reservation, in bytes. A smaller one may contain no aligned step; all memory then comes from operator new.
constexpr std::size_t kLeastReserved = 2 * kStep;

std::size_t roundUp(std::size_t value, std::size_t unit) { return (value + unit - 1) / unit * unit; }

#ifdef _WIN32

std::byte* reserveSpace(std::size_t bytes) {
    constexpr unsigned long kReserve = 0x2000, kNoAccess = 0x01;
    return static_cast<std::byte*>(VirtualAlloc(nullptr, bytes, kReserve, kNoAccess));
}
bool commitMemory(std::byte* begin, std::size_t bytes) {
    constexpr unsigned long kCommit = 0x1000, kReadWrite = 0x04;
    return VirtualAlloc(begin, bytes, kCommit, kReadWrite) != nullptr;
}
bool decommitMemory(std::byte* begin, std::size_t bytes) { return VirtualFree(begin, bytes, 0x4000) != 0; }
void releaseSpace(std::byte* space, std::size_t) { VirtualFree(space, 0, 0x8000); }

#elif defined(__unix__) || defined(__APPLE__)

std::byte* reserveSpace(std::size_t bytes) {
    void* space = mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return space != MAP_FAILED ? static_cast<std::byte*>(space) : nullptr;
}
bool commitMemory(std::byte* begin, std::size_t bytes) {
    if (mprotect(begin, bytes, PROT_READ | PROT_WRITE) != 0) return false;
    populatePages(begin, bytes);
    return true;
}
/// Decommits memory; the address space stays reserved. A new mapping also releases its share of the system's commit
/// limit.
bool decommitMemory(std::byte* begin, std::size_t bytes) {
    return mmap(begin, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) != MAP_FAILED;
}
void releaseSpace(std::byte* space, std::size_t bytes) { munmap(space, bytes); }

#else  // all memory comes from operator new

std::byte* reserveSpace(std::size_t) { return nullptr; }
bool commitMemory(std::byte*, std::size_t) { return false; }
bool decommitMemory(std::byte*, std::size_t) { return false; }
void releaseSpace(std::byte*, std::size_t) {}

#endif

}  // namespace

class Arena::Impl {
  public:
    Impl() {
        // Where address space is limited (ulimit -v), reserves a quarter of the available space, and no more.
        std::size_t bytes = kReserved;
        std::byte* space = nullptr;
        while (bytes >= kLeastReserved && (space = reserveSpace(bytes)) == nullptr) bytes /= 4;
        if (space != nullptr && bytes < kReserved) {
            releaseSpace(space, bytes);
            bytes /= 4;
            space = bytes >= kLeastReserved ? reserveSpace(bytes) : nullptr;
        }
        if (space == nullptr) return;
        space_ = space;
        space_bytes_ = bytes;
        // Skips to the first aligned step, because huge pages are aligned to their size.
        const std::size_t skipped = -reinterpret_cast<std::uintptr_t>(space) % kStep;
        begin_ = space + skipped;
        room_ = (bytes - skipped) / kStep * kStep;
        assert(skipped + room_ <= space_bytes_);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() {
        if (space_ != nullptr) releaseSpace(space_, space_bytes_);
    }

    void* allocate(std::size_t bytes) noexcept {
        if (bytes > SIZE_MAX - 2 * kStep) return nullptr;
        bytes = roundUp(bytes, kUnit);
        void* memory = takeBlock(bytes);
        if (memory == nullptr) {
            memory = ::operator new(bytes, std::align_val_t(kUnit), std::nothrow);
            if (memory == nullptr) return nullptr;
            elsewhere_ += bytes;
        }
        used_ += bytes;
        return memory;
    }

    void release(void* memory, std::size_t bytes) noexcept {
        bytes = roundUp(bytes, kUnit);
        used_ -= bytes;
        const std::size_t place = reinterpret_cast<std::uintptr_t>(memory) - reinterpret_cast<std::uintptr_t>(begin_);
        if (place < held_) return endBlock(place);
        elsewhere_ -= bytes;
        ::operator delete(memory, std::align_val_t(kUnit));
    }

    void trim() {
        const std::size_t needed = roundUp(end(), kStep);
        if (needed < held_ && decommitMemory(begin_ + needed, held_ - needed)) held_ = needed;
    }

    [[nodiscard]] std::size_t heldBytes() const { return held_ + elsewhere_; }
    [[nodiscard]] std::size_t usedBytes() const { return used_; }

  private:
    struct Block {
        std::size_t begin, bytes;
        bool is_free;
    };

    /// Returns the first of the smallest free blocks that fit, otherwise the space after all blocks: the same calls on
    /// an empty arena return the same addresses. Null if there is no room.
    void* takeBlock(std::size_t bytes) noexcept {
        return withMemory([&]() -> std::byte* {
            auto best = blocks_.end();
            for (auto block = blocks_.begin(); block != blocks_.end(); ++block) {
                if (block->is_free && block->bytes >= bytes && (best == blocks_.end() || block->bytes < best->bytes))
                    best = block;
            }
            if (best == blocks_.end()) {
                if (!commitUpTo(end(), bytes)) return nullptr;
                blocks_.push_back({end(), bytes, false});
                return begin_ + blocks_.back().begin;
            }
            if (best->bytes > bytes) {
                best = blocks_.insert(best, *best);
                best[1].begin += bytes;
                best[1].bytes -= bytes;
            }
            *best = {best->begin, bytes, false};
            return begin_ + best->begin;
        });
    }

    void endBlock(std::size_t begin) noexcept {
        auto block = std::lower_bound(blocks_.begin(), blocks_.end(), begin,
                                      [](const Block& b, std::size_t place) { return b.begin < place; });
        block->is_free = true;
        if (block + 1 != blocks_.end() && block[1].is_free) joinWithNext(block);
        if (block != blocks_.begin() && block[-1].is_free) joinWithNext(block - 1);
        if (blocks_.back().is_free) blocks_.pop_back();
    }
    void joinWithNext(std::vector<Block>::iterator block) noexcept {
        block->bytes += block[1].bytes;
        blocks_.erase(block + 1);
    }

    /// Returns the offset of the end of the last block in use.
    [[nodiscard]] std::size_t end() const { return blocks_.empty() ? 0 : blocks_.back().begin + blocks_.back().bytes; }

    bool commitUpTo(std::size_t begin, std::size_t bytes) {
        if (bytes > room_ - begin) return false;
        const std::size_t needed = roundUp(begin + bytes, kStep);  // room_ is a multiple of kStep
        assert(held_ <= room_ && needed <= room_);
        if (needed > held_ && !commitMemory(begin_ + held_, needed - held_)) return false;
        held_ = std::max(held_, needed);
        return true;
    }

    std::byte *space_ = nullptr, *begin_ = nullptr;
    std::size_t space_bytes_ = 0, room_ = 0;  ///< reserved bytes, and how many of them are usable
    std::size_t held_ = 0, elsewhere_ = 0, used_ = 0;
    std::vector<Block> blocks_;  ///< consecutive blocks up to the last one in use; free blocks are never adjacent
};

Arena::Arena() : impl_(new Impl) {
    allocator_ = {.allocate = [](void* user, std::size_t bytes,
                                 std::size_t) { return static_cast<Impl*>(user)->allocate(bytes); },
                  .release = [](void* user, void* memory, std::size_t bytes,
                                std::size_t) { static_cast<Impl*>(user)->release(memory, bytes); },
                  .user = impl_};
}

Arena::~Arena() { delete impl_; }

std::size_t Arena::heldBytes() const { return impl_->heldBytes(); }
std::size_t Arena::usedBytes() const { return impl_->usedBytes(); }
void Arena::trim() { impl_->trim(); }

}  // namespace tspace
