// SPDX-License-Identifier: MIT
// Sorting, in little code where code must be small (TSPACE_SMALL).
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <type_traits>
#include <vector>

namespace tspace {

/// Whether row `a` stands before row `b`; `less` is what the caller gave.
using RowIsLess = bool (*)(const void* less, const void* a, const void* b);

/// Merge sort for rows of any kind, which are moved as bytes: stable, in O(n log n), with scratch memory for as many rows.
/// `row_bytes` is a multiple of 4.
void sortRows(void* rows, std::size_t count, std::size_t row_bytes, RowIsLess isLess, const void* less);

/// Equal elements keep their order. One function for all kinds of elements, in place of the kilobyte or two that the
/// standard library takes for each.
template <class Iterator, class Less>
void sortInLittleCode(Iterator begin, Iterator end, const Less& less) {
    using Element = typename std::iterator_traits<Iterator>::value_type;
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
        sortInLittleCode(order.begin(), order.end(), [&](const Element* a, const Element* b) { return less(*a, *b); });
        std::vector<Element> sorted;
        for (Element* element : order) sorted.push_back(std::move(*element));
        std::move(sorted.begin(), sorted.end(), begin);
    }
}

/// For lists in which no two elements are equal, or where it does not matter which of them is first.
template <class Iterator, class Less = std::less<>>
void sortList(Iterator begin, Iterator end, const Less& less = {}) {
#ifdef TSPACE_SMALL
    sortInLittleCode(begin, end, less);
#else
    std::sort(begin, end, less);
#endif
}

/// Equal elements keep their order.
template <class Iterator, class Less>
void sortStably(Iterator begin, Iterator end, const Less& less) {
#ifdef TSPACE_SMALL
    sortInLittleCode(begin, end, less);
#else
    std::stable_sort(begin, end, less);
#endif
}

}  // namespace tspace
