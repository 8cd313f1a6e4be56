// SPDX-License-Identifier: MIT
// Extensions that refer to vertices, when vertices are split or removed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "generate_run.h"
#include "model/gltf/accessor.h"
#include "model/gltf/codecs/codecs.h"
#include "support/shared_data.h"

namespace tspace::test {
namespace {

constexpr std::size_t kSize = 4;

struct Written {
    GenerateReport report = {};
    gltf::Document document = {};
    std::vector<gltf::Primitive> primitives = {};

    [[nodiscard]] const Json& primitive(std::size_t i = 0) const { return document.json["meshes"][0]["primitives"][i]; }
    [[nodiscard]] bool warns(const std::string& text) const {
        return std::any_of(report.warnings.begin(), report.warnings.end(),
                           [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
    }
};

/// Runs generate on the model, and again on its output, which must not change.
Written generated(const GltfBuilder& builder, GenerateOptions options = {}) {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", builder.glb()), output = folder.path("out.glb").string();
    Result<GenerateReport> report = generateFile(input, output, options);
    EXPECT_TRUE(report) << report.error().message << " at " << report.error().place;
    if (!report) return {};
    Written written{.report = *std::move(report), .document = gltf::loadDocument(output, {})};
    written.primitives = gltf::readPrimitives(written.document);
    options.selection.existing = ExistingTangents::replace;
    options.storage.compression = Compression::keep;
    const Result<GenerateReport> second = generateFile(output, folder.path("again.glb").string(), options);
    EXPECT_TRUE(second && !second->changed && second->warnings.empty());
    return written;
}

/// Returns a grid whose UVs are mirrored at its middle column. The vertices of this column are split.
GltfBuilder splitModel() {
    GltfBuilder builder = gridModel(Grid(kSize));
    builder.json()["extensionsUsed"] = Json::array();
    return builder;
}

void addOutline(GltfBuilder& builder, const std::vector<std::uint16_t>& edges, std::size_t primitive = 0) {
    const std::size_t accessor = builder.addAccessor(edges, kU16, "SCALAR", edges.size());
    builder.json()["extensionsUsed"] = {"CESIUM_primitive_outline"};
    builder.json()["meshes"][0]["primitives"][primitive]["extensions"]["CESIUM_primitive_outline"] = {
        {"indices", accessor}};
}

/// Positions of the two ends of each edge, as a set, because direction does not matter.
using Place = std::array<float, 3>;
using Places = std::multiset<std::set<Place>>;

struct Outline {
    std::vector<std::uint32_t> edges = {};
    Places places = {};
    std::size_t off_triangles = 0;  ///< edges that belong to no triangle
};

Outline outlineOf(const gltf::Document& document, const gltf::Primitive& primitive) {
    const Json& extensions = document.json["meshes"][primitive.mesh]["primitives"][primitive.index]["extensions"];
    const auto accessor = extensions["CESIUM_primitive_outline"]["indices"].get<std::size_t>();
    Outline outline;
    outline.edges = gltf::decodeIndices(document, gltf::readAccessor(document, accessor), primitive.vertex_count, "");
    const std::vector<Vec3> positions = gltf::readVec3(document, primitive, "POSITION");
    const std::vector<std::uint32_t> corners = gltf::readTriangleCorners(document, primitive);
    std::set<std::set<std::uint32_t>> sides;
    for (std::size_t c = 0; c < corners.size(); ++c) sides.insert({corners[c], corners[c - c % 3 + (c + 1) % 3]});
    const auto place = [&](std::uint32_t v) { return Place{positions[v].x, positions[v].y, positions[v].z}; };
    for (std::size_t i = 0; i + 1 < outline.edges.size(); i += 2) {
        outline.places.insert({place(outline.edges[i]), place(outline.edges[i + 1])});
        outline.off_triangles += sides.count({outline.edges[i], outline.edges[i + 1]}) == 0;
    }
    return outline;
}

/// Edges of the middle column and of the lower border, and one edge that no triangle has.
const std::vector<std::uint16_t> kEdges = {2, 7, 12, 7, 12, 17, 22, 17, 0, 1, 1, 2, 2, 3, 3, 4, 0, 24};

TEST(VertexNumbers, OutlinesAreEdgesOfTrianglesAfterASplitOnBothSidesOfIt) {
    GltfBuilder builder = splitModel();
    addOutline(builder, kEdges);
    const Outline before = outlineOf(parse(builder), gltf::readPrimitives(parse(builder))[0]);
    const Written written = generated(builder);
    ASSERT_GT(written.primitives[0].vertex_count, Grid(kSize).vertexCount());
    const Outline after = outlineOf(written.document, written.primitives[0]);
    EXPECT_EQ(before.off_triangles, 1U);
    EXPECT_EQ(after.off_triangles, 1U) << "the one that never was a side";
    EXPECT_EQ(std::set(after.places.begin(), after.places.end()), std::set(before.places.begin(), before.places.end()));
    EXPECT_EQ(after.edges.size(), kEdges.size() + 8) << "the triangles on both sides of the four edges have their own";
    EXPECT_TRUE(written.report.warnings.empty());
    const auto accessor = written.primitive()["extensions"]["CESIUM_primitive_outline"]["indices"].get<std::size_t>();
    EXPECT_EQ(accessor, 4U) << "the entry that it had";
}

TEST(VertexNumbers, OutlinesOfPrimitivesThatShareVerticesAreEachTheirOwn) {
    GltfBuilder builder = splitModel();
    const Json first = firstPrimitive(builder);
    builder.json()["meshes"][0]["primitives"].push_back(first);
    addOutline(builder, kEdges);
    builder.json()["meshes"][0]["primitives"][1]["extensions"] = firstPrimitive(builder)["extensions"];
    const Written written = generated(builder);
    for (const gltf::Primitive& primitive : written.primitives)
        EXPECT_EQ(outlineOf(written.document, primitive).off_triangles, 1U);
    EXPECT_EQ(written.primitive(0)["extensions"], written.primitive(1)["extensions"]);
}

TEST(VertexNumbers, WithoutASplitOutlinesAreUnchanged) {
    GltfBuilder builder = gridModel(Grid(kSize, false));
    addOutline(builder, kEdges);
    const Written written = generated(builder);
    EXPECT_EQ(outlineOf(written.document, written.primitives[0]).edges,
              std::vector<std::uint32_t>(kEdges.begin(), kEdges.end()));
}

TEST(VertexNumbers, AnInvalidOutlineIsKeptAndReported) {
    GltfBuilder builder = splitModel();
    addOutline(builder, {0, 1, 900, 1});
    EXPECT_TRUE(generated(builder).warns("CESIUM_primitive_outline"));
}

TEST(VertexNumbers, FeatureIdsThatAreNumbersOfVerticesBecomeAnAttribute) {
    GltfBuilder builder = splitModel();
    const std::size_t own = builder.addAccessor(std::vector<float>(Grid(kSize).vertexCount(), 3), 5126, "SCALAR",
                                                Grid(kSize).vertexCount());
    Json& primitive = firstPrimitive(builder);
    primitive["attributes"]["_FEATURE_ID_0"] = own;
    primitive["extensions"]["EXT_mesh_features"] =
        Json::parse(R"({"featureIds": [{"featureCount": 4, "attribute": 0}, {"featureCount": 25}]})");
    builder.json()["extensionsUsed"] = {"EXT_mesh_features"};
    const Written written = generated(builder);
    EXPECT_TRUE(written.report.warnings.empty());
    const Json& ids = written.primitive()["extensions"]["EXT_mesh_features"]["featureIds"];
    EXPECT_EQ(ids[0], Json::parse(R"({"featureCount": 4, "attribute": 0})"));
    EXPECT_EQ(ids[1], Json::parse(R"({"featureCount": 25, "attribute": 1})"));
    const gltf::Primitive& result = written.primitives[0];
    EXPECT_EQ(gltf::readAccessor(written.document, *result.find("_FEATURE_ID_0")).count, result.vertex_count);
    const gltf::Accessor numbers = gltf::readAccessor(written.document, *result.find("_FEATURE_ID_1"));
    const Bytes elements = gltf::copyElements(written.document, numbers);
    ASSERT_EQ(elements.size(), 2 * result.vertex_count);
    // Each vertex keeps the number that belongs to its position.
    const std::vector<Vec3> positions = gltf::readVec3(written.document, result, "POSITION");
    for (std::size_t i = 0; i < result.vertex_count; ++i) {
        const auto expected = static_cast<std::size_t>(positions[i].y * (kSize + 1) + positions[i].x);
        EXPECT_EQ(elements[2 * i] + 256U * elements[2 * i + 1], expected) << i;
    }
}

TEST(VertexNumbers, OtherExtensionsOfPrimitivesAndMeshesAreReported) {
    GltfBuilder builder = splitModel();
    firstPrimitive(builder)["extensions"]["FB_ngon_encoding"] = Json::object();
    firstPrimitive(builder)["extensions"]["KHR_materials_variants"] = Json::parse(R"({"mappings": []})");
    firstPrimitive(builder)["extensions"]["EXT_structural_metadata"] = Json::parse(R"({"propertyAttributes": [0]})");
    builder.json()["meshes"][0]["extensions"]["ACME_seams"] = Json::parse(R"({"vertices": [2]})");
    builder.json()["scenes"] = Json::parse(R"([{"extensions": {"FB_geometry_metadata": {"vertexCount": 25}}}])");
    builder.json()["extensionsUsed"] = {"FB_ngon_encoding", "ACME_seams"};
    const Written written = generated(builder);
    EXPECT_EQ(written.report.warnings.size(), 3U);
    for (const char* name : {"FB_ngon_encoding", "ACME_seams", "FB_geometry_metadata"}) {
        EXPECT_TRUE(written.warns(name)) << name;
    }
    EXPECT_EQ(written.document.json["meshes"][0]["extensions"], builder.json()["meshes"][0]["extensions"]);
}

TEST(VertexNumbers, WithoutASplitNothingIsReported) {
    GltfBuilder builder = gridModel(Grid(kSize, false));
    firstPrimitive(builder)["extensions"]["FB_ngon_encoding"] = Json::object();
    builder.json()["extensionsUsed"] = {"FB_ngon_encoding"};
    EXPECT_TRUE(generated(builder).report.warnings.empty());
}

TEST(VertexNumbers, OutlinesFollowWhenDracoRemovesUnusedVertices) {
    if (!gltf::dracoMissing().empty()) GTEST_SKIP() << gltf::dracoMissing();
    GltfBuilder builder = splitModel();
    // Remove the first quad, so that vertex 0 is unused.
    std::vector<std::uint16_t> indices = Grid(kSize).indices<std::uint16_t>();
    indices.erase(indices.begin(), indices.begin() + 6);
    firstPrimitive(builder)["indices"] = builder.addAccessor(indices, kU16, "SCALAR", indices.size());
    addOutline(builder, {2, 7, 12, 7, 12, 17, 22, 17, 1, 2, 2, 3, 3, 4});
    firstPrimitive(builder)["extensions"]["EXT_mesh_features"] =
        Json::parse(R"({"featureIds": [{"featureCount": 25}]})");
    const Written written = generated(builder, {.storage = {.compression = Compression::draco}});
    EXPECT_TRUE(written.report.warnings.empty());
    EXPECT_EQ(outlineOf(written.document, written.primitives[0]).off_triangles, 0U);
    EXPECT_TRUE(written.primitives[0].find("_FEATURE_ID_0"));
}

TEST(VertexNumbers, TheSharedOutlineIsOneOfTriangles) {
    TSPACE_NEEDS_SHARED("reports/outline.glb");
    const TempFolder folder;
    const std::string output = folder.path("out.glb").string();
    ASSERT_TRUE(generateFile(shared("reports/outline.glb").string(), output));
    const gltf::Document document = gltf::loadDocument(output, {});
    const Outline outline = outlineOf(document, gltf::readPrimitives(document)[0]);
    EXPECT_GE(outline.edges.size(), 14U);
    EXPECT_EQ(outline.off_triangles, 0U);
}

}  // namespace
}  // namespace tspace::test
