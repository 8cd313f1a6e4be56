// SPDX-License-Identifier: MIT
// A glTF model that consists of one correct patch with a normal map. Tests of checkFile add faults to it.
#pragma once

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "commands/check/patch.h"
#include "images/images.h"
#include "model/gltf_builder.h"
#include "support/temp_folder.h"

namespace tspace::test {

template <class T>
std::vector<float> floatsOf(const SharedArray<T>& values) {
    const auto* first = reinterpret_cast<const float*>(values.data());
    return {first, first + values.size() * sizeof(T) / sizeof(float)};
}

/// Adds a patch to mesh 0, with material 0.
inline void addPatch(GltfBuilder& builder, const ScenePrimitive& patch) {
    gltf::Json attributes = gltf::Json::object();
    attributes["POSITION"] = builder.addFloats(floatsOf(patch.positions), 3);
    attributes["NORMAL"] = builder.addFloats(floatsOf(patch.normals), 3);
    attributes["TANGENT"] = builder.addFloats(floatsOf(patch.tangents), 4);
    attributes["TEXCOORD_0"] = builder.addFloats(floatsOf(patch.uv_sets[0]), 2);
    const std::vector<std::uint32_t> corners(patch.corners.begin(), patch.corners.end());
    const std::size_t indices = builder.addAccessor(corners, 5125, "SCALAR", corners.size());
    gltf::Json& primitive = builder.addPrimitive(attributes);
    primitive["indices"] = indices;
    primitive["material"] = 0;
}

/// A model with a normal map in a separate file.
struct TestModel {
    TempFolder folder = {};
    GltfBuilder builder = {};

    explicit TestModel(bool green_down = false, bool inverted = false) {
        folder.write("normal.png", pngFile(normalMapOf(256, bumps, green_down)));
        builder.json()["images"] = gltf::Json::parse(R"([{"uri":"normal.png"}])");
        builder.json()["textures"] = gltf::Json::parse(R"([{"source":0}])");
        builder.json()["materials"] = gltf::Json::parse(R"([{"name":"skin","normalTexture":{"index":0}}])");
        ScenePrimitive patch = goodPatch(Seam::turned);
        if (inverted) {
            edit(patch.tangents, [](auto& tangents) {
                for (Vec4& t : tangents) t.w = -t.w;
            });
        }
        addPatch(builder, patch);
        builder.json()["meshes"][0]["name"] = "patch";
    }

    /// Makes the texture refer to its image through an extension, such as KHR_texture_basisu.
    void setTextureExtension(const char* name) {
        gltf::Json texture = gltf::Json::object();
        texture["extensions"][name]["source"] = 0;
        builder.json()["textures"] = gltf::Json::array({std::move(texture)});
    }

    [[nodiscard]] CheckReport check(const CheckOptions& options = {}) const {
        const Result<CheckReport> report = checkFile(folder.write("model.gltf", builder.gltfText()), options);
        EXPECT_TRUE(report) << report.error().message;
        return report ? *report : CheckReport{};
    }
};

using CodeCounts = std::multiset<std::string>;

/// Returns the severity and the name of each finding.
inline CodeCounts codes(const CheckReport& report) {
    CodeCounts result;
    for (const Finding& finding : report.findings) {
        result.insert(std::string(severityName(finding.severity)) + " " + findingName(finding.code));
    }
    return result;
}

}  // namespace tspace::test
