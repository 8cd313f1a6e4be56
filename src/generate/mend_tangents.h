// SPDX-License-Identifier: MIT
// Repair: what is wrong is mended, and all else keeps its bits.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "generate/primitive.h"
#include "tspace/vec.h"

namespace tspace {

/// Puts the tangents that a pool keeps in place of those computed for a primitive, but where they are to be mended.
///
/// corners    the pool's vertex of each corner, three per triangle
/// tangents   one per corner: in, what was computed; out, what is written
///
/// Returns one entry per corner: whether what morph targets add is to be new there, too. Near-linear.
std::vector<bool> mendCorners(const PoolView& pool, std::span<const std::uint32_t> corners, const Mends& mends,
                              std::span<Vec4> tangents);

}  // namespace tspace
