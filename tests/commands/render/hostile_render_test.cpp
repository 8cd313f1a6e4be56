// SPDX-License-Identifier: MIT
// Malicious or empty models.
#include <cmath>
#include <limits>

#include "commands/render/drawn.h"

namespace tspace::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNoNumber = std::numeric_limits<float>::quiet_NaN();
constexpr RenderShow kAllShows[] = {RenderShow::lit,   RenderShow::normals, RenderShow::tangents, RenderShow::sign,
                                    RenderShow::error, RenderShow::uv,      RenderShow::mapped};

TEST(HostileRender, AnyFloatsAreDrawnOrIgnored) {
    for (const float bad : {kNoNumber, kInfinity, -kInfinity, 3.4e38f, -3.4e38f, 1e-45f, 0.0f}) {
        for (int what = 0; what < 4; ++what) {
            SquareModel model;
            std::vector<float>* arrays[] = {&model.positions, &model.normals, &model.tangents, &model.uvs};
            for (std::size_t i = 0; i < arrays[what]->size(); i += 2) (*arrays[what])[i] = bad;
            GltfBuilder builder = model.build();
            builder.json()["materials"][0]["normalTexture"] = {
                {"index", addTexture(builder, plainImage(200, 90, 220))}};
            for (const RenderShow show : kAllShows) {
                RenderOptions options = plainView(show, 24);
                options.samples = 2;
                for (const double field_of_view : {0.0, 90.0}) {
                    options.field_of_view_deg = field_of_view;
                    draw(builder, options);
                }
            }
        }
    }
}

TEST(HostileRender, OneExtremeVertexDoesNotAffectTheRest) {
    SquareModel model;
    model.positions.insert(model.positions.end(), {kNoNumber, 0, 0});
    model.normals.insert(model.normals.end(), {0, 0, 1});
    model.tangents.insert(model.tangents.end(), {1, 0, 0, 1});
    model.uvs.insert(model.uvs.end(), {0, 0});
    model.indices.insert(model.indices.end(), {0, 1, 4});
    const Drawn drawn = draw(model.build(), plainView(RenderShow::normals));
    EXPECT_EQ(drawn.center()[2], 255);
}

TEST(HostileRender, CyclesOfNodesAreIgnored) {
    GltfBuilder builder = SquareModel().build();
    builder.json()["nodes"] = Json::parse(R"([{"children":[1]},{"children":[0,2,2],"mesh":0},{"mesh":0}])");
    builder.json()["scenes"] = Json::parse(R"([{"nodes":[1]}])");
    EXPECT_EQ(draw(builder, plainView(RenderShow::normals)).report.triangle_count, 4U);
}

TEST(HostileRender, EndlessInstancesAreRejected) {
    // Each of thousands of instances covers the whole picture, and they are drawn from back to front.
    SquareModel model;
    for (int i = 0; i < 2000; ++i) model.indices.insert(model.indices.end(), {0, 1, 2, 0, 2, 3});
    GltfBuilder builder = model.build();
    Json nodes = Json::array(), roots = Json::array();
    for (std::size_t i = 0; i < 3000; ++i) {
        nodes.push_back({{"mesh", 0}, {"translation", {0, 0, 0.001 * static_cast<double>(i)}}});
        roots.push_back(i);
    }
    builder.json()["nodes"] = nodes;
    builder.json()["scenes"] = Json::array({Json{{"nodes", roots}}});
    std::vector<std::uint8_t> png;
    const Bytes file = builder.glb();
    const Result<RenderReport> report = renderTo(png, file, plainView(RenderShow::normals));
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.error().code, ErrorCode::tooLarge);
    EXPECT_TRUE(png.empty());
}

TEST(HostileRender, AnEmptyModelIsAnEmptyPicture) {
    const Drawn drawn = draw(GltfBuilder(), plainView(RenderShow::lit));
    EXPECT_EQ(drawn.report.triangle_count, 0U);
    EXPECT_EQ(drawn.center(), drawn.at(0, 0));
}

TEST(HostileRender, ReportsUnreadableTextures) {
    GltfBuilder builder = SquareModel().build();
    const std::size_t number = addTexture(builder, plainImage(1, 2, 3));
    builder.json()["images"][number] = {{"uri", "data:image/png;base64,AAAA"}, {"name", "a\nb"}};
    builder.json()["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", number}};
    const Drawn drawn = draw(builder, plainView(RenderShow::lit));
    ASSERT_EQ(drawn.report.warnings.size(), 1U);
    EXPECT_EQ(drawn.report.warnings[0].find('\n'), std::string::npos);
}

}  // namespace
}  // namespace tspace::test
