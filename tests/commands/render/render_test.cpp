// SPDX-License-Identifier: MIT
// Contents of pictures, pixel by pixel.
#include <cmath>

#include "commands/render/drawn.h"
#include "maps/texels/shading.h"
#include "support/temp_folder.h"

namespace tspace::test {
namespace {

int byteOfSigned(double component) { return static_cast<int>(std::lround(255 * (0.5 * component + 0.5))); }
bool isNearTo(const Pixel& a, const Pixel& b, int most) {
    return std::abs(a[0] - b[0]) <= most && std::abs(a[1] - b[1]) <= most && std::abs(a[2] - b[2]) <= most;
}
int brightness(const Pixel& p) { return p[0] + p[1] + p[2]; }
constexpr Pixel kBackgroundPixel{236, 238, 241};

/// Returns a sphere of latitudes and longitudes; N is the position.
SquareModel sphere(std::uint32_t rings) {
    SquareModel model;
    model.positions.clear();
    model.uvs.clear();
    model.indices.clear();
    const std::uint32_t columns = 2 * rings;
    for (std::uint32_t y = 0; y <= rings; ++y) {
        for (std::uint32_t x = 0; x <= columns; ++x) {
            const double s = double(x) / columns, t = double(y) / rings, a = 2 * M_PI * s, b = M_PI * t;
            for (const double value : {std::sin(a) * std::sin(b), std::cos(b), std::cos(a) * std::sin(b)})
                model.positions.push_back(static_cast<float>(value));
            model.uvs.insert(model.uvs.end(), {static_cast<float>(s), static_cast<float>(t)});
            if (x == columns || y == rings) continue;
            const std::uint32_t at = y * (columns + 1) + x, below = at + columns + 1;
            model.indices.insert(model.indices.end(), {at, below, below + 1, at, below + 1, at + 1});
        }
    }
    model.normals = model.positions;
    model.tangents.clear();
    return model;
}

TEST(Render, NormalsOfASphereAreItsFormula) {
    const Drawn drawn = draw(sphere(120).build(), plainView(RenderShow::normals, 96));
    int compared = 0;
    for (std::uint32_t row = 0; row < 96; ++row) {
        for (std::uint32_t column = 0; column < 96; ++column) {
            const double x = (column + 0.5 - 48) / (48 * 0.94), y = (47.5 - row) / (48 * 0.94), r = x * x + y * y;
            if (r > 1.02) {
                EXPECT_EQ(drawn.at(column, row), kBackgroundPixel);
            }
            if (r > 0.9) continue;
            const Pixel expected{byteOfSigned(x), byteOfSigned(y), byteOfSigned(std::sqrt(1 - r))};
            EXPECT_TRUE(isNearTo(drawn.at(column, row), expected, 1)) << column << ' ' << row;
            ++compared;
        }
    }
    EXPECT_GT(compared, 5000);
}

TEST(Render, TheViewDeterminesTheCamera) {
    RenderOptions options = plainView(RenderShow::normals);
    const GltfBuilder model = sphere(40).build();
    const auto seen = [&](double yaw, double pitch) {
        options.yaw_deg = yaw;
        options.pitch_deg = pitch;
        return draw(model, options).center();
    };
    EXPECT_TRUE(isNearTo(seen(0, 0), {128, 128, 255}, 3));
    EXPECT_TRUE(isNearTo(seen(180, 0), {128, 128, 0}, 3));
    EXPECT_TRUE(isNearTo(seen(90, 0), {255, 128, 128}, 3));
    EXPECT_TRUE(isNearTo(seen(-90, 0), {0, 128, 128}, 3));
    EXPECT_TRUE(isNearTo(seen(0, 90), {128, 255, 128}, 3));
    EXPECT_TRUE(isNearTo(seen(0, -90), {128, 0, 128}, 3));
}

TEST(Render, PerspectiveShowsTheWholeModel) {
    RenderOptions options = plainView(RenderShow::normals, 100);
    options.field_of_view_deg = 60;
    const Drawn drawn = draw(sphere(60).build(), options);
    for (std::uint32_t i = 0; i < 100; ++i) {
        for (const Pixel& pixel : {drawn.at(i, 0), drawn.at(i, 99), drawn.at(0, i), drawn.at(99, i)})
            EXPECT_EQ(pixel, kBackgroundPixel);
    }
    EXPECT_NE(drawn.at(50, 8), kBackgroundPixel);
    EXPECT_TRUE(isNearTo(drawn.center(), {128, 128, 255}, 3));
}

TEST(Render, TangentsAreColored) {
    EXPECT_TRUE(isNearTo(draw(SquareModel().build(), plainView(RenderShow::tangents)).center(), {255, 128, 128}, 1));
}

/// Returns two squares side by side; the left one is mirrored.
SquareModel mirroredPair() {
    SquareModel model;
    model.positions = {-2, -1, 0, 0, -1, 0, 0, 1, 0, -2, 1, 0, 0, -1, 0, 2, -1, 0, 2, 1, 0, 0, 1, 0};
    model.normals.clear();
    model.tangents.clear();
    for (int i = 0; i < 8; ++i) {
        const float side = i < 4 ? -1.0f : 1.0f;
        model.normals.insert(model.normals.end(), {0, 0, 1});
        model.tangents.insert(model.tangents.end(), {side, 0, 0, side});
    }
    model.uvs = {1, 1, 0, 1, 0, 0, 1, 0, 0, 1, 1, 1, 1, 0, 0, 0};
    model.indices = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    return model;
}

/// Returns the number of pixels from `begin` to `end` in the middle row that have the color.
int countOf(const Drawn& drawn, std::uint32_t begin, std::uint32_t end, bool (*is_it)(const Pixel&)) {
    int count = 0;
    for (std::uint32_t x = begin; x < end; ++x) count += is_it(drawn.at(x, drawn.image.height / 2));
    return count;
}
bool isBlue(const Pixel& p) { return p[2] > p[0] + 60; }
bool isOrange(const Pixel& p) { return p[0] > p[2] + 60 && p[1] > 100; }
bool isRed(const Pixel& p) { return p[0] > 150 && p[1] < 60 && p[2] < 60; }

TEST(Render, AMirroredHalfShowsTheOtherSign) {
    const RenderOptions options = plainView(RenderShow::sign);
    const Drawn right = draw(mirroredPair().build(), options);
    EXPECT_GT(countOf(right, 36, 60, isBlue), 20);
    EXPECT_GT(countOf(right, 4, 28, isOrange), 8);  // not all pixels are orange, because mirrored parts have stripes
    EXPECT_EQ(countOf(right, 0, 64, isRed), 0);

    SquareModel lost = mirroredPair();
    for (std::size_t i = 3; i < lost.tangents.size(); i += 4) lost.tangents[i] = 1;
    const Drawn wrong = draw(lost.build(), options);
    EXPECT_GT(countOf(wrong, 36, 60, isBlue), 20);
    EXPECT_GT(countOf(wrong, 4, 28, isRed), 8);
    EXPECT_EQ(countOf(wrong, 34, 64, isRed), 0);
}

/// Returns a square whose normal map is tilted upward or downward. `green`: above 128 is upward in glTF.
GltfBuilder leaning(std::uint8_t green) {
    GltfBuilder builder = SquareModel().build();
    const std::size_t map = addTexture(builder, plainImage(128, green, 218));
    builder.json()["materials"][0]["normalTexture"] = {{"index", map}};
    return builder;
}

TEST(Render, FlippedGreenIsLitFromTheOtherSide) {
    RenderOptions options = plainView(RenderShow::lit);
    const auto lit = [&](std::uint8_t green, float light_y) {
        options.to_light = {0, light_y, 0.5f};
        return brightness(draw(leaning(green), options).center());
    };
    EXPECT_GT(lit(218, 1), lit(218, -1) + 100);
    EXPECT_GT(lit(38, -1), lit(38, 1) + 100);
    // A program that expects green down renders the map with green 218 as a program for glTF renders green 38.
    options.reading = *findMapReading("directx");
    EXPECT_GT(lit(218, -1), lit(218, 1) + 100);
}

TEST(Render, MappedNormalsAreThoseOfTheShadingReference) {
    GltfBuilder builder = leaning(218);
    builder.json()["materials"][0]["normalTexture"]["scale"] = 0.5;
    const DVec3 vector{0.5 * (2.0 * 128 / 255 - 1), 0.5 * (2.0 * 218 / 255 - 1), 2.0 * 218 / 255 - 1};
    const double size = length(vector);
    const Pixel expected{byteOfSigned(vector.x / size), byteOfSigned(vector.y / size), byteOfSigned(vector.z / size)};
    EXPECT_TRUE(isNearTo(draw(builder, plainView(RenderShow::mapped)).center(), expected, 1));
}

TEST(Render, TexturesAreOrientedAsInGltf) {
    RgbImage image{.width = 2, .height = 2, .rgb = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}};
    GltfBuilder builder = SquareModel().build();
    const std::size_t map = addTexture(builder, image);
    Json& material = builder.json()["materials"][0];
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", map}};
    material["extensions"]["KHR_materials_unlit"] = Json::object();
    const RenderOptions options = plainView(RenderShow::lit);
    const Drawn drawn = draw(builder, options);
    // The pixels nearest to texel centers are slightly off-center, and in sRGB a small difference in linear light is
    // large.
    EXPECT_TRUE(isNearTo(drawn.at(16, 16), {255, 0, 0}, 60));
    EXPECT_TRUE(isNearTo(drawn.at(47, 16), {0, 255, 0}, 60));
    EXPECT_TRUE(isNearTo(drawn.at(16, 47), {0, 0, 255}, 60));
    EXPECT_TRUE(isNearTo(drawn.at(47, 47), {255, 255, 255}, 60));
    // A transform that moves the image by half of its width exchanges the two columns.
    material["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"]["offset"] = {0.5, 0};
    EXPECT_TRUE(isNearTo(draw(builder, options).at(16, 16), {0, 255, 0}, 60));
}

TEST(Render, AFlatGraySquareIsLitByLambertsLaw) {
    GltfBuilder builder = SquareModel().build();
    builder.json()["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.5, 0.5, 1};
    RenderOptions options = plainView(RenderShow::lit);
    const auto gray = [&](const Vec3& to_light) {
        options.to_light = to_light;
        return draw(builder, options).center()[0];
    };
    // Linear 0.5 is 188 in sRGB; 0.5 * (0.12 + 0.88 * 0.5) is 145; 0.06 is 69.
    EXPECT_EQ(gray({0, 0, 3}), 188);
    EXPECT_NEAR(gray({std::sqrt(3.0f), 0, 1}), 145, 1);
    EXPECT_NEAR(gray({0, 0, -1}), 69, 1);
}

TEST(Render, BackFacesAreDrawnForDoubleSidedMaterials) {
    RenderOptions options = plainView(RenderShow::normals);
    options.yaw_deg = 180;
    GltfBuilder builder = SquareModel().build();
    EXPECT_EQ(draw(builder, options).center(), kBackgroundPixel);
    builder.json()["materials"][0]["doubleSided"] = true;
    EXPECT_TRUE(isNearTo(draw(builder, options).center(), {128, 128, 0}, 1)) << "turned toward the camera";
}

TEST(Render, MaskedTexelsAreTransparent) {
    GltfBuilder builder = SquareModel().build();
    Json& material = builder.json()["materials"][0];
    material["alphaMode"] = "MASK";
    material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.4};
    EXPECT_EQ(draw(builder, plainView(RenderShow::normals)).center(), kBackgroundPixel);
    material["alphaCutoff"] = 0.3;
    EXPECT_NE(draw(builder, plainView(RenderShow::normals)).center(), kBackgroundPixel);
}

TEST(Render, NodesPlaceTheMesh) {
    GltfBuilder builder = SquareModel().build();
    // The mesh is drawn twice: once rotated by 90 degrees about y, so that only its edge is visible, and once mirrored
    // and moved.
    builder.json()["nodes"] = Json::parse(
        R"([{"children":[1,2],"translation":[5,0,0]},{"mesh":0,"rotation":[0,0.70710678,0,0.70710678]},
            {"mesh":0,"scale":[-1,1,1],"translation":[1,0,0]}])");
    builder.json()["scenes"] = Json::parse(R"([{"nodes":[0]}])");
    RenderOptions options = plainView(RenderShow::normals);
    const Drawn front = draw(builder, options);
    EXPECT_EQ(front.report.triangle_count, 4U);
    EXPECT_TRUE(isNearTo(front.center(), {128, 128, 255}, 1)) << "mirrored, its front is still its front";
    options.yaw_deg = 90;
    EXPECT_TRUE(isNearTo(draw(builder, options).center(), {255, 128, 128}, 1));
}

TEST(Render, ASkinIsDrawnInItsPose) {
    GltfBuilder builder = SquareModel().build();
    // The joint moves by (3, 0, 0), but the mesh was bound at this position, so it does not move. The mesh node's own
    // scale is ignored.
    const std::size_t bind =
        builder.addAccessor(std::vector<float>{0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 3, 0, 1}, 5126, "MAT4", 1);
    builder.json()["nodes"] = Json::parse(R"([{"mesh":0,"skin":0,"scale":[1,1,-1]},{"translation":[3,0,0]}])");
    builder.json()["skins"] = Json::array({Json{{"joints", {1}}, {"inverseBindMatrices", bind}}});
    builder.json()["scenes"] = Json::parse(R"([{"nodes":[0,1]}])");
    const Drawn drawn = draw(builder, plainView(RenderShow::tangents));
    EXPECT_TRUE(isNearTo(drawn.center(), {128, 255, 128}, 1)) << "the bind matrix turns x to y";
}

TEST(Render, ErrorIsTheAngleBetweenTheFrames) {
    SquareModel model;
    EXPECT_EQ(draw(model.build(), plainView(RenderShow::error)).report.max_error_deg, 0);
    for (std::size_t i = 0; i < model.tangents.size(); i += 4) {
        model.tangents[i] = std::cos(0.5f);
        model.tangents[i + 1] = std::sin(0.5f);
    }
    const RenderReport turned = draw(model.build(), plainView(RenderShow::error)).report;
    EXPECT_NEAR(turned.mean_error_deg, 0.5 * 180 / M_PI, 1e-4);
    EXPECT_NEAR(turned.max_error_deg, 0.5 * 180 / M_PI, 1e-4);
    EXPECT_GT(turned.error_sample_count, 3000U);
    SquareModel inverted;
    for (std::size_t i = 3; i < inverted.tangents.size(); i += 4) inverted.tangents[i] = -1;
    EXPECT_NEAR(draw(inverted.build(), plainView(RenderShow::error)).report.mean_error_deg, 180, 1e-4);
}

TEST(Render, MissingTangentsAreComputed) {
    SquareModel model;
    model.tangents.clear();
    GltfBuilder builder = model.build();
    RenderOptions options = plainView(RenderShow::tangents);
    const Drawn drawn = draw(builder, options);
    EXPECT_TRUE(isNearTo(drawn.center(), {255, 128, 128}, 1));
    EXPECT_EQ(drawn.report.computed_count, 1U);
    options.frames = RenderFrames::stored;
    EXPECT_EQ(draw(builder, options).report.without_tangents_count, 1U);
}

TEST(Render, TheUvMapShowsIslands) {
    const Drawn drawn = draw(mirroredPair().build(), plainView(RenderShow::uv));
    EXPECT_NE(drawn.center(), kBackgroundPixel);
    EXPECT_EQ(drawn.report.triangle_count, 4U);
}

TEST(Render, BytesDoNotDependOnThreads) {
    const Bytes model = sphere(30).build().glb();
    for (const RenderShow show : {RenderShow::lit, RenderShow::error, RenderShow::sign}) {
        RenderOptions options;
        options.show = show;
        options.width = 200;
        options.height = 120;
        std::vector<std::uint8_t> one, many;
        ASSERT_TRUE(renderTo(one, model, options).ok());
        options.execution.thread_count = 7;
        ASSERT_TRUE(renderTo(many, model, options).ok());
        EXPECT_EQ(one, many);
    }
}

TEST(Render, WritesAllOrNothing) {
    const TempFolder folder;
    const std::string good = folder.write("good.glb", std::span<const std::uint8_t>(SquareModel().build().glb()));
    const std::string bad = folder.write("bad.glb", std::string("glTF and no more"));
    RenderOptions options = plainView(RenderShow::lit);
    EXPECT_FALSE(renderFile(bad, folder.path("bad.png").string(), options));
    EXPECT_FALSE(folder.has("bad.png"));
    options.dry_run = true;
    EXPECT_TRUE(renderFile(good, folder.path("dry.png").string(), options));
    EXPECT_FALSE(folder.has("dry.png"));
    options.dry_run = false;
    EXPECT_TRUE(renderFile(good, folder.path("good.png").string(), options));
    EXPECT_TRUE(folder.has("good.png"));
}

TEST(Render, OptionsOutOfRangeAreRejected) {
    const Bytes model = SquareModel().build().glb();
    const auto errorWith = [&](const std::function<void(RenderOptions&)>& change) {
        RenderOptions options = plainView(RenderShow::lit);
        change(options);
        std::vector<std::uint8_t> png;
        const Result<RenderReport> report = renderTo(png, model, options);
        return report ? ErrorCode::ok : report.error().code;
    };
    EXPECT_EQ(errorWith([](RenderOptions& o) { o.width = 15; }), ErrorCode::invalidOption);
    EXPECT_EQ(errorWith([](RenderOptions& o) { o.height = 9000; }), ErrorCode::invalidOption);
    EXPECT_EQ(errorWith([](RenderOptions& o) { o.samples = 0; }), ErrorCode::invalidOption);
    EXPECT_EQ(errorWith([](RenderOptions& o) { o.yaw_deg = NAN; }), ErrorCode::invalidOption);
    EXPECT_EQ(errorWith([](RenderOptions& o) { o.to_light = {0, 0, 0}; }), ErrorCode::invalidOption);
    EXPECT_EQ(errorWith([](RenderOptions& o) { o.field_of_view_deg = 121; }), ErrorCode::invalidOption);
}

}  // namespace
}  // namespace tspace::test
