// SPDX-License-Identifier: MIT
// Memory ends at each allocation in turn, and callbacks throw: every call comes back with an error, and files are the old
// ones or the new ones.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <new>
#include <set>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "failures/failing_memory.h"
#include "support/temp_folder.h"
#include "tspace/asset.h"
#include "tspace/bake_file.h"
#include "tspace/check.h"
#include "tspace/diff.h"
#include "tspace/flip_green.h"
#include "tspace/identify.h"
#include "tspace/map_convert_file.h"
#include "tspace/render.h"
#include "tspace/tspace.h"
#include "tspace/tspace_files.h"

namespace tspace::test {
namespace {

std::array<char, 200> last_message = {};

template <class Value>
ErrorCode codeOf(const Result<Value>& result) {
    if (result) return ErrorCode::ok;
    std::snprintf(last_message.data(), last_message.size(), "%s", result.error().message.c_str());
    return result.error().code;
}

/// Calls call() with an allocation that fails, the first, the second and so on, until one comes back that needed fewer; once
/// with that one alone, once with all that follow. call() gives an ErrorCode; look(k) is asked after each.
template <class Call, class Look>
void failEachAllocation(const char* name, const Call& call, const Look& look) {
    for (const bool all_after : {false, true}) {
        constexpr long kMost = 200000;
        long k = 1, failures = 0;
        // Beyond some thousand not every one, for time's sake.
        for (; k < kMost; k += 1 + k / 1000) {
            failAllocation(k, all_after);
            const ErrorCode code = call();
            const bool was_reached = stopFailing();
            if (!was_reached && code != ErrorCode::ok)
                FAIL() << name << ": " << errorName(code) << " without a failure";
            if (!was_reached) {
                look(k, code);
                break;
            }
            failures += code != ErrorCode::ok;
            // What one can do without is left out; nothing else than memory may be blamed.
            // Embree does not always know why it fails.
            const bool is_embree =
                code == ErrorCode::internal && std::string_view(last_message.data()).starts_with("Embree");
            ASSERT_TRUE(code == ErrorCode::ok || code == ErrorCode::outOfMemory || is_embree)
                << name << ", allocation " << k << ": " << errorName(code) << ": " << last_message.data();
            look(k, code);
            if (::testing::Test::HasFailure()) return;
        }
        EXPECT_LT(k, kMost) << name;
        // Small meshes of the C API find room in what a thread keeps.
        EXPECT_TRUE(failures > 0 || k == 1) << name << ": no allocation failed";
    }
}

constexpr const char* kObj =
    "mtllib folded.mtl\no folded\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\n"
    "vt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nvt 1 0\nvt 1 1\nusemtl skin\nf 1/1 2/2 3/3 4/4\nf 2/2 5/5 6/6 3/3\n";

class FailingMemory : public ::testing::Test {
  protected:
    FailingMemory() {
        folder_.write("folded.obj", kObj);
        folder_.write("folded.mtl", "newmtl skin\n");
        GenerateOptions all;
        all.all = true;
        EXPECT_TRUE(generateFile(at("folded.obj"), at("plain.glb"), all));
        EXPECT_TRUE(generateFile(at("folded.obj"), at("plain.gltf"), all));
        all.tangents.method = Method::angle;
        all.existing = ExistingTangents::replace;
        EXPECT_TRUE(generateFile(at("plain.glb"), at("other.glb"), all));
    }
    /// Takes memory the first time only. `name` is short enough to take none.
    const std::string& at(const std::string& name) {
        const auto known = paths_.find(name);
        return known != paths_.end() ? known->second : paths_.emplace(name, folder_.path(name).string()).first->second;
    }

    /// The call must change no file, and leave none.
    template <class Call>
    void onlyReads(const char* name, const Call& call) {
        const std::set<std::string> files = folder_.files();
        ASSERT_EQ(call(), ErrorCode::ok) << name;
        failEachAllocation(name, call,
                           [&](long k, ErrorCode) { EXPECT_EQ(folder_.files(), files) << name << " " << k; });
    }
    /// The call writes the file `output` alone, whole or not at all.
    template <class Call>
    void writesOne(const char* name, const std::string& output, const Call& call) {
        std::filesystem::remove(at(output));
        ASSERT_EQ(call(), ErrorCode::ok) << name;
        const std::string whole = folder_.read(output);
        const std::set<std::string> files = folder_.files();
        folder_.write(output, std::string("old"));
        failEachAllocation(name, call, [&](long k, ErrorCode code) {
            EXPECT_EQ(folder_.files(), files) << name << " " << k;
            EXPECT_TRUE(folder_.read(output) == (code == ErrorCode::ok ? whole : "old"))
                << name << " " << k << ": " << errorName(code) << ", " << folder_.read(output).size() << " bytes";
            folder_.write(output, std::string("old"));
        });
        folder_.write(output, whole);
    }

    TempFolder folder_;
    std::map<std::string, std::string> paths_;
};

TEST_F(FailingMemory, OfGenerate) {
    for (const unsigned threads : {1U, 4U}) {
        writesOne("generate", "new.glb", [&] {
            GenerateOptions options;
            options.all = true;
            options.existing = ExistingTangents::replace;
            options.execution.thread_count = threads;
            return codeOf(generateFile(at("plain.glb"), at("new.glb"), options));
        });
    }
    writesOne("generate from OBJ", "obj.glb", [&] {
        GenerateOptions options;
        options.all = true;
        return codeOf(generateFile(at("folded.obj"), at("obj.glb"), options));
    });
    writesOne("repair", "repaired.glb", [&] {
        GenerateOptions options;
        options.existing = ExistingTangents::repair;
        return codeOf(generateFile(at("other.glb"), at("repaired.glb"), options));
    });
}

TEST_F(FailingMemory, OfGenerateIntoSeveralFiles) {
    const auto call = [&] {
        GenerateOptions options;
        options.all = true;
        options.existing = ExistingTangents::replace;
        options.tangents.method = Method::angle;
        return codeOf(generateFile(at("plain.gltf"), at("plain.gltf"), options));
    };
    std::map<std::string, std::string> before;
    for (const std::string& name : folder_.files()) before[name] = folder_.read(name);
    ASSERT_EQ(call(), ErrorCode::ok);
    std::map<std::string, std::string> after;
    for (const std::string& name : folder_.files()) after[name] = folder_.read(name);
    for (const auto& [name, bytes] : before) folder_.write(name, bytes);
    failEachAllocation("in place", call, [&](long k, ErrorCode code) {
        std::map<std::string, std::string> found;
        for (const std::string& name : folder_.files()) found[name] = folder_.read(name);
        EXPECT_TRUE(found == (code == ErrorCode::ok ? after : before)) << k;
        for (const auto& [name, bytes] : before) folder_.write(name, bytes);
    });
}

TEST_F(FailingMemory, OfCallsThatOnlyRead) {
    onlyReads("check", [&] { return codeOf(checkFile(at("other.glb"))); });
    onlyReads("check OBJ", [&] { return codeOf(checkFile(at("folded.obj"))); });
    onlyReads("inspect", [&] { return codeOf(inspectFile(at("plain.glb"))); });
    onlyReads("identify", [&] { return codeOf(identifyFile(at("other.glb"))); });
    onlyReads("diff", [&] { return codeOf(diffFiles(at("plain.glb"), at("other.glb"))); });
}

TEST_F(FailingMemory, OfPictures) {
    writesOne("render", "picture.png", [&] {
        RenderOptions options;
        options.width = options.height = 16;
        return codeOf(renderFile(at("plain.glb"), at("picture.png"), options));
    });
    writesOne("flip-green", "flipped.png", [&] { return codeOf(flipGreenFile(at("picture.png"), at("flipped.png"))); });
    ConvertMapFileOptions options;
    options.mesh = at("plain.glb");
    options.to_mesh = at("other.glb");
    writesOne("convert-map", "converted.png",
              [&] { return codeOf(convertMapFile(at("picture.png"), at("converted.png"), options)); });
}

TEST_F(FailingMemory, OfBake) {
    BakeFileOptions options;
    options.map.width = options.map.height = 16;
    const Result<BakeFileReport> tried = bakeFile(at("plain.glb"), at("other.glb"), at("baked.png"), options);
    if (!tried) GTEST_SKIP() << tried.error().message;
    writesOne("bake", "baked.png",
              [&] { return codeOf(bakeFile(at("plain.glb"), at("other.glb"), at("baked.png"), options)); });
}

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

TEST_F(FailingMemory, OfTheCFunctionsAlsoWhereTheCallIsWrong) {
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
    onlyReads("files", [&] {
        tspace_Bytes report{};
        const ErrorCode made = code(tspace_checkFile(at("plain.glb").c_str(), nullptr, &report, &error));
        tspace_destroyBytes(&report);
        return made;
    });
    // Whatever ends, a wrong call is an error and no end of the program.
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

TEST_F(FailingMemory, ASinkThatThrowsEndsTheCallWithAnError) {
    // Large enough for helper threads.
    std::string text;
    constexpr int kSide = 150;
    for (int y = 0; y <= kSide; ++y) {
        for (int x = 0; x <= kSide; ++x) {
            text += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string((x * y) % 3) + "\n";
            text += "vt " + std::to_string(x / 150.0) + " " + std::to_string(y / 150.0) + "\n";
        }
    }
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const int a = y * (kSide + 1) + x + 1, b = a + kSide + 1;
            for (const int corner : {a, a + 1, b + 1, b})
                text += (corner == a ? "f " : " ") + std::to_string(corner) + "/" + std::to_string(corner);
            text += "\n";
        }
    }
    folder_.write("grid.obj", text);
    for (const unsigned threads : {1U, 2U, 8U}) {
        for (int round = 0; round < 10; ++round) {
            GenerateOptions options;
            options.all = true;
            options.execution.thread_count = threads;
            int calls = 0;
            options.sink = [&](std::span<const std::uint8_t>) -> bool {
                if (++calls > round % 2) throw std::runtime_error("the caller's own");
                return true;
            };
            const Result<GenerateReport> result = generateFile(at("grid.obj"), "grid.glb", options);
            EXPECT_EQ(codeOf(result), ErrorCode::internal);
            options.sink = [](std::span<const std::uint8_t>) -> bool { throw std::bad_alloc(); };
            EXPECT_EQ(codeOf(generateFile(at("grid.obj"), "grid.glb", options)), ErrorCode::outOfMemory);
            options.sink = {};
            options.progress = [](const char*, std::uint64_t, std::uint64_t) { throw 7; };
            EXPECT_EQ(codeOf(generateFile(at("grid.obj"), at("grid.glb"), options)), ErrorCode::internal);
            EXPECT_FALSE(folder_.has("grid.glb"));
        }
    }
}

}  // namespace
}  // namespace tspace::test
