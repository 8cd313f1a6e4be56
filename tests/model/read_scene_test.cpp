// SPDX-License-Identifier: MIT
// The scene that check, diff and identify examine equals the contents of the file.
#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "model/read/read_scene.h"
#include "support/shared_data.h"
#include "support/temp_folder.h"

namespace tspace::test {
namespace {

/// Returns a model of one triangle with every attribute.
GltfBuilder oneTriangle() {
    GltfBuilder builder;
    builder.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
    builder.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    builder.addFloats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, 4);
    builder.addFloats({0, 1, 1, 1, 0, 0}, 2);
    builder.addPrimitive({{"POSITION", 0}, {"NORMAL", 1}, {"TANGENT", 2}, {"TEXCOORD_1", 3}});
    return builder;
}

Scene read(const GltfBuilder& builder, bool with_images = false) {
    const TempFolder folder;
    return readScene(folder.write("model.gltf", builder.gltfText()), {}, with_images);
}

TEST(ReadScene, HoldsTheAttributesOfAPrimitive) {
    GltfBuilder builder = oneTriangle();
    builder.json()["asset"]["generator"] = "a tool";
    builder.json()["meshes"][0]["name"] = "mesh";
    builder.json()["materials"] = Json::parse(R"([{"name":"skin","normalTexture":{"index":0,"texCoord":1}}])");
    builder.json()["textures"] = Json::parse(R"([{"source":0}])");
    builder.json()["images"] = Json::parse(R"([{"uri":"n.png"}])");
    Json& primitive = builder.json()["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["targets"] = Json::array({{{"POSITION", 1}}, {{"NORMAL", 0}}});
    const Scene scene = read(builder);
    EXPECT_EQ(scene.format, "gltf");
    EXPECT_EQ(scene.generator, "a tool");
    ASSERT_EQ(scene.primitives.size(), 1u);
    const ScenePrimitive& p = scene.primitives[0];
    EXPECT_EQ(p.place, "/meshes/0/primitives/0");
    EXPECT_EQ(p.mesh_name, "mesh");
    EXPECT_EQ(p.material_name, "skin");
    EXPECT_EQ(p.mode, "triangles");
    EXPECT_EQ(p.corners.size(), 3u);
    EXPECT_EQ(p.positions[1], (Vec3{1, 0, 0}));
    EXPECT_EQ(p.normals[2], (Vec3{0, 0, 1}));
    EXPECT_EQ(p.tangents[0].w, 1.0f);
    ASSERT_EQ(p.uv_sets.size(), 2u);
    EXPECT_TRUE(p.uv_sets[0].empty());
    EXPECT_EQ(p.uv_sets[1][1], (Vec2{1, 1}));
    ASSERT_EQ(p.morph_targets.size(), 2u);
    EXPECT_EQ(p.morph_targets[0].positions.size(), 3u);
    EXPECT_TRUE(p.morph_targets[0].normals.empty());
    EXPECT_EQ(p.morph_targets[1].normals[1], (Vec3{1, 0, 0}));
    ASSERT_EQ(p.uses.size(), 1u);
    EXPECT_EQ(p.uses[0].needed_by, "normalTexture");
    EXPECT_EQ(p.uses[0].uv_set, 1u);
    EXPECT_EQ(p.uses[0].image, std::size_t{0});
    ASSERT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(scene.images[0].uri, "n.png");
}

TEST(ReadScene, SharesWhatPrimitivesShare) {
    GltfBuilder builder = oneTriangle();
    builder.addPrimitive({{"POSITION", 0}, {"NORMAL", 1}});
    const Scene scene = read(builder);
    ASSERT_EQ(scene.primitives.size(), 2u);
    EXPECT_EQ(scene.primitives[0].positions.data(), scene.primitives[1].positions.data());
    EXPECT_EQ(scene.primitives[0].corners.data(), scene.primitives[1].corners.data());
}

TEST(ReadScene, LeavesPointsAndLinesWithoutCorners) {
    for (const int mode : {0, 1, 2, 3}) {
        GltfBuilder builder = oneTriangle();
        builder.json()["meshes"][0]["primitives"][0]["mode"] = mode;
        const Scene scene = read(builder);
        EXPECT_TRUE(scene.primitives[0].corners.empty());
        EXPECT_EQ(scene.primitives[0].positions.size(), 3u);
    }
}

TEST(ReadScene, RejectsArraysFarLargerThanTheFile) {
    GltfBuilder builder = oneTriangle();
    // Each accessor is within the limit for accessors without data, but all of them together exceed it.
    for (int i = 0; i < 400; ++i) {
        builder.json()["accessors"].push_back({{"componentType", 5126}, {"count", 1000000}, {"type", "VEC3"}});
        builder.addPrimitive({{"POSITION", 4 + i}});
    }
    EXPECT_EQ(errorOf([&] { (void)read(builder); }).code, ErrorCode::tooLarge);
}

TEST(ReadScene, RejectsFilesThatGenerateRejects) {
    const TempFolder folder;
    const auto code = [](const std::string& file) { return errorOf([&] { (void)readScene(file, {}, false); }).code; };
    EXPECT_EQ(code("no such file.glb"), ErrorCode::cannotRead);
    EXPECT_EQ(code("no such file.obj"), ErrorCode::cannotRead);
    EXPECT_EQ(code(folder.write("a.gltf", "hello")), ErrorCode::invalidFile);
    GltfBuilder builder = oneTriangle();
    builder.json()["meshes"][0]["primitives"][0]["indices"] =
        builder.addAccessor<std::uint8_t>({0, 1, 3}, 5121, "SCALAR", 3);
    EXPECT_EQ(code(folder.write("b.gltf", builder.gltfText())), ErrorCode::invalidFile);
}

TEST(ReadScene, ReadsTheBytesOfNormalMapsOnlyWhenAsked) {
    const TempFolder folder;
    folder.write("n.png", "from a file");
    GltfBuilder builder = oneTriangle();
    const std::size_t view = builder.addView(toBytes("from a view"));
    builder.json()["images"] = Json::array({{{"uri", "n.png"}},
                                            {{"bufferView", view}, {"mimeType", "image/png"}},
                                            {{"uri", "data:image/png;base64,AAAA"}},
                                            {{"uri", "missing.png"}},
                                            {{"uri", "n.png"}}});
    for (int i = 0; i < 4; ++i) {
        builder.json()["textures"].push_back({{"source", i}});
        builder.json()["materials"].push_back({{"normalTexture", {{"index", i}}}});
        if (i > 0) builder.addPrimitive({{"POSITION", 0}});
        builder.json()["meshes"][0]["primitives"][i]["material"] = i;
    }
    const std::string file = folder.write("model.gltf", builder.gltfText());
    const Scene scene = readScene(file, {}, true);
    ASSERT_EQ(scene.images.size(), 5u);
    const auto text = [&](std::size_t i) {
        return std::string(scene.images[i].bytes.begin(), scene.images[i].bytes.end());
    };
    EXPECT_EQ(text(0), "from a file");
    EXPECT_EQ(text(1), "from a view");
    EXPECT_EQ(text(2), std::string(3, 0));
    EXPECT_EQ(scene.images[2].uri, "");
    EXPECT_EQ(text(3), "") << "an image that is missing is no error";
    EXPECT_EQ(text(4), "") << "nothing needs tangents for it";
    for (const SceneImage& image : readScene(file, {}, false).images) EXPECT_TRUE(image.bytes.empty());
}

TEST(ReadScene, TriangulatesTheFacesOfAnObjAndFlipsItsUvs) {
    const TempFolder folder;
    folder.write("m.mtl", "newmtl a\nnorm n.png\n");
    folder.write("n.png", "image");
    const std::string file =
        folder.write("a.obj",
                     "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 0.75\n"
                     "vt 0 1\no one\nusemtl a\nf 1/1 2/2 3/3 4/4\n");
    const Scene scene = readScene(file, {}, true);
    EXPECT_EQ(scene.format, "obj");
    ASSERT_EQ(scene.primitives.size(), 1u);
    const ScenePrimitive& p = scene.primitives[0];
    EXPECT_EQ(p.place, "usemtl a");
    EXPECT_EQ(p.mesh_name, "one");
    EXPECT_EQ(p.mode, "polygons");
    EXPECT_EQ(p.corners.size(), 6u);
    EXPECT_EQ(p.positions.size(), 4u);
    EXPECT_TRUE(p.normals.empty());
    EXPECT_EQ(p.uv_sets[0][2], (Vec2{1, 0.25f}));
    ASSERT_EQ(p.uses.size(), 1u);
    EXPECT_EQ(p.uses[0].image, std::size_t{0});
    ASSERT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(scene.images[0].bytes.size(), 5u);
    EXPECT_TRUE(readScene(file, {}, false).images[0].bytes.empty());
}

}  // namespace
}  // namespace tspace::test
