// SPDX-License-Identifier: MIT
// Cost of the functions of a shader, counted in its SPIR-V before optimization.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace tspace::shaders {

/// Numbers of scalar operations. Vector operations count once per component. A selection (?:), a comparison and a
/// conversion count as one each. An integer division counts as two (high product and shift), because divisors are
/// constants. Loads, stores and moves are not counted.
struct OperationCount {
    unsigned operations = 0, roots = 0, divisions = 0, sines = 0;  ///< sines and cosines
    /// Returns a text such as "94 operations, 2 roots, 1 division".
    [[nodiscard]] std::string text() const;
    bool operator==(const OperationCount&) const = default;
};

/// Returns the counts of all functions by name. They include the functions that each function calls. Functions with
/// unknown instructions are omitted.
std::map<std::string, OperationCount> countOperations(std::span<const std::uint32_t> spirv);

}  // namespace tspace::shaders
