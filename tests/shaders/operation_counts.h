// SPDX-License-Identifier: MIT
// Cost of the functions of a shader, counted in its SPIR-V before optimization.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace tspace::shaders {

/// Number of scalar operations: vector operations count once per component; a selection (?:), a comparison and a
/// conversion count as one each; an integer division counts as two, because divisors are constants (high product and
/// shift). Loads, stores and moves are not counted.
struct OperationCount {
    unsigned operations = 0, roots = 0, divisions = 0, sines = 0;  ///< cosines too
    /// Returns a text such as "94 operations, 2 roots, 1 division".
    [[nodiscard]] std::string text() const;
    bool operator==(const OperationCount&) const = default;
};

/// Returns the counts of all functions, including the functions that they call, keyed by name. Functions with unknown
/// instructions are skipped.
std::map<std::string, OperationCount> countOperations(std::span<const std::uint32_t> spirv);

}  // namespace tspace::shaders
