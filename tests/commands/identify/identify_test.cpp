// SPDX-License-Identifier: MIT
// identify finds the method and the convention by which tangents were computed.
#include "tspace/generate.h"
#include "tspace/inspect.h"

#include <gtest/gtest.h>

#include "core/base/vec_math.h"
#include "core/mesh/quads/quad_meshes.h"
#include "support/scene_file.h"
#include "support/shared_data.h"

namespace tspace::test {
namespace {

Identification identityOf(const std::vector<ModelData>& models, const IdentifyOptions& options = {}) {
    const TempFolder folder;
    const Result<Identification> result = identifyFile(writeModel(folder, "model.glb", models), options);
    EXPECT_TRUE(result.ok()) << (result ? "" : result.error().message);
    return result ? *result : Identification{};
}

TEST(Identify, FindsTheMethodThatMadeTheTangents) {
    // Strongly distorted UVs, so that the results of the methods differ by more than the tolerance. flat is not tested,
    // because without shared vertices its results equal those of lengyel.
    for (const Method method : {Method::mikktspace, Method::area, Method::uniform, Method::lengyel}) {
        ModelData data = bentSheet(5);
        for (Vec2& uv : data.uvs) uv = {uv.x * uv.x + 2 * uv.y, uv.y * uv.y - uv.x};
        const Identification result = identityOf({withTangents(data, method)}, {.tolerance_deg = 0.01});
        ASSERT_FALSE(result.explanations.empty());
        EXPECT_EQ(methodName(result.explanations[0].method), std::string(methodName(method))) << result.verdict;
        EXPECT_EQ(result.explanations[0].near_count, result.explanations[0].corner_count);
        EXPECT_EQ(result.verdict.rfind(std::string("Made by ") + methodName(method) + ":", 0), 0U) << result.verdict;
    }
}

TEST(Identify, FindsBestWithAnyNumberOfSteps) {
    ModelData data = trianglesOf(hills(10), kCuts[3]);
    data.tangents = {};
    for (const std::uint32_t refine : {0u, 1u, 2u}) {
        const Identification result = identityOf(
            {withTangents(data, {.method = Method::best, .convention = conventions::opengl, .refine = refine})},
            {.tolerance_deg = 0.01});
        EXPECT_EQ(result.explanations[0].method, Method::best) << result.verdict;
        EXPECT_EQ(result.explanations[0].near_count, result.explanations[0].corner_count) << refine;
    }
}

/// If tangents are stored as integers, differences between methods that are smaller than a step are lost.
TEST(Identify, NamesAllMethodsThatFitTangentsOfEightBits) {
    const TempFolder folder;
    ModelData data = bentSheet(6);
    for (std::size_t v = 0; v < data.positions.size(); ++v) {
        data.positions[v].z = 0;
        data.uvs[v] = {data.positions[v].x, data.positions[v].y};
    }
    data.normals.assign(data.positions.size(), {0, 0, 1});
    const std::string input = writeModel(folder, "plane.glb", {data}), output = folder.path("best.glb").string();
    GenerateOptions options;
    options.selection.all = true;
    options.storage.format = VectorFormat::snorm8;
    options.tangents.compute.method = Method::best;
    ASSERT_TRUE(generateFile(input, output, options));
    const Result<Identification> result = identifyFile(output);
    ASSERT_TRUE(result);
    EXPECT_NE(result->verdict.find("best"), std::string::npos) << result->verdict;
}

TEST(Identify, TellsTheSignsOfGltfFromInvertedOnes) {
    const ModelData right = withTangents(bentSheet(4), Method::mikktspace, -1);
    const ModelData inverted = withTangents(bentSheet(4), Method::mikktspace, 1);
    EXPECT_EQ(identityOf({right}).explanations[0].signs(), SignReading::gltf);
    EXPECT_EQ(identityOf({inverted}).explanations[0].signs(), SignReading::inverted);
    EXPECT_EQ(identityOf({right, inverted}).explanations[0].signs(), SignReading::mixed);
    EXPECT_NE(identityOf({inverted}).verdict.find("inverted"), std::string::npos);
}

TEST(Identify, DetectsTangentsWrittenPerVertex) {
    // A mirrored seam runs through the middle. Its vertices are welded after tangents are computed, and keep the
    // tangent of their last corner.
    ModelData data = bentSheet(8);
    for (std::size_t i = 0; i < data.uvs.size(); ++i)
        data.uvs[i] = {std::fabs(data.positions[i].x - 0.5f), data.positions[i].y};
    const ModelData corners = withTangents(data, Method::mikktspace);
    data.tangents.resize(data.positions.size());
    for (std::size_t c = 0; c < corners.tangents.size(); ++c) data.tangents[data.indices[c]] = corners.tangents[c];
    const Explanation best = identityOf({data}).explanations[0];
    EXPECT_LT(best.near_count, best.corner_count);
    EXPECT_EQ(best.near_any_count, best.corner_count);
}

/// Returns the identification of a sheet whose normal map has this transform, with the tangents of `data`, which may
/// belong to other UVs.
Identification identityWithTransform(const ModelData& data, const Json& transform) {
    const TempFolder folder;
    GltfBuilder builder;
    builder.json()["images"] = Json::array({Json{{"uri", "none.png"}}});
    builder.json()["textures"] = Json::array({Json{{"source", 0}}});
    builder.json()["materials"] =
        Json::array({Json{{"normalTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}}});
    Json& primitive = builder.addPrimitive({{"POSITION", builder.addFloats(floatsOf(data.positions), 3)},
                                            {"NORMAL", builder.addFloats(floatsOf(data.normals), 3)},
                                            {"TEXCOORD_0", builder.addFloats(floatsOf(data.uvs), 2)},
                                            {"TANGENT", builder.addFloats(floatsOf(data.tangents), 4)}});
    primitive["indices"] = builder.addAccessor(data.indices, 5125, "SCALAR", data.indices.size());
    primitive["material"] = 0;
    const Result<Identification> result =
        identifyFile(folder.write("model.glb", std::span<const std::uint8_t>(builder.glb())));
    EXPECT_TRUE(result.ok());
    return result ? *result : Identification{};
}

TEST(Identify, FollowsTheTextureTransformAndSaysSo) {
    const Json turn = {{"rotation", 1.5707963267948966}}, mirror = {{"scale", {1, -1}}},
               squeeze = {{"rotation", 0.5}, {"scale", {1, 3}}};
    const double c = std::cos(0.5), s = std::sin(0.5);
    struct Case {
        Json transform;
        double uu, uv, vu, vv;
    };
    for (const Case& one : {Case{turn, 0, 1, -1, 0}, Case{mirror, 1, 0, 0, -1}, Case{squeeze, c, 3 * s, -s, 3 * c}}) {
        const ModelData plain = unwelded(bentSheet(6));
        ModelData turned = plain;
        for (Vec2& uv : turned.uvs) {
            uv = {static_cast<float>(one.uu * uv.x + one.uv * uv.y), static_cast<float>(one.vu * uv.x + one.vv * uv.y)};
        }
        for (const bool after : {true, false}) {
            ModelData data = withTangents(after ? turned : plain, Method::mikktspace);
            data.uvs = plain.uvs;
            const Identification result = identityWithTransform(data, one.transform);
            ASSERT_FALSE(result.explanations.empty());
            const Explanation& best = result.explanations[0];
            EXPECT_EQ(best.method, Method::mikktspace);
            EXPECT_EQ(best.near_count, best.corner_count) << one.transform << after;
            EXPECT_EQ(best.signs(), SignReading::gltf) << one.transform << after;
            ASSERT_FALSE(result.primitives[0].explanations.empty());
            EXPECT_EQ(result.primitives[0].explanations[0].is_transformed, after);
            EXPECT_TRUE(result.primitives[0].has_two_readings);
            EXPECT_NE(result.verdict.find(after ? "after KHR_texture_transform" : "before KHR_texture_transform"),
                      std::string::npos)
                << result.verdict;
        }
    }
}

TEST(Identify, IgnoresTransformsThatChangeNoFrame) {
    const ModelData data = withTangents(bentSheet(4), Method::mikktspace);
    const Identification result = identityWithTransform(data, {{"offset", {0.5, 0.25}}, {"scale", {3, 2}}});
    EXPECT_EQ(result.verdict.find("KHR_texture_transform"), std::string::npos) << result.verdict;
    EXPECT_FALSE(result.primitives[0].has_two_readings);
}

TEST(Identify, FindsTheUvSetThatWasFollowed) {
    ModelData data = withTangents(bentSheet(5), Method::mikktspace);
    data.other_uvs = data.uvs;
    for (Vec2& uv : data.uvs) uv = {-uv.y, uv.x};
    const Identification result = identityOf({data});
    const Explanation& best = result.primitives[0].explanations[0];
    EXPECT_EQ(best.uv_set, 1);
    EXPECT_FALSE(best.is_textures_set);
    EXPECT_EQ(best.near_count, best.corner_count);
    EXPECT_NE(result.verdict.find("different UV set"), std::string::npos) << result.verdict;
}

TEST(Identify, NamesQuadsWhereTangentsWereMadeOnThem) {
    const ModelData on_quads = withTangentsOnQuads(hills(14), kFan);
    const Identification result = identityOf({on_quads});
    ASSERT_FALSE(result.explanations.empty());
    EXPECT_EQ(result.explanations[0].method, Method::mikktspace);
    EXPECT_EQ(result.explanations[0].faces, Faces::quads);
    EXPECT_EQ(result.explanations[0].near_count, result.explanations[0].corner_count);
    EXPECT_EQ(result.explanations[0].signs(), SignReading::gltf);
    EXPECT_EQ(result.verdict.rfind("Made by mikktspace on quads:", 0), 0U) << result.verdict;
    ASSERT_FALSE(result.primitives[0].explanations.empty());
    EXPECT_EQ(result.primitives[0].explanations[0].faces, Faces::quads);
}

TEST(Identify, DoesNotNameQuadsWhereTrianglesExplainAsMuch) {
    for (const Method method : {Method::mikktspace, Method::area, Method::uniform, Method::lengyel}) {
        const Identification result = identityOf({withTangents(trianglesOf(hills(14), kFan), method)});
        for (const Explanation& entry : result.explanations) EXPECT_EQ(entry.faces, Faces::triangles);
        for (const Explanation& entry : result.primitives[0].explanations) EXPECT_EQ(entry.faces, Faces::triangles);
        EXPECT_EQ(result.verdict.find("quads"), std::string::npos) << result.verdict;
    }
}

TEST(Identify, CountsThePrimitivesOnTrianglesWithThoseOnQuads) {
    const Identification result = identityOf(
        {withTangentsOnQuads(hills(14), kFan), withTangents(trianglesOf(hills(6), kFan), Method::mikktspace)});
    EXPECT_EQ(result.explanations[0].faces, Faces::quads);
    EXPECT_EQ(result.explanations[0].near_count, result.explanations[0].corner_count);
    EXPECT_EQ(result.primitives[0].explanations[0].faces, Faces::quads);
    EXPECT_EQ(result.primitives[1].explanations[0].faces, Faces::triangles);
}

TEST(Identify, IgnoresCornersWithoutUvArea) {
    ModelData data = withTangents(bentSheet(6), Method::mikktspace);
    // Add the same number of triangles whose UVs are a single point, with meaningless tangents and signs.
    ModelData flat = unwelded(bentSheet(6));
    const auto first = static_cast<std::uint32_t>(data.positions.size());
    for (std::size_t v = 0; v < flat.positions.size(); ++v) {
        data.positions.push_back(flat.positions[v] + Vec3{2, 0, 0});
        data.normals.push_back(flat.normals[v]);
        data.uvs.push_back({0.5F, 0.5F});
        data.tangents.push_back({0, 1, 0, v % 2 == 0 ? 1.0F : -1.0F});
        data.indices.push_back(first + static_cast<std::uint32_t>(v));
    }
    const Explanation best = identityOf({data}).explanations[0];
    EXPECT_EQ(best.method, Method::mikktspace);
    EXPECT_EQ(best.corner_count, flat.positions.size());
    EXPECT_EQ(best.undecided_count, flat.positions.size());
    EXPECT_EQ(best.near_count, best.corner_count);
    EXPECT_EQ(best.near_any_count, best.corner_count);
    EXPECT_EQ(best.signs(), SignReading::gltf);
}

TEST(Identify, FollowsNoUvSetThatHasNoArea) {
    ModelData data = withTangents(bentSheet(5), Method::mikktspace);
    data.other_uvs.assign(data.uvs.size(), Vec2{0.25F, 0.75F});
    // The tangents resemble a default tangent, which some methods write for UVs without direction. They are opposite to
    // increasing u of the UV set with area.
    for (Vec4& tangent : data.tangents) tangent = {-tangent.x, -tangent.y, -tangent.z, tangent.w};
    const Identification result = identityOf({data});
    for (const Explanation& entry : result.primitives[0].explanations) EXPECT_EQ(entry.uv_set, 0);
    EXPECT_EQ(result.verdict.find("different UV set"), std::string::npos) << result.verdict;
    data.uvs = data.other_uvs;
    EXPECT_EQ(identityOf({data}).primitives[0].skipped, "its UVs have no area");
}

TEST(Identify, NamesTheMethodOfEachPrimitive) {
    ModelData sheet = trianglesOf(hills(10), kCuts[3]);
    const Identification result = identityOf(
        {withTangents(sheet, Method::mikktspace), withTangents(sheet, Method::area), withTangents(sheet, Method::area)},
        {.tolerance_deg = 0.05});
    EXPECT_EQ(result.verdict.rfind("Made by different methods: mikktspace in 1 primitive, area in 2.", 0), 0U)
        << result.verdict;
}

TEST(Identify, PrefersCommonMethodsOverThoseOfTspace) {
    // On nine of ten tangents (a flat part) all methods agree; the rest match only `best`.
    ModelData flat = bentSheet(12);
    for (std::size_t v = 0; v < flat.positions.size(); ++v) {
        flat.positions[v].z = 0;
        flat.normals[v] = {0, 0, 1};
        flat.uvs[v] = {flat.positions[v].x, flat.positions[v].y};
    }
    ModelData bent = trianglesOf(hills(2), kCuts[3]);
    bent.tangents = {};
    const Identification result =
        identityOf({withTangents(flat, Method::best), withTangents(bent, Method::best)}, {.tolerance_deg = 0.01});
    EXPECT_EQ(result.explanations[0].method, Method::mikktspace) << result.verdict;
    const auto best = std::find_if(result.explanations.begin(), result.explanations.end(),
                                   [](const Explanation& entry) { return entry.method == Method::best; });
    EXPECT_GT(best->near_count, result.explanations[0].near_count);
}

TEST(Identify, ExplainsWhyAPrimitiveWasSkipped) {
    const ModelData data = withTangents(bentSheet(2), Method::mikktspace);
    ModelData no_tangents = data, no_normals = data, no_uvs = data;
    no_tangents.tangents.clear();
    no_normals.normals.clear();
    no_uvs.uvs.clear();
    const Identification result = identityOf({no_tangents, no_normals, no_uvs});
    EXPECT_EQ(result.primitives[0].skipped, "it has no tangents");
    EXPECT_EQ(result.primitives[1].skipped, "it has no normals");
    EXPECT_EQ(result.primitives[2].skipped, "it has no UVs");
    EXPECT_TRUE(result.explanations.empty());
    EXPECT_EQ(identityOf({no_tangents}).verdict, "This file contains no tangents.");
}

TEST(Identify, NoiseMatchesNoMethod) {
    ModelData data = withTangents(bentSheet(6), Method::mikktspace);
    for (std::size_t i = 0; i < data.tangents.size(); ++i) {
        const Vec4 t = data.tangents[i];
        data.tangents[i] = {t.y, -t.x, t.z, t.w};
    }
    for (const float sign : {1.0f, -1.0f}) {
        for (Vec4& t : data.tangents) t.w = sign;
        const std::string verdict = identityOf({data}).verdict;
        EXPECT_NE(verdict.find("No known method"), std::string::npos);
        EXPECT_EQ(verdict.find("sign"), std::string::npos) << verdict;
    }
}

TEST(Identify, ThreadsChangeNothing) {
    const ModelData data = withTangents(bentSheet(40), Method::angle);
    const Identification one = identityOf({data}, {.execution = {.thread_count = 1}});
    const Identification four = identityOf({data}, {.execution = {.thread_count = 4}});
    EXPECT_EQ(one.verdict, four.verdict);
    for (std::size_t i = 0; i < one.explanations.size(); ++i) {
        EXPECT_EQ(one.explanations[i].near_count, four.explanations[i].near_count);
        EXPECT_EQ(one.explanations[i].mean_deg, four.explanations[i].mean_deg);
    }
}

struct Known {
    const char* file;
    Method method;
    double least, most;  ///< range of the share of close corners, in percent
    SignReading signs;
};

/// The shares of mikktspace are those of the reference implementation on these files, among the corners with
/// determinate UVs (four fifths of Ghost's corners). The other shares were measured once, and are far above chance.
TEST(Identify, AgreesWithTheReferenceOnPublicModels) {
    const Known known[] = {
        {"khronos/TwoSidedPlane.glb", Method::mikktspace, 100, 100, SignReading::inverted},
        {"khronos/Lantern.glb", Method::mikktspace, 93.6, 93.8, SignReading::gltf},
        {"khronos/FlightHelmet/FlightHelmet.gltf", Method::mikktspace, 73.5, 74, SignReading::gltf},
        {"khronos/FlightHelmet/FlightHelmet.gltf", Method::uniform, 94, 96, SignReading::gltf},
        {"khronos/BoomBoxWithAxes.glb", Method::mikktspace, 95.9, 96.1, SignReading::gltf},
        {"khronos/SciFiHelmet.glb", Method::mikktspace, 2.5, 2.7, SignReading::mixed},
        {"khronos/ClearCoatTest.glb", Method::mikktspace, 99.9, 100, SignReading::gltf},
        {"assets/Cat.glb", Method::lengyel, 99, 100, SignReading::inverted},
        {"assets/Ghost.glb", Method::mikktspace, 91.2, 91.5, SignReading::gltf},
    };
    for (const Known& entry : known) {
        const std::string path = std::string("models/") + entry.file;
        TSPACE_NEEDS_SHARED(path);
        const Result<Identification> result = identifyFile(shared(path));
        ASSERT_TRUE(result.ok()) << entry.file;
        const auto found =
            std::find_if(result->explanations.begin(), result->explanations.end(),
                         [&](const Explanation& e) { return e.method == entry.method && e.faces == Faces::triangles; });
        ASSERT_NE(found, result->explanations.end());
        EXPECT_GE(100 * found->nearShare(), entry.least) << entry.file;
        EXPECT_LE(100 * found->nearShare(), entry.most) << entry.file;
        EXPECT_EQ(signReadingName(found->signs()), std::string(signReadingName(entry.signs))) << entry.file;
    }
}

}  // namespace
}  // namespace tspace::test
