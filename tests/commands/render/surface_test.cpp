// SPDX-License-Identifier: MIT
// Materials, poses and series of pictures.
#include "commands/render/drawn.h"
#include "support/temp_folder.h"

namespace tspace::test {
namespace {

bool isNear(const Pixel& a, const Pixel& b, int most) {
    return std::abs(a[0] - b[0]) <= most && std::abs(a[1] - b[1]) <= most && std::abs(a[2] - b[2]) <= most;
}

GltfBuilder unlitSquare(const std::vector<double>& color) {
    GltfBuilder builder = SquareModel().build();
    Json& material = builder.json()["materials"][0];
    material["extensions"]["KHR_materials_unlit"] = Json::object();
    material["pbrMetallicRoughness"]["baseColorFactor"] = color;
    return builder;
}

TEST(RenderSurface, ColorsOfVerticesAreMultipliedWithThatOfTheMaterial) {
    GltfBuilder builder = unlitSquare({1, 1, 0.2158605, 1});
    const std::size_t colors = builder.addFloats(std::vector<float>{1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1}, 4);
    builder.json()["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = colors;
    EXPECT_TRUE(isNear(draw(builder, plainView(RenderShow::lit)).center(), {255, 0, 128}, 1));
}

/// Returns two squares with these colors; the second one is closer to the camera.
GltfBuilder twoSquares(const std::vector<double>& far, const std::vector<double>& near, bool is_near_first) {
    GltfBuilder builder = unlitSquare(far);
    Json& json = builder.json();
    json["materials"].push_back(json["materials"][0]);
    json["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"] = near;
    json["materials"][1]["alphaMode"] = "BLEND";
    json["meshes"].push_back(json["meshes"][0]);
    json["meshes"][1]["primitives"][0]["material"] = 1;
    json["nodes"] = Json::parse(R"([{"mesh":0},{"mesh":1,"translation":[0,0,0.5]}])");
    json["scenes"] = Json::array({Json{{"nodes", is_near_first ? Json::parse("[1,0]") : Json::parse("[0,1]")}}});
    return builder;
}

TEST(RenderSurface, BlendedSurfacesAreOpaqueInAnyOrder) {
    for (const bool is_near_first : {false, true}) {
        const GltfBuilder builder = twoSquares({0, 1, 0, 1}, {1, 0, 0, 0.25}, is_near_first);
        EXPECT_TRUE(isNear(draw(builder, plainView(RenderShow::lit)).center(), {255, 0, 0}, 1)) << is_near_first;
        EXPECT_TRUE(isNear(draw(builder, plainView(RenderShow::normals)).center(), {128, 128, 255}, 1));
    }
    const GltfBuilder invisible = twoSquares({0, 1, 0, 1}, {1, 0, 0, 0}, false);
    EXPECT_TRUE(isNear(draw(invisible, plainView(RenderShow::lit)).center(), {0, 255, 0}, 1));
}

TEST(RenderSurface, ABlendedSurfaceIsDrawnWhereItsAlphaIsAtLeastHalfOfTheMaterials) {
    const auto centerAt = [](float alpha) {
        GltfBuilder builder = twoSquares({0, 1, 0, 1}, {1, 0, 0, 0.25}, false);
        std::vector<float> values;
        for (int i = 0; i < 4; ++i) values.insert(values.end(), {1, 1, 1, alpha});
        const std::size_t colors = builder.addFloats(values, 4);
        builder.json()["meshes"][1]["primitives"][0]["attributes"]["COLOR_0"] = colors;
        return draw(builder, plainView(RenderShow::lit)).center();
    };
    EXPECT_TRUE(isNear(centerAt(0.51f), {255, 0, 0}, 1));
    EXPECT_TRUE(isNear(centerAt(0.49f), {0, 255, 0}, 1));
}

TEST(RenderSurface, WeightsOfMorphTargetsMoveTheSurface) {
    GltfBuilder builder = SquareModel().build();
    Json& mesh = builder.json()["meshes"][0];
    // The target's N is +x, as if the square was rotated by 90 degrees about y. With weight 0.5, N is tilted by 45
    // degrees.
    const std::size_t normals = builder.addFloats(std::vector<float>{1, 0, -1, 1, 0, -1, 1, 0, -1, 1, 0, -1}, 3);
    mesh["primitives"][0]["targets"] = Json::array({Json{{"NORMAL", normals}}});
    mesh["weights"] = Json::array({0});
    builder.json()["nodes"] = Json::parse(R"([{"mesh":0}])");
    builder.json()["scenes"] = Json::parse(R"([{"nodes":[0]}])");
    const RenderOptions options = plainView(RenderShow::normals);
    EXPECT_TRUE(isNear(draw(builder, options).center(), {128, 128, 255}, 1));
    mesh["weights"] = Json::array({0.5});
    EXPECT_TRUE(isNear(draw(builder, options).center(), {218, 128, 218}, 1));
    // The weights of a node have priority over those of its mesh.
    builder.json()["nodes"][0]["weights"] = Json::array({0});
    EXPECT_TRUE(isNear(draw(builder, options).center(), {128, 128, 255}, 1));
}

TEST(RenderSurface, BonesTransformFramesAndTheNodeOfASkinnedMeshIsIgnored) {
    GltfBuilder builder = SquareModel().build();
    Json& attributes = builder.json()["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = builder.addAccessor(
        std::vector<std::uint16_t>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5123, "VEC4", 4);
    attributes["WEIGHTS_0"] =
        builder.addFloats(std::vector<float>{1, 0, 0, 0, 0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 1, 0, 0, 0}, 4);
    // The second joint rotates x to y. Weights are normalized so that their sum is 1.
    builder.json()["nodes"] = Json::parse(
        R"([{"mesh":0,"skin":0,"scale":[1,1,-1],"translation":[9,0,0]},{},{"rotation":[0,0,0.70710678,0.70710678]}])");
    builder.json()["skins"] = Json::array({Json{{"joints", {1, 2}}}});
    builder.json()["scenes"] = Json::parse(R"([{"nodes":[0,1,2]}])");
    RenderOptions options = plainView(RenderShow::tangents);
    const Drawn posed = draw(builder, options);
    EXPECT_TRUE(isNear(posed.center(), {128, 255, 128}, 1));
    for (const std::uint32_t corner : {8U, 56U}) EXPECT_TRUE(isNear(posed.at(corner, corner), {128, 255, 128}, 1));
    options.pose = false;
    EXPECT_TRUE(isNear(draw(builder, options).center(), {255, 128, 128}, 1)) << "where the first joint puts it";
}

TEST(RenderSurface, BothSidesAreThePicturesOfTheStoredAndTheComputedFrames) {
    SquareModel square;
    for (std::size_t i = 3; i < square.tangents.size(); i += 4) square.tangents[i] = -1;  // the wrong sign
    GltfBuilder builder = square.build();
    const std::size_t map = addTexture(builder, plainImage(128, 218, 218));
    builder.json()["materials"][0]["normalTexture"] = {{"index", map}};
    RenderOptions options = plainView(RenderShow::both);
    const Drawn both = draw(builder, options);
    options.show = RenderShow::lit;
    options.frames = RenderFrames::stored;
    const Drawn stored = draw(builder, options);
    options.frames = RenderFrames::computed;
    const Drawn computed = draw(builder, options);
    for (std::uint32_t y = 0; y < 64; y += 9) {
        for (std::uint32_t x = 0; x < 64; ++x) {
            if (x < 30) {
                EXPECT_EQ(both.at(x, y), stored.at(x, y));
            }
            if (x >= 34) {
                EXPECT_EQ(both.at(x, y), computed.at(x, y));
            }
        }
    }
    EXPECT_NE(both.at(20, 32), both.at(44, 32)) << "the wrong sign is seen";
    EXPECT_EQ(both.report.computed_count, 1U);
}

TEST(RenderSurface, ATurntableWritesNumberedPicturesFromOneDistance) {
    const TempFolder folder;
    const GltfBuilder builder = SquareModel().build();
    const Bytes file = builder.glb();
    RenderOptions options = plainView(RenderShow::normals, 32);
    options.turntable = 4;
    options.file.content = file;
    const Result<RenderReport> report = renderFile("model.glb", (folder.path() / "turn.png").string(), options);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_EQ(report->picture_count, 4U);
    for (const char* name : {"turn_000.png", "turn_001.png", "turn_002.png", "turn_003.png"})
        EXPECT_TRUE(std::filesystem::exists(folder.path() / name)) << name;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "turn.png"));
    options.turntable = 1000;
    EXPECT_EQ(renderFile("model.glb", (folder.path() / "turn.png").string(), options).error().code,
              ErrorCode::invalidOption);
}

TEST(RenderSurface, PicturesHaveTheSameBytesForAnyNumberOfThreads) {
    GltfBuilder builder = twoSquares({0, 1, 0, 0.5}, {1, 0, 0, 0.25}, true);
    builder.json()["materials"][0]["alphaMode"] = "BLEND";
    builder.json()["materials"][0].erase("extensions");
    RenderOptions options = plainView(RenderShow::lit, 200);
    options.samples = 2;
    options.yaw_deg = 40;
    options.field_of_view_deg = 30;
    options.execution.thread_count = 1;
    const Drawn one = draw(builder, options);
    options.execution.thread_count = 5;
    EXPECT_EQ(draw(builder, options).image.rgb, one.image.rgb);
}

}  // namespace
}  // namespace tspace::test
