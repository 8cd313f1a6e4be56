// SPDX-License-Identifier: MIT
// What the functions of a shader cost, counted in its SPIR-V as the compiler writes it down, before it is optimised.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace tspace::shaders {

/// Scalar operations: a vector's count once for each component; a choice (?:), a comparison and a conversion are one each;
/// a division of whole numbers is two, since divisors are constants (high product and shift). Loads, stores and moves
/// are not counted.
struct OperationCount {
    unsigned operations = 0, roots = 0, divisions = 0, sines = 0;  ///< cosines too
    /// "94 operations, 2 roots, 1 division"
    [[nodiscard]] std::string text() const;
    bool operator==(const OperationCount&) const = default;
};

/// By the names of the functions, with what they call. Functions whose instructions are not known are left out.
std::map<std::string, OperationCount> countOperations(std::span<const std::uint32_t> spirv);

}  // namespace tspace::shaders
