// SPDX-License-Identifier: MIT
// Sums of vertices over primitives that share vertices.
#include <gtest/gtest.h>

#include <set>

#include "commands/generate/generate_report.h"
#include "model/generate_run.h"
#include "support/scene_file.h"
#include "support/shared_data.h"
#include "tspace/generate.h"
#include "tspace/inspect.h"

namespace tspace::test {
namespace {

report::VertexTotals verticesOf(const std::string& input) {
    const TempFolder folder;
    const auto report = generateFile(input, folder.path("out.glb").string(), {.selection = {.all = true}});
    EXPECT_TRUE(report) << report.error().message;
    return report ? report::totalsOf(*report).vertices : report::VertexTotals{};
}

/// Returns the number of distinct vertex lists in inspectFile's report.
std::size_t listCount(const std::string& input) {
    const auto inspection = inspectFile(input);
    EXPECT_TRUE(inspection) << inspection.error().message;
    std::set<std::uint32_t> lists;
    for (const PrimitiveInfo& primitive : inspection->primitives) lists.insert(primitive.vertex_list);
    return lists.size();
}

/// Returns `count` primitives that each draw the whole sheet with a material of its own. The materials of the second
/// half use TEXCOORD_1.
GltfBuilder sheets(std::size_t count, bool share_vertices) {
    const ModelData sheet = bentSheet(6);
    GltfBuilder builder;
    builder.json()["textures"] = Json::parse("[{}]");
    Json attributes;
    for (std::size_t i = 0; i < count; ++i) {
        if (i == 0 || !share_vertices) {
            std::vector<float> turned;
            for (const Vec2& uv : sheet.uvs) turned.insert(turned.end(), {uv.y, uv.x});
            attributes = {{"POSITION", builder.addFloats(floatsOf(sheet.positions), 3)},
                          {"NORMAL", builder.addFloats(floatsOf(sheet.normals), 3)},
                          {"TEXCOORD_0", builder.addFloats(floatsOf(sheet.uvs), 2)},
                          {"TEXCOORD_1", builder.addFloats(turned, 2)}};
        }
        builder.json()["materials"].push_back({{"normalTexture", {{"index", 0}, {"texCoord", i < count / 2 ? 0 : 1}}}});
        const std::size_t indices = builder.addAccessor(sheet.indices, kU32, "SCALAR", sheet.indices.size());
        Json& primitive = builder.addPrimitive(attributes);
        primitive["indices"] = indices;
        primitive["material"] = i;
    }
    return builder;
}

TEST(VertexTotals, CountSharedVerticesOnce) {
    const std::size_t vertex_count = bentSheet(6).positions.size();
    for (const bool share : {true, false}) {
        const TempFolder folder;
        const std::string input = folder.write("in.glb", sheets(6, share).glb());
        const report::VertexTotals vertices = verticesOf(input);
        EXPECT_EQ(vertices.before(), share ? vertex_count : 6 * vertex_count);
        EXPECT_EQ(vertices.after(), vertices.before());
        EXPECT_EQ(listCount(input), share ? 1u : 6u);
    }
}

TEST(VertexTotals, CountVerticesOfAFileOnce) {
    TSPACE_NEEDS_SHARED("reports/second/shared_10.glb");
    const std::string input = shared("reports/second/shared_10.glb").string();
    EXPECT_EQ(verticesOf(input).before(), 441u);
    EXPECT_EQ(listCount(input), 1u);
}

TEST(VertexTotals, OfObjFilesCountEachPrimitive) {
    const TempFolder folder;
    const std::string input =
        folder.write("in.obj", std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n"
                                           "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 3/3 2/2 4/4\n"));
    EXPECT_EQ(verticesOf(input).before(), 6u);
    EXPECT_EQ(listCount(input), 2u);
}

}  // namespace
}  // namespace tspace::test
