// SPDX-License-Identifier: MIT
// Nodes of a document: their transforms, instances and visibility.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/gltf/accessor.h"
#include "model/gltf/document.h"
#include "model/gltf/json_access.h"
#include "model/scene/scene.h"

namespace tspace::gltf {

inline Affine transformOf(const double (&move)[3], const double (&turn)[4], const double (&scale)[3]) {
    const double x = turn[0], y = turn[1], z = turn[2], w = turn[3];
    return {scale[0] * DVec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
            scale[1] * DVec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
            scale[2] * DVec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
            {move[0], move[1], move[2]}};
}

/// Reads the local transform of a node: a matrix, or translation, rotation and scale.
inline Affine readTransform(const Json& node, const std::string& place) {
    if (findMember(node, "matrix") != nullptr) {
        double m[16] = {};
        readNumbers(node, "matrix", place, m);
        return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    }
    double move[3] = {0, 0, 0}, turn[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1};
    readNumbers(node, "translation", place, move);
    readNumbers(node, "rotation", place, turn);
    readNumbers(node, "scale", place, scale);
    return transformOf(move, turn, scale);
}

/// Number of instances of a node. All its instancing attributes should have one element per instance.
struct InstanceCounts {
    std::size_t complete = 1;  ///< elements of the shortest attribute
    std::size_t largest = 1;   ///< elements of the longest attribute
};

inline InstanceCounts countInstances(const Document& document, const Json& node, const std::string& place) {
    const Json* const extension = findExtension(node, "EXT_mesh_gpu_instancing");
    const Json* const attributes = extension == nullptr ? nullptr : findMember(*extension, "attributes");
    if (attributes == nullptr || !attributes->is_object() || attributes->empty()) return {};
    const std::string at = place + "/extensions/EXT_mesh_gpu_instancing/attributes";
    InstanceCounts counts{static_cast<std::size_t>(-1), 0};
    for (const auto& [name, index] : attributes->items()) {
        const std::size_t accessor =
            toIndex(index, join(at, name), rootArray(document, "accessors").size(), "accessor");
        const std::size_t count = readAccessor(document, accessor).count;
        counts = {std::min(counts.complete, count), std::max(counts.largest, count)};
    }
    return counts;
}

/// Reads EXT_mesh_gpu_instancing: the transforms of a node's instances relative to the node, or a single identity
/// without it. Ignores attributes of a wrong type or without data.
inline std::vector<Affine> readInstances(const Document& document, const Json& node, const std::string& place) {
    const Json* const extension = findExtension(node, "EXT_mesh_gpu_instancing");
    const Json* const attributes = extension == nullptr ? nullptr : findMember(*extension, "attributes");
    if (attributes == nullptr || !attributes->is_object()) return {Affine{}};
    const std::string at = place + "/extensions/EXT_mesh_gpu_instancing/attributes";
    std::optional<std::size_t> count;
    const auto read = [&](const char* name, std::size_t width, const auto& decode) {
        using List = decltype(decode(document, Accessor{}, at));
        const auto index = readIndex(*attributes, name, at, rootArray(document, "accessors").size(), "accessor");
        if (!index) return List{};
        const Accessor accessor = readAccessor(document, *index);
        if (accessor.component_count != width || !hasData(document, accessor)) return List{};
        document.memory->require(accessor.count * (sizeof(Affine) + sizeof(Vec4)), join(at, name));
        count = std::min(count.value_or(accessor.count), accessor.count);
        return decode(document, accessor, join(at, name));
    };
    const std::vector<Vec3> moves = read("TRANSLATION", 3, decodeVec3), scales = read("SCALE", 3, decodeVec3);
    const std::vector<Vec4> turns = read("ROTATION", 4, decodeVec4);
    std::vector<Affine> instances(count.value_or(1));
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const Vec3 move = moves.empty() ? Vec3{} : moves[i], scale = scales.empty() ? Vec3{1, 1, 1} : scales[i];
        const Vec4 turn = turns.empty() ? Vec4{0, 0, 0, 1} : turns[i];
        instances[i] =
            transformOf({move.x, move.y, move.z}, {turn.x, turn.y, turn.z, turn.w}, {scale.x, scale.y, scale.z});
    }
    return instances;
}

/// Returns whether the node hides itself and its children.
inline bool hidesItself(const Json& node) {
    const Json* const visibility = findExtension(node, "KHR_node_visibility");
    const Json* const is_visible = visibility == nullptr ? nullptr : findMember(*visibility, "visible");
    return is_visible != nullptr && is_visible->is_boolean() && !is_visible->get<bool>();
}

/// Nodes of a document as a forest: references that would give a node a second parent, or form a cycle, are ignored.
class Nodes {
  public:
    explicit Nodes(const Document& document)
        : document_(document), list_(rootArray(document, "nodes")), worlds_(list_.size()), is_hidden_(list_.size(), 0),
          seen_(list_.size(), 0) {
        std::vector<std::uint8_t> is_child(list_.size(), 0);
        for (std::size_t i = 0; i < list_.size(); ++i) {
            for (const std::size_t child : indicesIn(list_[i], "children", join("/nodes", i))) is_child[child] = 1;
        }
        for (std::size_t i = 0; i < list_.size(); ++i) {
            if (is_child[i] == 0) roots_.push_back(i);
        }
        below(roots_);
    }

    /// Returns the nodes of the default scene, otherwise of the first scene, otherwise of the whole forest; parents
    /// before children.
    std::vector<std::size_t> shown() {
        const Json& scenes = rootArray(document_, "scenes");
        if (scenes.empty()) return below(roots_);
        const std::size_t scene = readIndex(document_.json, "scene", "", scenes.size(), "scene").value_or(0);
        return below(indicesIn(scenes[scene], "nodes", join("/scenes", scene)));
    }

    [[nodiscard]] const Json& operator[](std::size_t node) const { return list_[node]; }
    [[nodiscard]] const Affine& world(std::size_t node) const { return worlds_[node]; }
    /// Returns whether neither the node nor one of its parents is hidden.
    [[nodiscard]] bool isVisible(std::size_t node) const { return is_hidden_[node] == 0; }

  private:
    [[nodiscard]] std::vector<std::size_t> indicesIn(const Json& object, const char* key,
                                                     const std::string& place) const {
        std::vector<std::size_t> result;
        const Json& array = readArray(object, key, place, false);
        for (std::size_t i = 0; i < array.size(); ++i)
            result.push_back(toIndex(array[i], join(join(place, key), i), list_.size(), "node"));
        return result;
    }

    /// Returns `roots` and all nodes below them, each once. Computes the world transform of each node, along the first
    /// path that reaches it in any traversal.
    std::vector<std::size_t> below(const std::vector<std::size_t>& roots) {
        ++walk_;
        std::vector<std::size_t> order;
        const auto meet = [&](std::size_t node, const Affine& parent, bool is_hidden) {
            if (seen_[node] == walk_) return;
            if (seen_[node] == 0) {
                worlds_[node] = compose(parent, readTransform(list_[node], join("/nodes", node)));
                is_hidden_[node] = is_hidden || hidesItself(list_[node]) ? 1 : 0;
            }
            seen_[node] = walk_;
            order.push_back(node);
        };
        for (const std::size_t root : roots) meet(root, {}, false);
        for (std::size_t i = 0; i < order.size(); ++i) {
            const std::size_t node = order[i];
            for (const std::size_t child : indicesIn(list_[node], "children", join("/nodes", node)))
                meet(child, worlds_[node], !isVisible(node));
        }
        return order;
    }

    const Document& document_;
    const Json& list_;
    std::vector<Affine> worlds_;
    std::vector<std::uint8_t> is_hidden_;
    std::vector<std::uint8_t> seen_;  ///< index of the last traversal that visited the node
    std::uint8_t walk_ = 0;
    std::vector<std::size_t> roots_ = {};
};

}  // namespace tspace::gltf
