// SPDX-License-Identifier: MIT
// Sorting, with small code size if required (TSPACE_SMALL).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <type_traits>
#include <vector>

#include "core/base/memory.h"

namespace tspace {

/// Returns whether row `a` is ordered before row `b`; `less` is the caller's comparison.
using RowIsLess = bool (*)(const void* less, const void* a, const void* b);

/// Sorts rows of any type, which are moved as bytes, by merging: stable, O(n log n), with scratch memory for as many
/// rows.
/// `row_bytes` is a multiple of 4.
/// Runs of 1, 2, 4, ... rows are merged from one half of the memory into the other.
inline void sortRows(void* rows, std::size_t count, std::size_t row_bytes, RowIsLess isLess, const void* less) {
    const std::size_t words = row_bytes / 4;
    Buffer<std::uint32_t> scratch(nullptr, count * words);
    auto* from = static_cast<unsigned char*>(rows);
    auto* to = reinterpret_cast<unsigned char*>(scratch.data());
    const auto copy = [](unsigned char*& target, const unsigned char*& source, std::size_t word_count) {
        for (; word_count != 0; --word_count, target += 4, source += 4) std::memcpy(target, source, 4);
    };
    for (std::size_t run = 1; run < count; run *= 2) {
        unsigned char* target = to;
        for (std::size_t begin = 0; begin < count; begin += 2 * run) {
            const std::size_t middle = std::min(begin + run, count), end = std::min(middle + run, count);
            const unsigned char* a = from + begin * row_bytes;
            const unsigned char* b = from + middle * row_bytes;
            const unsigned char* const a_end = b;
            const unsigned char* const b_end = from + end * row_bytes;
            // Runs that are already in order, as in most lists of a mesh, are merged with one comparison.
            if (b != b_end && isLess(less, b, b - row_bytes)) {
                while (a != a_end && b != b_end) copy(target, isLess(less, b, a) ? b : a, words);
            }
            copy(target, a, static_cast<std::size_t>(a_end - a) / 4);
            copy(target, b, static_cast<std::size_t>(b_end - b) / 4);
        }
        std::swap(from, to);
    }
    if (from != rows) std::memcpy(rows, from, count * row_bytes);
}

/// Sorts stably, with one function for all element types, instead of the 1 to 2 KB of code per type in the standard
/// library.
template <class Iterator, class Less>
void sortWithSharedCode(Iterator begin, Iterator end, const Less& less) {
    using Element = std::remove_cvref_t<decltype(*begin)>;
    const auto count = static_cast<std::size_t>(end - begin);
    if (count < 2) return;
    if constexpr (std::is_trivially_copy_constructible_v<Element> && std::is_trivially_destructible_v<Element>) {
        static_assert(sizeof(Element) % 4 == 0);
        const RowIsLess isLess = [](const void* by, const void* a, const void* b) -> bool {
            return (*static_cast<const Less*>(by))(*static_cast<const Element*>(a), *static_cast<const Element*>(b));
        };
        sortRows(&*begin, count, sizeof(Element), isLess, &less);
    } else {
        std::vector<Element*> order;
        for (Iterator at = begin; at != end; ++at) order.push_back(&*at);
        sortWithSharedCode(order.begin(), order.end(),
                           [&](const Element* a, const Element* b) { return less(*a, *b); });
        std::vector<Element> sorted;
        for (Element* element : order) sorted.push_back(std::move(*element));
        std::move(sorted.begin(), sorted.end(), begin);
    }
}

/// Sorts lists without equal elements, or in which the order of equal elements is irrelevant.
template <class Iterator, class Less = std::less<>>
void sortList(Iterator begin, Iterator end, const Less& less = {}) {
#if defined(TSPACE_SMALL) || defined(TSPACE_MIKKTSPACE_ONLY)
    sortWithSharedCode(begin, end, less);
#else
    std::sort(begin, end, less);
#endif
}

/// Sorts stably: equal elements keep their order.
template <class Iterator, class Less>
void sortStably(Iterator begin, Iterator end, const Less& less) {
#if defined(TSPACE_SMALL) || defined(TSPACE_MIKKTSPACE_ONLY)
    sortWithSharedCode(begin, end, less);
#else
    std::stable_sort(begin, end, less);
#endif
}

}  // namespace tspace
