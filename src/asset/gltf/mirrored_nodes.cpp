// SPDX-License-Identifier: MIT
// Signs of determinants from the roots down, without recursion.
#include "asset/gltf/mirrored_nodes.h"

#include <array>

#include "asset/file_error.h"
#include "asset/gltf/accessor.h"

namespace tspace::gltf {

namespace {

/// The first numbers of an array member; `fallback` where it is absent.
template <std::size_t count>
std::array<double, count> readNumbers(const Json& node, const char* key, const std::string& place,
                                      std::array<double, count> fallback) {
    const Json& list = readArray(node, key, place, false);
    if (list.empty()) return fallback;
    std::array<double, count> numbers{};
    for (std::size_t i = 0; i < count; ++i) {
        if (list.size() != count || !list[i].is_number()) {
            failFile(ErrorCode::invalidFile,
                     std::string("'") + key + "' is not a list of " + std::to_string(count) + " numbers",
                     join(place, key));
        }
        numbers[i] = list[i].get<double>();
    }
    return numbers;
}

bool isReflection(double x, double y, double z) { return ((x < 0) != (y < 0)) != (z < 0); }

/// Of the node's own transform.
bool hasNegativeDeterminant(const Json& node, const std::string& place) {
    if (findMember(node, "matrix") != nullptr) {
        const auto m =
            readNumbers<16>(node, "matrix", place, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
        const double determinant = m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
                                   m[2] * (m[4] * m[9] - m[5] * m[8]);
        return determinant < 0;
    }
    const auto scale = readNumbers<3>(node, "scale", place, {1, 1, 1});
    return isReflection(scale[0], scale[1], scale[2]);
}

/// True when a node that is itself mirrored or not draws anything mirrored.
bool drawsMirrored(const Document& document, const Json& node, const std::string& place, bool mirrored) {
    const Json* instancing = findExtension(node, "EXT_mesh_gpu_instancing");
    const std::string list_place = place + "/extensions/EXT_mesh_gpu_instancing/attributes";
    const Json* attributes = instancing == nullptr ? nullptr : readObject(*instancing, "attributes", place);
    if (attributes == nullptr) return mirrored;
    const auto scale =
        readIndex(*attributes, "SCALE", list_place, rootArray(document, "accessors").size(), "accessor");
    if (!scale) return mirrored;
    for (const Vec3& s : decodeVec3(document, readAccessor(document, *scale), join(list_place, "SCALE"))) {
        if (isReflection(s.x, s.y, s.z) != mirrored) return true;
    }
    return false;
}

std::vector<std::size_t> readChildren(const Json& node, const std::string& place, std::size_t node_count) {
    std::vector<std::size_t> children;
    const Json& list = readArray(node, "children", place, false);
    for (std::size_t i = 0; i < list.size(); ++i) {
        children.push_back(toIndex(list[i], join(join(place, "children"), i), node_count, "node"));
    }
    return children;
}

}  // namespace

std::vector<bool> findMirroredMeshes(const Document& document) {
    const Json& nodes = rootArray(document, "nodes");
    std::vector<bool> result(rootArray(document, "meshes").size(), false);
    std::vector<std::vector<std::size_t>> children(nodes.size());
    std::vector<bool> has_parent(nodes.size(), false);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        children[i] = readChildren(nodes[i], join("/nodes", i), nodes.size());
        for (const std::size_t child : children[i]) has_parent[child] = true;
    }
    // Each node once, even where a broken file gives it two parents.
    std::vector<bool> mirrored(nodes.size(), false), seen(nodes.size(), false);
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (has_parent[i]) continue;
        open.push_back(i);
        seen[i] = true;
    }
    while (!open.empty()) {
        const std::size_t i = open.back();
        open.pop_back();
        const std::string place = join("/nodes", i);
        mirrored[i] = mirrored[i] != hasNegativeDeterminant(nodes[i], place);
        const auto mesh = readIndex(nodes[i], "mesh", place, result.size(), "mesh");
        if (mesh && !result[*mesh] && findMember(nodes[i], "skin") == nullptr) {
            result[*mesh] = drawsMirrored(document, nodes[i], place, mirrored[i]);
        }
        for (const std::size_t child : children[i]) {
            if (seen[child]) continue;
            seen[child] = true;
            mirrored[child] = mirrored[i];
            open.push_back(child);
        }
    }
    return result;
}

}  // namespace tspace::gltf
