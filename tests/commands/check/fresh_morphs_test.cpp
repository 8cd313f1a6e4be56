// SPDX-License-Identifier: MIT
// check reports no fault in the output of generate, for small meshes whose triangles are degenerate in the base shape
// or in a morph target.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "model/gltf_builder.h"
#include "support/temp_folder.h"
#include "tspace/check.h"
#include "tspace/generate.h"

namespace tspace::test {
namespace {

/// Returns `count` vectors of small integers, some of them with small deviations.
std::vector<float> anyVectors(std::size_t count, std::size_t components) {
    const auto vectors = *rc::gen::container<std::vector<int>>(count * components, rc::gen::inRange(-100, 101));
    std::vector<float> numbers;
    for (const int n : vectors) {
        const float near = n % 10 == 0 ? 1e-6f * static_cast<float>(n) : 0;
        numbers.push_back(static_cast<float>(n / 34) + near);
    }
    return numbers;
}

/// Returns normals along the axes and along diagonals between them.
std::vector<float> anyNormals(std::size_t count) {
    std::vector<float> normals;
    for (std::size_t i = 0; i < count; ++i) {
        const auto n = *rc::gen::element(Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{0.6f, 0, 0.8f}, Vec3{0, 0, -1});
        normals.insert(normals.end(), {n.x, n.y, n.z});
    }
    return normals;
}

GltfBuilder anyMorphModel() {
    const auto count = *rc::gen::inRange<std::size_t>(3, 12);
    const auto faces = *rc::gen::inRange<std::size_t>(1, 12);
    GltfBuilder builder;
    builder.json()["images"] = Json::array({Json{{"uri", "n.png"}}});
    builder.json()["textures"] = Json::array({Json{{"source", 0}}});
    builder.json()["materials"] = Json::array({Json{{"normalTexture", {{"index", 0}}}}});
    Json attributes = {{"POSITION", builder.addFloats(anyVectors(count, 3), 3)},
                       {"TEXCOORD_0", builder.addFloats(anyVectors(count, 2), 2)}};
    const bool has_normals = *rc::gen::arbitrary<bool>();
    if (has_normals) attributes["NORMAL"] = builder.addFloats(anyNormals(count), 3);
    const auto last = static_cast<std::uint32_t>(count);
    const auto indices =
        *rc::gen::container<std::vector<std::uint32_t>>(3 * faces, rc::gen::inRange<std::uint32_t>(0, last));
    const std::size_t index_accessor = builder.addAccessor(indices, 5125, "SCALAR", indices.size());
    Json targets = Json::array();
    for (int left = *rc::gen::inRange(1, 4); left > 0; --left) {
        Json target = {{"POSITION", builder.addFloats(anyVectors(count, 3), 3)}};
        if (has_normals && *rc::gen::arbitrary<bool>()) target["NORMAL"] = builder.addFloats(anyVectors(count, 3), 3);
        targets.push_back(target);
    }
    Json& primitive = builder.addPrimitive(attributes);
    primitive["indices"] = index_accessor;
    primitive["material"] = 0;
    primitive["targets"] = targets;
    return builder;
}

RC_GTEST_PROP(FreshMorphs, HaveNoFindings, ()) {
    const TempFolder folder;
    const std::string out = folder.path("out.gltf").string();
    const auto made = generateFile(folder.write("in.gltf", anyMorphModel().gltfText()), out);
    RC_ASSERT(made.ok());
    const auto checked = checkFile(out);
    RC_ASSERT(checked.ok());
    for (const Finding& finding : checked->findings) {
        if (finding.code == FindingCode::morphTangentsWrong) RC_FAIL(finding.message);
    }
}

}  // namespace
}  // namespace tspace::test
