// SPDX-License-Identifier: MIT
// MTL libraries: paths of libraries and textures, options of textures, and materials of faces without UVs.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "model/gltf/load_document.h"
#include "model/obj/obj_model.h"
#include "support/temp_folder.h"
#include "tspace/generate.h"

namespace tspace::test {
namespace {

using gltf::Json;

/// The start of a PNG, up to its size of 2 x 1 pixels.
const std::string kPng("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\2\0\0\0\1 not really", 35);
/// The start of a JPEG, up to its size.
const std::string kJpeg("\xff\xd8\xff\xc0\0\x0b\x08\0\1\0\2\3 not really", 23);

/// Returns a flat normal map of one pixel. Images of map_bump are decoded, to distinguish normal maps from height maps.
std::string flatPng() {
    constexpr unsigned char kBytes[] = {
        0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
        0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00, 0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00,
        0x0c, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x68, 0x68, 0xf8, 0x0f, 0x00, 0x03, 0x83, 0x02, 0x00, 0x00,
        0xa5, 0xfb, 0x89, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    return {reinterpret_cast<const char*>(kBytes), sizeof kBytes};
}

/// Checks that every texture of every primitive's material uses a UV set that the primitive has.
void expectTexturesToHaveUvs(const Json& json) {
    for (const Json& mesh : json["meshes"]) {
        for (const Json& primitive : mesh["primitives"]) {
            if (!primitive.contains("material") || primitive["attributes"].contains("TEXCOORD_0")) continue;
            const std::string material = json["materials"][primitive["material"].get<std::size_t>()].dump();
            EXPECT_EQ(material.find("Texture\""), std::string::npos) << material;
        }
    }
}

TEST(ObjMaterials, FacesWithoutTextureCoordinatesGetTheirMaterialWithoutTextures) {
    const TempFolder folder;
    folder.write("in/m.mtl", "newmtl a\nmap_Kd n.png\nnorm n.png\nNs 10\nd 0.5\nnewmtl b\nmap_Kd n.png\n");
    folder.write("in/n.png", kPng);
    const ObjModel made = make(folder, "mtllib m.mtl\n" + std::string(kQuad) +
                                           "usemtl a\nf 1/1 2/2 3/3\nf 1 3 4\nusemtl b\nf 1 2 4\nf 2 3 4\n");
    const Json& json = made.document.json;
    expectTexturesToHaveUvs(json);
    ASSERT_EQ(json["materials"].size(), 3U) << "b is shown without textures alone, and needs no second one";
    EXPECT_TRUE(json["materials"][0].contains("normalTexture"));
    EXPECT_EQ(json["materials"][2]["name"], "a");
    EXPECT_EQ(json["materials"][2]["alphaMode"], "BLEND");
    EXPECT_EQ(json["materials"][2]["pbrMetallicRoughness"]["roughnessFactor"],
              json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"]);
    EXPECT_TRUE(mentions(made.report.warnings, "'a' has textures, but 1 triangle with"));
    EXPECT_TRUE(mentions(made.report.warnings, "'b' has textures, but 2 triangles"));
}

TEST(ObjMaterials, TangentsAreMadeWhereTheMaterialHasANormalMap) {
    for (const char* keyword : {"map_Bump", "map_bump", "bump", "norm"}) {
        const TempFolder folder;
        folder.write("in/m.mtl", std::string("newmtl plain\nnewmtl rough\n") + keyword + " -bm 0.5 n.png\n");
        folder.write("in/n.png", flatPng());
        const ObjModel made = make(
            folder,
            "mtllib m.mtl\n" + std::string(kQuad) + "usemtl plain\nf 1/1 2/2 3/3\nusemtl rough\nf 1/1 3/3 4/4\n", {});
        ASSERT_EQ(made.report.primitives.size(), 2U) << keyword;
        EXPECT_EQ(made.report.primitives[0].action, PrimitiveAction::notNeeded);
        EXPECT_EQ(made.report.primitives[1].action, PrimitiveAction::generated);
        EXPECT_EQ(made.document.json["materials"][1]["normalTexture"]["scale"], 0.5);
    }
}

/// The options -o, -s and -t take one, two or three numbers. The file name after them is not one of them.
TEST(ObjMaterials, OptionsOfTexturesDoNotIncludeTheName) {
    for (const char* options :
         {"-s 2", "-s 2 2", "-s 2 2 1", "-o 0.5 -s 2 2", "-t .5", "-o -1e-1 +2. -bm 0.5", "-mm 0.1 -clamp on", "-s 1 1",
          "-blendu off -imfchan l", "-texres 512", "-bm 0.5 -s 1 1 1"}) {
        for (const char* keyword : {"norm", "bump", "map_bump", "map_Bump"}) {
            for (const char* name : {"n.png", "my n.png", "7"}) {
                const TempFolder folder;
                folder.write("in/m.mtl", std::string("newmtl a\n") + keyword + ' ' + options + ' ' + name + "\n");
                folder.write(std::string("in/") + name, flatPng());
                const ObjModel made =
                    make(folder, "mtllib m.mtl\n" + std::string(kQuad) + "usemtl a\nf 1/1 2/2 3/3\n", {});
                EXPECT_EQ(made.report.primitives[0].action, PrimitiveAction::generated) << keyword << options << name;
                EXPECT_TRUE(made.document.json.contains("images")) << keyword << options << name;
            }
        }
    }
}

TEST(ObjMaterials, ACorruptHeightMapIsIgnoredWithAWarning) {
    const TempFolder folder;
    folder.write("in/m.mtl", "newmtl a\nmap_bump -bm 0.5 n.png\n");
    folder.write("in/n.png", kPng);
    const ObjModel made = make(folder, "mtllib m.mtl\n" + std::string(kQuad) + "usemtl a\nf 1/1 2/2 3/3\n", {});
    EXPECT_FALSE(made.document.json["materials"][0].contains("normalTexture"));
    EXPECT_TRUE(mentions(made.report.warnings, "'n.png' was skipped, and no normal map was made from it"));
}

TEST(ObjMaterials, ImagesWithoutASizeAreIgnored) {
    for (const std::string bytes : {"\x89PNG\r\n\x1a\nnot really", "\xff\xd8\xff not really"}) {
        const TempFolder folder;
        folder.write("in/m.mtl", "newmtl a\nnorm n.png\n");
        folder.write("in/n.png", bytes);
        const ObjModel made = make(folder, "mtllib m.mtl\n" + std::string(kQuad) + "usemtl a\nf 1/1 2/2 3/3\n", {});
        EXPECT_FALSE(made.document.json.contains("images"));
        EXPECT_TRUE(mentions(made.report.warnings, "its header is invalid"));
    }
}

TEST(ObjMaterials, TexturesThatAreMovedGiveAWarning) {
    for (const bool moves : {true, false}) {
        const TempFolder folder;
        folder.write("in/m.mtl", std::string("newmtl a\nnorm -s ") + (moves ? "2 2" : "1 1") + " n.png\n");
        folder.write("in/n.png", kPng);
        const ObjModel made = make(folder, "mtllib m.mtl\n" + std::string(kQuad) + "usemtl a\nf 1/1 2/2 3/3\n", {});
        const auto& warnings = made.report.warnings;
        EXPECT_EQ(
            std::any_of(warnings.begin(), warnings.end(),
                        [](const std::string& text) { return text.find("which are ignored") != std::string::npos; }),
            moves);
    }
}

TEST(ObjMaterials, ImagesBesideTheOutputAreNamedAndOthersAreEmbedded) {
    const TempFolder folder;
    folder.write("in/m.mtl", "newmtl a\nmap_Kd maps\\base color.png\nnorm n.jpg\n");
    folder.write("in/maps/base color.png", kPng);
    folder.write("in/n.jpg", kJpeg);
    const std::string obj = "mtllib m.mtl\n" + std::string(kQuad) + "usemtl a\nf 1/1 2/2 3/3\n";
    const ObjModel embedded = make(folder, obj, {});
    ASSERT_EQ(embedded.document.json["images"].size(), 2U);
    EXPECT_EQ(embedded.document.json["images"][0]["mimeType"], "image/png");
    const std::size_t view = embedded.document.json["images"][0]["bufferView"].get<std::size_t>();
    const gltf::BufferView range = gltf::readBufferView(embedded.document, view);
    const auto image = embedded.document.buffers[0].bytes.range(range.begin, range.byte_count);
    EXPECT_EQ(std::string(image.begin(), image.end()), kPng);

    ASSERT_TRUE(generateFile((folder.path() / "in/model.obj").string(), (folder.path() / "in/model.gltf").string()));
    const gltf::Document beside = gltf::loadDocument(folder.path() / "in/model.gltf", {});
    EXPECT_EQ(beside.json["images"][0]["uri"], "maps/base%20color.png");
    EXPECT_EQ(beside.json["images"][1]["uri"], "n.jpg");
    EXPECT_EQ(beside.json["buffers"][0]["uri"], "model.bin");
}

TEST(ObjMaterials, MissingForbiddenAndInvalidTexturesAreIgnoredWithAWarning) {
    for (const std::string name :
         {"missing.png", "../secret.png", "/etc/hostname", "text.png", "sub/../../secret.png"}) {
        const TempFolder folder;
        folder.write("secret.png", kPng);
        folder.write("in/text.png", "no image");
        folder.write("in/m.mtl", "newmtl a\nnorm " + name + "\n");
        const ObjModel made = make(folder, "mtllib m.mtl\n" + std::string(kQuad) + "usemtl a\nf 1/1 2/2 3/3\n", {});
        EXPECT_FALSE(made.document.json.contains("images")) << name;
        EXPECT_TRUE(mentions(made.report.warnings, "was ignored")) << name;
        EXPECT_EQ(made.report.primitives[0].action, PrimitiveAction::generated) << "the material still asks for them";
    }
    const TempFolder folder;
    folder.write("secret.png", kPng);
    folder.write("in/m.mtl", "newmtl a\nnorm ../secret.png\n");
    GenerateOptions options;
    options.file.allow_external = true;
    const ObjModel made = make(folder, "mtllib m.mtl\n" + std::string(kQuad) + "usemtl a\nf 1/1 2/2 3/3\n", options);
    EXPECT_TRUE(made.document.json.contains("images"));
}

/// In Shift-JIS, GBK and Big5, the second byte of a character may equal a backslash. It does not continue a line then.
TEST(ObjMaterials, TextThatIsNotUtf8KeepsItsBytesAndGivesAWarning) {
    const TempFolder folder;
    folder.write("in/m.mtl", "newmtl \x94\xa7\nnorm \x94\xa7.png\n");
    folder.write("in/\x94\xa7.png", kPng);
    const std::string faces = std::string(kQuad) + "usemtl \x94\xa7\nf 1/1 2/2 3/3\n";
    const ObjModel made = make(folder, "o \x91\xcc\x95\x5c\nmtllib m.mtl\n" + faces, {});
    EXPECT_EQ(made.report.primitives[0].action, PrimitiveAction::generated) << "the material was found";
    EXPECT_TRUE(made.document.json.contains("images"));
    EXPECT_TRUE(mentions(made.report.warnings, "not UTF-8"));
    EXPECT_TRUE(mentions(made.report.warnings, "m.mtl"));
    for (const char* name : {"\xb3\x5c", "\xa5\x5c\xaf\xe0\xb3\x5c", "\xb1\x83\x5c", "\x8d\x5c"}) {
        const std::string text =
            "o " + std::string(name) + "\nv 9 9 9\n" + kQuad + "usemtl " + name + "\nf 2/1 3/2 4/3\n";
        EXPECT_EQ(make(folder, text).primitives.at(0).corner_count, 3u) << name;
    }
    const ObjModel utf8 = make(folder, "o \xe4\xbd\x93\\\n 2\nmtllib m.mtl\n" + faces, {});
    EXPECT_TRUE(mentions(utf8.report.warnings, "not UTF-8")) << "its usemtl is not";
    const ObjModel plain = make(folder, "o \xe4\xbd\x93\n" + std::string(kQuad) + "f 1/1 2/2 3/3\n", {});
    EXPECT_FALSE(mentions(plain.report.warnings, "not UTF-8"));
}

/// 95 5c is one character in Shift-JIS. b1 5c is one in GBK, but a half-width katakana and a separator in Shift-JIS.
TEST(ObjMaterials, BytesOfABackslashInNamesOfFilesAreKept) {
    const std::string faces = std::string(kQuad) + "usemtl a\nf 1/1 2/2 3/3\n";
    for (const auto& [named, stored] : {std::pair{"\x95\x5c.png", "\x95\x5c.png"},
                                        {"maps\\\x95\x5c.png", "maps/\x95\x5c.png"},
                                        {"\xb1\x5cn.png", "\xb1\x5cn.png"},
                                        {"\xb1\x5cn.png", "\xb1/n.png"},
                                        {"\x83\x83\x5cn.png", "\x83\x83/n.png"}}) {
        const TempFolder folder;
        folder.write("in/\x94\x5c.mtl", "newmtl a\nnorm " + std::string(named) + "\n");
        folder.write("in/" + std::string(stored), kPng);
        const ObjModel made = make(folder, "mtllib \x94\x5c.mtl\n" + faces, {});
        EXPECT_TRUE(made.document.json.contains("images")) << named;
        EXPECT_EQ(made.report.primitives[0].action, PrimitiveAction::generated) << named;
    }
}

TEST(ObjMaterials, AbsolutePathsAreSearchedByFileName) {
    const TempFolder folder;
    folder.write("in/maps/m.mtl", "newmtl a\nmap_Kd /home/me/c.png\nmap_Bump C:\\Users\\me\\Desktop\\n.png\n");
    folder.write("in/maps/n.png", flatPng());
    folder.write("in/maps/c.png", kPng);
    const std::string faces = std::string(kQuad) + "usemtl a\nf 1/1 2/2 3/3\n";
    const ObjModel made = make(folder, "mtllib maps/m.mtl\n" + faces, {});
    EXPECT_EQ(made.document.json["images"].size(), 2u);
    EXPECT_TRUE(mentions(made.report.warnings, "'C:/Users/me/Desktop/n.png' is absolute"));
    EXPECT_TRUE(mentions(made.report.warnings, "'/home/me/c.png' is absolute"));
    folder.write("in/m.mtl", "newmtl a\nnorm maps/n.png\n");
    for (const char* library : {"D:\\x\\m.mtl", "/home/me/m.mtl"}) {
        const ObjModel beside = make(folder, "mtllib " + std::string(library) + "\n" + faces, {});
        EXPECT_EQ(beside.document.json["images"].size(), 1u) << library;
    }
}

TEST(ObjMaterials, PathsMayHaveCommentsAndContinuedLines) {
    const TempFolder folder;
    const std::string faces = std::string(kQuad) + "usemtl a\nf 1/1 2/2 3/3\n";
    folder.write("in/n.png", flatPng());
    folder.write("in/my n.png", flatPng());
    folder.write("in/n.png # 2.png", flatPng());
    const struct {
        const char *line, *file;
        bool is_warned;
    } cases[] = {{"norm n.png # the normal map", "n", true},
                 {"norm \"my n.png\"\t# the normal map #2", "my n", true},
                 {"norm -bm 2 C:\\maps\\n.png # exported", "n", true},
                 {"norm n.png # 2.png", "n.png # 2", false},
                 {"norm -bm 2 \\\n n.png", "n", false},
                 {"norm\\\nmy n.png", "my n", false}};
    for (const auto& one : cases) {
        folder.write("in/m.mtl", "newmtl a\n" + std::string(one.line) + "\nKd 1 0 0\n");
        const ObjModel made = make(folder, "mtllib m.mtl # materials\n" + faces, {});
        ASSERT_TRUE(made.document.json.contains("images")) << one.line;
        EXPECT_EQ(made.document.json["images"][0]["name"], one.file) << made.document.json["images"];
        EXPECT_EQ(mentions(made.report.warnings, "'#' begins a comment only at the start of a line"), one.is_warned)
            << one.line;
        EXPECT_FALSE(mentions(made.report.warnings, "cannot find the material library")) << one.line;
    }
    // A backslash at the end of a path does not continue the line if the next line is a statement.
    folder.write("in/m.mtl", "newmtl a\nmap_Kd maps\\\nnorm n.png\n");
    EXPECT_EQ(make(folder, "mtllib m.mtl\n" + faces, {}).report.primitives[0].action, PrimitiveAction::generated);
}

TEST(ObjMaterials, MaterialLibrariesOutsideTheFolderAreNotRead) {
    const TempFolder folder;
    folder.write("m.mtl", "newmtl a\nnorm n.png\n");
    const std::string obj = "mtllib ../m.mtl\n" + std::string(kQuad) + "usemtl a\nf 1/1 2/2 3/3\n";
    ObjModel made = make(folder, obj, {});
    EXPECT_TRUE(mentions(made.report.warnings, "material library ignored"));
    EXPECT_EQ(made.report.primitives[0].action, PrimitiveAction::notNeeded);
    GenerateOptions options;
    options.file.allow_external = true;
    made = make(folder, obj, options);
    EXPECT_EQ(made.report.primitives[0].action, PrimitiveAction::generated);
}

TEST(ObjMaterials, NamesOfMaterialLibrariesMayHaveSpacesOrBeSeveral) {
    const TempFolder folder;
    folder.write("in/my file.mtl", "newmtl a\nnorm n.png\n");
    folder.write("in/x.mtl", "newmtl x\n");
    folder.write("in/y.mtl", "newmtl b \nnorm n.png\n");
    const std::string faces = std::string(kQuad) + "usemtl a\nf 1/1 2/2 3/3\nusemtl b \nf 1/1 3/3 4/4\n";
    const ObjModel made = make(folder, "mtllib my file.mtl\nmtllib x.mtl y.mtl\n" + faces, {});
    EXPECT_EQ(made.report.primitives[0].action, PrimitiveAction::generated);
    EXPECT_EQ(made.report.primitives[1].action, PrimitiveAction::generated);
}

}  // namespace
}  // namespace tspace::test
