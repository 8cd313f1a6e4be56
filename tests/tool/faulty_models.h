// SPDX-License-Identifier: MIT
// Models in which one attribute has a wrong type or a wrong number of elements. A second primitive has no fault.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/temp_folder.h"

namespace tspace::test {

struct FaultyModel {
    const char* name;       ///< name of the test case
    const char* attribute;  ///< the faulty attribute
    int target;             ///< index of the morph target that has the attribute; -1: the primitive itself
    int component_count;
    int element_count;      ///< correct is kFaultyVertices
    bool is_repairable;     ///< whether a command repairs the fault
    const char* also = "";  ///< another attribute, with the same fault
};

inline constexpr int kFaultyVertices = 4;

inline const std::vector<FaultyModel>& faultyModels() {
    static const std::vector<FaultyModel> models{
        {"position4", "POSITION", -1, 4, 4, true},
        {"position2", "POSITION", -1, 2, 4, false},
        {"joints3", "JOINTS_0", -1, 3, 4, false},
        {"jointsCount", "JOINTS_0", -1, 4, 3, false},
        {"weights3", "WEIGHTS_0", -1, 3, 4, false},
        {"weightsCount", "WEIGHTS_0", -1, 4, 5, false},
        {"influences2", "JOINTS_0", -1, 2, 4, true, "WEIGHTS_0"},
        {"influencesCount", "JOINTS_0", -1, 2, 3, false, "WEIGHTS_0"},
        {"custom", "_DENSITY", -1, 3, 7, true},
        {"normalAndWeights", "NORMAL", -1, 3, 3, false, "WEIGHTS_0"},
        {"targetPosition4", "POSITION", 0, 4, 4, true},
        {"targetPosition", "POSITION", 0, 3, 3, false},
        {"targetNormal4", "NORMAL", 0, 4, 4, true},
        {"targetNormal2", "NORMAL", 0, 2, 4, true},
        {"targetNormal", "NORMAL", 1, 3, 5, true},
        {"targetUvs", "TEXCOORD_0", 0, 2, 3, true},
        {"targetUvs3", "TEXCOORD_0", 1, 3, 4, true},
        {"targetColors", "COLOR_0", 0, 2, 4, true},
    };
    return models;
}

/// Writes faulty.gltf and returns its path. Mesh 0 has no fault; mesh 1 has a skin, two morph targets and the fault.
inline std::string writeFaulty(const TempFolder& folder, const FaultyModel& model) {
    using Json = nlohmann::json;
    std::vector<float> bytes;  // all numbers are floats, except joints and indices, which are zero or consecutive
    Json gltf = {{"asset", {{"version", "2.0"}}}};
    const auto add = [&](const std::vector<float>& values, int components, int count, int type = 5126) {
        gltf["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", 4 * bytes.size()}, {"byteLength", 4 * values.size()}});
        bytes.insert(bytes.end(), values.begin(), values.end());
        gltf["accessors"].push_back({{"bufferView", gltf["bufferViews"].size() - 1},
                                     {"componentType", type},
                                     {"count", count},
                                     {"type", components == 1 ? "SCALAR" : "VEC" + std::to_string(components)}});
        return gltf["accessors"].size() - 1;
    };
    /// Adds an attribute with values(v) for each vertex v, and returns its accessor. The faulty attribute gets another
    /// number of vertices and components.
    const auto attribute = [&](const std::string& name, int target, int components, const auto& values) {
        const bool is_here = model.target == target && (name == model.attribute || name == model.also);
        const int count = is_here ? model.element_count : kFaultyVertices;
        if (is_here) components = model.component_count;
        std::vector<float> list;
        for (int v = 0; v < count; ++v) {
            std::vector<float> element = values(v % kFaultyVertices);
            element.resize(static_cast<std::size_t>(components), 0);
            list.insert(list.end(), element.begin(), element.end());
        }
        const std::size_t index = add(list, components, count, name == "JOINTS_0" ? 5123 : 5126);
        if (name == "POSITION") {
            gltf["accessors"][index]["min"] = std::vector<float>(static_cast<std::size_t>(components), 0);
            gltf["accessors"][index]["max"] = std::vector<float>(static_cast<std::size_t>(components), 1);
            if (components > 2) gltf["accessors"][index]["max"][2] = target < 0 ? 0.f : 1.f;
            if (components > 3) gltf["accessors"][index]["max"][3] = 0;
            if (target >= 0) gltf["accessors"][index]["max"][1] = 0;
        }
        return index;
    };
    using List = std::vector<float>;
    const auto x = [](int v) { return static_cast<float>(v % 2); };
    const auto y = [](int v) { return static_cast<float>(v / 2); };
    List corners;
    for (const std::uint32_t corner : {0u, 1u, 3u, 0u, 3u, 2u}) {
        float bits;
        std::memcpy(&bits, &corner, sizeof(bits));
        corners.push_back(bits);
    }
    for (const int mesh : {0, 1}) {
        const int base = mesh == 0 ? -2 : -1;  // no fault has target -2, so mesh 0 has none
        Json attributes = {{"POSITION", attribute("POSITION", base, 3,
                                                  [&](int v) {
                                                      return List{x(v), y(v), 0};
                                                  })},
                           {"NORMAL", attribute("NORMAL", base, 3,
                                                [](int) {
                                                    return List{0, 0, 1};
                                                })},
                           {"TEXCOORD_0", attribute("TEXCOORD_0", base, 2, [&](int v) {
                                return List{x(v), 1 - y(v)};
                            })}};
        Json primitive = {{"material", 0}, {"indices", add(corners, 1, 6, 5125)}};
        if (mesh == 1) {
            attributes["JOINTS_0"] = attribute("JOINTS_0", base, 4, [](int) { return List{0}; });
            attributes["WEIGHTS_0"] = attribute("WEIGHTS_0", base, 4, [](int) { return List{1}; });
            attributes["_DENSITY"] = attribute("_DENSITY", base, 1, [](int) { return List{7}; });
            for (const int target : {0, 1}) {
                Json list = {{"POSITION", attribute("POSITION", target, 3,
                                                    [&](int v) {
                                                        return List{0, 0, x(v)};
                                                    })},
                             {"NORMAL", attribute("NORMAL", target, 3, [](int) {
                                  return List{-0.70710678f, 0, -0.29289322f};
                              })}};
                if (std::strcmp(model.attribute, "TEXCOORD_0") == 0)
                    list["TEXCOORD_0"] = attribute("TEXCOORD_0", target, 2, [](int) { return List{0, 0}; });
                if (std::strcmp(model.attribute, "COLOR_0") == 0)
                    list["COLOR_0"] = attribute("COLOR_0", target, 3, [](int) { return List{0, 0, 0}; });
                primitive["targets"].push_back(list);
            }
        }
        primitive["attributes"] = attributes;
        gltf["meshes"].push_back({{"primitives", Json::array({primitive})}});
    }
    gltf.update(Json::parse(R"({
        "nodes": [{"mesh": 0}, {"mesh": 1, "skin": 0}, {"name": "joint"}],
        "skins": [{"joints": [2]}], "scenes": [{"nodes": [0, 1, 2]}], "scene": 0,
        "materials": [{"normalTexture": {"index": 0}}], "textures": [{}], "buffers": [{"uri": "faulty.bin"}]})"));
    gltf["buffers"][0]["byteLength"] = 4 * bytes.size();
    std::string stored(4 * bytes.size(), '\0');
    std::memcpy(stored.data(), bytes.data(), stored.size());
    folder.write("faulty.bin", stored);
    folder.write("faulty.gltf", gltf.dump());
    return folder.path("faulty.gltf").string();
}

}  // namespace tspace::test
