// SPDX-License-Identifier: MIT
#include "level_errors.h"

#include <cmath>
#include <cstddef>

#include "core/base/vec_math.h"
#include "surfaces.h"

namespace tspace::bench {

namespace {

DVec3 vectorOf(const Vec3& texel) { return {2.0 * texel.x - 1, 2.0 * texel.y - 1, 2.0 * texel.z - 1}; }

/// Sums of vectors over squares of `side` x `side` texels. A sum is zero if any of its texels is background.
struct Blocks {
    Blocks(const BakedMap& map, std::size_t side, bool unit) : width(map.width / side) {
        sums.resize(width * (map.height / side));
        for (std::size_t block = 0; block < sums.size(); ++block) {
            const std::size_t first = block / width * side * map.width + block % width * side;
            for (std::size_t i = 0; i < side * side; ++i) {
                const std::size_t texel = first + i / side * map.width + i % side;
                if (map.origins[texel] != TexelOrigin::hit) {
                    sums[block] = {};
                    break;
                }
                const DVec3 vector = vectorOf(map.texels[texel]);
                sums[block] = sums[block] + (unit ? accuracy::unit(vector) : vector);
            }
        }
    }

    std::size_t width;
    std::vector<DVec3> sums = {};
};

}  // namespace

std::array<double, kLevels> levelErrors(const BakedMap& map, const BakedMap& fine) {
    const std::size_t finer = fine.width / map.width;
    std::array<double, kLevels> errors{};
    for (std::size_t level = 0; level < kLevels; ++level) {
        const std::size_t side = std::size_t{2} << level;
        const Blocks own(map, side, false), wanted(fine, finer * side, true);
        double sum = 0;
        std::size_t count = 0;
        for (std::size_t i = 0; i < own.sums.size(); ++i) {
            if (!(length(own.sums[i]) > 0) || !(length(wanted.sums[i]) > 0)) continue;
            sum += accuracy::angleDeg(own.sums[i], wanted.sums[i]);
            ++count;
        }
        errors[level] = count > 0 ? sum / static_cast<double>(count) : 0;
    }
    return errors;
}

}  // namespace tspace::bench
