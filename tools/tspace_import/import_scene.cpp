// SPDX-License-Identifier: MIT
// Converts Assimp's scene to glTF: nodes, meshes with their skins, animations.
#include "import_scene.h"

#include <assimp/commonMetaData.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <new>
#include <optional>

#include "glb_builder.h"
#include "materials.h"
#include "meshes.h"
#include "model_files.h"
#include "moved_meshes.h"
#include "near_origin/near_origin.h"
#include "number_text.h"
#include "repair.h"
#include "stored_tangents.h"

namespace tspace::import {
namespace {

class SceneWriter {
  public:
    SceneWriter(const aiScene& scene, bool takes_tangents, MovedMeshes moved)
        : scene_(scene), takes_tangents_(takes_tangents), moved_(std::move(moved)) {}

    std::vector<std::uint8_t> write() {
        aiString generator;
        if (scene_.mMetaData != nullptr && scene_.mMetaData->Get(AI_METADATA_SOURCE_GENERATOR, generator) &&
            generator.length > 0) {
            builder_.json()["asset"]["generator"] = generator.C_Str();
        }
        listNodes();
        const aiMatrix4x4 root = inMeters() * scene_.mRootNode->mTransformation;
        meters_ = std::cbrt(std::fabs(static_cast<double>(root.Determinant())));
        addMaterials(builder_, scene_);
        for (std::size_t i = 0; i < nodes_.size(); ++i) builder_.append("nodes", nodeJson(i));
        for (std::size_t i = 0; i < nodes_.size(); ++i) addMeshes(i);
        addAnimations();
        builder_.json()["scene"] = 0;
        builder_.json()["scenes"] = Json::array({Json{{"nodes", {0}}}});
        return builder_.finish();
    }

    [[nodiscard]] RepairCounts& repairs() { return builder_.repairs(); }

  private:
    /// Lists nodes breadth first, so that deep hierarchies need no stack.
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
        if (i == 0) place = inMeters() * place;
        const std::vector<float> matrix = columnsOf(place, builder_.repairs());
        if (i > 0) countCoarsePlace(node.mTransformation, meters_, builder_.repairs());
        if (isAnimated(node) && isFinite(place[0], 16)) {
            // Animated nodes need separate translation, rotation and scale, because glTF does not allow animating a
            // matrix.
            aiVector3D scale, translation;
            aiQuaternion rotation;
            place.Decompose(scale, rotation, translation);
            json["translation"] = {translation.x, translation.y, translation.z};
            rotation = unitRotation(rotation);
            json["rotation"] = {rotation.x, rotation.y, rotation.z, rotation.w};
            json["scale"] = {scale.x, scale.y, scale.z};
        } else if (matrix != columnsOf(aiMatrix4x4(), builder_.repairs())) {
            json["matrix"] = matrix;
        }
        return json;
    }

    /// Returns the transform to meters. FBX declares the size of its unit in centimeters; for other formats Assimp has
    /// applied it to the root, or it is unknown.
    [[nodiscard]] aiMatrix4x4 inMeters() const {
        float centimeters = 100;
        if (scene_.mMetaData != nullptr) scene_.mMetaData->Get("UnitScaleFactor", centimeters);
        aiMatrix4x4 matrix;
        if (!std::isfinite(centimeters) || !(centimeters > 0)) return matrix;
        return aiMatrix4x4::Scaling(aiVector3D(centimeters / 100), matrix);
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

    struct MeshNumbers {
        std::optional<std::size_t> mesh = {}, skin = {};
    };

    /// Adds one glTF mesh for all meshes of the node with unchanged coordinates, and one for those with an offset.
    void addMeshes(std::size_t i) {
        const aiNode& node = *nodes_[i];
        std::vector<unsigned> list, moved;
        for (unsigned k = 0; k < node.mNumMeshes; ++k)
            (moved_.isMoved(node.mMeshes[k]) ? moved : list).push_back(node.mMeshes[k]);
        const MeshNumbers numbers = meshOf(list, node), moved_numbers = meshOf(moved, node);
        if (numbers.mesh) setMesh(i, numbers);
        if (moved_numbers.mesh) setMesh(nodeAtOffset(i, !list.empty()), moved_numbers);
    }

    void setMesh(std::size_t node, const MeshNumbers& numbers) {
        Json& json = builder_.json()["nodes"][node];
        json["mesh"] = *numbers.mesh;
        if (numbers.skin) json["skin"] = *numbers.skin;
    }

    /// Returns the glTF mesh for a list of Assimp meshes, and its skin. Nodes with equal lists share both.
    MeshNumbers meshOf(const std::vector<unsigned>& list, const aiNode& node) {
        if (list.empty()) return {};
        const auto [known, is_new] = mesh_of_.try_emplace(list);
        if (is_new) known->second = makeMesh(list, node);
        return known->second;
    }

    /// Returns the node that draws meshes with the offset: the node itself, with the offset as its translation, if it
    /// has no transform and no other content; otherwise a new child.
    std::size_t nodeAtOffset(std::size_t i, bool has_other_mesh) {
        const Json translation = {moved_.offset.x, moved_.offset.y, moved_.offset.z};
        Json& json = builder_.json()["nodes"][i];
        const bool has_place = json.contains("matrix") || json.contains("translation");
        if (!has_other_mesh && !has_place && nodes_[i]->mNumChildren == 0) {
            json["translation"] = translation;
            return i;
        }
        const std::size_t child = builder_.append("nodes", Json{{"translation", translation}});
        builder_.json()["nodes"][i]["children"].push_back(child);
        return child;
    }

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

    /// Returns the material, or a copy without the textures whose UV sets the primitive lacks.
    std::size_t materialFor(std::size_t number, const Json& primitive) {
        Json material = builder_.json()["materials"][number];
        bool changed = false;
        const auto eraseMember = [&](Json& object, const char* name) {
            if (!object.contains(name)) return;
            const Json* uv_set = object[name].find("texCoord");
            const std::string set = std::to_string(uv_set == nullptr ? 0 : uv_set->get<int>());
            changed = changed || !primitive["attributes"].contains("TEXCOORD_" + set);
            if (!primitive["attributes"].contains("TEXCOORD_" + set)) object.erase(name);
        };
        eraseMember(material["pbrMetallicRoughness"], "baseColorTexture");
        eraseMember(material, "normalTexture");
        if (!changed) return number;
        const auto [entry, is_new] = reduced_materials_.try_emplace(material.dump(-1, ' ', BadUtf8::replace), 0);
        if (is_new) entry->second = builder_.append("materials", std::move(material));
        return entry->second;
    }

    struct Skin {
        std::vector<std::size_t> joints = {};  ///< indices of the nodes that are joints
        std::vector<float> inverse_bind = {};
        std::map<std::string, std::uint16_t> place_of = {};
    };

    /// Returns the bones of all meshes of a node; none if a bone has no node.
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
                const std::vector<float> matrix = columnsOf(bone.mOffsetMatrix, builder_.repairs());
                skin.inverse_bind.insert(skin.inverse_bind.end(), matrix.begin(), matrix.end());
            }
        }
        return skin;
    }

    std::size_t addSkin(const Skin& skin) {
        const std::size_t matrices = builder_.addFloats(skin.inverse_bind, skin.joints.size(), "MAT4", gltf::kNoTarget);
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

    /// Adds a track. Keys whose time does not increase are skipped, because glTF forbids them, and so are keys that are
    /// not finite.
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
        const std::size_t input = builder_.addFloats(times, times.size(), "SCALAR", gltf::kNoTarget, true);
        const std::size_t output =
            builder_.addFloats(values, times.size(), "VEC" + std::to_string(width), gltf::kNoTarget);
        animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
    }

    const aiScene& scene_;
    bool takes_tangents_;
    MovedMeshes moved_;
    double meters_ = 1;  ///< meters per unit of the nodes below the root
    GlbBuilder builder_;
    std::vector<const aiNode*> nodes_ = {};
    std::vector<std::size_t> first_child_ = {};
    std::map<std::string, std::size_t> index_of_ = {};
    std::map<std::vector<unsigned>, MeshNumbers> mesh_of_ = {};
    std::map<std::string, std::size_t> reduced_materials_ = {};  ///< index of each reduced material; key: its JSON
};

/// Parameters for reading a file once more.
struct Reading {
    const std::string& path;
    const ImportRules& rules;
    Assimp::Importer& importer;
    bool takes_tangents;
};

/// Reads the file again with an offset subtracted from its coordinates. Returns an empty string if the
/// shape is then precise, otherwise the reason why it is not. `scene` may be invalid afterwards.
std::string readNearOrigin(const Reading& reading, const aiScene& scene, Imported& imported) {
    const std::optional<NearFile> moved = nearOrigin(reading.path);
    if (!moved) return "; the file does not store more digits, so move the model to the origin before exporting it";
    const std::string no_common =
        ", and no common offset fixes this; split the model, and move each part to its own origin";
    if (moved->bytes.empty()) return no_common;
    const std::vector<aiVector3D> first_vertices = firstVertices(scene);
    std::vector<std::string> refused;  // refused files, which the first pass has already recorded
    reading.importer.SetIOHandler(new ModelFiles(reading.path, reading.rules.anywhere, refused, &moved->bytes));
    const aiScene* const near = reading.importer.ReadFile(reading.path, 0);
    if (near == nullptr || near->mRootNode == nullptr) return "; reading it near the origin failed";
    const MovedMeshes meshes = movedMeshes(*near, first_vertices, moved->offset);
    SceneWriter writer(*near, reading.takes_tangents, meshes);
    std::vector<std::uint8_t> glb = writer.write();
    if (writer.repairs().isCoarse()) return no_common;
    imported.glb = std::move(glb);
    imported.warnings = writer.repairs().warnings();
    const double offset[3] = {moved->offset.x, moved->offset.y, moved->offset.z};
    std::copy_n(offset, 3, imported.offset);
    imported.warnings.push_back(
        "the coordinates are so far from the origin that 32-bit floats would change the shape; the offset (" +
        numberText(offset[0]) + ", " + numberText(offset[1]) + ", " + numberText(offset[2]) +
        ") was subtracted from them first, and is the translation of the nodes in glTF (generate --keep-coordinates "
        "disables this)");
    return {};
}

/// Subtracts an offset if the edges of a scene are coarse, or records why this is not possible. `scene` may be invalid
/// afterwards.
void moveNearOrigin(const Reading& reading, const aiScene& scene, const RepairCounts& repairs, Imported& imported) {
    const std::string coarse = repairs.coarseness();
    std::string why;
    if (!isReadInDouble(reading.path)) {
        why =
            "; this format is read as 32-bit floats, so further digits are lost: move the model to the origin before "
            "exporting it, or export OBJ, PLY or STL, which are read in double precision";
    } else if (reading.rules.keep_coordinates) {
        imported.keeps_coordinates = true;
        why = "; omit --keep-coordinates to subtract an offset, if that helps";
    } else {
        try {
            why = readNearOrigin(reading, scene, imported);
        } catch (const std::bad_alloc&) {
            why = "; reading them in double precision would exceed the memory limit; use --memory-limit to raise it";
        }
    }
    if (!why.empty()) imported.warnings.push_back(coarse + why);
}

}  // namespace

Imported importScene(const std::string& path, const ImportRules& rules) {
    std::vector<std::string> refused;
    Assimp::Importer importer;
    importer.SetIOHandler(new ModelFiles(path, rules.anywhere, refused));  // the importer takes ownership
    // No post-processing, so that seams, duplicates and polygons stay as in the file.
    const aiScene* scene = importer.ReadFile(path, 0);
    std::vector<std::string> not_read;
    for (const std::string& file : refused)
        not_read.push_back("the file " + file +
                           " is outside the folder of the model and was not read; use --allow-external to read it");
    if (scene == nullptr || scene->mRootNode == nullptr) {
        std::string why = importer.GetErrorString();
        std::replace(why.begin(), why.end(), '\n', ' ');
        return {.error = "the importer cannot read the file: " + (!not_read.empty() ? not_read[0]
                                                                  : why.empty()     ? "it contains no scene"
                                                                                    : why)};
    }
    bool has_faces = false;
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) has_faces = has_faces || scene->mMeshes[i]->HasFaces();
    if (!has_faces)
        return {.error = not_read.empty() ? "the file has no faces" : "the file has no faces; " + not_read[0]};
    const StoredTangents stored = storedTangents(path);
    const bool takes_tangents = stored == StoredTangents::withBitangents;
    SceneWriter writer(*scene, takes_tangents, {});
    Imported imported{.glb = writer.write()};
    imported.warnings = writer.repairs().warnings();
    if (writer.repairs().isCoarse())
        moveNearOrigin({path, rules, importer, takes_tangents}, *scene, writer.repairs(), imported);
    imported.warnings.insert(imported.warnings.end(), not_read.begin(), not_read.end());
    imported.has_no_tangents = stored == StoredTangents::none;
    return imported;
}

}  // namespace tspace::import
