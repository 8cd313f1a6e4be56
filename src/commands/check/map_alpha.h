// SPDX-License-Identifier: MIT
// Detects maps that store x or y in alpha, with any filling in the other channels: DXT5nm and its variants.
#pragma once

#include <span>
#include <vector>

#include "commands/check/map_texels.h"
#include "tspace/map_files.h"

namespace tspace {

/// A color that may be x or y of vectors whose other component is in alpha.
struct AlphaPair {
    MapChannel color = MapChannel::green;
    /// The texels suffice as evidence; otherwise the slopes must confirm it.
    bool is_certain = false;
    bool is_gray = false;  ///< all three colors are equal
};

/// Returns whether alpha may hold x or y, so that it must be decoded: one of the colors is constant, or two are equal.
/// Reason: if alpha holds one of x and y, the three colors hold only the other one, z and filling.
bool mayHaveXInAlpha(std::span<const TexelBytes> texels);

/// Returns each color (the first of equal ones) that forms x and y with alpha, if the colors hold nothing else: each of
/// them is constant, equal to it, or the z of the resulting vectors.
std::vector<AlphaPair> alphaPairs(std::span<const TexelBytes> texels);

}  // namespace tspace
