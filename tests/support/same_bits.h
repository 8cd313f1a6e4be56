// SPDX-License-Identifier: MIT
// Bitwise comparison of lists.
#pragma once

#include <cstring>
#include <vector>

namespace tspace::test {

template <class T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

}  // namespace tspace::test
