// SPDX-License-Identifier: MIT
// Mip levels of a normal map: mean directions.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/vec_math.h"

namespace tspace {

struct NormalLevel {
    std::uint32_t width = 0, height = 0;
    std::vector<Vec3> normals = {};  ///< unit normal of each texel
    /// Spread of the covered normals m around the texel's normal n: 1 - mean((m . n)^2), which is the mean squared part
    /// of m perpendicular to n. Empty unless requested.
    std::vector<float> spreads = {};
    /// Fraction of each texel that is surface, 0 to 1; empty: fully covered.
    std::vector<float> coverage = {};
};

/// Texels in a row of a level that one texel in a row of a smaller level covers: consecutive texels from `begin` on,
/// with weights that sum to 1.
struct Cover {
    std::size_t begin = 0;
    std::vector<double> weights = {};
};
std::vector<Cover> coversOf(std::uint32_t from, std::uint32_t to);

/// Calls part(texel, weight) for each texel of a level with rows of `width` texels that one texel of a smaller level
/// covers.
template <class Part>
void forCovered(std::size_t width, const Cover& across, const Cover& down, const Part& part) {
    for (std::size_t j = 0; j < down.weights.size(); ++j) {
        const std::size_t row = (down.begin + j) * width + across.begin;
        for (std::size_t i = 0; i < across.weights.size(); ++i) part(row + i, down.weights[j] * across.weights[i]);
    }
}

/// Returns the given level and all smaller ones down to 1 x 1, each half as wide and high, rounded down. A texel of any
/// level is the normalized mean of the normals that it covers in the first level, weighted by area and coverage, or (0,
/// 0, 1) if that mean has no direction. A texel without coverage, in any level including the first, gets the normal of
/// the next smaller level, so that filters at silhouettes read no unrelated direction. Memory: twice that of the first
/// level, four times with spreads. The result does not depend on the number of threads.
std::vector<NormalLevel> makeNormalLevels(NormalLevel first, Parallel& parallel, bool with_spreads = false);

}  // namespace tspace
