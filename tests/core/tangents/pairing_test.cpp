// SPDX-License-Identifier: MIT
// The reference's grouping depends on the order of faces, because its last edge bucket is not sorted; corrected pairing
// does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "core/base/vec_math.h"
#include "support/simple_mesh.h"
#include "tspace/tangents.h"

namespace tspace {
namespace {

constexpr unsigned kCells = 2;  // so few that the last edge affects most of the mesh

/// A grid with slanted UVs that differ from cell to cell, so that a missing neighbor changes the result.
struct Grid : test::SimpleMesh {
    explicit Grid(std::mt19937& random) {
        const auto noise = [&] { return static_cast<float>(random() % 1000) / 2500.0f; };
        for (unsigned y = 0; y <= kCells; ++y) {
            for (unsigned x = 0; x <= kCells; ++x) {
                const Vec2 uv{static_cast<float>(x) + noise(), static_cast<float>(y) + noise()};
                addVertex({static_cast<float>(x), static_cast<float>(y), 0}, {0, 0, 1}, uv);
            }
        }
        for (unsigned y = 0; y < kCells; ++y) {
            for (unsigned x = 0; x < kCells; ++x) {
                const unsigned a = y * (kCells + 1) + x, b = a + 1, c = a + kCells + 1, d = c + 1;
                addTriangle(a, b, d);
                addTriangle(a, d, c);
            }
        }
    }

    /// Returns tangents per corner of the faces as stored, computed with the faces in the given order.
    [[nodiscard]] std::vector<Vec4> tangents(const std::vector<std::size_t>& order, Pairing pairing) const {
        std::vector<std::uint32_t> ordered;
        for (const std::size_t f : order) ordered.insert(ordered.end(), &indices[3 * f], &indices[3 * f] + 3);
        MeshView mesh = view();
        mesh.indices = IndexView(std::span<const std::uint32_t>(ordered));
        std::vector<Vec4> moved(ordered.size()), result(ordered.size());
        EXPECT_TRUE(
            generateTangents(mesh, {.convention = conventions::opengl, .pairing = pairing}, {.tangents = moved}));
        for (std::size_t i = 0; i < order.size(); ++i) std::copy_n(&moved[3 * i], 3, &result[3 * order[i]]);
        return result;
    }
};

/// Returns the largest change of any tangent when the faces of many grids are shuffled.
float largestChange(Pairing pairing) {
    float largest = 0;
    for (unsigned seed = 0; seed < 500; ++seed) {
        std::mt19937 random(seed);
        const Grid grid(random);
        std::vector<std::size_t> order(grid.indices.size() / 3);
        std::iota(order.begin(), order.end(), std::size_t{0});
        const std::vector<Vec4> before = grid.tangents(order, pairing);
        std::shuffle(order.begin(), order.end(), random);
        const std::vector<Vec4> after = grid.tangents(order, pairing);
        for (std::size_t c = 0; c < before.size(); ++c) {
            largest = std::max(largest, length(xyz(before[c]) - xyz(after[c])));
        }
    }
    return largest;
}

TEST(CorrectedPairing, DoesNotDependOnTheOrderOfFaces) { EXPECT_LT(largestChange(Pairing::corrected), 1e-5f); }

TEST(ReferencePairing, LosesNeighborsInSomeOrdersOfFaces) { EXPECT_GT(largestChange(Pairing::reference), 1e-2f); }

}  // namespace
}  // namespace tspace
