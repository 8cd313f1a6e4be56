// SPDX-License-Identifier: MIT
// Lets each allocation of each C function fail in turn.
#include <array>
#include <vector>

#include "failures/each_allocation.h"
#include "tspace/render.h"
#include "tspace/tspace.h"
#include "tspace/tspace_files.h"

namespace tspace::test {
namespace {

/// A square.
struct Square {
    float positions[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    float normals[12] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    float uvs[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    std::uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    tspace_Mesh mesh;

    Square() {
        TSPACE_INIT(mesh);
        mesh.positions = {positions, 4, 0};
        mesh.normals = {normals, 4, 0};
        mesh.uvs = {uvs, 4, 0};
        mesh.indices = {indices, 6, TSPACE_INDEX_U32};
    }
};

TEST_F(FailingMemory, OfTheCFunctionsThatMakeFrames) {
    const Square square;
    tspace_Error error;
    const auto code = [](tspace_ErrorCode from) { return static_cast<ErrorCode>(from); };
    std::vector<float> tangents(24);
    error = {};
    tspace_TangentOptions options;
    TSPACE_INIT(options);
    tspace_findConvention("gltf", &options.convention, nullptr);
    onlyReads("tangents", [&] {
        tspace_TangentOutput out;
        TSPACE_INIT(out);
        out.tangents = {tangents.data(), 6, 0};
        return code(tspace_generateTangents(&square.mesh, &options, &out, nullptr, nullptr, &error));
    });
    EXPECT_STREQ(error.message, "");
    onlyReads("plan", [&] {
        tspace_TangentPlan* plan = nullptr;
        const ErrorCode made = code(tspace_planTangents(&square.mesh, &options, nullptr, &plan, &error));
        tspace_destroyTangentPlan(plan);
        return made;
    });
    std::vector<float> normals(18);
    onlyReads("normals", [&] {
        tspace_NormalOptions chosen;
        TSPACE_INIT(chosen);
        chosen.convention = options.convention;
        chosen.weighting = TSPACE_NORMAL_WEIGHTING_BEST;
        return code(tspace_generateNormals(&square.mesh, &chosen, {normals.data(), 6, 0}, nullptr, nullptr, &error));
    });
    onlyReads("triangulate", [&] {
        tspace_Triangulation* made = nullptr;
        const ErrorCode said = code(tspace_triangulate(&square.mesh, &made, &error));
        tspace_destroyTriangulation(made);
        return said;
    });
    onlyReads("split", [&] {
        const tspace_CornerAttribute attribute = {tangents.data(), 0, 4, 0};
        tspace_SplitResult* made = nullptr;
        const ErrorCode said =
            code(tspace_splitVertices(&square.mesh.indices, 4, 6, &attribute, 1, nullptr, &made, &error));
        tspace_destroySplitResult(made);
        return said;
    });
    onlyReads("indexed frames", [&] {
        tspace_IndexedFramesOptions chosen;
        TSPACE_INIT(chosen);
        chosen.tangents = &options;
        chosen.sanitize = 1;
        tspace_IndexedFrames* made = nullptr;
        const ErrorCode said = code(tspace_makeIndexedFrames(&square.mesh, &chosen, nullptr, &made, &error));
        tspace_destroyIndexedFrames(made);
        return said;
    });
    onlyReads("arena", [&] {
        tspace_Arena* made = nullptr;
        const ErrorCode said = code(tspace_createArena(&made, &error));
        if (made != nullptr) tspace_destroyArena(made);
        return said;
    });
}

TEST_F(FailingMemory, OfTheCFunctionsThatProcessExistingFrames) {
    const Square square;
    std::vector<float> tangents(24);
    for (int corner = 0; corner < 6; ++corner) tangents[4 * corner] = tangents[4 * corner + 3] = 1;
    tspace_Error error;
    const auto code = [](tspace_ErrorCode from) { return static_cast<ErrorCode>(from); };
    tspace_TangentOptions options;
    TSPACE_INIT(options);
    ASSERT_EQ(tspace_findConvention("gltf", &options.convention, nullptr), TSPACE_OK);
    tspace_TangentPlan* plan = nullptr;
    ASSERT_EQ(tspace_planTangents(&square.mesh, &options, nullptr, &plan, nullptr), TSPACE_OK);
    tspace_Pose pose;
    TSPACE_INIT(pose);
    pose.positions = square.mesh.positions;
    pose.normals = square.mesh.normals;
    onlyReads("evaluate", [&] {
        tspace_TangentOutput out;
        TSPACE_INIT(out);
        out.tangents = {tangents.data(), 6, 0};
        return code(tspace_evaluateTangents(plan, &pose, &out, nullptr, nullptr, &error));
    });
    onlyReads("describe", [&] {
        tspace_TangentPlanInfo info;
        TSPACE_INIT(info);
        return code(tspace_describeTangentPlan(plan, &info, &error));
    });
    tspace_destroyTangentPlan(plan);
    onlyReads("sanitize", [&] {
        return code(tspace_sanitizeTangents(&square.mesh, nullptr, {tangents.data(), 6, 0}, nullptr, nullptr, &error));
    });
    std::array<std::uint8_t, 2> turned = {};
    onlyReads("winding", [&] {
        return code(tspace_mendWinding(&square.mesh, nullptr, turned.data(), 2, nullptr, nullptr, &error));
    });
    onlyReads("noise", [&] {
        tspace_PositionNoise noise;
        TSPACE_INIT(noise);
        return code(tspace_measurePositionNoise(&square.mesh, nullptr, &noise, &error));
    });
    const tspace_FrameFormat format = TSPACE_FRAME_FORMAT_FRAME32;
    std::vector<std::uint8_t> packed(4 * tspace_frameBytes(format));
    onlyReads("pack", [&] {
        return code(tspace_packFrames(square.mesh.normals, {tangents.data(), 4, 0}, format, packed.data(),
                                      packed.size(), nullptr, &error));
    });
    std::vector<float> normals(12);
    onlyReads("unpack", [&] {
        return code(tspace_unpackFrames(packed.data(), packed.size(), format, {normals.data(), 4, 0},
                                        {tangents.data(), 4, 0}, &error));
    });
    onlyReads("validate", [&] { return code(tspace_validate(&square.mesh, &error)); });
}

TEST_F(FailingMemory, OfTheCFunctionsOfFiles) {
    tspace_Error error;
    const char* plain = at("plain.glb").c_str();
    const char* other = at("other.glb").c_str();
    const char* folded = at("folded.obj").c_str();
    const char* all = R"({"all": true, "overwrite": true, "method": "angle"})";
    const auto freed = [&](tspace_ErrorCode from, std::initializer_list<tspace_Bytes*> bytes) {
        for (tspace_Bytes* each : bytes) tspace_destroyBytes(each);
        std::snprintf(last_message.data(), last_message.size(), "%s", error.message);
        return static_cast<ErrorCode>(from);
    };
    const std::string glb = folder_.read("plain.glb");
    tspace_Model model;
    TSPACE_INIT(model);
    model.data = reinterpret_cast<const std::uint8_t*>(glb.data());
    model.size = glb.size();
    const auto fromFile = [&](const char* name, auto* function) {
        onlyReads(name, [&, function] {
            tspace_Bytes report{};
            const tspace_ErrorCode made = function(plain, nullptr, &report, &error);
            return freed(made, {&report});
        });
    };
    const auto fromBytes = [&](const char* name, auto* function) {
        onlyReads(name, [&, function] {
            tspace_Bytes report{};
            const tspace_ErrorCode made = function(&model, nullptr, &report, &error);
            return freed(made, {&report});
        });
    };
    fromFile("check file", tspace_checkFile);
    fromFile("inspect file", tspace_inspectFile);
    fromFile("identify file", tspace_identifyFile);
    fromBytes("check bytes", tspace_checkBytes);
    fromBytes("inspect bytes", tspace_inspectBytes);
    fromBytes("identify bytes", tspace_identifyBytes);
    onlyReads("diff files", [&] {
        tspace_Bytes report{};
        const tspace_ErrorCode made = tspace_diffFiles(plain, other, nullptr, &report, &error);
        return freed(made, {&report});
    });
    onlyReads("diff bytes", [&] {
        tspace_Bytes report{};
        const tspace_ErrorCode made = tspace_diffBytes(&model, &model, nullptr, &report, &error);
        return freed(made, {&report});
    });
    onlyReads("generate bytes", [&] {
        tspace_Bytes output{}, report{};
        const tspace_ErrorCode made = tspace_generateBytes(&model, all, &output, &report, &error);
        return freed(made, {&output, &report});
    });
    const auto toFile = [&](const char* name, const char* output, const auto& call) {
        const char* path = at(output).c_str();
        writesOne(name, output, [&, path] {
            tspace_Bytes report{};
            const tspace_ErrorCode made = call(path, &report);
            return freed(made, {&report});
        });
    };
    toFile("generate file", "made.glb", [&](const char* output, tspace_Bytes* report) {
        return tspace_generateFile(plain, output, all, report, &error);
    });
    RenderOptions small;
    small.width = small.height = 16;
    if (!renderFile(plain, at("picture.png"), small)) GTEST_SKIP() << "built without images";
    const char* picture = at("picture.png").c_str();
    const std::string png = folder_.read("picture.png");
    const auto* pixels = reinterpret_cast<const std::uint8_t*>(png.data());
    const auto fromPixels = [&](const char* name, auto* function) {
        onlyReads(name, [&, function] {
            tspace_Bytes output{}, report{};
            const tspace_ErrorCode made = function(pixels, png.size(), nullptr, &output, &report, &error);
            return freed(made, {&output, &report});
        });
    };
    fromPixels("flip bytes", tspace_flipGreenBytes);
    fromPixels("compress bytes", tspace_compressMapBytes);
    const auto ofPicture = [&](const char* name, const char* output, auto* function) {
        toFile(name, output, [&, function](const char* path, tspace_Bytes* report) {
            return function(picture, path, nullptr, report, &error);
        });
    };
    ofPicture("flip file", "flipped.png", tspace_flipGreenFile);
    ofPicture("convert file", "converted.png", tspace_convertMapFile);
    ofPicture("height file", "heights.png", tspace_heightToNormalFile);
    ofPicture("compress file", "blocks.ktx2", tspace_compressMapFile);
    toFile("finish file", "ready.glb", [&](const char* output, tspace_Bytes* report) {
        return tspace_finishFile(folded, output, nullptr, report, &error);
    });
    if (tspace_bakeFile(plain, other, at("baked.png").c_str(), R"({"size": "16"})", nullptr, &error) != TSPACE_OK)
        GTEST_SKIP() << error.message;
    toFile("bake file", "baked.png", [&](const char* output, tspace_Bytes* report) {
        return tspace_bakeFile(plain, other, output, R"({"size": "16"})", report, &error);
    });
}

TEST_F(FailingMemory, OfCFunctionsWithInvalidArgumentsIsAnError) {
    const Square square;
    tspace_Error error;
    const std::string path = at("plain.glb");
    for (long k = 1; k < 200; ++k) {
        for (const bool all_after : {false, true}) {
            const auto fails = [&](auto&& call) {
                failAllocation(k, all_after);
                const tspace_ErrorCode made = call();
                stopFailing();
                EXPECT_NE(made, TSPACE_OK) << k;
            };
            tspace_Bytes bytes{};
            tspace_Mesh wrong = square.mesh;
            wrong.struct_size = 7;
            fails([&] { return tspace_generateTangents(&wrong, nullptr, nullptr, nullptr, nullptr, &error); });
            fails([&] { return tspace_validate(&wrong, &error); });
            fails([&] { return tspace_validate(nullptr, &error); });
            fails([&] { return tspace_checkFile(nullptr, nullptr, &bytes, &error); });
            fails(
                [&] { return tspace_checkFile(path.c_str(), "{\"no such option\": 1, \"nor\": 2}", &bytes, &error); });
            fails([&] { return tspace_checkFile("/no/such/file/that/has/a/long/name.glb", nullptr, &bytes, &error); });
            fails([&] { return tspace_generateFile(path.c_str(), "/dev/null/x.glb", nullptr, &bytes, &error); });
            fails([&] { return tspace_inspectBytes(nullptr, nullptr, &bytes, &error); });
        }
    }
}

}  // namespace
}  // namespace tspace::test
