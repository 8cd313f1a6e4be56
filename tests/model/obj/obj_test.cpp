// SPDX-License-Identifier: MIT
// OBJ to glTF: which data is preserved, computed, and rejected. Materials are in obj_materials_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "model/gltf/primitive_reader.h"
#include "model/obj/obj_model.h"
#include "model/obj/obj_reader.h"
#include "model/read/read_scene.h"
#include "support/shared_data.h"
#include "support/temp_folder.h"
#include "tspace/generate.h"
#include "tspace/normals.h"
#include "tspace/result.h"
#include "tspace/tangents.h"

namespace tspace::test {
namespace {

using gltf::Json;

Error failure(const std::string& obj) {
    const TempFolder folder;
    Result<GenerateReport> report = tryMake(folder, obj, everything());
    EXPECT_FALSE(report) << obj;
    EXPECT_FALSE(folder.has("out.glb"));
    return report ? Error{.code = ErrorCode::ok} : report.error();
}

TEST(Obj, KeepsPolygonsOfAnySizeUntilFramesAreComputed) {
    std::ostringstream obj;
    std::ostringstream face;
    constexpr int kCorners = 400;  // more than 8 bits can represent, with which the parser counts corners
    for (int i = 1; i <= kCorners; ++i) {
        const double a = i * 2 * 3.14159265358979 / kCorners;
        obj << "v " << std::cos(a) << ' ' << std::sin(a) << " 0\nvt " << std::cos(a) << ' ' << std::sin(a) << '\n';
        face << ' ' << i << '/' << i;
    }
    const TempFolder folder;
    const ObjModel made = make(folder, obj.str() + "f" + face.str() + "\n");
    ASSERT_EQ(made.primitives.size(), 1U);
    EXPECT_EQ(made.corners().size(), (kCorners - 2) * 3U);
    EXPECT_EQ(made.vec3("POSITION").size(), std::size_t{kCorners});
}

TEST(Obj, EqualTriplesOfIndicesBecomeOneVertexInOrderOfFirstUse) {
    const TempFolder folder;
    const ObjModel made = make(folder, std::string(kQuad) + "vn 0 0 1\nf 4/4/1 1/1/1 2/2/1\nf 4/4/1 2/2/1 3/3/1\n");
    EXPECT_EQ(made.corners(), (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(made.vec3("POSITION").front(), (Vec3{0, 1, 0}));
    EXPECT_EQ(made.document.json["accessors"][0]["max"], Json({1.0, 1.0, 0.0}));
}

TEST(Obj, RelativeIndicesMeanTheSameAsAbsoluteOnes) {
    const TempFolder a;
    const TempFolder b;
    make(a, std::string(kQuad) + "f 1/1 2/2 3/3 4/4\n");
    make(b, std::string(kQuad) + "f -4/-4 -3/-3 -2/-2 -1/-1\n");
    EXPECT_EQ(a.read("out.glb"), b.read("out.glb"));
}

TEST(Obj, LineEndsContinuationsCommentsAndByteOrderMarksDoNotMatter) {
    const std::string plain = std::string(kQuad) + "f 1/1 2/2 3/3 4/4\n";
    const TempFolder expected;
    make(expected, plain);
    std::string crlf;
    std::string cr;
    for (const char c : plain) {
        crlf += c == '\n' ? "\r\n" : std::string(1, c);
        cr += c == '\n' ? '\r' : c;
    }
    for (const std::string& text :
         {crlf, cr, "\xEF\xBB\xBF" + plain, std::string(kQuad) + "f 1/1 2/2 \\\n3/3 4/4 # four corners",
          "# comment\n\n  " + std::string(kQuad) + "\tf\t1/1 2/2 3/3 4/4"}) {
        const TempFolder folder;
        make(folder, text);
        EXPECT_EQ(folder.read("out.glb"), expected.read("out.glb")) << text;
    }
}

TEST(Obj, TextureCoordinatesAreFlippedVertically) {
    const TempFolder folder;
    const ObjModel made = make(folder, std::string(kQuad) + "f 1/1 2/2 3/3 4/4\n");
    const std::vector<Vec2> uvs = gltf::readUvs(made.document, made.primitives[0], 0);
    EXPECT_EQ(uvs, (std::vector<Vec2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}}));
    for (const Vec4& t : gltf::readTangents(made.document, made.primitives[0])) EXPECT_EQ(t, (Vec4{1, 0, 0, 1}));
}

TEST(Obj, AMaterialThatStatesNoColorIsWhite) {
    const TempFolder folder;
    folder.write("in/m.mtl", "newmtl a\nNs 10\nnewmtl b\nKd 0 0 0\n");
    const ObjModel made =
        make(folder, "mtllib m.mtl\n" + std::string(kQuad) + "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/3 4/4\n");
    const Json& materials = made.document.json["materials"];
    EXPECT_FALSE(materials[0]["pbrMetallicRoughness"].contains("baseColorFactor"));
    EXPECT_EQ(materials[1]["pbrMetallicRoughness"]["baseColorFactor"], Json({0.0, 0.0, 0.0, 1.0}));
}

TEST(Obj, EachShapeIsAMeshAndEachMaterialInItAPrimitive) {
    const TempFolder folder;
    folder.write("in/m.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nd 0.5\n");
    const ObjModel made = make(folder, "mtllib m.mtl\n" + std::string(kQuad) +
                                           "o first\nusemtl red\nf 1/1 2/2 3/3\nusemtl blue\nf 1/1 3/3 4/4\n"
                                           "o second\nf 1/1 2/2 3/3\no first\nusemtl red\nf 2/2 3/3 4/4\n");
    const Json& json = made.document.json;
    ASSERT_EQ(made.primitives.size(), 3U);
    EXPECT_EQ(json["meshes"].size(), 2U);
    EXPECT_EQ(json["nodes"][1]["name"], "second");
    EXPECT_EQ(json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"], Json({1.0, 0.0, 0.0, 1.0}));
    EXPECT_EQ(json["materials"][1]["alphaMode"], "BLEND");
    EXPECT_EQ(made.report.primitives[0].material_name, "red");
    EXPECT_EQ(made.report.primitives[1].material_name, "blue");
    EXPECT_EQ(made.report.primitives[2].mesh_name, "second");
    EXPECT_EQ(made.corners(0).size(), 6U) << "the object comes back later in the file";
}

/// Returns two quads at a right angle. The edge between them has vertices 2 and 3.
std::string folded(const std::string& before_faces) {
    return std::string(kQuad) + "v 1 0 -1\nv 1 1 -1\nvt 2 0\nvt 2 1\n" + before_faces +
           "f 1/1 2/2 3/3 4/4\nf 2/2 5/5 6/6 3/3\n";
}

TEST(Obj, SmoothingGroupsDecideWhereNormalsAreMissing) {
    const TempFolder folder;
    EXPECT_EQ(make(folder, folded("s 1\n")).vec3("NORMAL").size(), 6U);
    EXPECT_EQ(make(folder, folded("s off\n")).vec3("NORMAL").size(), 8U);
    EXPECT_EQ(make(folder, folded("s 0\n")).vec3("NORMAL").size(), 8U);
    EXPECT_EQ(make(folder, folded("")).vec3("NORMAL").size(), 8U) << "glTF's default is flat";
    EXPECT_EQ(make(folder, std::string(kQuad) + "v 1 0 -1\nv 1 1 -1\ns 1\nf 1/1 2/2 3/3 4/4\ns 2\nf 2/2 5/1 6/4 3/3\n")
                  .vec3("NORMAL")
                  .size(),
              8U);
    const ObjModel smooth = make(folder, folded("s 1\n"));
    EXPECT_TRUE(smooth.report.primitives[0].normals_generated);
    EXPECT_NEAR(smooth.vec3("NORMAL")[1].x, std::sqrt(0.5), 1e-6);
}

TEST(Obj, OptionsOverrideSmoothingGroups) {
    const TempFolder folder;
    GenerateOptions options = everything();
    options.normals.use_smoothing_groups = false;
    EXPECT_EQ(make(folder, folded("s 1\n"), options).vec3("NORMAL").size(), 8U);
    options.normals.compute.weighting = NormalWeighting::angle;
    EXPECT_EQ(make(folder, folded("s off\n"), options).vec3("NORMAL").size(), 6U);
    options.normals.compute.crease_angle_deg = 60;
    EXPECT_EQ(make(folder, folded("s 1\n"), options).vec3("NORMAL").size(), 8U);
}

TEST(Obj, SmoothingGoesAcrossMaterialsAndObjects) {
    const TempFolder folder;
    const ObjModel made =
        make(folder, std::string(kQuad) + "v 1 0 -1\nv 1 1 -1\ns 1\no a\nusemtl x\nf 1/1 2/2 3/3 4/4\n" +
                         "o b\nusemtl y\nf 2/2 5/1 6/4 3/3\n");
    ASSERT_EQ(made.primitives.size(), 2U);
    EXPECT_EQ(made.vec3("NORMAL", 0)[1], made.vec3("NORMAL", 1)[0]);
}

TEST(Obj, NormalsAreKeptAndNormalizedOnlyIfNotUnit) {
    const TempFolder folder;
    const ObjModel made = make(folder, std::string(kQuad) + "vn 0 0.6 0.8\nvn 0 0 2\nf 1/1/1 2/2/2 3/3/1\n");
    EXPECT_EQ(made.vec3("NORMAL"), (std::vector<Vec3>{{0, 0.6f, 0.8f}, {0, 0, 1}, {0, 0.6f, 0.8f}}));
    EXPECT_FALSE(made.report.primitives[0].normals_generated);
}

TEST(Obj, FacesWithoutTextureCoordinatesAreAPrimitiveOfTheirOwn) {
    const TempFolder folder;
    const ObjModel made = make(folder, std::string(kQuad) + "f 1/1 2/2 3/3\nf 1 3 4\n");
    ASSERT_EQ(made.report.primitives.size(), 2U);
    EXPECT_EQ(made.report.primitives[0].action, PrimitiveAction::generated);
    EXPECT_EQ(made.report.primitives[1].action, PrimitiveAction::impossible);
    EXPECT_FALSE(made.report.primitives[1].reason.empty());
    EXPECT_FALSE(made.primitives[1].find("TANGENT"));
    GenerateOptions options = everything();
    options.tangents.compute.method = Method::basis;
    EXPECT_TRUE(make(folder, std::string(kQuad) + "f 1 3 4\n", options).primitives[0].find("TANGENT"));
}

TEST(Obj, IndicesAreSixteenBitsWhereTheySuffice) {
    const auto componentType = [](int triangles) {
        std::ostringstream obj;
        obj << "vt 0 0\nvt 1 0\nvt 0 1\n";
        for (int i = 0; i < triangles; ++i) {
            obj << "v " << i << " 0 0\nv " << i << ".5 0 0\nv " << i << " 1 0\nf -3/1 -2/2 -1/3\n";
        }
        const TempFolder folder;
        const ObjModel made = make(folder, obj.str());
        return made.document.json["accessors"][*made.primitives[0].indices]["componentType"].get<int>();
    };
    EXPECT_EQ(componentType(21845), 5123);  // 65535 vertices: the largest number for 16-bit indices
    EXPECT_EQ(componentType(21846), 5125);
}

TEST(Obj, DataThatGltfCannotRepresentIsReplacedWithAWarning) {
    const TempFolder folder;
    const ObjModel made =
        make(folder, "v nan 0 0\nv 1e400 0 0\nv 0 1 0\nvt inf 0\nvt 1e60 0\nvt 0 1\nf 1/1 2/2 3/3\nf 1 2\n");
    EXPECT_TRUE(mentions(made.report.warnings, "invalid values"));
    EXPECT_TRUE(mentions(made.report.warnings, "not finite"));
    EXPECT_TRUE(mentions(made.report.warnings, "fewer than 3 corners"));
    for (const Vec3& p : made.vec3("POSITION")) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
    for (const Vec4& t : gltf::readTangents(made.document, made.primitives[0])) {
        EXPECT_NEAR(std::sqrt(t.x * t.x + t.y * t.y + t.z * t.z), 1, 1e-5);
    }
}

TEST(Obj, MalformedFilesAreRejectedWithTheLine) {
    EXPECT_EQ(failure("").message, "the OBJ file has no faces");
    EXPECT_EQ(failure("v 0 0 0\nf 1 1\n").message, "the OBJ file has no faces");
    EXPECT_EQ(failure(std::string(64, '\0')).message, "the OBJ file has no faces");
    for (const char* face : {"f 1 2 5", "f 1 2 -5", "f 1 2 0", "f 1 2 x", "f 0/1 1/2 2/3", "f 1 2 4294967297",
                             "f 1 2 99999999999999999999", "f 1 2 -99999999999", "f 1/4294967297 2/2 3/3"}) {
        const Error error = failure(std::string(kQuad) + "\n# comment\n" + face + "\n");
        EXPECT_EQ(error.code, ErrorCode::invalidFile) << face;
        EXPECT_EQ(error.place, "line 11") << face << ": " << error.message;
    }
}

/// Such files exist: faces with indices of missing normals, or index 0 for a corner without a normal.
TEST(Obj, FacesWithMissingUvsOrNormalsHaveNone) {
    const std::string vertices = std::string(kQuad) + "vn 0 0.6 0.8\nf 1/1/1 2/2/1 4/4/1\n";
    const std::string rest = "f 2/2/1 3/3/1 4/4/1\n";
    const TempFolder expected;
    make(expected, vertices + "f 1 2 3\n" + rest);
    for (const char* face : {"f 1/5/2 2/2/1 3/3/1", "f 1/1/1 2/-5/1 3/3/-2", "f 1/9/9 2/9/9 3/9/9",
                             "f 1/0/0 2/0/0 3/0/0", "f 1/1/1 2/999999999/1 3/3/999999999", "f 1/0/1 2/2/0 3/3/1"}) {
        const TempFolder folder;
        make(folder, vertices + face + "\n" + rest);
        EXPECT_EQ(folder.read("out.glb"), expected.read("out.glb")) << face;
    }
}

TEST(Obj, InvalidIndicesAreCountedAndReported) {
    const TempFolder folder;
    const ObjModel made =
        make(folder, std::string(kQuad) + "f 1/1/1 2/5/2 3/-9/3\nf 1/-5 2/2 3/3\n# ahead:\nf 1/5/1 3/3/1 4/4/1\n");
    EXPECT_TRUE(mentions(made.report.warnings,
                         "4 indices refer to texture coordinates that do not exist, the first in line 9;"));
    EXPECT_TRUE(mentions(made.report.warnings, "6 indices refer to normals that do not exist, the first in line 9;"));
    EXPECT_TRUE(make(folder, std::string(kQuad) + "f 1/0/0 2/0/0 3/0/0\n").report.warnings.empty())
        << "0 says that there is none";
}

TEST(Obj, UnusualFloatsAreParsed) {
    for (const char* number : {"1e2147483649", "1e-2147483649", "-", "+.", ".", "1e", "0e400", "1.2.3", "--1",
                               "111111111111111111111111111111111111111111111111111111"}) {
        const TempFolder folder;
        make(folder, std::string("v ") + number + " 0 0\nv 1 0 0\nv 0 1 0\nvt 0 " + number +
                         "\nvt 1 0\nvt 0 1\nvn 0 0 " + number + "\nf 1/1/1 2/2/1 3/3/1\n");
    }
}

/// Returns the processor time, in seconds, of preparing a text with this number of faces.
double secondsToPrepare(int face_count) {
    std::string text;
    for (int f = 0; f < face_count; ++f) text += "f 1/1 2/2 3/3 4/4\n";
    const std::clock_t begin = std::clock();
    obj::prepareLines(text);
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

TEST(ObjTime, GrowsLinearlyWithTheNumberOfFaces) {
    // Ten times the faces take ten times the time. A search through the rest of the file would take a hundred times.
    EXPECT_LT(secondsToPrepare(400000), 40 * secondsToPrepare(40000) + 0.05);
}

TEST(Obj, OnlyGlTfIsWritten) {
    const TempFolder folder;
    const std::string input = folder.write("a.obj", std::string(kQuad) + "f 1/1 2/2 3/3\n");
    EXPECT_FALSE(generateFile(input, (folder.path() / "b.obj").string()));
    EXPECT_EQ(folder.files(), std::set<std::string>{"a.obj"});
}

/// Returns all .obj files below a folder of the shared data.
std::vector<std::string> sharedObjFiles(const std::string& relative) {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shared(relative))) {
        if (entry.path().extension() == ".obj") files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    return files;
}

TEST(Obj, EverySharedModelIsConverted) {
    TSPACE_NEEDS_SHARED("models");
    const std::vector<std::string> files = sharedObjFiles("models");
    ASSERT_FALSE(files.empty());
    for (const std::string& file : files) {
        const TempFolder folder;
        Result<GenerateReport> report = generateFile(file, (folder.path() / "out.glb").string(), everything());
        ASSERT_TRUE(report) << file << ": " << report.error().message;
        const gltf::Document document = gltf::loadDocument(folder.path() / "out.glb", {});
        for (const gltf::Primitive& primitive : gltf::readPrimitives(document)) {
            for (const Vec3& n : gltf::readVec3(document, primitive, "NORMAL")) {
                EXPECT_NEAR(std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z), 1, 5e-4) << file;
            }
            EXPECT_EQ(primitive.find("TANGENT").has_value(), primitive.find("TEXCOORD_0").has_value()) << file;
        }
    }
}

TEST(Obj, BrokenSharedFilesAreReadOrRefused) {
    TSPACE_NEEDS_SHARED("bad");
    for (const std::string& file : sharedObjFiles("bad")) {
        const TempFolder folder;
        Result<GenerateReport> report = generateFile(file, (folder.path() / "out.glb").string(), everything());
        if (report) continue;
        EXPECT_EQ(report.error().code, ErrorCode::invalidFile) << file;
        EXPECT_EQ(report.error().message.find('\n'), std::string::npos) << file;
        EXPECT_TRUE(folder.files().empty()) << file;
    }
}

TEST(Obj, EveryTruncationOfAFileIsReadOrRefused) {
    const std::string whole = "mtllib m.mtl\n" + folded("s 1\nusemtl a\nvn 0 0 1\n") + "o x\nf 1//1 2//1 3//1\n";
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const TempFolder folder;
        folder.write("in/m.mtl", std::string("newmtl a\nmap_Kd -clamp on -s 1 1 x.png\nnorm n.png").substr(0, length));
        Result<GenerateReport> report = tryMake(folder, whole.substr(0, length), everything());
        EXPECT_TRUE(report || report.error().code == ErrorCode::invalidFile) << length;
    }
}

}  // namespace
}  // namespace tspace::test
