// SPDX-License-Identifier: MIT
// Component types that glTF does not allow for an attribute are findings; allowed ones are not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "commands/check/test_model.h"
#include "tspace/check.h"

namespace tspace::test {
namespace {

constexpr int kI8 = 5120, kU8 = 5121, kU16 = 5123, kU32 = 5125;

/// Returns how many findings of `check` report the component type of an attribute that is added to a correct model.
template <class T>
std::ptrdiff_t findingsOn(const std::string& name, int type, int components, bool normalized) {
    TestModel model;
    auto& primitive = model.builder.json()["meshes"][0]["primitives"][0];
    const auto positions = primitive["attributes"]["POSITION"].get<std::size_t>();
    const auto count = model.builder.json()["accessors"][positions]["count"].get<std::size_t>();
    const std::vector<T> zeros(count * 4, T{0});
    const char* const shape = components == 2 ? "VEC2" : components == 3 ? "VEC3" : "VEC4";
    const std::size_t accessor = model.builder.addAccessor(zeros, type, shape, count);
    auto& json = model.builder.json();
    json["accessors"][accessor]["normalized"] = normalized;
    json["bufferViews"][json["accessors"][accessor]["bufferView"].get<std::size_t>()]["byteStride"] = 4 * sizeof(T);
    primitive["attributes"][name] = accessor;
    const Result<CheckReport> report = checkFile(model.folder.write("model.glb", model.builder.glb()));
    EXPECT_TRUE(report) << report.error().message;
    if (!report) return -1;
    return std::count_if(report->findings.begin(), report->findings.end(), [&](const Finding& finding) {
        if (finding.code != FindingCode::attributeUnreadable) return false;
        EXPECT_EQ(finding.severity, Severity::warning);
        EXPECT_NE(finding.message.find("the elements of " + name), std::string::npos) << finding.message;
        return true;
    });
}

TEST(ComponentTypes, ThatGltfDoesNotAllowAreFindings) {
    EXPECT_EQ(findingsOn<std::uint32_t>("TEXCOORD_1", kU32, 2, false), 1);
    EXPECT_EQ(findingsOn<std::uint32_t>("COLOR_0", kU32, 3, false), 1);
    EXPECT_EQ(findingsOn<std::int8_t>("COLOR_0", kI8, 4, true), 1);
    EXPECT_EQ(findingsOn<std::uint8_t>("COLOR_0", kU8, 4, false), 1);
    EXPECT_EQ(findingsOn<std::uint8_t>("WEIGHTS_0", kU8, 4, false), 1);
    EXPECT_EQ(findingsOn<std::uint8_t>("JOINTS_0", kU8, 4, true), 1);
}

TEST(ComponentTypes, ThatGltfAllowsAreNoFindings) {
    EXPECT_EQ(findingsOn<std::uint16_t>("TEXCOORD_1", kU16, 2, true), 0);
    EXPECT_EQ(findingsOn<std::int8_t>("TEXCOORD_1", kI8, 2, false), 0);  // KHR_mesh_quantization
    EXPECT_EQ(findingsOn<std::uint8_t>("COLOR_0", kU8, 4, true), 0);
    EXPECT_EQ(findingsOn<std::uint16_t>("JOINTS_0", kU16, 4, false), 0);
    EXPECT_EQ(findingsOn<std::uint16_t>("WEIGHTS_0", kU16, 4, true), 0);
}

}  // namespace
}  // namespace tspace::test
