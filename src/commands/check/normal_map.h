// SPDX-License-Identifier: MIT
// Direction of green in a normal map or in parts of it, and axes of a map relative to those of a mesh.
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
    std::uint64_t block_count = 0;       ///< number of blocks with enough relief to vote
    std::uint64_t down_block_count = 0;  ///< number of blocks that vote for green down
    /// In a mixed map: number of blocks of the largest part where green points down, and its bounding rectangle.
    std::uint64_t down_part_blocks = 0;
    TexelRect down_part = {};
    std::uint64_t up_part_blocks = 0;  ///< number of blocks of the largest part where green points up
    TexelRect up_part = {};

    /// Returns the confidence of the verdict, 0 to 1: the share of agreeing blocks beyond an even split.
    [[nodiscard]] double confidence() const;
};

/// Determines the direction of green from the integrability of the map. A normal map contains the slopes of a height h:
/// p = -nx/nz = dh/dx, and q = -ny/nz = dh/dy with y pointing up. Mixed derivatives are equal, so dq/dx = dp/dy. If
/// green points down, q has the wrong sign, and dq/dx = -dp/dy. All of this is along the axes of the image, so rotated
/// or mirrored islands of the UV map do not matter: their tangents are rotated and mirrored too.
///
/// Real maps are not perfect height fields (baked across seams, painted over, compressed), so blocks of texels vote.
/// Flat maps, and maps with relief along one axis only, get no verdict.
class GreenBlocks {
  public:
    static constexpr std::uint32_t kBlock = 16;  ///< texels along each side of a block

    /// Uses the texels in `inside`: the texels that triangles cover, as a mask with the size of the image.
    GreenBlocks(const RgbImage& image, const TexelMask& inside);

    /// Returns the result of all blocks of the map.
    [[nodiscard]] GreenTest all() const;
    /// Returns the result for the blocks of which `part` covers at least a quarter. If these are too few for a verdict,
    /// and the whole map has one direction, the result is that direction.
    [[nodiscard]] GreenTest within(const TexelMask& part) const;

    /// Returns the memory in bytes that this object needs for an image of this size.
    static std::uint64_t bytesOf(std::uint64_t width, std::uint64_t height) {
        return 2 * (width / kBlock + 1) * (height / kBlock + 1) * sizeof(Block);
    }

  private:
    struct Block {
        float ab = 0, aa = 0, bb = 0;  ///< sums of products of the derivatives a = dq/dx, b = dp/drow
        bool votes = false;
        /// Green direction of the part that contains the block: -1 up, +1 down; 0: undetermined.
        std::int8_t side = 0;
        std::uint32_t part = 0;  ///< number of the part, starting at 1; 0 if the block is in no part
    };
    /// `isChosen(block)`: returns whether the block is used.
    template <class IsChosen>
    [[nodiscard]] GreenTest judge(const IsChosen& isChosen) const;
    template <class IsChosen>
    int sideOfMeans(const IsChosen& isChosen, GreenTest& test) const;
    /// Returns the sums of all blocks, from squares of `side` x `side` texels.
    [[nodiscard]] std::vector<Block> measured(const RgbImage& image, const TexelMask& inside, std::uint32_t side) const;
    [[nodiscard]] TexelRect rectOf(std::size_t block) const;
    [[nodiscard]] int sideOf(std::size_t block) const;
    void findParts();

    std::uint32_t width_ = 0, height_ = 0;
    std::uint32_t columns_ = 0, rows_ = 0;
    std::vector<Block> blocks_ = {};
    /// Blocks measured on averages of 2 x 2 texels; computed only if single texels are inconclusive for the whole map.
    std::vector<Block> means_ = {};
    std::uint32_t part_count_ = 0;
};

// Finds the axes of a map relative to those of a mesh: the rotation or permutation of channels that maps directions to
// normals.

/// Weighted sum of n v^T over the surface, where n is the normal of the mesh and v the direction in the map; the mean
/// is sum / weight.
struct Moments {
    std::array<std::array<double, 3>, 3> sum = {};
    double weight = 0;
};

/// Returns the largest mean cosine that any rotation or reflection of the map's axes achieves: the sum of the singular
/// values.
double bestAgreement(const Moments& moments);

/// Signed channels that hold the mesh's x, y and z, and the resulting mean cosine between its normals and the map's.
struct Axes {
    MapLayout layout = {};
    double agreement = -1;
};

Axes bestAxes(const Moments& moments);

}  // namespace tspace
