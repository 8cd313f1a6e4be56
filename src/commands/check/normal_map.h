// SPDX-License-Identifier: MIT
// Which way green points in a normal map, or in parts of it, and which axes of a map are those of a mesh.
#pragma once

#include <array>
#include <vector>

#include "images/image.h"
#include "maps/layout/uv_coverage.h"
#include "tspace/map_files.h"

namespace tspace {

enum class GreenVerdict { unknown, up, down, mixed };

struct GreenTest {
    GreenVerdict verdict = GreenVerdict::unknown;
    /// Correlation of the two mixed derivatives over all blocks: -1 for a perfect height field with green up, +1 with
    /// green down.
    double correlation = 0;
    std::uint64_t block_count = 0;       ///< blocks that have enough relief to say something
    std::uint64_t down_block_count = 0;  ///< those that say "down"
    /// In a mixed map: the blocks of the largest part where green points down, and where that part lies.
    std::uint64_t down_part_blocks = 0;
    TexelRect down_part = {};
    std::uint64_t up_part_blocks = 0;  ///< blocks of the largest part where green points up
    TexelRect up_part = {};

    /// Confidence of the verdict: how many of the blocks agree beyond an even split, 0 to 1.
    [[nodiscard]] double confidence() const;
};

/// A normal map is the slope of some height h: p = -nx/nz = dh/dx, and q = -ny/nz = dh/dy with y upwards. The order of
/// derivatives does not matter, so dq/dx = dp/dy. Where green points down, q has the wrong sign, and dq/dx = -dp/dy.
/// All of this is along the axes of the image, so it does not matter whether an island of the UV map is turned or
/// mirrored: the tangents that belong to it are too.
///
/// Real maps are not perfect height fields (baked over seams, painted over, compressed), so blocks of texels vote. Flat
/// maps, and those with relief along one axis only, get no verdict.
class GreenBlocks {
  public:
    static constexpr std::uint32_t kBlock = 16;  ///< texels along each side of a block

    /// Reads the texels in `inside`, a mask of the image's size: those that some triangle shows.
    GreenBlocks(const RgbImage& image, const TexelMask& inside);

    /// All blocks.
    [[nodiscard]] GreenTest all() const;
    /// The blocks of which `part` covers a quarter or more. Where they are too few to say anything, but the whole map is
    /// one way throughout, they are taken to be so too.
    [[nodiscard]] GreenTest within(const TexelMask& part) const;

    /// Its memory.
    static std::uint64_t bytesOf(std::uint64_t width, std::uint64_t height) {
        return 2 * (width / kBlock + 1) * (height / kBlock + 1) * sizeof(Block);
    }

  private:
    struct Block {
        float ab = 0, aa = 0, bb = 0;  ///< sums of products of the derivatives a = dq/dx, b = dp/drow
        bool votes = false;
        std::int8_t side = 0;    ///< side of its part: -1 up, +1 down
        std::uint32_t part = 0;  ///< from 1; 0: none
    };
    /// isChosen(block): whether it counts.
    template <class IsChosen>
    [[nodiscard]] GreenTest judge(const IsChosen& isChosen) const;
    template <class IsChosen>
    int sideOfMeans(const IsChosen& isChosen, GreenTest& test) const;
    /// Sums of all blocks, by squares of `side` texels a side.
    [[nodiscard]] std::vector<Block> measured(const RgbImage& image, const TexelMask& inside, std::uint32_t side) const;
    [[nodiscard]] TexelRect rectOf(std::size_t block) const;
    [[nodiscard]] int leaningOf(std::size_t block) const;
    void findParts();

    std::uint32_t width_ = 0, height_ = 0;
    std::uint32_t columns_ = 0, rows_ = 0;
    std::vector<Block> blocks_ = {};
    std::vector<Block> means_ =
        {};  ///< means of squares of four texels, if single texels are inconclusive for the whole map
    std::uint32_t part_count_ = 0;
};

// Finds the axes of a map relative to those of a mesh: the rotation or exchange of channels that maps directions to normals.

/// The mean of n v^T over the surface; n is the mesh's normal, v the direction in the map.
struct Moments {
    std::array<std::array<double, 3>, 3> sum = {};
    double weight = 0;
};

/// The largest mean cosine that any rotation or reflection of the map's axes gives: the sum of the singular values.
double bestAgreement(const Moments& moments);

/// Signed channels that hold the mesh's x, y and z, and the resulting mean cosine between its normals and the map's.
struct Axes {
    MapLayout layout = {};
    double agreement = -1;
};

Axes bestAxes(const Moments& moments);

}  // namespace tspace
