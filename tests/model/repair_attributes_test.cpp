// SPDX-License-Identifier: MIT
// Attributes with a wrong type or count: the remedies of check's findings work.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "generate_run.h"
#include "tspace/check.h"

namespace tspace {
namespace {

using namespace test;

struct FaultyAttribute {
    const char* name;
    int component_count;
    std::size_t vertex_count;
    const char* why;
    const char* option;  ///< option of generate that the remedy names; empty: no command repairs it
};

/// Runs the remedies that `check` suggests.
TEST(Repair, RepairsAttributesOfAWrongTypeOrCount) {
    const Grid grid(4, false);
    const std::size_t count = grid.vertexCount();
    for (const FaultyAttribute& faulty : {
             FaultyAttribute{"NORMAL", 4, count, "they do not have 3 components", "--repair"},
             {"NORMAL", 2, count, "they do not have 3 components", "--overwrite-normals"},
             {"NORMAL", 3, count - 5, "there are 20 of them for 25 vertices", "--overwrite-normals"},
             {"NORMAL", 3, count + 1, "there are 26 of them for 25 vertices", "--overwrite-normals"},
             {"TEXCOORD_0", 3, count, "they do not have 2 components", "--repair"},
             {"TEXCOORD_1", 4, count, "they do not have 2 components", "--repair"},
             {"TEXCOORD_0", 2, count - 1, "there are 24 of them for 25 vertices", ""},
             {"TEXCOORD_1", 2, count - 1, "there are 24 of them for 25 vertices", "--repair"},
             {"COLOR_0", 2, count, "they do not have 3 or 4 components", "--repair"},
             {"COLOR_0", 4, 2 * count, "there are 50 of them for 25 vertices", "--repair"},
         }) {
        SCOPED_TRACE(std::string(faulty.name) + " " + std::to_string(faulty.component_count) + " " + faulty.why);
        GltfBuilder builder = gridModel(grid);
        std::vector<float> values;
        const auto components = static_cast<std::size_t>(faulty.component_count);
        for (std::size_t i = 0; i < faulty.vertex_count * components; ++i) {
            const std::size_t v = i / components % count, k = i % components;
            const bool is_uv = std::string(faulty.name) == "TEXCOORD_0";
            values.push_back(is_uv ? (k < 2 ? grid.uvs[2 * v + k] : 7) : k == 2 ? 1 : 0);
        }
        firstPrimitive(builder)["attributes"][faulty.name] = builder.addFloats(values, components);
        const TempFolder folder;
        const std::string input = folder.write("in.glb", builder.glb());
        const Result<CheckReport> checked = checkFile(input);
        ASSERT_TRUE(checked) << checked.error().message;
        ASSERT_EQ(checked->findings.size(), 1u);
        const Finding& finding = checked->findings[0];
        EXPECT_EQ(finding.code, FindingCode::attributeUnreadable);
        EXPECT_NE(finding.message.find(faulty.why), std::string::npos) << finding.message;
        const std::string command = faulty.option[0] == '\0' ? "" : std::string("tspace generate ") + faulty.option;
        EXPECT_EQ(finding.remedy.find("tspace generate") == std::string::npos, command.empty()) << finding.remedy;
        EXPECT_NE(finding.remedy.find(command), std::string::npos) << finding.remedy;
        const std::string output = folder.path("out.glb").string();
        const Result<GenerateReport> plain = generateFile(input, output, {});
        ASSERT_TRUE(plain) << plain.error().message;
        EXPECT_EQ(plain->primitives.at(0).action, PrimitiveAction::impossible) << "nothing is removed unasked";
        EXPECT_FALSE(plain->changed);
        if (command.empty()) continue;
        GenerateOptions options;
        options.normals.overwrite = std::string(faulty.option) == "--overwrite-normals";
        if (!options.normals.overwrite) options.selection.existing = ExistingTangents::repair;
        const Result<GenerateReport> mended = generateFile(input, output, options);
        ASSERT_TRUE(mended) << mended.error().message;
        const Result<CheckReport> again = checkFile(output);
        ASSERT_TRUE(again) << again.error().message;
        for (const Finding& left : again->findings) ADD_FAILURE() << left.message;
        const gltf::Document document = gltf::loadDocument(output, {});
        for (const Vec3& normal : readVec3(document, readPrimitives(document).at(0), "NORMAL"))
            EXPECT_EQ(normal, (Vec3{0, 0, 1}));
        for (const Vec4& tangent : readTangents(document, readPrimitives(document).at(0)))
            EXPECT_EQ(tangent, (Vec4{1, 0, 0, 1}));
    }
}

}  // namespace
}  // namespace tspace
