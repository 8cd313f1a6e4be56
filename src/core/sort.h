// SPDX-License-Identifier: MIT
// Sorting lists by an order in which no two elements are equal, so that it does not matter how.
#pragma once

#include <algorithm>

namespace tspace {

/// In O(n log n). What is sorted in the core is rare, so where code must be small (TSPACE_SMALL) it is done by a heap, in a
/// fifth of the code that std::sort takes for each kind of element.
template <class Iterator, class Less>
void sortList(Iterator begin, Iterator end, const Less& less) {
#ifdef TSPACE_SMALL
    std::make_heap(begin, end, less);
    std::sort_heap(begin, end, less);
#else
    std::sort(begin, end, less);
#endif
}

}  // namespace tspace
