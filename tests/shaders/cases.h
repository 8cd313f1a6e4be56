// SPDX-License-Identifier: MIT
// Inputs and expected results for every shader language: each function of shaders/ on many items.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tspace::shaders {

/// Number of floats of a result. An item has two result vectors of four floats: (normal, 0) and the tangent, or
/// (vector, 0) and zeros.
inline constexpr std::size_t kResultFloats = 8;
/// Number of words of the header of a buffer: number of the case, number of items, words per item, and 0.
inline constexpr std::size_t kHeaderWords = 4;

struct Case {
    std::string name;
    std::uint32_t number = 0;             ///< number of the case in the shaders
    std::size_t item_words = 0;           ///< number of words per item that a shader reads
    std::vector<std::uint32_t> buffer{};  ///< the header, then the words of the items
    std::vector<double> expected{};       ///< kResultFloats values per item
    double bound = 0;                     ///< maximum deviation of a component from its expected value

    [[nodiscard]] std::size_t count() const { return expected.size() / kResultFloats; }
};

std::size_t caseCount();
/// Creates case `number` with about `count` items, which are the same on every machine. Takes time O(count).
Case makeCase(std::uint32_t number, std::size_t count);

/// Returns an empty string if all components are within the bound and all signs are exact. Otherwise returns a
/// description of the first wrong result.
std::string whatIsWrong(const Case& c, std::span<const float> results);
/// Returns the largest difference between a component of the results and its expected value.
double worstDifference(const Case& c, std::span<const float> results);

}  // namespace tspace::shaders
