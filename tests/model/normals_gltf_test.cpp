// SPDX-License-Identifier: MIT
// Normals of glTF files with generateFile: across borders of primitives, recomputed normals, and deltas of morph
// targets.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "generate_run.h"
#include "model/gltf/accessor.h"
#include "support/scene_file.h"
#include "support/shared_data.h"

namespace tspace {
namespace {

using gltf::findAttribute;
using gltf::Json;
using namespace test;

using Place = std::array<float, 3>;
Place placeOf(const Vec3& p) { return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; }

double degreesBetween(const Vec3& a, const Vec3& b) {
    const double dots = double{a.x} * b.x + double{a.y} * b.y + double{a.z} * b.z;
    const auto size = [](const Vec3& v) {
        return std::sqrt(double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z);
    };
    return std::acos(std::clamp(dots / (size(a) * size(b)), -1.0, 1.0)) * 180 / 3.14159265358979;
}

/// Returns the triangles of `data` for which `takes(center of the triangle)` is true, and their vertices.
template <class Takes>
ModelData part(const ModelData& data, const Takes& takes) {
    ModelData result;
    std::map<std::uint32_t, std::uint32_t> number_of;
    for (std::size_t c = 0; c < data.indices.size(); c += 3) {
        const auto at = [&](std::size_t k) { return data.positions[data.indices[c + k]]; };
        if (!takes((at(0).x + at(1).x + at(2).x) / 3)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = data.indices[c + k];
            const auto [entry, is_new] = number_of.try_emplace(v, static_cast<std::uint32_t>(number_of.size()));
            if (is_new) {
                result.positions.push_back(data.positions[v]);
                result.normals.push_back(data.normals[v]);
                result.uvs.push_back(data.uvs[v]);
            }
            result.indices.push_back(entry->second);
        }
    }
    return result;
}

/// Returns a sheet that is arched along x. `bend`: factor of its height.
ModelData arch(int n, float bend) {
    ModelData sheet = bentSheet(n);
    for (Vec3& p : sheet.positions) p.z = bend * p.x * (1 - p.x) + 0.1f * p.y * p.x;
    return sheet;
}
ModelData leftOf(const ModelData& data) {
    return part(data, [](float x) { return x < 0.5f; });
}
ModelData rightOf(const ModelData& data) {
    return part(data, [](float x) { return x > 0.5f; });
}

/// Adds a primitive with a normal map to mesh 0, and returns its JSON. `with_normals`: with the normals of `data`.
Json& addPart(GltfBuilder& builder, const ModelData& data, bool with_normals = false) {
    builder.json()["materials"] = Json::parse(R"([{"normalTexture":{"index":0}},{"name":"plain"}])");
    builder.json()["textures"] = Json::parse("[{}]");
    Json attributes = {{"POSITION", builder.addFloats(floatsOf(data.positions), 3)}};
    attributes["TEXCOORD_0"] = builder.addFloats(floatsOf(data.uvs), 2);
    if (with_normals) attributes["NORMAL"] = builder.addFloats(floatsOf(data.normals), 3);
    const std::size_t indices = builder.addAccessor(data.indices, kU32, "SCALAR", data.indices.size());
    Json& primitive = builder.addPrimitive(attributes);
    primitive["indices"] = indices;
    primitive["material"] = 0;
    return primitive;
}

/// The result of a run, read from its output.
struct Made {
    GenerateReport report;
    gltf::Document document;
    std::vector<gltf::Primitive> primitives;

    [[nodiscard]] std::vector<Vec3> vec3(std::size_t primitive, const char* name) const {
        return readVec3(document, primitives[primitive], name);
    }
    /// Returns the normals of a primitive by position. `target`: number of the morph target that is applied; -1: none.
    [[nodiscard]] std::map<Place, std::vector<Vec3>> normals(std::size_t primitive, int target = -1) const {
        const std::vector<Vec3> positions = vec3(primitive, "POSITION");
        std::vector<Vec3> normals = vec3(primitive, "NORMAL");
        if (target >= 0) {
            const auto offsets = readOffsets(document, primitives[primitive], std::size_t(target), "NORMAL");
            for (std::size_t v = 0; v < offsets.size(); ++v) {
                normals[v] = {normals[v].x + offsets[v].x, normals[v].y + offsets[v].y, normals[v].z + offsets[v].z};
            }
        }
        std::map<Place, std::vector<Vec3>> result;
        for (std::size_t v = 0; v < positions.size(); ++v) result[placeOf(positions[v])].push_back(normals[v]);
        return result;
    }
};

Made make(const GltfBuilder& builder, const GenerateOptions& options) {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", std::span<const std::uint8_t>(builder.glb()));
    const std::string output = folder.path("out.glb").string();
    auto report = generateFile(input, output, options);
    EXPECT_TRUE(report.ok()) << (report ? "" : report.error().message);
    if (!report) return {};
    Made made{*std::move(report), gltf::loadDocument(output, {}), {}};
    made.primitives = readPrimitives(made.document);
    return made;
}

GenerateOptions smooth(NormalWeighting weighting = NormalWeighting::angle) {
    GenerateOptions options;
    options.normals.compute.weighting = weighting;
    return options;
}

struct Border {
    std::size_t count = 0, equal_count = 0;
    double worst_deg = 0;
};
Border borderOf(const Made& made, int target = -1) {
    const auto left = made.normals(0, target), right = made.normals(1, target);
    Border border;
    for (const auto& [place, normals] : left) {
        const auto found = right.find(place);
        if (found == right.end()) continue;
        ++border.count;
        for (const Vec3& a : normals) {
            for (const Vec3& b : found->second) border.worst_deg = std::max(border.worst_deg, degreesBetween(a, b));
        }
        border.equal_count += normals.front() == found->second.front();
    }
    return border;
}

TEST(NormalsOverPrimitives, OneSurfaceInTwoPrimitivesHasNoSeam) {
    const ModelData sheet = arch(8, 0.8f);
    GltfBuilder whole, parts;
    addPart(whole, sheet);
    addPart(parts, leftOf(sheet));
    addPart(parts, rightOf(sheet));
    for (const NormalWeighting weighting : {NormalWeighting::uniform, NormalWeighting::area, NormalWeighting::angle,
                                            NormalWeighting::angleArea, NormalWeighting::max}) {
        const Made made = make(parts, smooth(weighting));
        const Border border = borderOf(made);
        EXPECT_EQ(border.count, 9u);
        EXPECT_EQ(border.equal_count, 9u) << "bit for bit";
        const auto expected = make(whole, smooth(weighting)).normals(0);
        for (std::size_t p = 0; p < 2; ++p) {
            for (const auto& [place, normals] : made.normals(p))
                EXPECT_LT(degreesBetween(normals[0], expected.at(place)[0]), 0.05);
            EXPECT_EQ(made.report.primitives[p].normals_joined_count, 9u);
            ASSERT_EQ(made.report.primitives[p].notes.size(), 1u);
            EXPECT_NE(made.report.primitives[p].notes[0].find("--normals-per-primitive"), std::string::npos);
            EXPECT_EQ(made.report.primitives[p].normals.face_count, 64u) << "its own";
        }
    }
    EXPECT_LT(borderOf(make(parts, smooth(NormalWeighting::best))).worst_deg, 0.05);
}

TEST(NormalsOverPrimitives, EachCanHaveItsOwn) {
    const ModelData sheet = arch(8, 0.8f);
    GltfBuilder parts, left;
    addPart(parts, leftOf(sheet));
    addPart(parts, rightOf(sheet));
    addPart(left, leftOf(sheet));
    GenerateOptions options = smooth();
    options.normals.per_primitive = true;
    const Made made = make(parts, options);
    EXPECT_GT(borderOf(made).worst_deg, 5);
    EXPECT_EQ(made.vec3(0, "NORMAL"), make(left, options).vec3(0, "NORMAL"));
    EXPECT_EQ(made.report.primitives[0].normals_joined_count, 0u);
}

TEST(NormalsOverPrimitives, TheCreaseAngleHolds) {
    ModelData roof = bentSheet(8);
    for (Vec3& p : roof.positions) p.z = -std::fabs(p.x - 0.5f);
    GltfBuilder parts;
    addPart(parts, leftOf(roof));
    addPart(parts, rightOf(roof));
    GenerateOptions options = smooth();
    EXPECT_LT(borderOf(make(parts, options)).worst_deg, 0.05);
    options.normals.compute.crease_angle_deg = 60;
    EXPECT_NEAR(borderOf(make(parts, options)).worst_deg, 90, 0.1);
}

TEST(NormalsOverPrimitives, SharedAndQuantizedVerticesAreJoinedToo) {
    const ModelData sheet = arch(8, 0.8f);
    GltfBuilder shared;
    addPart(shared, sheet);
    Json& first = firstPrimitive(shared);
    std::vector<std::uint32_t> sides[2];
    for (std::size_t c = 0; c < sheet.indices.size(); c += 3) {
        const bool is_left = c / 3 % 16 < 8;
        sides[is_left ? 0 : 1].insert(sides[is_left ? 0 : 1].end(), &sheet.indices[c], &sheet.indices[c] + 3);
    }
    first["indices"] = shared.addAccessor(sides[0], kU32, "SCALAR", sides[0].size());
    Json second = firstPrimitive(shared);
    second["indices"] = shared.addAccessor(sides[1], kU32, "SCALAR", sides[1].size());
    shared.json()["meshes"][0]["primitives"].push_back(second);
    const Border border = borderOf(make(shared, smooth()));
    EXPECT_EQ(border.count, 81u) << "all vertices are everybody's";
    EXPECT_EQ(border.equal_count, 81u);

    GltfBuilder quantised;
    for (const ModelData& side : {leftOf(sheet), rightOf(sheet)}) {
        addPart(quantised, side);
        std::vector<std::int16_t> numbers;
        for (const Vec3& p : side.positions) {
            for (const float value : {p.x, p.y, p.z, 0.0f}) numbers.push_back(std::int16_t(std::lround(value * 32767)));
        }
        const std::size_t accessor = quantised.addAccessor(numbers, 5122, "VEC3", side.positions.size());
        quantised.json()["accessors"][accessor]["normalized"] = true;
        quantised.json()["bufferViews"].back()["byteStride"] = 8;
        quantised.json()["meshes"][0]["primitives"].back()["attributes"]["POSITION"] = accessor;
    }
    quantised.json()["extensionsUsed"] = quantised.json()["extensionsRequired"] = {"KHR_mesh_quantization"};
    const Border rounded = borderOf(make(quantised, smooth()));
    EXPECT_EQ(rounded.count, 9u);
    EXPECT_EQ(rounded.equal_count, 9u);
}

TEST(NormalsOverPrimitives, MorphTargetsKeepTheBorderClosed) {
    const ModelData sheet = arch(8, 0.4f);
    GltfBuilder parts;
    for (const ModelData& side : {leftOf(sheet), rightOf(sheet)}) {
        std::vector<float> offsets;
        for (const Vec3& p : side.positions) offsets.insert(offsets.end(), {0, 0, p.x > 0.55f ? p.x : 0.0f});
        const std::size_t accessor = parts.addFloats(offsets, 3);
        addPart(parts, side)["targets"] = Json::array({Json{{"POSITION", accessor}}});
    }
    const Made made = make(parts, smooth());
    EXPECT_EQ(borderOf(made).equal_count, 9u);
    const Border moved = borderOf(made, 0);
    EXPECT_EQ(moved.count, 9u);
    EXPECT_LT(moved.worst_deg, 0.05) << "the left half does not move, but its border turns";
    const auto before = made.normals(0), after = made.normals(0, 0);
    double turned = 0;
    for (const auto& [place, normals] : before)
        turned = std::max(turned, degreesBetween(normals[0], after.at(place)[0]));
    EXPECT_GT(turned, 5);
}

TEST(NormalsOverPrimitives, ExistingNormalsAreKeptAndContinuedIfTheyFit) {
    const ModelData sheet = arch(8, 0.8f);
    ModelData right = rightOf(sheet);
    right.normals.assign(right.positions.size(), Vec3{0.1f, 0, 0.99498744f});
    GltfBuilder parts;
    addPart(parts, leftOf(sheet));
    addPart(parts, right, true);
    const Made made = make(parts, smooth());
    EXPECT_EQ(made.vec3(1, "NORMAL"), right.normals);
    EXPECT_LT(borderOf(made).worst_deg, 0.05);
    EXPECT_NE(made.report.primitives[0].notes.back().find("were kept"), std::string::npos);

    right.normals.assign(right.positions.size(), Vec3{1, 0, 0});
    GltfBuilder apart;
    addPart(apart, leftOf(sheet));
    addPart(apart, right, true);
    EXPECT_GT(borderOf(make(apart, smooth())).worst_deg, 60) << "a hard edge";
}

TEST(NormalsOverPrimitives, SidesOfASheetAndFlippedPiecesAreNotJoined) {
    const ModelData sheet = arch(4, 0.8f);
    ModelData back = sheet, turned = rightOf(sheet);
    for (ModelData* data : {&back, &turned}) {
        for (std::size_t c = 0; c < data->indices.size(); c += 3) std::swap(data->indices[c], data->indices[c + 1]);
    }
    for (const auto& [first, second] : {std::pair(sheet, back), std::pair(leftOf(sheet), turned)}) {
        GltfBuilder both, alone;
        addPart(both, first);
        addPart(both, second);
        addPart(alone, first);
        EXPECT_EQ(make(both, smooth()).vec3(0, "NORMAL"), make(alone, smooth()).vec3(0, "NORMAL"));
    }
}

GenerateOptions anew(NormalWeighting weighting = NormalWeighting::angle) {
    GenerateOptions options = smooth(weighting);
    options.normals.overwrite = true;
    return options;
}

TEST(OverwriteNormals, FlatTrianglesBecomeSmoothWithMergedVertices) {
    const ModelData sheet = arch(8, 0.8f);
    ModelData flat = withTangents(sheet, Method::mikktspace);
    for (std::size_t c = 0; c < flat.indices.size(); c += 3) {
        for (std::size_t k = 0; k < 3; ++k) flat.normals[c + k] = {0, 0, c % 2 == 0 ? 1.0f : -1.0f};
    }
    GltfBuilder builder, bare;
    addPart(builder, flat, true)["attributes"]["TANGENT"] = builder.addFloats(floatsOf(flat.tangents), 4);
    addPart(bare, sheet);
    const Made made = make(builder, anew()), expected = make(bare, smooth());
    const PrimitiveReport& report = made.report.primitives[0];
    EXPECT_EQ(made.primitives[0].vertex_count, 81u);
    EXPECT_EQ(report.vertices_before, 384u);
    EXPECT_EQ(report.vertices_after, 81u);
    EXPECT_TRUE(report.normals_generated && report.normals_replaced);
    EXPECT_EQ(report.action, PrimitiveAction::replaced) << "old tangents would not fit";
    EXPECT_NE(report.reason.find("would not fit"), std::string::npos);
    const auto normals = expected.normals(0);
    for (const auto& [place, found] : made.normals(0)) {
        ASSERT_EQ(found.size(), 1u);
        EXPECT_LT(degreesBetween(found[0], normals.at(place)[0]), 1e-2);
    }
    const Made again = [&] {
        GenerateOptions options = anew();
        options.normals.compute.crease_angle_deg = 0.01f;
        return make(builder, options);
    }();
    EXPECT_GT(again.primitives[0].vertex_count, 81u) << "hard edges split what was welded";
}

TEST(OverwriteNormals, OtherDifferencesKeepVerticesSeparate) {
    ModelData data = unwelded(arch(2, 0.5f));
    std::vector<float> colors(data.positions.size() * 3);
    for (std::size_t v = 0; v < data.positions.size(); ++v) colors[3 * v] = v % 3 == 0 ? 1.0f : 0.0f;
    GltfBuilder builder;
    const std::size_t accessor = builder.addFloats(colors, 3);
    addPart(builder, data, true)["attributes"]["COLOR_0"] = accessor;
    const Made made = make(builder, anew());
    EXPECT_GT(made.primitives[0].vertex_count, 9u);
    std::set<std::pair<Place, float>> before, after;
    for (std::size_t v = 0; v < data.positions.size(); ++v) before.emplace(placeOf(data.positions[v]), colors[3 * v]);
    const auto positions = made.vec3(0, "POSITION"), new_colors = made.vec3(0, "COLOR_0");
    for (std::size_t v = 0; v < positions.size(); ++v) after.emplace(placeOf(positions[v]), new_colors[v].x);
    EXPECT_EQ(before, after);
}

TEST(OverwriteNormals, OnlyNormalsIfTangentsAreNotNeeded) {
    GltfBuilder builder;
    addPart(builder, arch(4, 0.8f), true)["material"] = 1;
    const Made made = make(builder, anew());
    EXPECT_FALSE(made.primitives[0].find("TANGENT"));
    EXPECT_TRUE(made.report.primitives[0].normals_replaced);
    EXPECT_EQ(made.report.primitives[0].action, PrimitiveAction::notNeeded);
    EXPECT_TRUE(made.report.changed);
}

TEST(OverwriteNormals, NormalsAreKeptIfTangentsCannotBeRecomputed) {
    const ModelData data = withTangents(arch(4, 0.8f), Method::mikktspace);
    GltfBuilder builder;
    Json& attributes = addPart(builder, data, true)["attributes"];
    attributes["TANGENT"] = builder.addFloats(floatsOf(data.tangents), 4);
    firstPrimitive(builder)["attributes"].erase("TEXCOORD_0");
    const Made made = make(builder, anew());
    EXPECT_EQ(made.vec3(0, "NORMAL"), data.normals);
    EXPECT_FALSE(made.report.primitives[0].normals_replaced);
    ASSERT_FALSE(made.report.primitives[0].notes.empty());
    EXPECT_NE(made.report.primitives[0].notes[0].find("its normals were kept"), std::string::npos);
}

TEST(OverwriteNormals, InvertedSignsAreKeptBecauseTheMapMayMatchThem) {
    ModelData data = withTangents(arch(4, 0.8f), Method::mikktspace);
    for (const float factor : {1.0f, -1.0f}) {
        for (Vec4& tangent : data.tangents) tangent.w *= factor;
        GltfBuilder builder;
        const std::size_t tangents = builder.addFloats(floatsOf(data.tangents), 4);
        addPart(builder, data, true)["attributes"]["TANGENT"] = tangents;
        const Made made = make(builder, anew());
        for (const Vec4& tangent : readTangents(made.document, made.primitives[0]))
            EXPECT_EQ(tangent.w, data.tangents[0].w);
        EXPECT_EQ(made.report.primitives[0].notes.size(), factor < 0 ? 1u : 0u);
        GenerateOptions options = anew();
        options.selection.existing = ExistingTangents::replace;
        const Made replaced = make(builder, options);
        EXPECT_EQ(readTangents(replaced.document, replaced.primitives[0])[0].w, factor * data.tangents[0].w);
    }
}

TEST(OverwriteNormals, SignsAreThoseOfTheUvsWhereOnlyTheWindingWasWrong) {
    for (const float factor : {1.0f, -1.0f}) {
        ModelData data = withTangents(arch(4, 0.8f), Method::mikktspace);
        const float sign = data.tangents[0].w;
        for (Vec4& tangent : data.tangents) tangent.w *= factor;
        for (std::size_t c = 0; c < data.indices.size(); c += 3) std::swap(data.indices[c], data.indices[c + 1]);
        GltfBuilder builder;
        const std::size_t tangents = builder.addFloats(floatsOf(data.tangents), 4);
        addPart(builder, data, true)["attributes"]["TANGENT"] = tangents;
        const Made made = make(builder, anew());
        // The new normals point to the other side, for which the sign is the opposite.
        for (const Vec4& tangent : readTangents(made.document, made.primitives[0]))
            EXPECT_EQ(tangent.w, -factor * sign);
        EXPECT_EQ(made.report.primitives[0].notes.size(), factor < 0 ? 1u : 0u);
    }
}

TEST(OverwriteNormals, TargetsGetNewOffsets) {
    const ModelData data = arch(4, 0.2f);
    GltfBuilder builder;
    std::vector<float> offsets;
    for (const Vec3& p : data.positions) offsets.insert(offsets.end(), {0, 0, p.x * p.x});
    const std::size_t positions = builder.addFloats(offsets, 3);
    addPart(builder, data, true)["targets"] = Json::array({Json{{"POSITION", positions}, {"NORMAL", positions}}});
    ModelData moved = data;
    for (std::size_t v = 0; v < moved.positions.size(); ++v) moved.positions[v].z += offsets[3 * v + 2];
    GltfBuilder bare;
    addPart(bare, moved);
    const Made made = make(builder, anew()), expected = make(bare, smooth());
    const auto normals = made.normals(0, 0);
    std::size_t v = 0;
    const std::vector<Vec3> wanted = expected.vec3(0, "NORMAL");
    for (const Vec3& p : data.positions) EXPECT_LT(degreesBetween(normals.at(placeOf(p))[0], wanted[v++]), 0.1);
}

bool says(const std::vector<std::string>& warnings, const std::string& what) {
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const std::string& warning) { return warning.find(what) != std::string::npos; });
}

TEST(OptionsWithoutEffect, AreReported) {
    const ModelData data = withTangents(arch(4, 0.8f), Method::mikktspace);
    GltfBuilder builder;
    addPart(builder, data, true)["attributes"]["TANGENT"] = builder.addFloats(floatsOf(data.tangents), 4);
    GenerateOptions options = smooth();
    options.normals.compute.crease_angle_deg = 60;
    options.tangents.compute.method = Method::area;
    options.normals.morphs = MorphNormals::missing;
    EXPECT_TRUE(says(make(builder, options).report.warnings, "--crease has no effect")) << "as --crease 60 alone is";
    options.normals.use_smoothing_groups = false;
    const std::vector<std::string> warnings = make(builder, options).report.warnings;
    EXPECT_TRUE(says(warnings, "--normals and --crease have no effect"));
    EXPECT_TRUE(says(warnings, "--method has no effect"));
    EXPECT_TRUE(says(warnings, "--morph-normals has no effect"));
    options.normals.overwrite = true;
    options.normals.morphs = MorphNormals::keep;
    EXPECT_TRUE(make(builder, options).report.warnings.empty());
    EXPECT_TRUE(make(builder, {}).report.warnings.empty());
}

TEST(OverwriteNormals, ReportsAuthoredTangentsThatAreReplaced) {
    const ModelData data = withTangents(arch(4, 0.8f), Method::mikktspace);
    const auto notes = [&](const char* material, const GenerateOptions& options) {
        GltfBuilder builder;
        addPart(builder, data, true)["attributes"]["TANGENT"] = builder.addFloats(floatsOf(data.tangents), 4);
        builder.json()["materials"][0] = Json::parse(material);
        return make(builder, options).report.primitives[0].notes;
    };
    const char* hair = R"({"extras":{"hairFlow":true}})";
    const char* brushed = R"({"extensions":{"KHR_materials_anisotropy":{"anisotropyStrength":1}}})";
    EXPECT_TRUE(says(notes(hair, anew()), "may have been authored for extras of the material"));
    EXPECT_TRUE(says(notes(R"({"extensions":{"EXT_fur":{}}})", anew()), "authored for the material extension EXT_fur"));
    EXPECT_TRUE(says(notes(brushed, anew()), "authored for anisotropy without a texture"));
    EXPECT_FALSE(says(notes(brushed, {}), "authored")) << "they stay";
    EXPECT_FALSE(says(notes(R"({"normalTexture":{"index":0},"extras":{"hairFlow":true}})", anew()), "authored"));
    EXPECT_FALSE(says(notes("{}", anew()), "authored"));
}

/// Returns a sheet with a morph target that rolls it up along x. Its base normals are authored: they are tilted along
/// y.
GltfBuilder rolling(const ModelData& data, bool with_offsets) {
    GltfBuilder builder;
    std::vector<float> offsets;
    for (const Vec3& p : data.positions)
        offsets.insert(offsets.end(), {std::sin(p.x) - p.x, 0, 1 - std::cos(p.x) - p.z});
    const std::size_t positions = builder.addFloats(offsets, 3);
    Json target = {{"POSITION", positions}};
    if (with_offsets) target["NORMAL"] = positions;
    addPart(builder, data, true)["targets"] = Json::array({target});
    return builder;
}

TEST(MorphNormals, NormalsTurnAsTheSurfaceDoes) {
    ModelData data = bentSheet(16);
    for (Vec3& p : data.positions) p.z = 0;
    const float tilt = 0.3f;
    data.normals.assign(data.positions.size(), Vec3{0, std::sin(tilt), std::cos(tilt)});
    for (const bool with_offsets : {false, true}) {
        for (const MorphNormals which : {MorphNormals::keep, MorphNormals::missing, MorphNormals::all}) {
            const GltfBuilder builder = rolling(data, with_offsets);
            const Made made = make(builder, {.normals = {.morphs = which}});
            EXPECT_EQ(made.vec3(0, "NORMAL"), data.normals);
            const bool is_new = which == MorphNormals::all || (which == MorphNormals::missing && !with_offsets);
            EXPECT_EQ(made.report.primitives[0].morph_normals_computed, is_new ? 1u : 0u);
            EXPECT_EQ(findAttribute(made.primitives[0].targets[0], "NORMAL").has_value(), with_offsets || is_new);
            if (!is_new) continue;
            for (const auto& [place, normals] : made.normals(0, 0)) {
                const float x = std::clamp(place[0], 1.0f / 32, 31.0f / 32);  // the border has faces on one side only
                const Vec3 expected{-std::sin(x) * std::cos(tilt), std::sin(tilt), std::cos(x) * std::cos(tilt)};
                EXPECT_LT(degreesBetween(normals[0], expected), 0.2) << place[0];
            }
        }
    }
}

/// Returns `rolling` with these offsets of normals.
GltfBuilder rollingWith(const ModelData& data, const std::vector<float>& normals) {
    GltfBuilder builder = rolling(data, false);
    const std::size_t accessor = builder.addFloats(normals, 3);
    firstPrimitive(builder)["targets"][0]["NORMAL"] = accessor;
    return builder;
}

TEST(MorphNormals, OffsetsThatAreNotFiniteAreMissing) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    ModelData data = bentSheet(16);
    for (Vec3& p : data.positions) p.z = 0;
    data.normals.assign(data.positions.size(), Vec3{0, 0, 1});
    const auto offsetsOf = [](const Made& made) { return readOffsets(made.document, made.primitives[0], 0, "NORMAL"); };
    const std::vector<Vec3> right = offsetsOf(make(rolling(data, false), {.normals = {.morphs = MorphNormals::all}}));
    ASSERT_GE(right.size(), data.positions.size());

    const std::vector<float> all_nan(3 * data.positions.size(), nan);
    std::vector<float> one_nan(3 * data.positions.size(), 0.125f);  // all others count as authored
    one_nan[3 * 40] = nan;
    for (const MorphNormals which : {MorphNormals::missing, MorphNormals::all}) {
        EXPECT_EQ(offsetsOf(make(rollingWith(data, all_nan), {.normals = {.morphs = which}})), right);
        const Made made = make(rollingWith(data, one_nan), {.normals = {.morphs = which}});
        EXPECT_FALSE(says(made.report.warnings, "no effect"));
        const std::vector<Vec3> offsets = offsetsOf(made);
        for (std::size_t v = 0; v < data.positions.size(); ++v) {
            const bool is_new = which == MorphNormals::all || v == 40;
            EXPECT_EQ(offsets[v], (is_new ? right[v] : Vec3{0.125f, 0.125f, 0.125f})) << v;
        }
    }
}

TEST(MorphNormals, AreComputedIfTangentsAreKeptOrNotNeeded) {
    ModelData data = bentSheet(8);
    for (Vec3& p : data.positions) p.z = 0;
    data.normals.assign(data.positions.size(), Vec3{0, 0, 1});
    GltfBuilder plain = rolling(data, false);
    firstPrimitive(plain)["material"] = 1;
    const Made without = make(plain, {.normals = {.morphs = MorphNormals::missing}});
    EXPECT_FALSE(without.primitives[0].find("TANGENT"));
    EXPECT_TRUE(findAttribute(without.primitives[0].targets[0], "NORMAL"));

    // Tangents of the first run are kept. Their deltas must match the new normals.
    const Made first = make(rolling(data, true), {});
    GltfBuilder again;
    ModelData kept = data;
    kept.tangents = readTangents(first.document, first.primitives[0]);
    again = rolling(data, true);
    firstPrimitive(again)["attributes"]["TANGENT"] = again.addFloats(floatsOf(kept.tangents), 4);
    const std::size_t zeros = again.addFloats(std::vector<float>(3 * data.positions.size(), 0), 3);
    firstPrimitive(again)["targets"][0]["TANGENT"] = zeros;
    const Made made = make(again, {.normals = {.morphs = MorphNormals::all}});
    EXPECT_EQ(made.report.primitives[0].action, PrimitiveAction::kept);
    EXPECT_EQ(made.report.primitives[0].morph_deltas_computed, 1u);
    const auto deltas = readOffsets(made.document, made.primitives[0], 0, "TANGENT");
    const auto normals = made.normals(0, 0);
    for (std::size_t v = 0; v < deltas.size(); ++v) {
        const Vec4& t = kept.tangents[v];
        const Vec3 tangent{t.x + deltas[v].x, t.y + deltas[v].y, t.z + deltas[v].z};
        EXPECT_NEAR(degreesBetween(tangent, normals.at(placeOf(data.positions[v]))[0]), 90, 0.5);
    }
}

TEST(Winding, CountsFlippedTrianglesAndNormalsToTheBack) {
    ModelData data = arch(8, 0.5f);
    for (std::size_t c = 0; c < data.indices.size(); c += 3 * 7) std::swap(data.indices[c], data.indices[c + 1]);
    GltfBuilder builder;
    addPart(builder, data);
    const Made made = make(builder, smooth());
    const PrimitiveReport& report = made.report.primitives[0];
    EXPECT_EQ(report.turned_triangle_count, 19u);
    EXPECT_GT(report.normals_behind_count, 19u);
    EXPECT_TRUE(says(made.report.warnings, "19 of 128 triangles are wound opposite to their neighbors"));
    EXPECT_TRUE(says(made.report.warnings, "to the back of its triangle"));
    GltfBuilder sound;
    addPart(sound, arch(8, 0.5f));
    const Made right = make(sound, smooth());
    EXPECT_EQ(right.report.primitives[0].turned_triangle_count, 0u);
    EXPECT_EQ(right.report.primitives[0].normals_behind_count, 0u);
    EXPECT_TRUE(right.report.warnings.empty());
}

}  // namespace
}  // namespace tspace
