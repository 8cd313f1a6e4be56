// SPDX-License-Identifier: MIT
// A model and its arrays: caching, how they count toward the memory budget, and recomputation after a change.
#include "model/gltf/model.h"
#include "model/gltf/load_document.h"

#include <gtest/gtest.h>

#include <thread>

#include "gltf_builder.h"
#include "model/io/file_error.h"

namespace tspace::gltf {
namespace {

using test::GltfBuilder;

/// Returns a model of two primitives that share their positions.
Model twoPrimitives(const FileOptions& options = {}) {
    GltfBuilder builder;
    builder.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
    builder.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    builder.addPrimitive({{"POSITION", 0}, {"NORMAL", 1}});
    builder.addPrimitive({{"POSITION", 0}});
    return Model(parseDocument(builder.glb(), "model.glb", options));
}

TEST(DecodedArrays, SharesAnArrayWhileItIsInUse) {
    Model model = twoPrimitives();
    const SharedArray<Vec3> first = model.arrays().vec3(0, {}), second = model.arrays().vec3(0, {});
    EXPECT_EQ(first.data(), second.data());
    EXPECT_EQ(model.arrays().borrowVec3(model.primitives()[1], "POSITION").data(), first.data());
    EXPECT_EQ(model.sceneOf().primitives[1].positions.data(), first.data());
}

TEST(DecodedArrays, ChargesAnArrayOnceUntilItsLastUserReleasesIt) {
    Model model = twoPrimitives();
    const MemoryBudget& memory = *model.document().memory;
    const std::int64_t before = memory.left();
    {
        const SharedArray<Vec3> first = model.arrays().vec3(0, {});
        const SharedArray<Vec3> second = model.arrays().vec3(0, {});
        EXPECT_EQ(memory.left(), before - 36);
        const SharedArray<Vec3> borrowed = model.arrays().borrowVec3(model.primitives()[0], "NORMAL");
        EXPECT_LE(memory.left(), before - 36) << "what is borrowed is not charged, primitives are";
    }
    static_cast<void>(model.primitives());
    const std::int64_t with_primitives = memory.left();
    static_cast<void>(model.scene());
    EXPECT_LT(memory.left(), with_primitives);
    model.dropScene();
    EXPECT_EQ(memory.left(), with_primitives);
    model.wasEdited();
    EXPECT_EQ(memory.left(), before);
}

TEST(DecodedArrays, RefundsTheBudgetOfFailedDecoding) {
    GltfBuilder builder;
    builder.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
    builder.addPrimitive({{"POSITION", 0}});
    Model model(parseDocument(builder.glb(), "model.glb", {}));
    const std::int64_t before = model.document().memory->left();
    EXPECT_TRUE(tryFile([&] { static_cast<void>(model.arrays().vec4(0, {})); }));
    EXPECT_EQ(model.document().memory->left(), before);
}

TEST(DecodedArrays, OutlivesItsModel) {
    SharedArray<Vec3> positions;
    {
        Model model = twoPrimitives();
        positions = model.scene().primitives[0].positions;
    }
    EXPECT_EQ(positions[1], (Vec3{1, 0, 0}));
}

TEST(DecodedArrays, ServesSeveralThreads) {
    Model model = twoPrimitives();
    const std::vector<Primitive>& primitives = model.primitives();
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([&] {
            for (int round = 0; round < 200; ++round) {
                EXPECT_EQ(model.arrays().vec3(0, {})[1], (Vec3{1, 0, 0}));
                EXPECT_EQ(model.arrays().borrowVec3(primitives[0], "POSITION").size(), 3U);
                EXPECT_EQ(model.arrays().corners(primitives[0]).size(), 3U);
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
}

TEST(Model, ReadsEditedArraysAgain) {
    Model model = twoPrimitives();
    const SharedArray<Vec3> old = model.scene().primitives[0].positions;
    model.document().json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 1;
    EXPECT_EQ(model.scene().primitives[0].positions.data(), old.data()) << "the scene is made once";
    model.wasEdited();
    EXPECT_EQ(model.scene().primitives[0].positions[0], (Vec3{0, 0, 1}));
    EXPECT_EQ(old[0], (Vec3{0, 0, 0})) << "who has an array keeps it";
}

TEST(Model, KeepsItsAddressesWhenItIsMoved) {
    Model model = twoPrimitives();
    const Primitive* const primitive = &model.primitives()[0];
    Model moved = std::move(model);
    EXPECT_EQ(&moved.primitives()[0], primitive);
    EXPECT_EQ(moved.scene().primitives.size(), 2U);
}

}  // namespace
}  // namespace tspace::gltf
