// SPDX-License-Identifier: MIT
// Which primitive of one file is which of another.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "commands/diff/pair_triangles.h"
#include "model/scene/scene.h"

namespace tspace {

inline constexpr std::size_t kNoPrimitive = ~std::size_t{0};

struct PrimitivePair {
    std::size_t a = kNoPrimitive, b = kNoPrimitive;  ///< numbers in their scenes; kNoPrimitive: no partner
    std::string paired_by = "none";                  ///< PrimitiveDiff::paired_by
    std::vector<TrianglePair> triangles = {};
};

/// The primitives of A in file order, then those of B without a partner. Primitives without triangles are left out.
std::vector<PrimitivePair> pairPrimitives(const Scene& a, const Scene& b);

}  // namespace tspace
