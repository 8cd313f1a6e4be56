// SPDX-License-Identifier: MIT
// The library in a process with little address space (RLIMIT_AS): each function succeeds or reports that it is out of
// memory.
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <functional>
#include <new>
#include <string>
#include <vector>

#include "support/grid_obj.h"
#include "support/temp_folder.h"
#include "tspace/bake_file.h"
#include "tspace/check.h"
#include "tspace/execution.h"
#include "tspace/generate.h"
#include "tspace/indexed_frames.h"
#include "tspace/maps.h"
#include "tspace/normals.h"
#include "tspace/result.h"
#include "tspace/tangents.h"

namespace tspace::test {
namespace {

constexpr int kDone = 0, kOutOfMemory = 5, kOther = 3;

/// Returns the exit code of a child process that runs call() with `megabytes` of address space, or the negated number
/// of the signal that ended it.
int exitWithin(std::uint64_t megabytes, const std::function<ErrorCode()>& call) {
    const pid_t child = fork();
    if (child == 0) {
        const rlimit none = {0, 0}, addresses = {megabytes << 20, megabytes << 20};
        setrlimit(RLIMIT_CORE, &none);
        alarm(20);
        if (setrlimit(RLIMIT_AS, &addresses) != 0) _exit(99);
        ErrorCode code = ErrorCode::outOfMemory;
        try {
            code = call();
        } catch (const std::bad_alloc&) {
            // Vectors of this test, or the constructor of Arena, threw it.
        }
        _exit(code == ErrorCode::ok ? kDone : code == ErrorCode::outOfMemory ? kOutOfMemory : kOther);
    }
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

template <class Value>
ErrorCode codeOf(const Result<Value>& result) {
    return result ? ErrorCode::ok : result.error().code;
}

struct Grid {
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<std::uint32_t> indices;
    MeshView view;

    explicit Grid(std::uint32_t side) {
        for (std::uint32_t y = 0; y <= side; ++y) {
            for (std::uint32_t x = 0; x <= side; ++x) {
                const float u = static_cast<float>(x) / static_cast<float>(side);
                const float v = static_cast<float>(y) / static_cast<float>(side);
                positions.push_back({u, v, 0.01F * std::sin(40 * u)});
                normals.push_back({0, 0, 1});
                uvs.push_back({u, v});
            }
        }
        for (std::uint32_t y = 0; y < side; ++y) {
            for (std::uint32_t x = 0; x < side; ++x) {
                const std::uint32_t a = y * (side + 1) + x, b = a + side + 1;
                indices.insert(indices.end(), {a, a + 1, b + 1, a, b + 1, b});
            }
        }
        view = {.positions = positions, .normals = normals, .uvs = uvs, .indices = IndexView(indices)};
    }
};

TEST(ScarceAddresses, EndNoFunctionOfTheLibraryBySignal) {
    const Grid grid(300);
    const TempFolder folder;
    const std::string obj = folder.write("grid.obj", gridObj(60, 0.01)), glb = folder.path("grid.glb").string();
    const std::string output = folder.path("new.glb").string(), map = folder.path("new.png").string();
    GenerateOptions all;
    all.selection.all = true;
    BakeFileOptions small;
    small.map.width = small.map.height = 16;
    ASSERT_TRUE(generateFile(obj, glb, all));
    struct Named {
        const char* name;
        std::function<ErrorCode()> call;
    };
    std::vector<Vec4> tangents(grid.indices.size());
    const Execution threads{.thread_count = 4};
    const TangentOptions tangent_options{.convention = conventions::gltf};
    const NormalOptions normal_options{.convention = conventions::gltf};
    const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const std::vector<Vec3> up(6, {0, 0, 1});
    const std::vector<Vec4> right(6, {1, 0, 0, 1});
    const std::vector<Vec2> corner_uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    const std::vector<Named> calls = {
        {"generateTangents",
         [&] { return codeOf(generateTangents(grid.view, tangent_options, {.tangents = tangents}, threads)); }},
        {"generateTangents in an arena",
         [&] {
             Arena arena;
             return codeOf(generateTangents(grid.view, tangent_options, {.tangents = tangents},
                                            {.thread_count = 4, .allocator = arena.allocator()}));
         }},
        {"planTangents", [&] { return codeOf(planTangents(grid.view, tangent_options, threads)); }},
        {"generateNormals",
         [&] {
             std::vector<Vec3> normals(grid.indices.size());
             return codeOf(generateNormals(grid.view, normal_options, normals, threads));
         }},
        {"makeIndexedFrames",
         [&] { return codeOf(makeIndexedFrames(grid.view, {.tangents = tangent_options}, threads)); }},
        {"bakeMap",
         [&] {
             const LowPoly low{.positions = corners, .normals = up, .tangents = right, .uvs = corner_uvs};
             const HighPoly high{.positions = grid.positions, .normals = grid.normals, .corners = grid.indices};
             return codeOf(bakeMap(low, high, {.width = 64, .height = 64}, threads));
         }},
        {"generateFile", [&] { return codeOf(generateFile(glb, output, all)); }},
        {"generateFile of OBJ", [&] { return codeOf(generateFile(obj, output, all)); }},
        {"checkFile", [&] { return codeOf(checkFile(glb)); }},
        {"bakeFile", [&] { return codeOf(bakeFile(glb, glb, map, small)); }},
    };
    for (const Named& each : calls) {
        // Builds without images or without Embree cannot bake.
        const int unlimited = exitWithin(1 << 20, each.call);
        const auto removeOutputs = [&] {
            for (const char* name : {"new.glb", "new.png"}) std::filesystem::remove(folder.path(name));
        };
        removeOutputs();
        if (!std::string(each.name).starts_with("bake")) {
            ASSERT_EQ(unlimited, kDone) << each.name;
        }
        for (std::uint64_t megabytes = 16; megabytes <= 256; megabytes += TSPACE_LIMIT_STEP) {
            const int code = exitWithin(megabytes, each.call);
            EXPECT_TRUE(code == unlimited || code == kOutOfMemory) << each.name << ", " << megabytes << " MB: " << code;
            const std::set<std::string> files = folder.files();
            for (const std::string& name : files)
                EXPECT_TRUE(name.starts_with("grid.") || name.starts_with("new.")) << name;
            const bool has_output = folder.has("new.glb") || folder.has("new.png");
            EXPECT_FALSE(code == kOutOfMemory && has_output) << each.name << ", " << megabytes << " MB";
            removeOutputs();
        }
    }
}

}  // namespace
}  // namespace tspace::test
