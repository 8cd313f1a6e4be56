// SPDX-License-Identifier: MIT
// generate with convert_maps: with the new tangents and the new maps, a model renders as before.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "commands/shared/uv_reading.h"
#include "images/float_image.h"
#include "images/images.h"
#include "maps/texels/shading.h"
#include "maps/texels/texture_sample.h"
#include "model/gltf_builder.h"
#include "model/read/read_scene.h"
#include "support/shared_data.h"
#include "support/temp_folder.h"
#include "tspace/generate.h"
#include "tspace/normals.h"
#include "tspace/result.h"
#include "tspace/tangents.h"

namespace tspace::test {
namespace {

/// A bent sheet of `cells` x `cells` quads with uneven UVs inside a rectangle. Its normals are those of the surface.
struct Sheet {
    unsigned seed = 1;
    int cells = 4;
    double bend = 0.3;
    Vec2 first{0, 0}, last{1, 1};  ///< corners of the UV rectangle
};

struct SheetArrays {
    std::vector<float> positions, normals, uvs;
    std::vector<std::uint32_t> indices;
};

SheetArrays arraysOf(const Sheet& sheet) {
    std::mt19937 random(sheet.seed);
    std::uniform_real_distribution<double> jitter(-0.25, 0.25);
    SheetArrays arrays;
    const auto vertices = static_cast<std::uint32_t>(sheet.cells + 1);
    for (std::uint32_t row = 0; row < vertices; ++row) {
        for (std::uint32_t column = 0; column < vertices; ++column) {
            const auto inside = [&](std::uint32_t at) { return at > 0 && at + 1 < vertices ? jitter(random) : 0.0; };
            const double u = (column + inside(column)) / sheet.cells, v = (row + inside(row)) / sheet.cells;
            const double x = static_cast<double>(column) / sheet.cells, y = static_cast<double>(row) / sheet.cells;
            const auto add = [](std::vector<float>& to, std::initializer_list<double> values) {
                for (const double value : values) to.push_back(static_cast<float>(value));
            };
            add(arrays.positions, {x, y, sheet.bend * std::sin(3 * x) * std::cos(2 * y)});
            DVec3 normal{-3 * sheet.bend * std::cos(3 * x) * std::cos(2 * y),
                         2 * sheet.bend * std::sin(3 * x) * std::sin(2 * y), 1};
            normalize(normal);
            add(arrays.normals, {normal.x, normal.y, normal.z});
            add(arrays.uvs, {sheet.first.x + (sheet.last.x - sheet.first.x) * u,
                             sheet.last.y + (sheet.first.y - sheet.last.y) * v});
            if (row == 0 || column == 0) continue;
            const std::uint32_t here = row * vertices + column, above = here - vertices;
            for (const std::uint32_t index : {above - 1, above, here, above - 1, here, here - 1})
                arrays.indices.push_back(index);
        }
    }
    return arrays;
}

/// Adds a mesh for the sheet, with a node and the material.
void addSheet(GltfBuilder& builder, const Sheet& sheet, int material) {
    const SheetArrays arrays = arraysOf(sheet);
    Json& json = builder.json();
    const Json attributes = {{"POSITION", builder.addFloats(arrays.positions, 3)},
                             {"NORMAL", builder.addFloats(arrays.normals, 3)},
                             {"TEXCOORD_0", builder.addFloats(arrays.uvs, 2)}};
    const std::size_t indices = builder.addAccessor(arrays.indices, 5125, "SCALAR", arrays.indices.size());
    if (!json.contains("meshes")) json["meshes"] = Json::array();
    Json primitive = {{"attributes", attributes}, {"indices", indices}, {"material", material}};
    json["meshes"].push_back(Json{{"primitives", Json::array({primitive})}});
    if (!json.contains("nodes")) json["nodes"] = Json::array();
    json["nodes"].push_back(Json{{"mesh", json["meshes"].size() - 1}});
}

FloatImage mapOf(std::uint32_t size, unsigned bits) {
    const RgbImage heights = normalMapOf(size, bumps);
    FloatImage image{size, size, bits, std::vector<Vec3>(std::size_t{size} * size), {}};
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        DVec3 normal{heights.rgb[3 * i] / 127.5 - 1, heights.rgb[3 * i + 1] / 127.5 - 1,
                     heights.rgb[3 * i + 2] / 127.5 - 1};
        normalize(normal);
        image.texels[i] = toFloat(DVec3{0.5 * normal.x + 0.5, 0.5 * normal.y + 0.5, 0.5 * normal.z + 0.5});
    }
    return image;
}

Bytes fileOf(const FloatImage& image) {
    const auto file = encodePng(image, image.bits);
    return Bytes(file->begin(), file->end());
}

void embedMap(GltfBuilder& builder, unsigned bits, const char* materials = R"([{"normalTexture":{"index":0}}])") {
    const Bytes file = fileOf(mapOf(64, bits));
    Json& json = builder.json();
    json["images"] =
        Json::array({Json{{"bufferView", builder.addView(file)}, {"mimeType", "image/png"}, {"name", "bumps"}}});
    json["textures"] = Json::parse(R"([{"source":0}])");
    json["materials"] = Json::parse(materials);
}

/// Returns the shading normals at points of each triangle of each primitive, with bilinear filtering of the normal map.
std::vector<std::vector<DVec3>> pictureOf(const std::string& file) {
    const DrawnScene drawn = readDrawnScene(file, {}, true);
    std::vector<std::vector<DVec3>> picture;
    for (std::size_t p = 0; p < drawn.scene.primitives.size(); ++p) {
        const ScenePrimitive& primitive = drawn.scene.primitives[p];
        std::vector<DVec3>& shaded = picture.emplace_back();
        if (!drawn.looks[p].normal_texture || primitive.corners.empty() || primitive.tangents.empty()) continue;
        const TextureReading& texture = *drawn.looks[p].normal_texture;
        std::string why;
        const auto image = decodeFloatImage(drawn.scene.images[*texture.image].bytes, 1 << 26, why);
        if (!image) continue;
        const std::vector<Vec2> uvs = textureUvs(primitive.uv_sets[texture.uv_set].span(), texture.transform);
        const MapReading reading{.scale = static_cast<float>(drawn.looks[p].normal_scale)};
        const TextureShape shape{image->width, image->height, texture.wrap_u, texture.wrap_v};
        const std::size_t triangles = primitive.corners.size() / 3, step = triangles / 20000 + 1;
        for (std::size_t t = 0; t < triangles; t += step) {
            for (const std::array<double, 3>& weights : {std::array{0.5, 0.3, 0.2}, {0.1, 0.2, 0.7}, {0.3, 0.6, 0.1}}) {
                CornerFrames corners;
                Vec2 uv{};
                for (std::size_t i = 0; i < 3; ++i) {
                    const std::uint32_t vertex = primitive.corners[3 * t + i];
                    corners.normals[i] = primitive.normals[vertex];
                    corners.tangents[i] = primitive.tangents[vertex];
                    const auto weight = static_cast<float>(weights[i]);
                    uv = {uv.x + weight * uvs[vertex].x, uv.y + weight * uvs[vertex].y};
                }
                const Vec3 texel = sampleBilinear(shape, image->texels, uv);
                shaded.push_back(shadedNormal(shadingFrame(corners, weights, reading), decodeTexel(texel, reading)));
            }
        }
    }
    return picture;
}

double meanApart(const std::vector<DVec3>& a, const std::vector<DVec3>& b) {
    EXPECT_EQ(a.size(), b.size());
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        const double degrees = degreesBetween(a[i], b[i]);
        if (!std::isfinite(degrees)) continue;
        sum += degrees;
        ++count;
    }
    return count == 0 ? 0 : sum / static_cast<double>(count);
}

/// Report of a conversion, and differences between the shading of a model before and after it.
struct Converted {
    GenerateReport report = {};
    std::vector<double> off = {}, unconverted = {};  ///< mean error per primitive, with the new and the old map
};

Converted convertedModel(const TempFolder& folder, const std::string& input, GenerateOptions options) {
    const auto path = [&](const char* name) { return folder.path(name).string(); };
    options.selection.existing = ExistingTangents::replace;
    GenerateOptions first{.selection = {.all = true, .existing = options.selection.existing}};
    EXPECT_TRUE(generateFile(input, path("before.glb"), first));
    EXPECT_TRUE(generateFile(path("before.glb"), path("plain.glb"), options));
    options.maps.convert = true;
    Result<GenerateReport> report = generateFile(path("before.glb"), path("after.glb"), options);
    EXPECT_TRUE(report) << report.error().message;
    Converted made{.report = report ? *std::move(report) : GenerateReport{}};
    const auto before = pictureOf(path("before.glb")), after = pictureOf(path("after.glb")),
               plain = pictureOf(path("plain.glb"));
    EXPECT_EQ(before.size(), after.size());
    for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
        made.off.push_back(meanApart(before[i], after[i]));
        made.unconverted.push_back(meanApart(before[i], plain[i]));
    }
    return made;
}

Json jsonOf(const TempFolder& folder, const std::string& file) {
    return gltf::loadDocument(folder.path(file).string(), {}).json;
}

GenerateOptions methodOptions(Method method) {
    GenerateOptions options;
    options.tangents.compute.method = method;
    return options;
}

TEST(ConvertMaps, KeepThePicture) {
    // With 8 bits the old texels are not exact either: half a step is 0.22 degrees.
    for (const auto& [bits, most] : {std::pair{16U, 0.02}, {8U, 0.12}}) {
        for (const Method method : {Method::best, Method::lengyel, Method::area}) {
            const TempFolder folder;
            GltfBuilder builder;
            addSheet(builder, {}, 0);
            embedMap(builder, bits);
            const Converted made = convertedModel(folder, folder.write("in.glb", builder.glb()), methodOptions(method));
            ASSERT_EQ(made.report.converted_maps.size(), 1U);
            const ConvertedMapReport& map = made.report.converted_maps[0];
            EXPECT_TRUE(map.converted) << map.reason;
            EXPECT_EQ(map.bits, bits);
            EXPECT_EQ(map.name, "bumps");
            EXPECT_LT(made.off[0], most) << methodName(method);
            EXPECT_LT(made.off[0], 0.7 * made.unconverted[0]) << methodName(method);
            EXPECT_LT(map.mean_error_deg, most);
            const Json json = jsonOf(folder, "after.glb");
            EXPECT_EQ(json["images"].size(), 1U);
            EXPECT_EQ(json["textures"].size(), 1U);
        }
    }
}

RC_GTEST_PROP(ConvertMaps, KeepThePictureOfAnySheet, ()) {
    const TempFolder folder;
    GltfBuilder builder;
    Sheet sheet{.seed = *rc::gen::inRange(1U, 1000U), .cells = *rc::gen::inRange(2, 6)};
    sheet.bend = *rc::gen::inRange(0, 60) / 100.0;
    const bool is_mirrored = *rc::gen::arbitrary<bool>();
    if (is_mirrored) std::swap(sheet.first.x, sheet.last.x);
    addSheet(builder, sheet, 0);
    embedMap(builder, 16);
    builder.json()["materials"][0]["normalTexture"]["scale"] = *rc::gen::inRange(5, 20) / 10.0;
    const Method method = *rc::gen::element(Method::best, Method::uniform, Method::fast);
    const Converted made = convertedModel(folder, folder.write("in.glb", builder.glb()), methodOptions(method));
    RC_ASSERT(made.report.converted_maps.size() <= 1U);
    RC_ASSERT(made.off[0] <= std::max(0.03, 0.1 * made.unconverted[0]));
}

TEST(ConvertMaps, SplitsAMapThatSeveralMeshesNeedInDifferentWays) {
    const TempFolder folder;
    GltfBuilder builder;
    addSheet(builder, {.seed = 1}, 0);
    addSheet(builder, {.seed = 2, .bend = -0.4}, 0);
    addSheet(builder, {.seed = 3, .bend = 0.1}, 1);
    addSheet(builder, {.seed = 1}, 1);  // the first sheet again
    embedMap(builder, 16,
             R"([{"name":"a","normalTexture":{"index":0}},{"name":"b","normalTexture":{"index":0,"scale":1}}])");
    const Converted made = convertedModel(folder, folder.write("in.glb", builder.glb()), methodOptions(Method::best));
    ASSERT_EQ(made.report.converted_maps.size(), 3U);
    for (const double off : made.off) EXPECT_LT(off, 0.02);
    for (const double unconverted : made.unconverted) EXPECT_GT(unconverted, 0.04);
    const Json json = jsonOf(folder, "after.glb");
    const auto image_of = [&](std::size_t mesh) {
        const Json& material = json["materials"][json["meshes"][mesh]["primitives"][0]["material"].get<std::size_t>()];
        return json["textures"][material["normalTexture"]["index"].get<std::size_t>()]["source"].get<std::size_t>();
    };
    EXPECT_EQ(image_of(0), image_of(3));
    EXPECT_NE(image_of(0), image_of(1));
    EXPECT_NE(image_of(0), image_of(2));
    EXPECT_NE(image_of(1), image_of(2));
}

TEST(ConvertMaps, MakesOneMapForMeshesThatUseSeparateTexels) {
    const TempFolder folder;
    GltfBuilder builder;
    addSheet(builder, {.seed = 1, .first = {0, 0}, .last = {0.45F, 1}}, 0);
    addSheet(builder, {.seed = 2, .first = {0.55F, 0}, .last = {1, 1}}, 1);
    embedMap(builder, 16, R"([{"normalTexture":{"index":0}},{"normalTexture":{"index":0}}])");
    const Converted made = convertedModel(folder, folder.write("in.glb", builder.glb()), methodOptions(Method::best));
    ASSERT_EQ(made.report.converted_maps.size(), 1U);
    EXPECT_EQ(made.report.converted_maps[0].primitive_count, 2U);
    for (const double off : made.off) EXPECT_LT(off, 0.02);
    const Json json = jsonOf(folder, "after.glb");
    EXPECT_EQ(json["images"].size(), 1U);
    EXPECT_EQ(json["materials"].size(), 2U);
}

TEST(ConvertMaps, MakesASeparateMapForAMeshThatClampsIt) {
    const TempFolder folder;
    GltfBuilder builder;
    addSheet(builder, {.seed = 1, .first = {0, 0}, .last = {0.45F, 1}}, 0);
    addSheet(builder, {.seed = 2, .first = {0.55F, 0}, .last = {1, 1}}, 1);
    Json& json = builder.json();
    json["meshes"][1]["primitives"][0]["attributes"].erase("NORMAL");
    embedMap(builder, 16, R"([{"normalTexture":{"index":0}},{"normalTexture":{"index":1}}])");
    json["samplers"] = Json::parse(R"([{"wrapS":33071,"wrapT":33071}])");
    json["textures"] = Json::parse(R"([{"source":0},{"source":0,"sampler":0}])");
    GenerateOptions options = methodOptions(Method::best);
    options.maps.convert = true;
    options.normals.compute.weighting = NormalWeighting::angle;
    const auto report = generateFile(folder.write("in.glb", builder.glb()), folder.path("out.glb").string(), options);
    ASSERT_TRUE(report);
    ASSERT_EQ(report->converted_maps.size(), 2U);
    for (const ConvertedMapReport& map : report->converted_maps) EXPECT_EQ(map.primitive_count, 1U);
}

TEST(ConvertMaps, KeepsTheImageForItsOtherUsers) {
    const TempFolder folder;
    GltfBuilder builder;
    addSheet(builder, {}, 0);
    embedMap(builder, 8, R"([{"normalTexture":{"index":0},"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])");
    const Converted made =
        convertedModel(folder, folder.write("in.glb", builder.glb()), methodOptions(Method::lengyel));
    ASSERT_EQ(made.report.converted_maps.size(), 1U);
    EXPECT_EQ(made.report.converted_maps[0].new_image, 1U);
    const Json before = jsonOf(folder, "before.glb"), json = jsonOf(folder, "after.glb");
    EXPECT_EQ(json["images"].size(), 2U);
    EXPECT_EQ(json["images"][0]["name"], before["images"][0]["name"]);
    EXPECT_EQ(json["materials"][0]["pbrMetallicRoughness"], before["materials"][0]["pbrMetallicRoughness"]);
    EXPECT_EQ(json["materials"][0]["normalTexture"]["index"], 1);
    EXPECT_LT(made.off[0], 0.15);
}

TEST(ConvertMaps, CountsMissingTangentsAsThoseThatViewersMake) {
    const TempFolder folder;
    GltfBuilder builder;
    addSheet(builder, {}, 0);
    embedMap(builder, 16);
    const std::string input = folder.write("in.glb", builder.glb()), out = folder.path("out.glb").string();
    GenerateOptions options;
    options.maps.convert = true;
    auto report = generateFile(input, out, options);
    ASSERT_TRUE(report && report->converted_maps.size() == 1);
    EXPECT_FALSE(report->converted_maps[0].converted);
    EXPECT_NE(report->converted_maps[0].reason.find("the same shading"), std::string::npos);
    options.tangents.compute.method = Method::best;
    report = generateFile(input, out, options);
    ASSERT_TRUE(report && report->converted_maps.size() == 1);
    EXPECT_TRUE(report->converted_maps[0].converted);
    ASSERT_TRUE(generateFile(input, folder.path("viewer.glb").string()));
    EXPECT_LT(meanApart(pictureOf(folder.path("viewer.glb").string())[0], pictureOf(out)[0]), 0.02);
}

TEST(ConvertMaps, WritesNewFilesBesideAGltf) {
    const TempFolder folder;
    GltfBuilder builder;
    addSheet(builder, {}, 0);
    embedMap(builder, 8);
    const Bytes map = fileOf(mapOf(64, 8));
    folder.write("bumps.png", map);
    builder.json()["images"] = Json::parse(R"([{"uri":"bumps.png"}])");
    GenerateOptions options = methodOptions(Method::lengyel);
    options.maps.convert = true;
    const auto report =
        generateFile(folder.write("in.gltf", builder.gltfText()), folder.path("out.gltf").string(), options);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(report->converted_maps.at(0).converted);
    EXPECT_EQ(jsonOf(folder, "out.gltf")["images"][0]["uri"], "bumps-converted.png");
    EXPECT_TRUE(folder.has("bumps-converted.png"));
    EXPECT_EQ(folder.read("bumps.png"), std::string(map.begin(), map.end()));
}

TEST(ConvertMaps, ExplainsWhyAMapIsKept) {
    const TempFolder folder;
    for (const auto& [image, why] : {std::pair<std::string, std::string>{"no image", "neither PNG"},
                                     {std::string("\xabKTX 20\xbb\r\n\x1a\n", 12), "KTX2"}}) {
        GltfBuilder builder;
        addSheet(builder, {}, 0);
        embedMap(builder, 8);
        builder.json()["images"][0]["bufferView"] = builder.addView(toBytes(image));
        GenerateOptions options = methodOptions(Method::best);
        options.maps.convert = true;
        const auto report =
            generateFile(folder.write("in.glb", builder.glb()), folder.path("out.glb").string(), options);
        ASSERT_TRUE(report && report->converted_maps.size() == 1U);
        EXPECT_NE(report->converted_maps[0].reason.find(why), std::string::npos) << report->converted_maps[0].reason;
        EXPECT_EQ(report->primitives[0].action, PrimitiveAction::generated);
    }
}

TEST(ConvertMaps, RejectsOptionsThatChangeThePictureOnPurpose) {
    const TempFolder folder;
    GltfBuilder builder;
    addSheet(builder, {}, 0);
    embedMap(builder, 8);
    const std::string input = folder.write("in.glb", builder.glb());
    std::vector<GenerateOptions> refused(4);
    refused[0].maps.flip_green = FlipGreen::down;
    refused[1].selection.existing = ExistingTangents::repair;
    refused[2].tangents.texture_transform = TextureTransform::ignore;
    refused[3].tangents.compute.convention = conventions::directx;
    for (GenerateOptions& options : refused) {
        options.maps.convert = true;
        const auto report = generateFile(input, folder.path("out.glb").string(), options);
        EXPECT_TRUE(!report && report.error().code == ErrorCode::invalidOption);
        EXPECT_FALSE(folder.has("out.glb"));
    }
}

/// Real models with 8-bit maps: converted maps must not differ more from the original shading than the old maps do,
/// except invisibly, and large changes are undone.
TEST(ConvertMaps, KeepThePicturesOfModels) {
    struct Model {
        const char* path;
        double most;  ///< maximum ratio of the mean error over primitives to the one with the unconverted maps
    };
    for (const Model& model :
         {Model{"features/DuplicateMeshes/duplicate_meshes.gltf", 1.02},
          Model{"asset-generator/Node_NegativeScale/Node_NegativeScale_07.gltf", 1.02},
          Model{"asset-generator/Mesh_PrimitivesUV/Mesh_PrimitivesUV_08.gltf", 1.02},
          Model{"khronos/Lantern.glb", 1.02}, Model{"khronos/FlightHelmet/FlightHelmet.gltf", 0.6}}) {
        const std::filesystem::path file = shared("models") / model.path;
        if (!std::filesystem::exists(file)) GTEST_SKIP() << "no model " << file;
        const TempFolder folder;
        GenerateOptions options = methodOptions(Method::best);
        options.execution.thread_count = 2;
        const Converted made = convertedModel(folder, file.string(), options);
        double off = 0, unconverted = 0;
        for (std::size_t i = 0; i < made.off.size(); ++i) {
            EXPECT_LE(made.off[i], 1.1 * made.unconverted[i] + 0.005) << model.path << " " << i;
            off += made.off[i];
            unconverted += made.unconverted[i];
        }
        EXPECT_LE(off, model.most * unconverted + 1e-3) << model.path;
    }
}

}  // namespace
}  // namespace tspace::test
