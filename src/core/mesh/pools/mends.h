// SPDX-License-Identifier: MIT
// Repair: at which vertices of a primitive tangents are mended, and how much of them.
#pragma once

#include <cstdint>
#include <vector>

namespace tspace {

/// What is mended at a vertex. Bits.
namespace mend {
inline constexpr std::uint8_t kValues = 1;  ///< what no tangent may be: not finite, not unit, along N, w not +1 or -1
inline constexpr std::uint8_t kStraighten = 2;  ///< made perpendicular to N; its direction in the surface stays
inline constexpr std::uint8_t kTurnSign = 4;    ///< w is negated
inline constexpr std::uint8_t kSides = 8;   ///< anew at those corners whose triangle needs the other sign, or direction
inline constexpr std::uint8_t kWhole = 16;  ///< anew at all its corners
inline constexpr std::uint8_t kDeltas = 32;  ///< anew is what morph targets add to it
}  // namespace mend

struct VertexMend {
    std::uint32_t vertex = 0;  ///< of the pool
    std::uint8_t parts = 0;    ///< bits of namespace mend, not 0

    friend bool operator==(const VertexMend&, const VertexMend&) = default;
};

/// What one primitive is mended of. Values are mended at every vertex of the pool, named or not.
struct Mends {
    std::vector<VertexMend> vertices = {};  ///< ascending
    /// Its signs stay inverted, and what is computed anew gets such signs too.
    bool inverted_signs = false;

    friend bool operator==(const Mends&, const Mends&) = default;
};

}  // namespace tspace
