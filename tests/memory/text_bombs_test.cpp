// SPDX-License-Identifier: MIT
// Small texts that expand to large data: JSON values, faces of OBJ files, material libraries.
#include <gtest/gtest.h>

#include "expect_bounded.h"

namespace tspace {
namespace {

using test::expectBounded;
using test::TempFolder;

std::string repeated(const std::string& text, std::size_t bytes) {
    std::string all;
    while (all.size() < bytes) all += text;
    return all;
}

void expectTextBounded(const std::string& name, const std::string& text) {
    const TempFolder folder;
    const std::string path = folder.write(name, text);
    expectBounded(path, text.size());
}

std::string gltfWith(const std::string& member, const std::string& entry, std::size_t bytes = 8'000'000) {
    std::string list = repeated(entry + ',', bytes);
    list.back() = ']';
    return R"({"asset":{"version":"2.0"},)" + member + '[' + list + '}';
}

TEST(MemoryCeiling, HoldsForJsonOfManySmallValues) {
    for (const char* value : {"0", "[]", "{}", "\"\"", "[[]]", "{\"\":0}", "[[[]]]", "0.5", "null", "[0]"}) {
        SCOPED_TRACE(value);
        // Sizes just below the limit show whether estimates of memory are too low.
        for (const std::size_t bytes : {3'000'000, 5'000'000, 8'000'000}) {
            expectTextBounded("model.gltf", gltfWith("\"extras\":", value, bytes));
        }
    }
}

TEST(MemoryCeiling, HoldsForManyEmptyEntries) {
    for (const char* list :
         {"images", "materials", "nodes", "animations", "skins", "textures", "meshes", "scenes", "cameras"}) {
        SCOPED_TRACE(list);
        expectTextBounded("model.gltf", gltfWith('"' + std::string(list) + "\":", "{}"));
    }
    expectTextBounded("model.gltf", gltfWith("\"buffers\":", "{\"byteLength\":0}"));
    expectTextBounded("model.gltf", gltfWith("\"extensionsRequired\":", "\"a\""));
    expectTextBounded("model.gltf", gltfWith("\"accessors\":", R"({"componentType":5126,"count":1,"type":"VEC3"})"));
    expectTextBounded("model.gltf", gltfWith("\"meshes\":", R"({"primitives":[{"attributes":{}}]})"));
    std::string primitives = gltfWith(R"("meshes":[{"primitives":)", R"({"attributes":{}})");
    primitives.replace(primitives.size() - 1, 1, "}]}");
    expectTextBounded("model.gltf", primitives);
    primitives = gltfWith(R"("accessors":[{"componentType":5126,"count":3,"type":"VEC3"}],"meshes":[{"primitives":)",
                          R"({"attributes":{"POSITION":0}})");
    primitives.replace(primitives.size() - 1, 1, "}]}");
    expectTextBounded("model.gltf", primitives);
    std::string targets = gltfWith(
        R"("accessors":[{"componentType":5126,"count":3,"type":"VEC3"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"targets":)",
        R"({})");
    targets.replace(targets.size() - 1, 1, "}]}]}");
    expectTextBounded("model.gltf", targets);
}

TEST(MemoryCeiling, HoldsForDeepNesting) {
    expectTextBounded("model.gltf", R"({"asset":{"version":"2.0"},"extras":)" + std::string(4'000'000, '['));
}

TEST(MemoryCeiling, HoldsForObjFacesOfFewBytes) {
    const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";
    expectTextBounded("model.obj", head + repeated("f 1 2 3\n", 4'000'000));
    expectTextBounded("model.obj", head + repeated("f 1/1 2/2 3/3\n", 4'000'000));
    expectTextBounded("model.obj", head + "f " + repeated("1 2 3 ", 4'000'000) + "\n");
    expectTextBounded("model.obj", head + repeated("f 1\n", 4'000'000));
    expectTextBounded("model.obj", repeated("v\n", 4'000'000) + "f 1 2 3\n");
    expectTextBounded("model.obj", head + repeated("o a\ng b\nf 1 2 3\n", 4'000'000));
    std::string shapes = head;
    for (int i = 0; i < 300'000; ++i) shapes += "o " + std::to_string(i) + "\nf 1 2 3\n";
    expectTextBounded("model.obj", shapes);
    std::string materials = head;
    for (int i = 0; i < 300'000; ++i) materials += "usemtl " + std::to_string(i) + "\nf 1 2 3\n";
    expectTextBounded("model.obj", materials);
}

TEST(MemoryCeiling, HoldsForALibraryThatIsNamedOftenInOneLine) {
    const TempFolder folder;
    const std::string library = folder.write("a", repeated("newmtl a\n", 100'000));
    const std::string path =
        folder.write("model.obj", "mtllib " + repeated("a ", 10'000) + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expectBounded(path, test::bytesOf({path, library}));
}

TEST(MemoryCeiling, HoldsForMaterialsOfFewBytes) {
    const TempFolder folder;
    const std::string library = folder.write("a.mtl", repeated("newmtl a\n", 4'000'000));
    const std::string path = folder.write("model.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expectBounded(path, test::bytesOf({path, library}));
}

/// Tests a file of a format that a library reads in a separate process, whose address space is limited.
void expectImportBounded(const std::string& name, const std::string& text) {
    const TempFolder folder;
    const std::string path = folder.write(name, text);
    constexpr std::uint64_t kImportBase = std::uint64_t{128} << 20;
    expectBounded(path, text.size() + kImportBase / test::kCeilingRatio);
}

TEST(MemoryCeiling, HasAHigherOneForHeadersOfOtherFormats) {
    expectImportBounded(
        "model.ply",
        "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 4000000000\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n");
    expectImportBounded("model.off", "OFF\n4000000000 4000000000 0\n0 0 0\n");
    expectImportBounded("model.off", "OFF\n40000000 40000000 0\n0 0 0\n");
    expectImportBounded("model.ply",
                        "ply\nformat binary_little_endian 1.0\nelement vertex 20000000\nproperty float x\nproperty "
                        "float y\nproperty float z\n"
                        "element face 20000000\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n");
    std::string stl(80, ' ');
    stl += std::string("\x00\x00\x00\x7f", 4);
    expectImportBounded("model.stl", stl + std::string(50, '\0'));
}

}  // namespace
}  // namespace tspace
