// SPDX-License-Identifier: MIT
// Runs of 1, 2, 4, ... rows are merged from one half of the memory into the other.
#include "core/base/sort.h"

#include <cstdint>
#include <cstring>

#include "core/base/memory.h"

namespace tspace {

void sortRows(void* rows, std::size_t count, std::size_t row_bytes, RowIsLess isLess, const void* less) {
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
            // Runs that are in order already, as in most lists of a mesh, take one comparison.
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

}  // namespace tspace
