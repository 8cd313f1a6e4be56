// SPDX-License-Identifier: MIT
// Disjoint sets of numbers that are joined one by one, in an array of parents: a root is its own parent.
// Based on: Tarjan & van Leeuwen, "Worst-case analysis of set union algorithms", 1984 (halving of paths).
#pragma once

#include <cstdint>

namespace tspace {

/// The root of a member's set. Each second parent on the way to it is skipped from then on.
inline std::uint32_t rootOf(std::uint32_t* parents, std::uint32_t member) {
    while (parents[member] != member) member = parents[member] = parents[parents[member]];
    return member;
}

/// Joins the sets of two members; false where they are one set already. The lower root stays: linking by order with halved
/// paths is O(log n) per step, needs no ranks, and every root is the lowest of its set.
inline bool joinSets(std::uint32_t* parents, std::uint32_t a, std::uint32_t b) {
    a = rootOf(parents, a);
    b = rootOf(parents, b);
    if (a == b) return false;
    if (a < b)
        parents[b] = a;
    else
        parents[a] = b;
    return true;
}

}  // namespace tspace
