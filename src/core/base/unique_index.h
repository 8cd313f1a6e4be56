// SPDX-License-Identifier: MIT
// Hashing for tables that are never iterated, so that their internal order cannot affect results.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "tspace/span.h"

namespace tspace {

/// Mixes every bit of the input into all bits of the result.
inline std::uint64_t mixBits(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// Adds a value to the hash of a sequence; the initial hash is arbitrary.
inline std::uint64_t foldHash(std::uint64_t hash, std::uint64_t value) {
    return mixBits((hash + 0x9e3779b97f4a7c15u) ^ value);
}

/// Returns the bits of a float, with both zeros equal, so that -0 and 0 are welded.
inline std::uint32_t weldBits(float value) { return std::bit_cast<std::uint32_t>(value == 0.0f ? 0.0f : value); }
inline std::uint64_t uvBits(const Vec2& uv) { return weldBits(uv.x) | std::uint64_t{weldBits(uv.y)} << 32; }

/// Returns equal hashes for positions that compare equal: -0 and +0 are the same number.
inline std::uint64_t hashPosition(const Vec3& p) { return foldHash(mixBits(uvBits({p.x, p.y})), weldBits(p.z)); }

// Hash table that numbers values in order of first occurrence, to find equal vertices, edges and materials.

/// Hash table with open addressing that is never iterated. Keys are compared by their bits, so they must not have
/// padding; they consist of whole 32-bit words. Expected constant time per key.
template <class Key>
class UniqueIndex {
    static_assert(std::is_trivially_copyable_v<Key> && sizeof(Key) % 4 == 0);

  public:
    explicit UniqueIndex(std::size_t expected_count = 0) {
        keys_.reserve(expected_count);
        slots_.assign(std::bit_ceil(expected_count * 2 + 16), kEmpty);
    }

    /// Returns the number of a key: the old size() if the key is new.
    std::uint32_t indexOf(const Key& key) {
        if ((keys_.size() + 1) * 2 > slots_.size()) grow();
        std::uint32_t& slot = slots_[findSlot(key)];
        if (slot == kEmpty) {
            slot = static_cast<std::uint32_t>(keys_.size());
            keys_.push_back(key);
        }
        return slot;
    }

    /// Returns the number of a key, or 0xffffffff if it is unknown.
    [[nodiscard]] std::uint32_t find(const Key& key) const { return slots_[findSlot(key)]; }

    [[nodiscard]] std::size_t size() const { return keys_.size(); }
    [[nodiscard]] const std::vector<Key>& keys() const { return keys_; }

  private:
    static constexpr std::uint32_t kEmpty = 0xffffffffu;

    static std::size_t hash(const Key& key) {
        std::uint32_t words[sizeof(Key) / 4];
        std::memcpy(words, &key, sizeof(Key));
        std::uint64_t state = 0;
        for (const std::uint32_t word : words) {
            // An odd multiplier close to 2^64 / golden ratio spreads each word over the upper half.
            state = (state ^ word) * 0x9e3779b97f4a7c15u;
            state ^= state >> 32;
        }
        return static_cast<std::size_t>(state);
    }

    std::size_t findSlot(const Key& key) const {
        std::size_t slot = hash(key) & (slots_.size() - 1);
        while (slots_[slot] != kEmpty && std::memcmp(&keys_[slots_[slot]], &key, sizeof(Key)) != 0)
            slot = (slot + 1) & (slots_.size() - 1);
        return slot;
    }

    void grow() {
        slots_.assign(slots_.size() * 2, kEmpty);
        for (std::size_t i = 0; i < keys_.size(); ++i) slots_[findSlot(keys_[i])] = static_cast<std::uint32_t>(i);
    }

    std::vector<Key> keys_ = {};
    std::vector<std::uint32_t> slots_ = {};
};

}  // namespace tspace
