// SPDX-License-Identifier: MIT
// What every shader language is asked, and what it must answer: each function of shaders/ on many items.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tspace::shaders {

/// Of each item two vectors of four floats come out: (normal, 0) and the tangent, or (vector, 0) and zeros.
inline constexpr std::size_t kResultFloats = 8;
/// What the buffer of words begins with: number of the case, count of items, words of an item, 0.
inline constexpr std::size_t kHeaderWords = 4;

struct Case {
    std::string name;
    std::uint32_t number = 0;             ///< in the shaders
    std::size_t item_words = 0;           ///< that a shader reads of an item
    std::vector<std::uint32_t> buffer{};  ///< the header, then the words of the items
    std::vector<double> expected{};       ///< kResultFloats of each item
    double bound = 0;                     ///< how far a component may be from what is expected

    [[nodiscard]] std::size_t count() const { return expected.size() / kResultFloats; }
};

std::size_t caseCount();
/// Case `number` with about `count` items, the same ones on every machine. O(count).
Case makeCase(std::uint32_t number, std::size_t count);

/// Empty if the results are right: all components within the bound, and the signs exact. Else what is wrong first.
std::string whatIsWrong(const Case& c, std::span<const float> results);
/// The greatest difference of a component.
double worstDifference(const Case& c, std::span<const float> results);

}  // namespace tspace::shaders
