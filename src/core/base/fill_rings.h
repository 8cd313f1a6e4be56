// SPDX-License-Identifier: MIT
// Fills missing elements of a grid from their neighbors, ring by ring.
#pragma once

#include <cstddef>
#include <vector>

namespace tspace {

/// Computes missing elements in rings: each ring has the missing elements next to known ones, and is computed from the
/// elements that were known before it. An element that cannot be computed stays missing until another neighbor is
/// known.
///
/// is_missing     one flag per element
/// forNeighbors   forNeighbors(i, visit) calls visit(k) for each neighbor k of element i; may include i itself
/// compute        compute(i) returns the value of an element as an optional
/// set            set(i, value)
///
/// Time: linear.
template <class ForNeighbors, class Compute, class Set>
void fillRings(std::vector<bool>& is_missing, const ForNeighbors& forNeighbors, const Compute& compute,
               const Set& set) {
    std::vector<std::size_t> ring, next;
    std::vector<bool> is_listed(is_missing.size());
    const auto list = [&](std::size_t i) {
        if (!is_missing[i] || is_listed[i]) return;
        is_listed[i] = true;
        next.push_back(i);
    };
    for (std::size_t i = 0; i < is_missing.size(); ++i) {
        if (is_missing[i]) {
            forNeighbors(i, [&](std::size_t near) {
                if (!is_missing[near]) list(i);
            });
        }
    }
    std::vector<decltype(compute(0))> values;
    while (!next.empty()) {
        ring.swap(next);
        next.clear();
        values.clear();
        for (const std::size_t i : ring) values.push_back(compute(i));
        for (std::size_t k = 0; k < ring.size(); ++k) {
            is_listed[ring[k]] = false;
            if (!values[k]) continue;
            is_missing[ring[k]] = false;
            set(ring[k], *values[k]);
        }
        for (std::size_t k = 0; k < ring.size(); ++k) {
            if (values[k]) forNeighbors(ring[k], list);
        }
    }
}

}  // namespace tspace
