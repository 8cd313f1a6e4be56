// SPDX-License-Identifier: MIT
// Lets each allocation fail in turn, and lets callbacks throw. Every call returns an error, and the output files are
// either all old or all new.
#include <new>
#include <stdexcept>

#include "failures/each_allocation.h"
#include "support/grid_obj.h"
#include "tspace/bake_file.h"
#include "tspace/check.h"
#include "tspace/inspect.h"
#include "tspace/map_files.h"
#include "tspace/render.h"

namespace tspace::test {
namespace {

TEST_F(FailingMemory, OfGenerate) {
    for (const unsigned threads : {1U, 4U}) {
        writesOne("generate", "new.glb", [&] {
            GenerateOptions options;
            options.selection.all = true;
            options.selection.existing = ExistingTangents::replace;
            options.execution.thread_count = threads;
            return codeOf(generateFile(at("plain.glb"), at("new.glb"), options));
        });
    }
    writesOne("generate from OBJ", "obj.glb", [&] {
        GenerateOptions options;
        options.selection.all = true;
        return codeOf(generateFile(at("folded.obj"), at("obj.glb"), options));
    });
    writesOne("repair", "repaired.glb", [&] {
        GenerateOptions options;
        options.selection.existing = ExistingTangents::repair;
        return codeOf(generateFile(at("other.glb"), at("repaired.glb"), options));
    });
}

TEST_F(FailingMemory, OfGenerateIntoSeveralFiles) {
    const auto call = [&] {
        GenerateOptions options;
        options.selection.all = true;
        options.selection.existing = ExistingTangents::replace;
        options.tangents.compute.method = Method::angle;
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
    writesOne("height-to-normal", "heights.png",
              [&] { return codeOf(heightToNormalFile(at("picture.png"), at("heights.png"))); });
    writesOne("compress-map", "blocks.ktx2",
              [&] { return codeOf(compressMapFile(at("picture.png"), at("blocks.ktx2"))); });
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
    onlyReads("map-error", [&] { return codeOf(mapErrorFile(at("baked.png"), at("plain.glb"), at("other.glb"))); });
}

TEST_F(FailingMemory, OfFinish) {
    const FinishOptions options;
    writesOne("finish", "ready.glb", [&] { return codeOf(finishFile(at("folded.obj"), at("ready.glb"), options)); });
}

TEST_F(FailingMemory, ASinkThatThrowsEndsTheCallWithAnError) {
    // The model is large enough for helper threads.
    folder_.write("grid.obj", gridObj(150, 0.01));
    for (const unsigned threads : {1U, 2U, 8U}) {
        for (int round = 0; round < 10; ++round) {
            GenerateOptions options;
            options.selection.all = true;
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
