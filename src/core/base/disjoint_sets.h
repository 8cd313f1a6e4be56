// SPDX-License-Identifier: MIT
// Disjoint sets of numbers (union-find), in an array of parents: a root is its own parent. Based on: Tarjan & van
// Leeuwen, "Worst-case analysis of set union algorithms", 1984 (path halving).
#pragma once

#include <cstdint>

namespace tspace {

// Both functions are always inlined: with calls, computing normals with a crease angle took 6.5 % more instructions.

/// Returns the root of a member's set, and halves the path to it.
[[gnu::always_inline]] inline std::uint32_t rootOf(std::uint32_t* parents, std::uint32_t member) {
    while (parents[member] != member) member = parents[member] = parents[parents[member]];
    return member;
}

/// Joins the sets of two members; returns false if they are in the same set already. The lower root remains: linking by
/// order with path halving is O(log n) per step, needs no ranks, and every root is the lowest member of its set.
[[gnu::always_inline]] inline bool joinSets(std::uint32_t* parents, std::uint32_t a, std::uint32_t b) {
    a = rootOf(parents, a);
    b = rootOf(parents, b);
    if (a == b) return false;
    parents[a < b ? b : a] = a < b ? a : b;
    return true;
}

}  // namespace tspace
