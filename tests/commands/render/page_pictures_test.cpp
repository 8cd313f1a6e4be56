// SPDX-License-Identifier: MIT
// Pictures for pages: angles between two models, and locations of findings before and after their remedies.
#include <cmath>

#include "commands/check/remedy.h"
#include "commands/pages/check_page.h"
#include "commands/pages/diff_page.h"
#include "commands/render/drawn.h"
#include "commands/shared/picture/colors.h"

namespace tspace::test {
namespace {

RgbImage decoded(const std::vector<std::uint8_t>& png) {
    std::string why;
    const auto image = decodeImage(png, 1 << 26, why);
    EXPECT_TRUE(image.has_value()) << why;
    return image.value_or(RgbImage{});
}

FileOptions inMemory(const Bytes& file) {
    FileOptions options;
    options.content = file;
    return options;
}

/// Returns the square with T rotated by an angle, and the given sign.
SquareModel turnedSquare(double degrees, float sign = 1) {
    SquareModel model;
    const double a = degrees * M_PI / 180;
    for (std::size_t i = 0; i < model.tangents.size(); i += 4) {
        model.tangents[i] = static_cast<float>(std::cos(a));
        model.tangents[i + 1] = static_cast<float>(std::sin(a));
        model.tangents[i + 3] = sign;
    }
    return model;
}

/// Checks that the center of the heat map of two models has the color of `degrees`, except for its brightness.
void expectHeat(const SquareModel& a, const SquareModel& b, float degrees) {
    const Bytes file_a = a.build().glb(), file_b = b.build().glb();
    DiffOptions options{.file = inMemory(file_a), .file_b = inMemory(file_b)};
    DiffPictures pictures("a.glb", "b.glb", options);
    const RgbImage image = decoded(pictures.heatMap(DiffPictures::Side::front));
    ASSERT_EQ(image.width, DiffPictures::kHeatWidth);
    // The legend takes some rows at the bottom. The square is symmetric, so it is around the center of the other rows.
    const std::size_t i = 3 * (std::size_t{image.height / 2 - 10} * image.width + image.width / 2);
    const Vec3 expected = heatColor(degrees);
    // Inclined surfaces are darker: all channels are multiplied by the same factor.
    const double factor = image.rgb[i + 2] / (255.0 * expected.z);
    EXPECT_GT(factor, 0.7);
    EXPECT_LE(factor, 1.01);
    EXPECT_NEAR(image.rgb[i] / 255.0, factor * expected.x, 0.01);
    EXPECT_NEAR(image.rgb[i + 1] / 255.0, factor * expected.y, 0.01);
}

TEST(DiffPictures, ShowTheLargestAngle) {
    expectHeat(turnedSquare(0), turnedSquare(0), 0);
    expectHeat(turnedSquare(0), turnedSquare(30), 30);
    expectHeat(turnedSquare(10), turnedSquare(0), 10);
}

TEST(DiffPictures, ASignIsShownByItsEffectOnB) { expectHeat(turnedSquare(0), turnedSquare(0, -1), 180); }

TEST(DiffPictures, NormalsAreCompared) {
    SquareModel a, b;
    a.tangents.clear();
    b.tangents.clear();
    const auto s = static_cast<float>(std::sin(20 * M_PI / 180)), c = static_cast<float>(std::cos(20 * M_PI / 180));
    b.normals = {s, 0, c, s, 0, c, s, 0, c, s, 0, c};
    expectHeat(a, b, 20);
}

TEST(DiffPictures, TrianglesAreComparedWithTheirPartners) {
    SquareModel b = turnedSquare(30);
    b.indices = {3, 0, 2, 1, 2, 0};
    expectHeat(turnedSquare(0), b, 30);
}

TEST(DiffPictures, IncomparableSurfacesAreGray) {
    SquareModel without;
    without.tangents.clear();
    const Bytes file_a = SquareModel().build().glb(), file_b = without.build().glb();
    DiffPictures pictures("a.glb", "b.glb", {.file = inMemory(file_a), .file_b = inMemory(file_b)});
    const RgbImage image = decoded(pictures.heatMap(DiffPictures::Side::front));
    const std::size_t i = 3 * (std::size_t{image.height / 2 - 10} * image.width + image.width / 2);
    EXPECT_EQ(image.rgb[i], image.rgb[i + 1]);
    EXPECT_EQ(image.rgb[i], image.rgb[i + 2]);
}

TEST(DiffPictures, ALocationIsAPictureOfItsModel) {
    const Bytes file_a = SquareModel().build().glb(), file_b = turnedSquare(30).build().glb();
    DiffPictures pictures("a.glb", "b.glb", {.file = inMemory(file_a), .file_b = inMemory(file_b)});
    const DiffPictures::Place place = pictures.place({.vertex_a = 1, .vertex_b = 1});
    EXPECT_FALSE(place.a.empty());
    EXPECT_EQ(place.a, place.b) << "without a normal map the frames shade the same";
    EXPECT_FALSE(place.angle.empty());
    EXPECT_TRUE(pictures.place({.mesh_a = 7}).a.empty());
}

TEST(Remedy, CommandsAreOptionsOfGenerate) {
    const auto repair = optionsOf(usualRemedy(FindingCode::signsInverted).commands.at(0));
    ASSERT_TRUE(repair);
    EXPECT_EQ(repair->selection.existing, ExistingTangents::repair);
    EXPECT_EQ(repair->tangents.faces, Faces::automatic) << "as on the command line";
    const auto plain = optionsOf(usualRemedy(FindingCode::tangentsIgnored).commands.at(0));
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->selection.existing, ExistingTangents::keep);
    const auto other = optionsOf(toCommand("generate --overwrite --convention opengl"));
    ASSERT_TRUE(other);
    EXPECT_EQ(other->tangents.compute.convention.green, conventions::opengl.green);
    EXPECT_FALSE(optionsOf(toCommand("generate --pack"))) << "which format is left open";
    EXPECT_FALSE(optionsOf(toCommand("generate --pack FORMAT"))) << "which format is left open";
}

Finding findingAt(FindingCode code, const std::vector<std::uint32_t>& vertices) {
    Finding finding{.code = code, .place = "/meshes/0/primitives/0", .vertices = vertices};
    setRemedy(finding, usualRemedy(code));
    return finding;
}

Bytes mapped(const SquareModel& square) {
    GltfBuilder builder = square.build();
    builder.json()["materials"][0]["normalTexture"] = {{"index", addTexture(builder, plainImage(200, 90, 200))}};
    return builder.glb();
}

FindingPicture pictureOf(const Bytes& file, const Finding& finding) {
    return FindingPictures("a.glb", inMemory(file)).draw(finding);
}

/// Returns the number of pixels in which two pictures differ visibly.
std::size_t differingPixels(const RgbImage& a, const RgbImage& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i + 2 < std::min(a.rgb.size(), b.rgb.size()); i += 3) {
        int most = 0;
        for (std::size_t c = i; c < i + 3; ++c) most = std::max(most, std::abs(a.rgb[c] - b.rgb[c]));
        count += most >= 12;
    }
    return count;
}

TEST(FindingPictures, ShowWhatRepairChanges) {
    // T is also rotated slightly, which is not a finding: repair changes only the sign.
    const Finding finding = findingAt(FindingCode::signsInverted, {0, 1, 2, 3});
    const FindingPicture picture = pictureOf(mapped(turnedSquare(8, -1)), finding);
    EXPECT_EQ(picture.command, "tspace generate --repair");
    const RgbImage before = decoded(picture.before), after = decoded(picture.after),
                   difference = decoded(picture.difference);
    EXPECT_GT(differingPixels(before, after), before.rgb.size() / 3 / 10) << "a tenth of the picture";
    ASSERT_EQ(difference.rgb.size(), before.rgb.size());
    std::size_t bright = 0;
    for (std::size_t i = 0; i < difference.rgb.size(); i += 3) bright += difference.rgb[i] >= 12;
    EXPECT_GE(bright, differingPixels(before, after));
    EXPECT_EQ(picture.caption.rfind("difference", 0), 0U) << picture.caption;
}

TEST(FindingPictures, AreOmittedIfNothingIsVisible) {
    const FindingPicture same = pictureOf(mapped(turnedSquare(8, 1)), findingAt(FindingCode::signsInverted, {0}));
    EXPECT_TRUE(same.before.empty() && same.after.empty() && same.difference.empty());
}

TEST(FindingPictures, CountOnlyDifferencesOfTheirPrimitive) {
    // Two adjacent squares with inverted signs: one without relief, where nothing is visible, and one with relief.
    GltfBuilder builder = turnedSquare(0, -1).build();
    SquareModel other = turnedSquare(0, -1);
    for (std::size_t i = 0; i < other.positions.size(); i += 3) other.positions[i] += 2;
    Json& primitive = builder.addPrimitive({{"POSITION", builder.addFloats(other.positions, 3)},
                                            {"NORMAL", builder.addFloats(other.normals, 3)},
                                            {"TANGENT", builder.addFloats(other.tangents, 4)},
                                            {"TEXCOORD_0", builder.addFloats(other.uvs, 2)}});
    primitive["indices"] = builder.addAccessor(other.indices, 5125, "SCALAR", other.indices.size());
    primitive["material"] = 1;
    builder.json()["materials"] = Json::parse("[{}, {}]");
    builder.json()["materials"][0]["normalTexture"] = {{"index", addTexture(builder, plainImage(128, 128, 255))}};
    builder.json()["materials"][1]["normalTexture"] = {{"index", addTexture(builder, plainImage(200, 90, 200))}};
    const Bytes file = builder.glb();
    EXPECT_TRUE(pictureOf(file, findingAt(FindingCode::signsInverted, {1, 2})).before.empty());
    Finding with_relief = findingAt(FindingCode::signsInverted, {0, 3});
    with_relief.primitive = 1;
    EXPECT_FALSE(pictureOf(file, with_relief).before.empty());
}

TEST(FindingPictures, OmitColorsThatHideTheDifference) {
    // Colors that hide differences: one that is nearly black, and blue, whose brightness people hardly see.
    for (const auto& color : {Json{0.004, 0.004, 0.004, 1}, Json{0, 0, 1, 1}}) {
        GltfBuilder builder = turnedSquare(0, -1).build();
        builder.json()["materials"][0]["normalTexture"] = {{"index", addTexture(builder, plainImage(200, 90, 200))}};
        builder.json()["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = color;
        const FindingPicture picture = pictureOf(builder.glb(), findingAt(FindingCode::signsInverted, {0, 1, 2, 3}));
        EXPECT_TRUE(picture.is_clay) << color;
        EXPECT_GT(differingPixels(decoded(picture.before), decoded(picture.after)), 5000U) << color;
    }
}

TEST(FindingPictures, ShowTheSideThatIsVisibleAfterTheFix) {
    SquareModel square = turnedSquare(0);
    for (std::size_t i = 0; i < square.indices.size(); i += 3) std::swap(square.indices[i], square.indices[i + 1]);
    for (const std::vector<std::uint32_t>& vertices : {std::vector<std::uint32_t>{0, 1, 2, 3}, {}}) {
        Finding finding = findingAt(FindingCode::normalsAgainstWinding, vertices);
        setRemedy(finding, {"Reverse the winding: {}.", {toCommand("generate --fix-winding")}});
        const FindingPicture picture = pictureOf(mapped(square), finding);
        ASSERT_FALSE(picture.after.empty()) << picture.why_no_after;
        const RgbImage after = decoded(picture.after);
        RgbImage background = after;
        fillRect(background, 0, 0, after.width, after.height, kBackground);
        EXPECT_GT(differingPixels(after, background), 5000U);
    }
}

TEST(FindingPictures, ShowLocationsBehindOtherSurfaces) {
    // A square behind a plate that faces it and is ten times as large. The square is visible only if the plate is not
    // drawn.
    GltfBuilder builder = turnedSquare(0).build();
    SquareModel plate;
    for (std::size_t i = 0; i < plate.positions.size(); i += 3) {
        plate.positions[i] *= 10;
        plate.positions[i + 1] *= 10;
        plate.positions[i + 2] = 0.01f;
    }
    Json& primitive = builder.addPrimitive(
        {{"POSITION", builder.addFloats(plate.positions, 3)}, {"NORMAL", builder.addFloats(plate.normals, 3)}});
    primitive["indices"] = builder.addAccessor(plate.indices, 5125, "SCALAR", plate.indices.size());
    primitive["material"] = 1;
    builder.json()["materials"] = Json::parse(
        R"([{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}},
            {"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 1, 1]}}])");
    const RgbImage image = decoded(pictureOf(builder.glb(), findingAt(FindingCode::uvsDegenerate, {0})).before);
    std::size_t red = 0, blue = 0;
    for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3) {
        red += image.rgb[i] > 100 && image.rgb[i + 1] < 20 && image.rgb[i + 2] < 20;
        blue += image.rgb[i + 2] > 100 && image.rgb[i] < 20 && image.rgb[i + 1] < 20;
    }
    EXPECT_GT(red, 2000U);
    EXPECT_EQ(blue, 0U);
}

TEST(FindingPictures, ShowAMapWithItsGreenTurned) {
    Finding finding = findingAt(FindingCode::greenFlipped, {});
    setRemedy(finding, {"Invert it: {}.", {toCommand("generate --flip-green-all")}});
    const FindingPicture picture = pictureOf(mapped(SquareModel()), finding);
    EXPECT_GT(differingPixels(decoded(picture.before), decoded(picture.after)), 5000U);
}

TEST(FindingPictures, ExplainAMissingSecondPicture) {
    const Bytes good = mapped(SquareModel());
    const FindingPicture nothing = pictureOf(good, findingAt(FindingCode::signsWrong, {0}));
    EXPECT_TRUE(nothing.after.empty());
    EXPECT_EQ(nothing.why_no_after, "The fix changes nothing that is visible in this picture.");
    const FindingPicture none = pictureOf(good, findingAt(FindingCode::uvsDegenerate, {0}));
    EXPECT_FALSE(none.before.empty());
    EXPECT_EQ(none.command, "");
    const FindingPicture open = pictureOf(good, findingAt(FindingCode::packedFramesDiffer, {0}));
    EXPECT_EQ(open.why_no_after, "The command contains a value that must be chosen.");
}

}  // namespace
}  // namespace tspace::test
