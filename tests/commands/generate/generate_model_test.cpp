// SPDX-License-Identifier: MIT
// The result of generating in memory equals what a reader gets from the generated GLB.
#include "commands/generate/generate_model.h"

#include <gtest/gtest.h>

#include <cstring>

#include "model/io/file_io.h"
#include "model/read/read_scene.h"
#include "support/shared_data.h"
#include "support/temp_folder.h"

namespace tspace::test {
namespace {

template <class T>
void expectSame(const SharedArray<T>& a, const SharedArray<T>& b, const std::string& what) {
    ASSERT_EQ(a.size(), b.size()) << what;
    EXPECT_TRUE(a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0) << what;
}

void expectSame(const DrawnScene& a, const DrawnScene& b) {
    EXPECT_EQ(a.scene.format, b.scene.format);
    EXPECT_EQ(a.scene.generator, b.scene.generator);
    EXPECT_EQ(a.placements.size(), b.placements.size());
    ASSERT_EQ(a.scene.images.size(), b.scene.images.size());
    for (std::size_t i = 0; i < a.scene.images.size(); ++i)
        EXPECT_EQ(a.scene.images[i].bytes, b.scene.images[i].bytes) << "image " << i;
    ASSERT_EQ(a.scene.primitives.size(), b.scene.primitives.size());
    for (std::size_t i = 0; i < a.scene.primitives.size(); ++i) {
        const ScenePrimitive &one = a.scene.primitives[i], &other = b.scene.primitives[i];
        const std::string place = one.place + " ";
        EXPECT_EQ(one.place, other.place);
        EXPECT_EQ(one.mode, other.mode);
        expectSame(one.corners, other.corners, place + "corners");
        expectSame(one.positions, other.positions, place + "positions");
        expectSame(one.normals, other.normals, place + "normals");
        expectSame(one.tangents, other.tangents, place + "tangents");
        ASSERT_EQ(one.uv_sets.size(), other.uv_sets.size());
        for (std::size_t set = 0; set < one.uv_sets.size(); ++set)
            expectSame(one.uv_sets[set], other.uv_sets[set], place + "UVs");
        ASSERT_EQ(one.morph_targets.size(), other.morph_targets.size());
        for (std::size_t target = 0; target < one.morph_targets.size(); ++target)
            expectSame(one.morph_targets[target].tangents, other.morph_targets[target].tangents, place + "deltas");
    }
}

class GenerateModel : public testing::TestWithParam<const char*> {};

TEST_P(GenerateModel, EqualsTheModelReadFromItsGlb) {
    TSPACE_NEEDS_SHARED(GetParam());
    const TempFolder folder;
    const std::string input = shared(GetParam()).string(), output = folder.path("out.glb").string();
    GenerateOptions options{.selection = {.existing = ExistingTangents::replace}};
    options.selection.all = true;
    const Result<GenerateReport> written = generateFile(input, output, options);
    ASSERT_TRUE(written) << written.error().message;
    gltf::GeneratedModel made = generateModel(input, options, true);
    EXPECT_EQ(made.report.changed, written->changed);
    ASSERT_EQ(made.report.primitives.size(), written->primitives.size());
    for (std::size_t i = 0; i < written->primitives.size(); ++i) {
        EXPECT_EQ(made.report.primitives[i].action, written->primitives[i].action);
        EXPECT_EQ(made.report.primitives[i].notes, written->primitives[i].notes);
    }
    EXPECT_TRUE(made.report.output_files.empty());
    expectSame(made.model.drawnScene(true), readDrawnScene(output, {}, true));
}

INSTANTIATE_TEST_SUITE_P(Models, GenerateModel,
                         testing::Values("models/features/BoxTextured_meshopt.glb",
                                         "models/features/pirate_meshopt.glb",
                                         "models/features/meshopt-no-fallback/meshopt-no-fallback.gltf",
                                         "models/features/BoxDraco/BoxDraco.gltf",
                                         "models/derived/NormalTangentTest_draco.glb",
                                         "models/derived/Lantern_quantized.glb", "models/khronos/CesiumMan.glb",
                                         "models/obj/spot.obj", "reports/morph_pos_only.glb", "reports/two_mats.obj"));

TEST(GenerateModelOptions, RejectsOptionsLikeGenerateFile) {
    GenerateOptions options{.selection = {.strip = true}};
    options.selection.all = true;
    const std::optional<Error> error =
        tryFile([&] { static_cast<void>(generateModel("no such file.glb", options, false)); });
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code, ErrorCode::invalidOption);
}

}  // namespace
}  // namespace tspace::test
