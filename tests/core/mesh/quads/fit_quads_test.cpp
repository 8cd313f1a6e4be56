// SPDX-License-Identifier: MIT
// Tangents reveal the faces on which they were computed.
#include "core/mesh/quads/quads.h"

#include <gtest/gtest.h>

#include "core/base/vec_math.h"
#include "core/mesh/quads/quad_meshes.h"

namespace tspace::test {
namespace {

QuadFit fitOf(const ModelData& data) {
    Result<QuadFit> fit = fitQuads(viewOf(data), data.tangents, {});
    EXPECT_TRUE(fit.ok());
    return fit ? *std::move(fit) : QuadFit{};
}

TEST(FitQuads, ExplainsEveryTangentThatWasMadeOnQuads) {
    const PolygonMesh mesh = hills(16);
    for (const Cut& cut : kCuts) {
        const QuadFit fit = fitOf(withTangentsOnQuads(mesh, cut));
        EXPECT_TRUE(fit.wins());
        EXPECT_LT(fit.near_on_triangles, fit.corner_count * 93 / 100);
        EXPECT_EQ(fit.near_on_quads, fit.corner_count);
        EXPECT_EQ(fit.faces.quad_count, mesh.sizes.size());
    }
}

TEST(FitQuads, ExplainsNearlyAllBesideRealTriangles) {
    for (const int triangles_every : {3, 4, 5}) {
        const PolygonMesh mesh = hills(16, triangles_every);
        for (const Cut& cut : kCuts) {
            // With some cuts, the two halves of a quad are connected like the mesh's original triangles, so that more
            // of the original triangles look like quads.
            const bool is_hard = cut == kOtherFan || cut == kCuts.back();
            const QuadFit fit = fitOf(withTangentsOnQuads(mesh, cut));
            EXPECT_TRUE(fit.wins());
            EXPECT_GE(fit.near_on_quads * 100, fit.corner_count * (is_hard ? 95 : 99)) << triangles_every;
        }
    }
}

TEST(FitQuads, LosesIfTangentsWereComputedOnTriangles) {
    for (const Cut& cut : kCuts) {
        for (const Method method : {Method::mikktspace, Method::area, Method::lengyel, Method::uniform}) {
            EXPECT_FALSE(fitOf(withTangents(trianglesOf(hills(16), cut), method)).wins());
        }
    }
}

TEST(FitQuads, FindsTheFewRealTrianglesThatAreOnlyLikeQuads) {
    // By their shapes, all pairs of triangles are quads.
    const PolygonMesh mesh = hills(16, 4);
    const ModelData data = withTangentsOnQuads(mesh, kFan);
    const MeshView view = viewOf(data);
    const QuadCandidates candidates(view, data.tangents);
    const Result<std::vector<Vec4>> by_shape =
        tangentsOnFaces(view, facesOfPairs(candidates, pairsByShape(view, candidates)), {});
    ASSERT_TRUE(by_shape.ok());
    std::uint64_t near_by_shape = 0;
    for (std::size_t c = 0; c < data.indices.size(); ++c) {
        const DVec3 a = toDouble(xyz((*by_shape)[c])), b = toDouble(xyz(data.tangents[data.indices[c]]));
        near_by_shape += dot(a, b) >= 0.99985 * length(a) * length(b) ? 1 : 0;
    }
    EXPECT_GT(fitOf(data).near_on_quads, near_by_shape);
}

TEST(FitQuads, IgnoresIndeterminateCorners) {
    ModelData data = withTangentsOnQuads(hills(12), kFan);
    const std::size_t triangle_count = data.indices.size() / 3;
    // A quarter of the triangles has no UV area.
    for (std::size_t t = 0; t < triangle_count; t += 4)
        for (std::size_t k = 0; k < 3; ++k) data.uvs[data.indices[3 * t + k]] = {};
    EXPECT_EQ(fitOf(data).corner_count, 3 * (triangle_count - (triangle_count + 3) / 4));
}

TEST(FitQuads, WinsOnlyByAMargin) {
    EXPECT_TRUE(quadsWin(1000, 500, 950));
    EXPECT_TRUE(quadsWin(1000, 945, 1000));
    EXPECT_FALSE(quadsWin(1000, 500, 500));
    EXPECT_FALSE(quadsWin(1000, 500, 560));   // a part of what triangles do not explain, as expected by chance
    EXPECT_FALSE(quadsWin(1000, 999, 1000));  // all that triangles do not explain, but that is a single corner
    EXPECT_FALSE(quadsWin(1000, 50, 450));    // much more than triangles, but less than half of all corners
}

TEST(ChooseFaces, TakesTrianglesUnlessTangentsOrBlenderShowQuads) {
    const ModelData on_quads = withTangentsOnQuads(hills(12), kFan);
    const ModelData on_triangles = withTangents(trianglesOf(hills(12), kFan), Method::mikktspace);
    const auto quads = [&](const ModelData& data, bool has_tangents, bool is_from_blender, Faces faces) {
        const std::vector<Vec4> stored = has_tangents ? data.tangents : std::vector<Vec4>();
        const Result<QuadFaces> chosen = chooseFaces(viewOf(data), stored, is_from_blender, faces, {});
        EXPECT_TRUE(chosen.ok());
        return chosen ? chosen->quad_count : 0;
    };
    for (const bool is_from_blender : {false, true}) {
        EXPECT_EQ(quads(on_quads, true, is_from_blender, Faces::triangles), 0U);
        EXPECT_EQ(quads(on_quads, true, is_from_blender, Faces::automatic), 144U);
        EXPECT_EQ(quads(on_triangles, true, is_from_blender, Faces::automatic), 0U);
        EXPECT_EQ(quads(on_triangles, true, is_from_blender, Faces::quads), 144U);
        EXPECT_EQ(quads(on_quads, false, is_from_blender, Faces::automatic), is_from_blender ? 144U : 0U);
        EXPECT_EQ(quads(on_quads, false, is_from_blender, Faces::quads), 144U);
    }
    // Triangles that were not cut from quads are rarely connected as Blender connects the halves of a quad.
    ModelData scattered = trianglesOf(hills(12), kCuts[3]);
    EXPECT_EQ(quads(scattered, false, true, Faces::automatic), 0U);
}

}  // namespace
}  // namespace tspace::test
