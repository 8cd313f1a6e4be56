// SPDX-License-Identifier: MIT
// Bent sheets whose normals, winding or tangents have a fault.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/temp_folder.h"

namespace tspace::test {

/// A sheet of kSheetSize x kSheetSize vertices with a normal map, as lists of numbers.
struct Sheet {
    std::vector<float> positions = {}, normals = {}, uvs = {}, tangents = {};
    std::vector<std::uint32_t> corners = {};
    bool has_tangents = false, is_unlit = false;
    int normal_size = 3;        ///< stored components of a normal
    bool has_bytes = false;     ///< normals are stored as normalized unsigned bytes
    std::size_t uv_count = 0;   ///< number of stored UVs
    std::string image = {};     ///< URI of the normal map; empty: a texture without image
    nlohmann::json nodes = {};  ///< null: one node
};

inline constexpr int kSheetSize = 7;

/// Returns a sheet that bends around the y axis, with correct tangents that are stored if has_tangents is set.
inline Sheet bentSheetWithTangents() {
    Sheet sheet;
    constexpr float kBend = 0.25F, kTurns = 3;
    for (int y = 0; y < kSheetSize; ++y) {
        for (int x = 0; x < kSheetSize; ++x) {
            const float u = static_cast<float>(x) / (kSheetSize - 1), v = static_cast<float>(y) / (kSheetSize - 1);
            const float slope = kTurns * kBend * std::cos(kTurns * u), size = std::sqrt(1 + slope * slope);
            sheet.positions.insert(sheet.positions.end(), {u, v, kBend * std::sin(kTurns * u)});
            sheet.normals.insert(sheet.normals.end(), {-slope / size, 0, 1 / size});
            sheet.tangents.insert(sheet.tangents.end(), {1 / size, 0, slope / size, 1});
            sheet.uvs.insert(sheet.uvs.end(), {u, 1 - v});
        }
    }
    for (int y = 0; y + 1 < kSheetSize; ++y) {
        for (int x = 0; x + 1 < kSheetSize; ++x) {
            const auto a = static_cast<std::uint32_t>(y * kSheetSize + x), b = a + kSheetSize;
            sheet.corners.insert(sheet.corners.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    }
    sheet.uv_count = sheet.uvs.size() / 2;
    return sheet;
}

/// Writes the sheet as a .gltf file with a data URI, and returns its path.
inline std::string writeSheet(const TempFolder& folder, const std::string& name, const Sheet& sheet) {
    using Json = nlohmann::json;
    std::string bytes;
    Json gltf = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}};
    gltf["nodes"] = sheet.nodes.is_null() ? Json::parse(R"([{"mesh": 0}])") : sheet.nodes;
    const auto add = [&](const void* data, std::size_t size, int type, int components, std::size_t count, int stride) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        Json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}};
        if (stride != 0) view["byteStride"] = stride;
        gltf["bufferViews"].push_back(view);
        bytes.append(static_cast<const char*>(data), size);
        gltf["accessors"].push_back({{"bufferView", gltf["bufferViews"].size() - 1},
                                     {"componentType", type},
                                     {"count", count},
                                     {"type", components == 1 ? "SCALAR" : "VEC" + std::to_string(components)}});
        return gltf["accessors"].size() - 1;
    };
    const auto floats = [&](const std::vector<float>& list, int components) {
        return add(list.data(), 4 * list.size(), 5126, components, list.size() / static_cast<std::size_t>(components),
                   0);
    };
    const std::size_t count = sheet.positions.size() / 3;
    Json attributes = {{"POSITION", floats(sheet.positions, 3)}};
    gltf["accessors"][0]["min"] = {0, 0, 0};
    gltf["accessors"][0]["max"] = {1, 1, 0.25};
    if (sheet.has_bytes) {
        std::vector<std::uint8_t> list;
        for (std::size_t i = 0; i < sheet.normals.size(); ++i) {
            list.push_back(static_cast<std::uint8_t>(std::lround(255 * (sheet.normals[i] + 1) / 2)));
            if (i % 3 == 2) list.push_back(0);
        }
        attributes["NORMAL"] = add(list.data(), list.size(), 5121, 3, count, 4);
        gltf["accessors"].back()["normalized"] = true;
    } else {
        std::vector<float> list;
        for (std::size_t i = 0; i < sheet.normals.size(); ++i) {
            if (static_cast<int>(i % 3) < sheet.normal_size) list.push_back(sheet.normals[i]);
        }
        attributes["NORMAL"] = floats(list, sheet.normal_size);
    }
    attributes["TEXCOORD_0"] =
        floats({sheet.uvs.begin(), sheet.uvs.begin() + static_cast<std::ptrdiff_t>(2 * sheet.uv_count)}, 2);
    if (sheet.has_tangents) attributes["TANGENT"] = floats(sheet.tangents, 4);
    const std::size_t indices = add(sheet.corners.data(), 4 * sheet.corners.size(), 5125, 1, sheet.corners.size(), 0);
    gltf["meshes"] = {{{"primitives", {{{"attributes", attributes}, {"indices", indices}, {"material", 0}}}}}};
    gltf["materials"] = Json::parse(R"([{"normalTexture": {"index": 0}}])");
    gltf["textures"] = Json::parse("[{}]");
    if (!sheet.image.empty()) {
        gltf["images"] = {{{"uri", sheet.image}}};
        gltf["textures"][0]["source"] = 0;
    }
    if (sheet.is_unlit) {
        gltf["materials"][0]["extensions"]["KHR_materials_unlit"] = Json::object();
        gltf["extensionsUsed"] = {"KHR_materials_unlit"};
    }
    const std::string stem = name.substr(0, name.find_last_of('.'));
    gltf["buffers"] = {{{"uri", stem + ".bin"}, {"byteLength", bytes.size()}}};
    folder.write(stem + ".bin", bytes);
    return folder.write(name, gltf.dump());
}

struct SheetFault {
    const char* name;  ///< name of the test case
    std::function<void(Sheet&)> apply;
};

/// Sets two normals of the sheet.
inline void setNormals(Sheet& sheet, float x, float y, float z) {
    for (const std::size_t vertex : {10U, 24U}) {
        sheet.normals[3 * vertex] = x;
        sheet.normals[3 * vertex + 1] = y;
        sheet.normals[3 * vertex + 2] = z;
    }
}

/// Flips every n-th triangle.
inline void flipTriangles(Sheet& sheet, std::size_t n) {
    for (std::size_t t = 0; 3 * t < sheet.corners.size(); t += n)
        std::swap(sheet.corners[3 * t], sheet.corners[3 * t + 1]);
}

inline void negateSigns(Sheet& sheet) {
    sheet.has_tangents = true;
    for (std::size_t i = 3; i < sheet.tangents.size(); i += 4) sheet.tangents[i] = -sheet.tangents[i];
}

/// Faults that a command named by check fixes.
inline const std::vector<SheetFault>& sheetFaults() {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
    static const std::vector<SheetFault> faults{
        {"normalsOfLength0", [](Sheet& sheet) { setNormals(sheet, 0, 0, 0); }},
        {"tinyNormals", [](Sheet& sheet) { setNormals(sheet, 0, 0, 1e-20F); }},
        {"denormalNormals", [](Sheet& sheet) { setNormals(sheet, 0, 0, 1e-41F); }},
        {"normalsNan", [](Sheet& sheet) { setNormals(sheet, kNan, kNan, kNan); }},
        {"normalsInfinite", [](Sheet& sheet) { setNormals(sheet, kInfinity, 0, 0); }},
        {"normalsNanWithTangents",
         [](Sheet& sheet) {
             setNormals(sheet, kNan, 0, 0);
             sheet.has_tangents = true;
         }},
        {"normalsNanUnlit",
         [](Sheet& sheet) {
             setNormals(sheet, kNan, 0, 0);
             sheet.is_unlit = true;
         }},
        {"unsignedNormalsUnlit", [](Sheet& sheet) { sheet.has_bytes = sheet.is_unlit = true; }},
        {"unsignedNormalsUnlitWithTangents",
         [](Sheet& sheet) { sheet.has_bytes = sheet.is_unlit = sheet.has_tangents = true; }},
        {"normalsOfTwoNumbersUnlit",
         [](Sheet& sheet) {
             sheet.normal_size = 2;
             sheet.is_unlit = true;
         }},
        {"tiltedTangentsAtLongNormals",
         [](Sheet& sheet) {
             sheet.has_tangents = true;
             constexpr float kTilt = 0.4F, kLength = 0.5F;
             for (std::size_t v = 0; 3 * v < sheet.normals.size(); ++v) {
                 const float size = std::sqrt(1 + kTilt * kTilt);
                 for (std::size_t k = 0; k < 3; ++k) {
                     float& tangent = sheet.tangents[4 * v + k];
                     tangent = (tangent + kTilt * sheet.normals[3 * v + k]) / size;
                     sheet.normals[3 * v + k] *= kLength;
                 }
             }
         }},
        {"windingAgainstNormals", [](Sheet& sheet) { flipTriangles(sheet, 1); }},
        {"windingOfSomeTriangles",
         [](Sheet& sheet) {
             flipTriangles(sheet, 15);
             sheet.has_tangents = true;
         }},
        {"windingWithTangentsOfNormals",
         [](Sheet& sheet) {
             flipTriangles(sheet, 1);
             sheet.has_tangents = true;
         }},
        {"windingWithTangentsOfTriangles",
         [](Sheet& sheet) {
             flipTriangles(sheet, 1);
             negateSigns(sheet);
         }},
        {"windingAndInvertedSigns",
         [](Sheet& sheet) {
             flipTriangles(sheet, 15);
             negateSigns(sheet);
         }},
    };
    return faults;
}

}  // namespace tspace::test
