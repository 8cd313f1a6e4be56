// SPDX-License-Identifier: MIT
// Converts faces, attributes, weights and morph targets of a mesh.
#include "meshes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "repair.h"
#include "tspace/mesh.h"

namespace tspace::import {
namespace {

/// Attribute of a primitive: `components` floats per vertex.
struct Attribute {
    std::string name = {};  ///< "POSITION", or "target 3 NORMAL"
    std::size_t components = 0;
    std::vector<float> values = {};
};

std::vector<float> vectors(const aiVector3D* values, std::size_t count, std::size_t components, bool turn_v = false) {
    std::vector<float> floats;
    floats.reserve(count * components);
    for (std::size_t i = 0; i < count; ++i) {
        floats.push_back(values[i].x);
        floats.push_back(turn_v ? 1 - values[i].y : values[i].y);
        if (components == 3) floats.push_back(values[i].z);
    }
    return floats;
}

std::vector<float> differences(const aiVector3D* moved, const aiVector3D* base, std::size_t count) {
    std::vector<float> floats;
    floats.reserve(count * 3);
    for (std::size_t i = 0; i < count; ++i) {
        for (unsigned k = 0; k < 3; ++k) floats.push_back(moved[i][k] - base[i][k]);
    }
    zeroNotFinite(floats, 3);
    return floats;
}

/// Adds the joints of every vertex, largest weights first, four per set, at most two sets. Weights sum to 1.
void addWeights(const aiMesh& mesh, const std::vector<std::uint16_t>& joints, std::vector<Attribute>& attributes) {
    constexpr std::size_t kPerSet = 4, kMaxSets = 2;
    struct Influence {
        float weight = 0;
        std::uint16_t joint = 0;
    };
    std::vector<std::vector<Influence>> influences(mesh.mNumVertices);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        const aiBone& bone = *mesh.mBones[b];
        for (unsigned w = 0; w < bone.mNumWeights; ++w) {
            const aiVertexWeight& entry = bone.mWeights[w];
            if (entry.mVertexId >= mesh.mNumVertices || !std::isfinite(entry.mWeight) || !(entry.mWeight > 0)) continue;
            // A joint may be used only once per vertex.
            std::vector<Influence>& list = influences[entry.mVertexId];
            const auto known = std::find_if(list.begin(), list.end(),
                                            [&](const Influence& influence) { return influence.joint == joints[b]; });
            if (known == list.end()) {
                list.push_back({entry.mWeight, joints[b]});
            } else {
                known->weight += entry.mWeight;
            }
        }
    }
    std::size_t most = 1;
    for (std::vector<Influence>& list : influences) {
        std::stable_sort(list.begin(), list.end(),
                         [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
        if (list.size() > kPerSet * kMaxSets) list.resize(kPerSet * kMaxSets);
        float sum = 0;
        for (const Influence& influence : list) sum += influence.weight;
        for (Influence& influence : list) influence.weight /= sum;
        most = std::max(most, list.size());
    }
    for (std::size_t set = 0; set * kPerSet < most; ++set) {
        Attribute joint{"JOINTS_" + std::to_string(set), kPerSet}, weight{"WEIGHTS_" + std::to_string(set), kPerSet};
        for (const std::vector<Influence>& list : influences) {
            for (std::size_t i = set * kPerSet; i < (set + 1) * kPerSet; ++i) {
                joint.values.push_back(i < list.size() ? list[i].joint : 0);
                weight.values.push_back(i < list.size() ? list[i].weight : 0);
            }
            if (set == 0 && list.empty()) weight.values[weight.values.size() - kPerSet] = 1;
        }
        attributes.push_back(std::move(joint));
        attributes.push_back(std::move(weight));
    }
}

/// Returns tangents with T unchanged, and with the side of cross(N, T) on which the bitangent lies as w. The bitangent
/// of Assimp points along increasing v, which is up in the image. In glTF v increases downward, but the bitangent also
/// points up, so w needs no conversion.
Attribute tangentsOf(const aiMesh& mesh) {
    Attribute tangents{"TANGENT", 4};
    tangents.values.reserve(std::size_t{4} * mesh.mNumVertices);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const aiVector3D& t = mesh.mTangents[i];
        const float side = (mesh.mNormals[i] ^ t) * mesh.mBitangents[i];
        tangents.values.insert(tangents.values.end(), {t.x, t.y, t.z, side < 0 ? -1.0F : 1.0F});
    }
    return tangents;
}

std::vector<Attribute> attributesOf(const aiMesh& mesh, const std::vector<std::uint16_t>& joints,
                                    const std::vector<std::uint32_t>& triangles, bool takes_tangents,
                                    RepairCounts& repairs) {
    const std::size_t count = mesh.mNumVertices;
    std::vector<Attribute> attributes;
    attributes.push_back({"POSITION", 3, vectors(mesh.mVertices, count, 3)});
    repairs.positions += zeroNotFinite(attributes.back().values, 3);
    if (mesh.HasNormals()) {
        Attribute normals{"NORMAL", 3, vectors(mesh.mNormals, count, 3)};
        repairs.normals += repairNormals(normals.values, attributes.back().values, triangles);
        attributes.push_back(std::move(normals));
        if (takes_tangents && mesh.HasTangentsAndBitangents()) {
            attributes.push_back(tangentsOf(mesh));
            repairs.tangents += zeroNotFinite(attributes.back().values, 4);
        }
    }
    std::size_t uv_set = 0;
    for (unsigned set = 0; set < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++set) {
        if (mesh.mTextureCoords[set] == nullptr) continue;
        attributes.push_back(
            {"TEXCOORD_" + std::to_string(uv_set++), 2, vectors(mesh.mTextureCoords[set], count, 2, true)});
        repairs.uvs += zeroNotFinite(attributes.back().values, 2);
    }
    std::size_t color_set = 0;
    for (unsigned set = 0; set < AI_MAX_NUMBER_OF_COLOR_SETS; ++set) {
        if (mesh.mColors[set] == nullptr) continue;
        Attribute color{"COLOR_" + std::to_string(color_set++), 4};
        for (std::size_t i = 0; i < count; ++i) {
            const aiColor4D& c = mesh.mColors[set][i];
            for (const float value : {c.r, c.g, c.b, c.a})
                color.values.push_back(static_cast<float>(unitInterval(value, 1)));
        }
        attributes.push_back(std::move(color));
    }
    if (!joints.empty()) addWeights(mesh, joints, attributes);
    for (unsigned t = 0; t < mesh.mNumAnimMeshes; ++t) {
        const aiAnimMesh& target = *mesh.mAnimMeshes[t];
        if (target.mNumVertices != mesh.mNumVertices) continue;
        const std::string name = "target " + std::to_string(t) + " ";
        if (target.HasPositions())
            attributes.push_back({name + "POSITION", 3, differences(target.mVertices, mesh.mVertices, count)});
        if (target.HasNormals() && mesh.HasNormals())
            attributes.push_back({name + "NORMAL", 3, differences(target.mNormals, mesh.mNormals, count)});
    }
    return attributes;
}

/// Vertices after merging: the first vertex with the same bits in every attribute represents all others.
struct Joined {
    /// For each old vertex, the index of its representative among the kept vertices.
    std::vector<std::uint32_t> place = {};
    std::vector<std::uint32_t> kept = {};  ///< old indices of the kept vertices
};

Joined joinEqual(const std::vector<Attribute>& attributes, std::size_t count) {
    std::unordered_map<std::string, std::uint32_t> known;
    Joined joined;
    std::string bits;
    for (std::size_t i = 0; i < count; ++i) {
        bits.clear();
        for (const Attribute& attribute : attributes) {
            bits.append(reinterpret_cast<const char*>(&attribute.values[i * attribute.components]),
                        attribute.components * sizeof(float));
        }
        const auto [entry, is_new] = known.try_emplace(bits, static_cast<std::uint32_t>(joined.kept.size()));
        if (is_new) joined.kept.push_back(static_cast<std::uint32_t>(i));
        joined.place.push_back(entry->second);
    }
    return joined;
}

/// Returns the vertices of triangles. Points and lines are skipped.
std::vector<std::uint32_t> trianglesOf(const aiMesh& mesh) {
    std::vector<std::uint32_t> indices, sizes;
    bool only_triangles = true;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        if (face.mNumIndices < 3) continue;
        only_triangles = only_triangles && face.mNumIndices == 3;
        sizes.push_back(face.mNumIndices);
        for (unsigned k = 0; k < face.mNumIndices; ++k) {
            if (face.mIndices[k] >= mesh.mNumVertices)
                throw std::runtime_error("a face refers to a vertex that does not exist");
            indices.push_back(face.mIndices[k]);
        }
    }
    if (only_triangles) return indices;
    const std::vector<float> positions = vectors(mesh.mVertices, mesh.mNumVertices, 3);
    std::vector<float> uvs;
    if (mesh.HasTextureCoords(0)) uvs = vectors(mesh.mTextureCoords[0], mesh.mNumVertices, 2, true);
    MeshView view;
    view.positions = {reinterpret_cast<const Vec3*>(positions.data()), mesh.mNumVertices, sizeof(Vec3)};
    if (!uvs.empty()) view.uvs = {reinterpret_cast<const Vec2*>(uvs.data()), mesh.mNumVertices, sizeof(Vec2)};
    view.indices = std::span<const std::uint32_t>(indices);
    view.face_sizes = sizes;
    const Result<Triangulation> cut = triangulate(view);
    if (!cut) throw std::runtime_error(cut.error().message);
    std::vector<std::uint32_t> triangles;
    triangles.reserve(cut->corners.size());
    for (const std::uint32_t corner : cut->corners) triangles.push_back(indices[corner]);
    return triangles;
}

std::size_t addAttribute(GlbBuilder& builder, const Attribute& attribute, const std::vector<std::uint32_t>& kept,
                         bool is_target) {
    std::vector<float> values;
    values.reserve(kept.size() * attribute.components);
    for (const std::uint32_t i : kept) {
        const auto first = attribute.values.begin() + static_cast<std::ptrdiff_t>(i * attribute.components);
        values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(attribute.components));
    }
    const std::string type = "VEC" + std::to_string(attribute.components);
    if (attribute.name.starts_with("JOINTS")) {
        const std::vector<std::uint16_t> shorts(values.begin(), values.end());
        const std::size_t view = builder.addView(std::as_bytes(std::span(shorts)), 2, gltf::kVertexTarget);
        return builder.addAccessor(view, gltf::ComponentType::u16, kept.size(), type);
    }
    const bool bounds = attribute.name.ends_with("POSITION");
    return builder.addFloats(values, kept.size(), type, is_target && !bounds ? gltf::kNoTarget : gltf::kVertexTarget,
                             bounds);
}

}  // namespace

std::optional<Json> addPrimitive(GlbBuilder& builder, const aiMesh& mesh, const std::vector<std::uint16_t>& joints,
                                 bool takes_tangents) {
    std::vector<std::uint32_t> triangles = trianglesOf(mesh);
    if (triangles.empty()) return {};
    const std::vector<Attribute> attributes = attributesOf(mesh, joints, triangles, takes_tangents, builder.repairs());
    countCoarseEdges(attributes.front().values, triangles, builder.repairs());
    const Joined joined = joinEqual(attributes, mesh.mNumVertices);
    for (std::uint32_t& vertex : triangles) vertex = joined.place[vertex];

    Json primitive = {{"attributes", Json::object()}};
    std::unordered_map<std::string, std::size_t> target_of;
    for (const Attribute& attribute : attributes) {
        const bool is_target = attribute.name.starts_with("target ");
        const std::size_t accessor = addAttribute(builder, attribute, joined.kept, is_target);
        if (!is_target) {
            primitive["attributes"][attribute.name] = accessor;
            continue;
        }
        const std::size_t space = attribute.name.rfind(' ');
        const auto [entry, is_new] = target_of.try_emplace(attribute.name.substr(0, space), target_of.size());
        if (is_new) primitive["targets"].push_back(Json::object());
        primitive["targets"][entry->second][attribute.name.substr(space + 1)] = accessor;
    }
    primitive["indices"] = builder.addIndices(triangles, joined.kept.size());
    return primitive;
}

}  // namespace tspace::import
