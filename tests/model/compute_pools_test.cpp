// SPDX-License-Identifier: MIT
// Pools of vertices are computed in parallel. This has no effect on the file.
#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <thread>

#include "gltf_builder.h"
#include "support/temp_folder.h"
#include "tspace/execution.h"
#include "tspace/generate.h"

namespace tspace {
namespace {

using gltf::Json;
using test::GltfBuilder;
using test::TempFolder;

constexpr int kU32 = 5125;

/// Adds a primitive with accessors of its own: a grid whose rows are partly mirrored, so that vertices are split.
void addGrid(GltfBuilder& builder, std::uint32_t side, std::uint32_t seed, std::uint32_t wrong_index = 0) {
    std::vector<float> positions, normals, uvs;
    for (std::uint32_t y = 0; y <= side; ++y) {
        for (std::uint32_t x = 0; x <= side; ++x) {
            positions.insert(positions.end(), {static_cast<float>(x), static_cast<float>(y),
                                               static_cast<float>((x * 7 + y * 5 + seed) % 3)});
            normals.insert(normals.end(), {0.0f, 0.0f, 1.0f});
            const float u = static_cast<float>((x + seed) % 5 < 3 ? x : side - x);
            uvs.insert(uvs.end(), {u, static_cast<float>(y)});
        }
    }
    std::vector<std::uint32_t> indices;
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint32_t a = y * (side + 1) + x, b = a + 1, c = a + side + 1, d = c + 1;
            indices.insert(indices.end(), {a, b, d, a, d, c});
        }
    }
    indices[0] += wrong_index;
    const std::size_t position = builder.addFloats(positions, 3), normal = builder.addFloats(normals, 3),
                      uv = builder.addFloats(uvs, 2),
                      index = builder.addAccessor(indices, kU32, "SCALAR", indices.size());
    builder.addPrimitive({{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}})["indices"] = index;
}

/// Returns a model with one pool that is larger than all others, and many small ones.
GltfBuilder manyPools() {
    GltfBuilder builder;
    for (std::uint32_t i = 0; i < 12; ++i) addGrid(builder, i == 5 ? 60 : 3 + 2 * (i % 4), i);
    return builder;
}

GenerateOptions withExecution(const Execution& execution) {
    GenerateOptions options{.selection = {.all = true}};
    options.execution = execution;
    return options;
}

Bytes generated(const Bytes& model, const Execution& execution) {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", model), output = folder.path("out.glb").string();
    const auto report = generateFile(input, output, withExecution(execution));
    EXPECT_TRUE(report);
    if (!report) return {};
    std::size_t splits = 0;
    for (const PrimitiveReport& primitive : report->primitives) {
        splits += primitive.vertices_after - primitive.vertices_before;
    }
    EXPECT_GT(splits, 0u);
    return readFile(output);
}

TEST(ComputePools, GivesTheSameFileForAnyThreadCount) {
    const Bytes model = manyPools().glb();
    const Bytes expected = generated(model, {.thread_count = 1});
    for (const unsigned threads : {2u, 3u, 16u}) EXPECT_EQ(generated(model, {.thread_count = threads}), expected);
}

TEST(ComputePools, CallsTheCallersAllocatorFromTheCallingThreadOnly) {
    struct Calls {
        std::thread::id caller = std::this_thread::get_id();
        std::atomic<int> own = 0, foreign = 0;
    } calls;
    const Allocator allocator{
        .allocate =
            [](void* user, std::size_t bytes, std::size_t alignment) {
                auto& self = *static_cast<Calls*>(user);
                ++(std::this_thread::get_id() == self.caller ? self.own : self.foreign);
                return ::operator new(bytes, std::align_val_t(alignment));
            },
        .release = [](void*, void* memory, std::size_t,
                      std::size_t alignment) { ::operator delete(memory, std::align_val_t(alignment)); },
        .user = &calls};
    const Bytes model = manyPools().glb();
    EXPECT_EQ(generated(model, {.thread_count = 4, .allocator = &allocator}), generated(model, {.thread_count = 1}));
    EXPECT_GT(calls.own, 0);
    EXPECT_EQ(calls.foreign, 0);
}

TEST(ComputePools, ReportTheFirstErrorInTheFileForAnyThreadCount) {
    GltfBuilder builder;
    for (std::uint32_t i = 0; i < 8; ++i) addGrid(builder, i == 6 ? 60 : 12, i, i >= 3 ? 1'000'000 : 0);
    const TempFolder folder;
    const std::string input = folder.write("in.glb", builder.glb());
    for (const unsigned threads : {1u, 2u, 5u}) {
        const auto report =
            generateFile(input, folder.path("out.glb").string(), withExecution({.thread_count = threads}));
        ASSERT_FALSE(report);
        EXPECT_EQ(report.error().place, "/meshes/0/primitives/3/indices");
        EXPECT_FALSE(folder.has("out.glb"));
    }
}

}  // namespace
}  // namespace tspace
