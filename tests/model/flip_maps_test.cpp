// SPDX-License-Identifier: MIT
// generate with flip_green: inverting normal maps of models, wherever the maps are stored.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "images/image.h"
#include "images/images.h"
#include "model/gltf/read_scene.h"
#include "model/gltf_builder.h"
#include "model/read/read_scene.h"
#include "support/temp_folder.h"
#include "tspace/check.h"
#include "tspace/generate.h"
#include "tspace/result.h"

namespace tspace::test {
namespace {

const RgbImage& upMap() {
    static const RgbImage map = normalMapOf(256, bumps);
    return map;
}
const RgbImage& downMap() {
    static const RgbImage map = normalMapOf(256, bumps, true);
    return map;
}

/// Returns a model with a square that covers the whole image, and material 0. `sign`: of its tangents; 1 is correct in
/// glTF.
GltfBuilder square(float sign = 1) {
    GltfBuilder builder;
    const std::size_t indices = builder.addAccessor(std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}, 5125, "SCALAR", 6);
    std::vector<float> normals, tangents;
    for (int i = 0; i < 4; ++i) {
        normals.insert(normals.end(), {0, 0, 1});
        tangents.insert(tangents.end(), {1, 0, 0, sign});
    }
    Json& primitive = builder.addPrimitive({{"POSITION", builder.addFloats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 3)},
                                            {"NORMAL", builder.addFloats(normals, 3)},
                                            {"TANGENT", builder.addFloats(tangents, 4)},
                                            {"TEXCOORD_0", builder.addFloats({0, 1, 1, 1, 1, 0, 0, 0}, 2)}});
    primitive["indices"] = indices;
    primitive["material"] = 0;
    builder.json()["textures"] = Json::parse(R"([{"source":0}])");
    builder.json()["materials"] = Json::parse(R"([{"normalTexture":{"index":0}}])");
    builder.json()["images"] = Json::array({Json::object()});
    return builder;
}

void embed(GltfBuilder& builder, std::size_t image, const std::string& file, const char* type) {
    builder.json()["images"][image]["bufferView"] = builder.addView(toBytes(file));
    builder.json()["images"][image]["mimeType"] = type;
}

GenerateReport generate(const std::string& input, const std::string& output, GenerateOptions options = {}) {
    if (options.maps.flip_green == FlipGreen::none) options.maps.flip_green = FlipGreen::down;
    Result<GenerateReport> report = generateFile(input, output, options);
    EXPECT_TRUE(report) << report.error().message;
    return report ? *std::move(report) : GenerateReport{};
}

std::multiset<std::string> codes(const std::string& file) {
    std::multiset<std::string> result;
    const Result<CheckReport> report = checkFile(file);
    EXPECT_TRUE(report) << report.error().message;
    if (!report) return result;
    for (const Finding& finding : report->findings) result.insert(findingName(finding.code));
    return result;
}
using Codes = std::multiset<std::string>;

/// Returns the bytes of an image that is embedded in a GLB.
Bytes imageOf(const std::string& file, std::size_t image) {
    const gltf::Document document = gltf::loadDocument(file, {});
    EXPECT_TRUE(document.json["images"][image].contains("bufferView"));
    return gltf::tryReadImage(document, image);
}

RgbImage pixelsOf(const Bytes& file) {
    std::string why;
    const std::optional<RgbImage> image = decodeImage(file, 1 << 22, why);
    EXPECT_TRUE(image) << why;
    return image.value_or(RgbImage{});
}

RgbImage inverted(RgbImage image) {
    for (std::size_t i = 1; i < image.rgb.size(); i += 3) image.rgb[i] ^= 0xff;
    return image;
}

TEST(FlipMaps, FixesFindingsOfCheckInAGlb) {
    const TempFolder folder;
    for (const auto& [file, type] : {std::pair(pngFile(downMap()), "image/png"),
                                     {webpFile(downMap(), true), "image/webp"},
                                     {jpegFile(downMap(), 95), "image/jpeg"}}) {
        GltfBuilder builder = square();
        embed(builder, 0, file, type);
        if (std::string(type) == "image/webp") {
            builder.json()["textures"][0] = Json::parse(R"({"extensions":{"EXT_texture_webp":{"source":0}}})");
            builder.json()["extensionsUsed"] = builder.json()["extensionsRequired"] = {"EXT_texture_webp"};
        }
        const std::string in = folder.write("in.glb", builder.glb()), out = folder.path("out.glb").string();
        ASSERT_TRUE(codes(in).contains("greenFlipped")) << type;
        const GenerateReport report = generate(in, out);
        ASSERT_EQ(report.normal_maps.size(), 1u);
        EXPECT_TRUE(report.normal_maps[0].flipped && report.changed);
        EXPECT_FALSE(codes(out).contains("greenFlipped")) << type;
        if (std::string(type) != "image/jpeg") {
            EXPECT_EQ(pixelsOf(imageOf(out, 0)).rgb, inverted(downMap()).rgb);
        }
        const gltf::Document before = gltf::loadDocument(in, {}), after = gltf::loadDocument(out, {});
        EXPECT_EQ(after.json["images"].size(), 1u);
        EXPECT_EQ(after.json["images"][0]["mimeType"], type);
        EXPECT_EQ(after.json["bufferViews"].size(), before.json["bufferViews"].size()) << "in the place of the old one";
        EXPECT_EQ(after.json["textures"], before.json["textures"]);
    }
}

TEST(FlipMaps, KeepsMapsThatPointUpByteForByte) {
    const TempFolder folder;
    GltfBuilder builder = square();
    embed(builder, 0, pngFile(upMap()), "image/png");
    const std::string in = folder.write("in.glb", builder.glb());
    const GenerateReport report = generate(in, folder.path("out.glb").string());
    EXPECT_FALSE(report.changed);
    ASSERT_EQ(report.normal_maps.size(), 1u);
    EXPECT_EQ(report.normal_maps[0].reason, "green points up already");
    EXPECT_EQ(folder.read("in.glb"), folder.read("out.glb"));
    EXPECT_TRUE(
        generate(in, folder.path("all.glb").string(), {.maps = {.flip_green = FlipGreen::all}}).normal_maps[0].flipped);
    EXPECT_TRUE(codes(folder.path("all.glb").string()).contains("greenFlipped"));
}

TEST(FlipMaps, KeepsMapsThatInvertedSignsCancel) {
    const TempFolder folder;
    GltfBuilder builder = square(-1);
    embed(builder, 0, pngFile(downMap()), "image/png");
    const std::string in = folder.write("in.glb", builder.glb()), out = folder.path("out.glb").string();
    const GenerateReport kept = generate(in, out);
    EXPECT_FALSE(kept.changed || kept.normal_maps[0].flipped);
    EXPECT_NE(kept.normal_maps[0].reason.find("cancel out"), std::string::npos);
    // If only normals are recomputed, tangents keep their inverted signs.
    GenerateOptions normals;
    normals.normals.overwrite = true;
    EXPECT_FALSE(generate(in, out, normals).normal_maps[0].flipped);
    EXPECT_EQ(codes(out), codes(in));
    const GenerateReport both = generate(in, out, {.selection = {.existing = ExistingTangents::replace}});
    EXPECT_TRUE(both.normal_maps[0].flipped);
    EXPECT_EQ(codes(out), Codes{});
}

/// The map is correct for one mesh but not for the other. It is kept, because the mesh that renders correctly must stay
/// correct.
TEST(FlipMaps, KeepsMapsThatMatchSomeMeshes) {
    const TempFolder folder;
    GltfBuilder builder = square(-1);
    embed(builder, 0, pngFile(downMap()), "image/png");
    Json right = builder.json()["meshes"][0]["primitives"][0];
    right["attributes"]["TANGENT"] = builder.addFloats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, 4);
    builder.json()["meshes"][0]["primitives"].push_back(right);
    const std::string in = folder.write("in.glb", builder.glb()), out = folder.path("out.glb").string();
    for (const ExistingTangents existing : {ExistingTangents::keep, ExistingTangents::repair}) {
        const GenerateReport report = generate(in, out, {.selection = {.existing = existing}});
        EXPECT_FALSE(report.changed || report.normal_maps[0].flipped);
        EXPECT_NE(report.normal_maps[0].reason.find("cancel out"), std::string::npos);
    }
    generate(in, out, {.selection = {.existing = ExistingTangents::replace}});
    EXPECT_EQ(codes(out), Codes{});
}

TEST(FlipMaps, KeepsMapsThatMatchTheConvention) {
    const TempFolder folder;
    GltfBuilder builder = square();
    embed(builder, 0, pngFile(downMap()), "image/png");
    const std::string in = folder.write("in.glb", builder.glb()), out = folder.path("out.glb").string();
    GenerateOptions options{.selection = {.existing = ExistingTangents::replace}};
    options.tangents.compute.convention = conventions::directx;
    const GenerateReport report = generate(in, out, options);
    EXPECT_FALSE(report.normal_maps[0].flipped);
    EXPECT_NE(report.normal_maps[0].reason.find("convention"), std::string::npos);
}

TEST(FlipMaps, SeparatesTheImageFromItsOtherUses) {
    const TempFolder folder;
    GltfBuilder builder = square();
    embed(builder, 0, pngFile(downMap()), "image/png");
    builder.json()["materials"][0]["pbrMetallicRoughness"] = Json::parse(R"({"baseColorTexture":{"index":0}})");
    builder.json()["materials"].push_back(Json::parse(R"({"normalTexture":{"index":0,"scale":0.5}})"));
    const std::string in = folder.write("in.glb", builder.glb()), out = folder.path("out.glb").string();
    generate(in, out);
    EXPECT_FALSE(codes(out).contains("greenFlipped"));
    EXPECT_EQ(pixelsOf(imageOf(out, 0)).rgb, downMap().rgb) << "the base color";
    const Json json = gltf::loadDocument(out, {}).json;
    ASSERT_EQ(json["images"].size(), 2u);
    EXPECT_EQ(json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
    const Json& texture = json["materials"][0]["normalTexture"]["index"];
    EXPECT_EQ(json["textures"][texture.get<std::size_t>()]["source"], 1);
    EXPECT_EQ(json["materials"][1]["normalTexture"]["index"], texture) << "inverted once for both";
    EXPECT_EQ(json["materials"][1]["normalTexture"]["scale"], 0.5);
    EXPECT_EQ(pixelsOf(imageOf(out, 1)).rgb, inverted(downMap()).rgb);
}

TEST(FlipMaps, SeparatesBothFormatsOfATextureFromOtherUses) {
    const TempFolder folder;
    GltfBuilder builder = square();
    embed(builder, 0, pngFile(downMap()), "image/png");
    builder.json()["images"].push_back(Json::object());
    embed(builder, 1, webpFile(downMap(), true), "image/webp");
    builder.json()["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
    builder.json()["extensionsUsed"] = {"EXT_texture_webp"};
    builder.json()["materials"][0]["pbrMetallicRoughness"] = Json::parse(R"({"baseColorTexture":{"index":0}})");
    const std::string out = folder.path("out.glb").string();
    generate(folder.write("in.glb", builder.glb()), out);
    const Json json = gltf::loadDocument(out, {}).json;
    ASSERT_EQ(json["textures"].size(), 2u);
    EXPECT_EQ(json["textures"][0], builder.json()["textures"][0]) << "the base color";
    EXPECT_EQ(json["materials"][0]["normalTexture"]["index"], 1);
    const Json& own = json["textures"][1];
    for (const Json* source : {&own["source"], &own["extensions"]["EXT_texture_webp"]["source"]}) {
        EXPECT_EQ(pixelsOf(imageOf(out, source->get<std::size_t>())).rgb, inverted(downMap()).rgb);
    }
    for (const std::size_t image : {0, 1}) EXPECT_EQ(pixelsOf(imageOf(out, image)).rgb, downMap().rgb);
}

TEST(FlipMaps, InvertsBytesOnceThatSeveralImagesShare) {
    const TempFolder folder;
    GltfBuilder builder = square();
    embed(builder, 0, pngFile(downMap()), "image/png");
    Json second = builder.json()["images"][0];
    builder.json()["images"].push_back(second);
    builder.json()["textures"].push_back({{"source", 1}});
    builder.json()["materials"][0]["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"]["index"] = 1;
    const std::string in = folder.write("in.glb", builder.glb()), out = folder.path("out.glb").string();
    generate(in, out);
    EXPECT_FALSE(codes(out).contains("greenFlipped"));
    for (const std::size_t image : {0, 1}) EXPECT_EQ(pixelsOf(imageOf(out, image)).rgb, inverted(downMap()).rgb);
    EXPECT_LT(folder.read("out.glb").size(), folder.read("in.glb").size() + 3000) << "the bytes are there once";
}

TEST(FlipMaps, NeverChangesTheFilesOfTheUser) {
    const TempFolder folder;
    const std::string png = pngFile(downMap());
    folder.write("maps/n.png", png);
    GltfBuilder builder = square();
    builder.json()["images"][0]["uri"] = "maps/n.png";
    const std::string in = folder.write("in.gltf", builder.gltfText());
    for (const char* out : {"out.gltf", "elsewhere/out.gltf", "in.gltf"}) {
        const GenerateReport report = generate(in, folder.path(out).string());
        EXPECT_FALSE(codes(folder.path(out).string()).contains("greenFlipped")) << out;
        EXPECT_EQ(folder.read("maps/n.png"), png) << out;
        EXPECT_EQ(std::count(report.input_files.begin(), report.input_files.end(), folder.path("maps/n.png").string()),
                  1);
        EXPECT_TRUE(report.warnings.empty()) << report.warnings.front();
    }
    EXPECT_TRUE(folder.has("maps/n-green-up.png"));
    EXPECT_TRUE(folder.has("elsewhere/maps/n-green-up.png"));
    EXPECT_FALSE(folder.has("maps/n-green-up-2.png")) << "the same bytes need no second file";
}

TEST(FlipMaps, AvoidsNamesOfTheUsersFiles) {
    const TempFolder folder;
    folder.write("n.png", pngFile(downMap()));
    folder.write("n-green-up.png", "mine");
    GltfBuilder builder = square();
    builder.json()["images"][0]["uri"] = "n.png";
    const std::string out = folder.path("out.gltf").string();
    generate(folder.write("in.gltf", builder.gltfText()), out);
    EXPECT_EQ(folder.read("n-green-up.png"), "mine");
    EXPECT_TRUE(folder.has("n-green-up-2.png"));
    EXPECT_FALSE(codes(out).contains("greenFlipped"));
}

TEST(FlipMaps, FixesDataUrisAndFilesThatAGlbEmbeds) {
    const TempFolder folder;
    GltfBuilder builder = square();
    builder.json()["images"][0]["uri"] = encodeDataUri("image/png", toBytes(pngFile(downMap())));
    const std::string in = folder.write("in.gltf", builder.gltfText());
    for (const char* out : {"out.gltf", "out.glb"}) {
        generate(in, folder.path(out).string());
        EXPECT_EQ(codes(folder.path(out).string()), Codes{}) << out;
    }
    folder.write("n.png", pngFile(downMap()));
    builder.json()["images"][0]["uri"] = "n.png";
    generate(folder.write("b.gltf", builder.gltfText()), folder.path("b.glb").string());
    EXPECT_EQ(codes(folder.path("b.glb").string()), Codes{});
}

TEST(FlipMaps, EmbedsFilesIntoAGlbForAPipe) {
    const TempFolder folder;
    const std::string png = pngFile(downMap());
    folder.write("n.png", png);
    GltfBuilder builder = square();
    builder.json()["images"][0]["uri"] = "n.png";
    const std::string in = folder.write("in.glb", builder.glb());
    std::string piped;
    const GenerateReport report = generate(in, "stdout.glb", {.sink = [&](std::span<const std::uint8_t> bytes) {
                                               piped.append(bytes.begin(), bytes.end());
                                               return true;
                                           }});
    EXPECT_TRUE(report.warnings.empty()) << report.warnings.front();
    EXPECT_EQ(codes(folder.write("piped/out.glb", piped)), Codes{});
    generate(in, folder.path("b.glb").string());
    EXPECT_EQ(folder.read("b.glb"), piped);
    EXPECT_EQ(folder.read("n.png"), png);
    EXPECT_FALSE(folder.has("n-green-up.png"));
}

TEST(FlipMaps, WritesNothingInADryRunAndReportsChanges) {
    const TempFolder folder;
    folder.write("n.png", pngFile(downMap()));
    GltfBuilder builder = square();
    builder.json()["images"][0]["uri"] = "n.png";
    const std::string in = folder.write("in.gltf", builder.gltfText());
    const std::set<std::string> before = folder.files();
    const GenerateReport report = generate(in, folder.path("out.gltf").string(), {.dry_run = true});
    EXPECT_TRUE(report.normal_maps.at(0).flipped);
    EXPECT_EQ(
        std::count(report.output_files.begin(), report.output_files.end(), folder.path("n-green-up.png").string()), 1);
    EXPECT_EQ(folder.files(), before);
}

TEST(FlipMaps, KeepsAMapWhoseOtherFormatIsKept) {
    const TempFolder folder;
    GltfBuilder builder = square();
    embed(builder, 0, pngFile(downMap()), "image/png");
    builder.json()["images"].push_back(Json::object());
    embed(builder, 1, webpFile(upMap(), true), "image/webp");
    builder.json()["textures"] =
        Json::parse(R"([{"source":0,"extensions":{"EXT_texture_webp":{"source":1}}},{"source":1}])");
    builder.json()["extensionsUsed"] = {"EXT_texture_webp"};
    builder.json()["materials"][0]["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"]["index"] = 1;
    const GenerateReport report = generate(folder.write("in.glb", builder.glb()), folder.path("out.glb").string());
    for (const NormalMapReport& map : report.normal_maps) EXPECT_FALSE(map.flipped) << map.image << map.reason;
    EXPECT_FALSE(report.changed);
}

TEST(FlipMaps, InvertsBothFormatsOfATextureOrNeither) {
    const TempFolder folder;
    for (const bool is_webp : {true, false}) {
        GltfBuilder builder = square();
        embed(builder, 0, pngFile(downMap()), "image/png");
        builder.json()["images"].push_back(Json::object());
        const char* extension = is_webp ? "EXT_texture_webp" : "KHR_texture_basisu";
        embed(builder, 1, is_webp ? webpFile(downMap(), true) : "\xabKTX 20\xbb\r\n\x1a\n",
              is_webp ? "image/webp" : "image/ktx2");
        builder.json()["textures"][0]["extensions"][extension]["source"] = 1;
        builder.json()["extensionsUsed"] = {extension};
        const std::string in = folder.write("in.glb", builder.glb()), out = folder.path("out.glb").string();
        const GenerateReport report = generate(in, out);
        EXPECT_EQ(report.changed, is_webp);
        EXPECT_EQ(report.normal_maps[0].flipped, is_webp);
        if (is_webp) {
            EXPECT_EQ(pixelsOf(imageOf(out, 1)).rgb, inverted(downMap()).rgb);
        } else {
            EXPECT_NE(report.normal_maps[0].reason.find("KTX2"), std::string::npos);
        }
    }
}

TEST(FlipMaps, FixesMapsOfAnObj) {
    const TempFolder folder;
    const std::string png = pngFile(downMap());
    folder.write("m.mtl", "newmtl a\nnorm n.png\nmap_Kd n.png\n");
    folder.write("n.png", png);
    const std::string in = folder.write(
        "a.obj",
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nusemtl a\n"
        "f 1/1/1 2/2/1 3/3/1 4/4/1\n");
    ASSERT_TRUE(codes(in).contains("greenFlipped"));
    for (const char* out : {"out.glb", "out.gltf"}) {
        const GenerateReport report = generate(in, folder.path(out).string());
        ASSERT_EQ(report.normal_maps.size(), 1u);
        EXPECT_TRUE(report.normal_maps[0].flipped);
        EXPECT_EQ(codes(folder.path(out).string()), Codes{}) << out;
        EXPECT_EQ(folder.read("n.png"), png);
    }
}

TEST(FlipMaps, ExplainsWhyAMapIsUnchanged) {
    const TempFolder folder;
    GltfBuilder builder = square();
    embed(builder, 0, "not an image", "image/png");
    const GenerateReport report = generate(folder.write("in.glb", builder.glb()), folder.path("out.glb").string());
    ASSERT_EQ(report.normal_maps.size(), 1u);
    EXPECT_FALSE(report.changed);
    EXPECT_EQ(report.normal_maps[0].reason, "the map could not be examined (see tspace check)");
    const GenerateReport all = generate(folder.path("in.glb").string(), folder.path("out.glb").string(),
                                        {.maps = {.flip_green = FlipGreen::all}});
    EXPECT_EQ(all.normal_maps[0].reason, "the image is neither PNG, JPEG, WebP, EXR, KTX2, DDS nor TGA");
}

}  // namespace
}  // namespace tspace::test
