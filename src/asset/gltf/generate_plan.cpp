// SPDX-License-Identifier: MIT
// Choosing an action for each primitive and grouping primitives into pools of shared vertices.
#include "asset/gltf/generate_plan.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include "asset/file_error.h"
#include "asset/gltf/material_needs.h"

namespace tspace::gltf {

namespace {

std::string uvName(std::size_t set) { return "TEXCOORD_" + std::to_string(set); }

/// Tangents without normals are to be ignored (glTF 2.0, section 3.7.2.1), so they count as missing.
bool hasUsableTangents(const Primitive& primitive) {
    return primitive.find("TANGENT").has_value() && primitive.find("NORMAL").has_value();
}

/// Fills action and reason. Returns true when tangents are to be computed; the action is then known only
/// later.
bool decide(PrimitiveReport& report, const Primitive& primitive, const TangentNeed& need,
            const GenerateOptions& options) {
    const auto leave = [&](PrimitiveAction action, std::string reason) {
        report.action = action;
        report.reason = std::move(reason);
        return false;
    };
    if (!hasTriangles(primitive.mode)) {
        return leave(PrimitiveAction::notTriangles,
                     std::string("it draws ") + modeName(primitive.mode) + ", which have no tangents");
    }
    if (!need.needed() && !options.all) {
        return leave(PrimitiveAction::notNeeded, primitive.material
                                                     ? "its material has no texture that needs tangents"
                                                     : "it has no material");
    }
    if (hasUsableTangents(primitive) && !options.overwrite) {
        return leave(PrimitiveAction::kept, "it has tangents, and overwriting was not asked for");
    }
    if (primitive.has_draco) {
        failFile(ErrorCode::unsupportedFile,
                 "the primitive is compressed by KHR_draco_mesh_compression, which is not supported yet",
                 primitive.place() + "/extensions/KHR_draco_mesh_compression");
    }
    if (!primitive.find("POSITION")) return leave(PrimitiveAction::impossible, "it has no positions");
    if (primitive.triangleCount() == 0) return leave(PrimitiveAction::impossible, "it has no triangle");
    if (options.tangents.method != Method::basis) {
        if (!primitive.find(uvName(need.uv_set))) {
            return leave(PrimitiveAction::impossible,
                         "it has no " + uvName(need.uv_set) + " for the tangents to follow");
        }
        report.uv_set = static_cast<std::int32_t>(need.uv_set);
    }
    report.reason =
        need.needed() ? "its material needs tangents for " + need.needed_by : "all primitives were asked for";
    return true;
}

/// Two primitives with the same key share every vertex.
std::string poolKey(const Primitive& primitive, std::int32_t uv_set) {
    const auto append = [](std::string& key, AttributeList list) {
        std::sort(list.begin(), list.end());
        for (const auto& [name, accessor] : list)
            key += std::to_string(name.size()) + name + ' ' + std::to_string(accessor) + ' ';
        key += '|';
    };
    std::string key = std::to_string(uv_set);
    // Plain triangles without indices need no split, so no other primitive may force one on them.
    key += !primitive.indices && primitive.mode == Mode::triangles ? "n|" : "i|";
    append(key, primitive.attributes);
    for (const AttributeList& target : primitive.targets) append(key, target);
    return key;
}

}  // namespace

GeneratePlan planGenerate(const Document& document, std::span<const Primitive> primitives,
                          const GenerateOptions& options) {
    GeneratePlan plan;
    plan.reports.resize(primitives.size());
    std::map<std::string, std::size_t> pool_of;
    std::map<std::tuple<std::size_t, std::size_t, Mode>, std::size_t> geometry_of;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const Primitive& primitive = primitives[i];
        PrimitiveReport& report = plan.reports[i];
        report.mesh = primitive.mesh;
        report.primitive = primitive.index;
        report.mesh_name = primitive.mesh_name;
        report.material_name = materialName(document, primitive);
        report.triangle_count = primitive.triangleCount();
        report.vertices_before = report.vertices_after = primitive.vertex_count;
        if (!decide(report, primitive, tangentNeed(document, primitive), options)) continue;

        const auto [pool_entry, is_new_pool] =
            pool_of.try_emplace(poolKey(primitive, report.uv_set), plan.pools.size());
        const std::size_t pool_number = pool_entry->second;
        if (is_new_pool) {
            Pool& created = plan.pools.emplace_back();
            created.uses_uvs = report.uv_set >= 0;
            created.uv_set = created.uses_uvs ? static_cast<std::size_t>(report.uv_set) : 0;
            created.has_normals = primitive.find("NORMAL").has_value();
            created.has_tangents = hasUsableTangents(primitive);
        }
        Pool& pool = plan.pools[pool_number];
        pool.primitives.push_back(i);
        const std::size_t no_indices = rootArray(document, "accessors").size();
        const auto [geometry_entry, is_new_geometry] = geometry_of.try_emplace(
            {pool_number, primitive.indices.value_or(no_indices), primitive.mode}, pool.geometries.size());
        if (is_new_geometry) {
            pool.geometries.emplace_back();
            pool.corner_count += primitive.triangleCount() * 3;
        }
        pool.geometries[geometry_entry->second].primitives.push_back(i);
    }
    return plan;
}

}  // namespace tspace::gltf
