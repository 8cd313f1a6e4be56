// SPDX-License-Identifier: MIT
// Repair: at which vertices of a primitive tangents are mended, and how much of them.
#pragma once

#include <cstdint>
#include <vector>

namespace tspace {

/// Parts of a vertex's frame to mend, as bits.
namespace mend {
inline constexpr std::uint8_t kValues =
    1;  ///< values that no tangent may have: not finite, not unit, along N, w not +1 or -1
inline constexpr std::uint8_t kStraighten = 2;  ///< made perpendicular to N; its direction in the surface stays
inline constexpr std::uint8_t kTurnSign = 4;    ///< w is negated
inline constexpr std::uint8_t kSides =
    8;  ///< computed anew at corners whose triangle needs the other sign, or direction
inline constexpr std::uint8_t kWhole = 16;   ///< computed anew at all its corners
inline constexpr std::uint8_t kDeltas = 32;  ///< offsets of morph targets are computed anew
}  // namespace mend

struct VertexMend {
    std::uint32_t vertex = 0;  ///< of the pool
    std::uint8_t parts = 0;    ///< bits of namespace mend, not 0

    friend bool operator==(const VertexMend&, const VertexMend&) = default;
};

/// The mends of one primitive. Values are mended at every vertex of the pool, listed or not.
struct Mends {
    std::vector<VertexMend> vertices = {};  ///< ascending
    /// Its signs stay inverted, and tangents that are computed anew get such signs too.
    bool inverted_signs = false;

    friend bool operator==(const Mends&, const Mends&) = default;
};

}  // namespace tspace
