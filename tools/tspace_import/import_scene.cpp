// SPDX-License-Identifier: MIT
// Assimp's scene as glTF: nodes, meshes with their skins, animations.
#include "import_scene.h"

#include <assimp/commonMetaData.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "glb_builder.h"
#include "materials.h"
#include "mend.h"
#include "meshes.h"
#include "model_files.h"
#include "number_text.h"
#include "ply_offset.h"
#include "stored_tangents.h"

namespace tspace::import {

namespace {

class SceneWriter {
  public:
    SceneWriter(const aiScene& scene, bool takes_tangents, const DVec3& offset)
        : scene_(scene), takes_tangents_(takes_tangents), offset_(offset) {}

    std::vector<std::uint8_t> write() {
        aiString generator;
        if (scene_.mMetaData != nullptr && scene_.mMetaData->Get(AI_METADATA_SOURCE_GENERATOR, generator) &&
            generator.length > 0) {
            builder_.json()["asset"]["generator"] = generator.C_Str();
        }
        listNodes();
        addMaterials(builder_, scene_);
        for (std::size_t i = 0; i < nodes_.size(); ++i) builder_.append("nodes", nodeJson(i));
        for (std::size_t i = 0; i < nodes_.size(); ++i) addMesh(i);
        addAnimations();
        builder_.json()["scene"] = 0;
        builder_.json()["scenes"] = Json::array({Json{{"nodes", {0}}}});
        return builder_.finish();
    }

    [[nodiscard]] Mended& mended() { return builder_.mended(); }

  private:
    /// Breadth first, so that depth costs no stack.
    void listNodes() {
        nodes_.push_back(scene_.mRootNode);
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            const aiNode& node = *nodes_[i];
            index_of_.emplace(node.mName.C_Str(), i);
            first_child_.push_back(nodes_.size());
            for (unsigned k = 0; k < node.mNumChildren; ++k) nodes_.push_back(node.mChildren[k]);
        }
    }

    Json nodeJson(std::size_t i) {
        const aiNode& node = *nodes_[i];
        Json json = Json::object();
        if (node.mName.length > 0) json["name"] = node.mName.C_Str();
        if (node.mNumChildren > 0) {
            for (unsigned k = 0; k < node.mNumChildren; ++k) json["children"].push_back(first_child_[i] + k);
        }
        aiMatrix4x4 place = node.mTransformation;
        if (i == 0) place = inMetres() * place;
        const std::vector<float> matrix = columnsOf(place, builder_.mended());
        if (isAnimated(node) && isFinite(place[0], 16)) {
            // A matrix cannot be animated.
            aiVector3D scale, translation;
            aiQuaternion rotation;
            place.Decompose(scale, rotation, translation);
            json["translation"] = {translation.x, translation.y, translation.z};
            rotation = unitRotation(rotation);
            json["rotation"] = {rotation.x, rotation.y, rotation.z, rotation.w};
            json["scale"] = {scale.x, scale.y, scale.z};
        } else if (matrix != columnsOf(aiMatrix4x4(), builder_.mended())) {
            json["matrix"] = matrix;
        }
        // Of PLY, whose root is where the file is.
        if (i == 0 && length(offset_) > 0) json["translation"] = {offset_.x, offset_.y, offset_.z};
        return json;
    }

    /// FBX says how many centimetres its unit has; of other formats Assimp has put it into the root, or they do not say.
    [[nodiscard]] aiMatrix4x4 inMetres() const {
        float centimetres = 100;
        if (scene_.mMetaData != nullptr) scene_.mMetaData->Get("UnitScaleFactor", centimetres);
        aiMatrix4x4 matrix;
        if (!std::isfinite(centimetres) || !(centimetres > 0)) return matrix;
        return aiMatrix4x4::Scaling(aiVector3D(centimetres / 100), matrix);
    }

    bool isAnimated(const aiNode& node) const {
        for (unsigned a = 0; a < scene_.mNumAnimations; ++a) {
            const aiAnimation& animation = *scene_.mAnimations[a];
            for (unsigned c = 0; c < animation.mNumChannels; ++c) {
                if (animation.mChannels[c]->mNodeName == node.mName) return true;
            }
        }
        return false;
    }

    /// One glTF mesh for all meshes of the node; nodes with the same list and skin share it.
    void addMesh(std::size_t i) {
        const aiNode& node = *nodes_[i];
        if (node.mNumMeshes == 0) return;
        const std::vector<unsigned> list(node.mMeshes, node.mMeshes + node.mNumMeshes);
        const auto known = mesh_of_.find(list);
        if (known == mesh_of_.end()) mesh_of_[list] = makeMesh(list, node);
        const MeshNumbers& numbers = mesh_of_[list];
        if (!numbers.mesh) return;
        Json& json = builder_.json()["nodes"][i];
        json["mesh"] = *numbers.mesh;
        if (numbers.skin) json["skin"] = *numbers.skin;
    }

    struct MeshNumbers {
        std::optional<std::size_t> mesh = {}, skin = {};
    };

    MeshNumbers makeMesh(const std::vector<unsigned>& list, const aiNode& node) {
        Skin skin = skinOf(list);
        Json primitives = Json::array();
        std::vector<float> weights;
        std::vector<std::string> target_names;
        std::string name = node.mName.C_Str();
        for (const unsigned number : list) {
            const aiMesh& mesh = *scene_.mMeshes[number];
            std::vector<std::uint16_t> joints;
            for (unsigned b = 0; b < mesh.mNumBones && !skin.joints.empty(); ++b)
                joints.push_back(skin.place_of.at(mesh.mBones[b]->mName.C_Str()));
            std::optional<Json> primitive = addPrimitive(builder_, mesh, joints, takes_tangents_);
            if (!primitive) continue;
            if (mesh.mMaterialIndex < scene_.mNumMaterials)
                (*primitive)["material"] = materialFor(mesh.mMaterialIndex, *primitive);
            if (list.size() == 1 && mesh.mName.length > 0) name = mesh.mName.C_Str();
            if (primitives.empty()) {
                for (unsigned t = 0; t < mesh.mNumAnimMeshes; ++t) {
                    weights.push_back(mesh.mAnimMeshes[t]->mWeight);
                    target_names.emplace_back(mesh.mAnimMeshes[t]->mName.C_Str());
                }
            }
            primitives.push_back(std::move(*primitive));
        }
        if (primitives.empty()) return {};
        Json mesh = {{"primitives", std::move(primitives)}};
        if (!name.empty()) mesh["name"] = name;
        if (mesh["primitives"][0].contains("targets") && mesh["primitives"][0]["targets"].size() == weights.size()) {
            mesh["weights"] = weights;
            mesh["extras"]["targetNames"] = target_names;
        }
        MeshNumbers numbers{builder_.append("meshes", std::move(mesh))};
        if (!skin.joints.empty()) numbers.skin = addSkin(skin);
        return numbers;
    }

    /// The material, or one without the textures that are on UV sets which the primitive lacks.
    std::size_t materialFor(std::size_t number, const Json& primitive) {
        Json material = builder_.json()["materials"][number];
        bool changed = false;
        const auto leaveOut = [&](Json& object, const char* name) {
            if (!object.contains(name)) return;
            const Json* uv_set = object[name].find("texCoord");
            const std::string set = std::to_string(uv_set == nullptr ? 0 : uv_set->get<int>());
            changed = changed || !primitive["attributes"].contains("TEXCOORD_" + set);
            if (!primitive["attributes"].contains("TEXCOORD_" + set)) object.erase(name);
        };
        leaveOut(material["pbrMetallicRoughness"], "baseColorTexture");
        leaveOut(material, "normalTexture");
        if (!changed) return number;
        const auto [entry, is_new] = reduced_materials_.try_emplace(material.dump(-1, ' ', BadUtf8::replace), 0);
        if (is_new) entry->second = builder_.append("materials", std::move(material));
        return entry->second;
    }

    struct Skin {
        std::vector<std::size_t> joints = {};  ///< nodes
        std::vector<float> inverse_bind = {};
        std::map<std::string, std::uint16_t> place_of = {};
    };

    /// The bones of all meshes of a node. None where a bone has no node.
    Skin skinOf(const std::vector<unsigned>& list) {
        Skin skin;
        for (const unsigned number : list) {
            const aiMesh& mesh = *scene_.mMeshes[number];
            for (unsigned b = 0; b < mesh.mNumBones; ++b) {
                const aiBone& bone = *mesh.mBones[b];
                const auto node = index_of_.find(bone.mName.C_Str());
                if (node == index_of_.end() || skin.joints.size() == 0xffff) return {};
                if (!skin.place_of.try_emplace(bone.mName.C_Str(), static_cast<std::uint16_t>(skin.joints.size()))
                         .second)
                    continue;
                skin.joints.push_back(node->second);
                const std::vector<float> matrix = columnsOf(bone.mOffsetMatrix, builder_.mended());
                skin.inverse_bind.insert(skin.inverse_bind.end(), matrix.begin(), matrix.end());
            }
        }
        return skin;
    }

    std::size_t addSkin(const Skin& skin) {
        const std::size_t matrices = builder_.addFloats(skin.inverse_bind, 16, "MAT4", 0);
        return builder_.append("skins", {{"joints", skin.joints}, {"inverseBindMatrices", matrices}});
    }

    void addAnimations() {
        for (unsigned a = 0; a < scene_.mNumAnimations; ++a) {
            const aiAnimation& source = *scene_.mAnimations[a];
            const double ticks = source.mTicksPerSecond > 0 ? source.mTicksPerSecond : 25;
            Json animation = {{"channels", Json::array()}, {"samplers", Json::array()}};
            if (source.mName.length > 0) animation["name"] = source.mName.C_Str();
            for (unsigned c = 0; c < source.mNumChannels; ++c) {
                const aiNodeAnim& channel = *source.mChannels[c];
                const auto node = index_of_.find(channel.mNodeName.C_Str());
                if (node == index_of_.end()) continue;
                addTrack(animation, node->second, "translation", channel.mPositionKeys, channel.mNumPositionKeys,
                         ticks);
                addTrack(animation, node->second, "rotation", channel.mRotationKeys, channel.mNumRotationKeys, ticks);
                addTrack(animation, node->second, "scale", channel.mScalingKeys, channel.mNumScalingKeys, ticks);
            }
            if (!animation["channels"].empty()) builder_.append("animations", std::move(animation));
        }
    }

    static void appendValue(std::vector<float>& values, const aiVector3D& v) {
        values.insert(values.end(), {v.x, v.y, v.z});
    }
    static void appendValue(std::vector<float>& values, const aiQuaternion& rotation) {
        const aiQuaternion q = unitRotation(rotation);
        values.insert(values.end(), {q.x, q.y, q.z, q.w});
    }

    static bool isFiniteValue(const aiVector3D& v) { return isFinite(&v.x, 3); }
    static bool isFiniteValue(const aiQuaternion& q) { return isFinite(&q.w, 4); }

    /// Keys whose time does not grow are left out, since glTF forbids them, and those that are not finite.
    template <class Key>
    void addTrack(Json& animation, std::size_t node, const char* path, const Key* keys, unsigned count, double ticks) {
        std::vector<float> times, values;
        for (unsigned k = 0; k < count; ++k) {
            const auto time = static_cast<float>(std::max(0.0, keys[k].mTime) / ticks);
            if (!std::isfinite(time) || !isFiniteValue(keys[k].mValue)) continue;
            if (!times.empty() && !(time > times.back())) continue;
            times.push_back(time);
            appendValue(values, keys[k].mValue);
        }
        if (times.empty()) return;
        const std::size_t width = values.size() / times.size();
        const std::size_t input = builder_.addFloats(times, 1, "SCALAR", 0, true);
        const std::size_t output = builder_.addFloats(values, width, "VEC" + std::to_string(width), 0);
        animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
    }

    const aiScene& scene_;
    bool takes_tangents_;
    DVec3 offset_;
    GlbBuilder builder_;
    std::vector<const aiNode*> nodes_ = {};
    std::vector<std::size_t> first_child_ = {};
    std::map<std::string, std::size_t> index_of_ = {};
    std::map<std::vector<unsigned>, MeshNumbers> mesh_of_ = {};
    std::map<std::string, std::size_t> reduced_materials_ = {};  ///< by their JSON
};

bool endsInPly(const std::string& path) {
    std::string end = path.substr(path.size() - std::min<std::size_t>(path.size(), 4));
    std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
    return end == ".ply";
}

/// Reads a PLY file once more, near the origin, where that helps.
void readNearOrigin(const std::string& path, Assimp::Importer& importer, Imported& imported) {
    const std::optional<NearPly> moved = nearOrigin(path);
    if (!moved) return;
    const aiScene* scene = importer.ReadFileFromMemory(moved->bytes.data(), moved->bytes.size(), 0, "ply");
    if (scene == nullptr || scene->mRootNode == nullptr) return;
    SceneWriter writer(*scene, false, moved->offset);
    std::vector<std::uint8_t> glb = writer.write();
    if (writer.mended().isCoarse()) return;
    imported.glb = std::move(glb);
    imported.warnings = writer.mended().warnings();
    const double offset[3] = {moved->offset.x, moved->offset.y, moved->offset.z};
    std::copy_n(offset, 3, imported.offset);
    imported.warnings.push_back(
        "the coordinates are so far from the origin that 32-bit floats would change the shape; (" +
        numberText(offset[0]) + ", " + numberText(offset[1]) + ", " + numberText(offset[2]) +
        ") was taken out of them first, and is the translation of the root node in glTF (generate --keep-coordinates "
        "leaves it in)");
}

}  // namespace

Imported importScene(const std::string& path, const ImportRules& rules) {
    std::vector<std::string> refused;
    Assimp::Importer importer;
    importer.SetIOHandler(new ModelFiles(path, rules.anywhere, refused));  // which the importer owns
    // No step after reading: seams, duplicates and polygons stay as the file has them.
    const aiScene* scene = importer.ReadFile(path, 0);
    std::vector<std::string> not_read;
    for (const std::string& file : refused)
        not_read.push_back("the file " + file +
                           " lies outside of the model's folder, and was not read (--allow-external)");
    if (scene == nullptr || scene->mRootNode == nullptr) {
        std::string why = importer.GetErrorString();
        std::replace(why.begin(), why.end(), '\n', ' ');
        return {.error = "the importer cannot read it: " + (!not_read.empty() ? not_read[0]
                                                            : why.empty()     ? "no scene"
                                                                              : why)};
    }
    bool has_faces = false;
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) has_faces = has_faces || scene->mMeshes[i]->HasFaces();
    if (!has_faces) return {.error = not_read.empty() ? "it has no faces" : "it has no faces; " + not_read[0]};
    const StoredTangents stored = storedTangents(path);
    SceneWriter writer(*scene, stored == StoredTangents::withBitangents, {});
    Imported imported{.glb = writer.write()};
    imported.warnings = writer.mended().warnings();
    if (writer.mended().isCoarse() && endsInPly(path) && !rules.keep_coordinates)
        readNearOrigin(path, importer, imported);
    imported.warnings.insert(imported.warnings.end(), not_read.begin(), not_read.end());
    imported.has_no_tangents = stored == StoredTangents::none;
    return imported;
}

}  // namespace tspace::import
