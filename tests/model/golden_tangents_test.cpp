// SPDX-License-Identifier: MIT
// Compares tangents for the glTF convention with those that other tools shipped: at every corner the direction is
// within 1 degree and the sign is the same. This was found to be true of the files listed here.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "gltf_builder.h"
#include "model/gltf/primitive_reader.h"
#include "model/read/read_scene.h"
#include "model_files.h"
#include "support/temp_folder.h"

namespace tspace {
namespace {

using test::shared;

struct GoldenFile {
    const char* name;
    float sign;  ///< ratio of the shipped sign to the computed sign
};

void PrintTo(const GoldenFile& file, std::ostream* out) { *out << file.name; }

// The signs of TwoSidedPlane are inverted, contrary to the specification.
constexpr GoldenFile kFiles[] = {
    {"khronos/TwoSidedPlane.glb", -1},
    {"khronos/SheenCloth.glb", 1},
    {"khronos/AnisotropyStrengthTest.glb", 1},
    {"khronos/ClearCoatTest.glb", 1},
    {"features/DuplicateMeshes/duplicate_meshes.gltf", 1},
    {"blender/01_morphed_cube/01_morphed_cube.gltf", 1},
    {"blender/01_morphed_triangle/01_morphed_triangle.gltf", 1},
    {"blender/01_plane/01_plane.gltf", 1},
    {"blender/01_cube/01_cube.gltf", 1},
};

class ShippedTangents : public testing::TestWithParam<GoldenFile> {};

TEST_P(ShippedTangents, AgreeWithOursOnEveryCorner) {
    const std::string name = std::string("models/") + GetParam().name;
    TSPACE_NEEDS_SHARED(name);
    const test::TempFolder folder;
    const std::string output = folder.path("out.glb").string();
    GenerateOptions options;
    options.selection.all = true;
    options.selection.existing = ExistingTangents::replace;
    // SheenCloth has a mirroring texture transform, but its tangents follow the untransformed UVs.
    options.tangents.texture_transform = TextureTransform::ignore;
    const auto report = generateFile(shared(name).string(), output, options);
    ASSERT_TRUE(report) << report.error().message;
    const auto before = gltf::loadDocument(shared(name), {}), after = gltf::loadDocument(output, {});
    const auto old_list = readPrimitives(before), new_list = readPrimitives(after);
    ASSERT_EQ(old_list.size(), new_list.size());
    std::size_t corner_count = 0, direction_count = 0, sign_count = 0;
    for (std::size_t i = 0; i < old_list.size(); ++i) {
        if (!old_list[i].find("TANGENT")) continue;
        const auto old_tangents = readTangents(before, old_list[i]), new_tangents = readTangents(after, new_list[i]);
        const auto old_corners = readTriangleCorners(before, old_list[i]),
                   new_corners = readTriangleCorners(after, new_list[i]);
        ASSERT_EQ(old_corners.size(), new_corners.size());
        for (std::size_t c = 0; c < old_corners.size(); ++c, ++corner_count) {
            const Vec4 a = old_tangents[old_corners[c]], b = new_tangents[new_corners[c]];
            const double dot = double{a.x} * b.x + double{a.y} * b.y + double{a.z} * b.z;
            const double lengths = std::sqrt((double{a.x} * a.x + double{a.y} * a.y + double{a.z} * a.z) *
                                             (double{b.x} * b.x + double{b.y} * b.y + double{b.z} * b.z));
            direction_count += dot >= lengths * std::cos(3.14159265358979 / 180) ? 1 : 0;
            sign_count += a.w * b.w == GetParam().sign ? 1 : 0;
        }
    }
    EXPECT_GT(corner_count, 0u);
    EXPECT_EQ(direction_count, corner_count);
    EXPECT_EQ(sign_count, corner_count);
}

INSTANTIATE_TEST_SUITE_P(Shared, ShippedTangents, testing::ValuesIn(kFiles),
                         [](const auto& file) { return test::testName(file.param.name); });

}  // namespace
}  // namespace tspace
