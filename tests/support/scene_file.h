// SPDX-License-Identifier: MIT
// Small models written to files, for commands that read whole files.
#pragma once

#include <cmath>
#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include "model/gltf_builder.h"
#include "support/temp_folder.h"
#include "tspace/span.h"
#include "tspace/tangents.h"

namespace tspace::test {

/// Arrays of one primitive.
struct ModelData {
    std::string name = {};
    std::vector<Vec3> positions = {};
    std::vector<Vec3> normals = {};
    std::vector<Vec2> uvs = {};
    std::vector<Vec2> other_uvs = {};  ///< TEXCOORD_1 if not empty
    std::vector<Vec4> tangents = {};
    std::vector<std::uint32_t> indices = {};
};

/// Returns a bent sheet of n x n cells with smooth normals and unevenly stretched UVs.
inline ModelData bentSheet(int n) {
    ModelData data{.name = "sheet"};
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) {
            const float s = static_cast<float>(x) / static_cast<float>(n),
                        t = static_cast<float>(y) / static_cast<float>(n);
            const float height = 0.3f * s * s + 0.2f * s * t;
            data.positions.push_back({s, t, height});
            const float dx = 0.6f * s + 0.2f * t, dy = 0.2f * s;
            const float length = std::sqrt(dx * dx + dy * dy + 1);
            data.normals.push_back({-dx / length, -dy / length, 1 / length});
            data.uvs.push_back({s + 0.3f * t * t, t + 0.2f * s * s});
        }
    }
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const auto a = static_cast<std::uint32_t>(y * (n + 1) + x), b = a + 1;
            const std::uint32_t c = a + static_cast<std::uint32_t>(n) + 1, d = c + 1;
            for (const std::uint32_t i : {a, b, d, a, d, c}) data.indices.push_back(i);
        }
    }
    return data;
}

/// Returns the data with a vertex of its own for each corner.
inline ModelData unwelded(const ModelData& data) {
    ModelData result{.name = data.name};
    for (const std::uint32_t vertex : data.indices) {
        result.indices.push_back(static_cast<std::uint32_t>(result.positions.size()));
        result.positions.push_back(data.positions[vertex]);
        result.normals.push_back(data.normals[vertex]);
        result.uvs.push_back(data.uvs[vertex]);
        if (!data.other_uvs.empty()) result.other_uvs.push_back(data.other_uvs[vertex]);
        if (!data.tangents.empty()) result.tangents.push_back(data.tangents[vertex]);
    }
    return result;
}

/// Returns one tangent per corner. Throws if there are none, which no test expects.
inline std::vector<Vec4> tangentsOf(const ModelData& data, const TangentOptions& options) {
    const MeshView mesh{.positions = std::span<const Vec3>(data.positions),
                        .normals = std::span<const Vec3>(data.normals),
                        .uvs = std::span<const Vec2>(data.uvs),
                        .indices = std::span<const std::uint32_t>(data.indices)};
    std::vector<Vec4> tangents(data.indices.size());
    if (!generateTangents(mesh, options, {.tangents = std::span(tangents)})) throw std::exception();
    return tangents;
}
inline std::vector<Vec4> tangentsOf(const ModelData& data, Method method) {
    return tangentsOf(data, TangentOptions{.method = method, .convention = conventions::opengl});
}

/// Returns the data with the tangents of a method, and with unwelded vertices (except for `lengyel`, which averages by
/// vertex index). `sign_factor`: factor of the signs; -1 gives those of glTF.
inline ModelData withTangents(const ModelData& data, const TangentOptions& options, float sign_factor = -1) {
    ModelData result = options.method == Method::lengyel ? data : unwelded(data);
    const std::vector<Vec4> corners = tangentsOf(result, options);
    result.tangents.resize(result.positions.size());
    for (std::size_t c = 0; c < corners.size(); ++c) result.tangents[result.indices[c]] = corners[c];
    for (Vec4& tangent : result.tangents) tangent.w *= sign_factor;
    return result;
}
inline ModelData withTangents(const ModelData& data, Method method, float sign_factor = -1) {
    return withTangents(data, TangentOptions{.method = method, .convention = conventions::opengl}, sign_factor);
}

template <class Vec>
std::vector<float> floatsOf(const std::vector<Vec>& values) {
    const auto* first = reinterpret_cast<const float*>(values.data());
    return {first, first + values.size() * (sizeof(Vec) / sizeof(float))};
}

/// Writes a model with one mesh per entry. Returns its path.
inline std::string writeModel(const TempFolder& folder, const std::string& name, const std::vector<ModelData>& models) {
    GltfBuilder builder;
    Json meshes = Json::array();
    for (const ModelData& data : models) {
        Json attributes = {{"POSITION", builder.addFloats(floatsOf(data.positions), 3)}};
        if (!data.normals.empty()) attributes["NORMAL"] = builder.addFloats(floatsOf(data.normals), 3);
        if (!data.uvs.empty()) attributes["TEXCOORD_0"] = builder.addFloats(floatsOf(data.uvs), 2);
        if (!data.other_uvs.empty()) attributes["TEXCOORD_1"] = builder.addFloats(floatsOf(data.other_uvs), 2);
        if (!data.tangents.empty()) attributes["TANGENT"] = builder.addFloats(floatsOf(data.tangents), 4);
        const Json primitive = {{"attributes", attributes},
                                {"indices", builder.addAccessor(data.indices, 5125, "SCALAR", data.indices.size())}};
        meshes.push_back({{"name", data.name}, {"primitives", Json::array({primitive})}});
    }
    builder.json()["meshes"] = meshes;
    Json roots = Json::array();
    for (std::size_t i = 0; i < models.size(); ++i) {
        builder.json()["nodes"].push_back({{"mesh", i}});
        roots.push_back(i);
    }
    builder.json()["scenes"] = Json::array({Json{{"nodes", roots}}});
    builder.json()["scene"] = 0;
    return folder.write(name, std::span<const std::uint8_t>(builder.glb()));
}

}  // namespace tspace::test
