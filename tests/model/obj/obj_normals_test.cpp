// SPDX-License-Identifier: MIT
// Normals of OBJ files with generateFile.
#include <gtest/gtest.h>

#include <algorithm>

#include "model/generate_run.h"
#include "support/shared_data.h"

namespace tspace {
namespace {

using namespace test;

TEST(ObjNormals, OfTwoSidedSheetsAreReported) {
    TSPACE_NEEDS_SHARED("reports/walls_two_sided.obj");
    const TempFolder folder;
    GenerateOptions options;
    options.normals.compute.weighting = NormalWeighting::angle;
    options.selection.all = true;
    const auto report =
        generateFile(shared("reports/walls_two_sided.obj").string(), folder.path("out.glb").string(), options);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->primitives[0].two_sided_triangle_count, 4u) << "a quad and its reverse, cut along both diagonals";
    EXPECT_TRUE(std::any_of(report->warnings.begin(), report->warnings.end(), [](const std::string& warning) {
        return warning.find("two-sided sheets") != std::string::npos;
    }));
}

TEST(ObjNormals, AreRecomputedOnRequest) {
    TSPACE_NEEDS_SHARED("reports/rod_flat_vn.obj");
    const TempFolder folder;
    const std::string input = shared("reports/rod_flat_vn.obj").string(), output = folder.path("out.glb").string();
    GenerateOptions options;
    options.normals.compute.weighting = NormalWeighting::angle;
    ASSERT_TRUE(generateFile(input, output, options));
    EXPECT_EQ(readPrimitives(gltf::loadDocument(output, {}))[0].vertex_count, 64u);
    options.normals.overwrite = true;
    const auto report = generateFile(input, output, options);
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->primitives[0].normals_replaced);
    EXPECT_EQ(readPrimitives(gltf::loadDocument(output, {}))[0].vertex_count, 34u);
}

}  // namespace
}  // namespace tspace
