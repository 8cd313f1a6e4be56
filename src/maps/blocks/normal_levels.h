// SPDX-License-Identifier: MIT
// Smaller levels of a normal map: mean directions.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/vec_math.h"

namespace tspace {

struct NormalLevel {
    std::uint32_t width = 0, height = 0;
    std::vector<Vec3> normals = {};  ///< unit vectors
    /// Spread of the normals that a texel covers around its own: 1 - mean (n . own)^2, the trace of their covariance across it.
    /// Empty unless requested.
    std::vector<float> spreads = {};
    /// Fraction of each texel that is surface, 0 to 1; empty: all of it.
    std::vector<float> coverage = {};
};

/// Texels in a row of `from` covered by a texel in a row of `to`: from `begin` on, with weights that sum to 1.
struct Cover {
    std::size_t begin = 0;
    std::vector<double> weights = {};
};
std::vector<Cover> coversOf(std::uint32_t from, std::uint32_t to);

/// The given level and all smaller ones down to 1 x 1, each half as wide and high, rounded down. A texel of any level is the unit mean of
/// the normals that it covers on the first, in parts where an edge cuts them, weighted by their coverage; z along where that has no
/// direction. Where nothing is covered, a texel of any level, the first too, gets the normal of the next smaller level there, so
/// that filters at silhouettes read no foreign direction. Memory: twice that of the first level, with spreads four times. The same for
/// any number of threads.
std::vector<NormalLevel> makeNormalLevels(NormalLevel first, Parallel& parallel, bool with_spreads = false);

}  // namespace tspace
