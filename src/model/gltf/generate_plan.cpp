// SPDX-License-Identifier: MIT
// Choosing an action for each primitive and grouping primitives into pools of shared vertices.
#include "model/gltf/generate_plan.h"

#include <algorithm>
#include <bit>
#include <map>
#include <string>
#include <tuple>

#include "core/base/sort.h"
#include "core/base/vec_math.h"
#include "model/gltf/material_needs.h"
#include "model/gltf/primitive_notes.h"
#include "model/gltf/read_packed.h"
#include "model/gltf/strip_tangents.h"

namespace tspace::gltf {

namespace {

std::string uvName(std::size_t set) { return "TEXCOORD_" + std::to_string(set); }

/// Tangents without normals are to be ignored (glTF 2.0, section 3.7.2.1), so they count as missing.
bool hasUsableTangents(const Primitive& primitive) {
    return primitive.find("TANGENT").has_value() && primitive.find("NORMAL").has_value();
}

/// "its material", as a reason begins.
std::string needWords(const TangentUse& use) {
    return std::string(use.only_in_variant ? "a material variant" : "its material") + " needs tangents for " +
           use.needed_by;
}

bool tangentsGo(const Primitive& primitive, const std::vector<TangentUse>& uses, const GenerateOptions& options) {
    return options.strip && uses.empty() && canStripTangents(primitive);
}

std::string uvsOf(const std::vector<TangentUse>& uses) { return uvName(uses.empty() ? 0 : uses[0].uv_set); }

bool hasSurface(const Primitive& primitive) {
    return hasTriangles(primitive.mode) && primitive.find("POSITION") && primitive.triangleCount() != 0;
}

/// Whether its normals are made anew, and so are the tangents that it has: they would not fit.
bool makesNormalsAnew(PrimitiveReport& report, const Document& document, const Primitive& primitive,
                      const std::vector<TangentUse>& uses, const GenerateOptions& options) {
    if (!options.overwrite_normals || !hasSurface(primitive) || surfaceKind(document, primitive).is_unlit) return false;
    if (!packedAlone(document, primitive).empty()) return false;
    const bool can_follow = options.tangents.method == Method::basis || primitive.find(uvsOf(uses));
    if (!primitive.find("TANGENT") || tangentsGo(primitive, uses, options) || can_follow) return true;
    report.notes.push_back(
        "its normals stay: its tangents would not fit new ones, and cannot be computed, because it has no " +
        uvsOf(uses));
    return false;
}

/// Whether a target leaves normals as they are, or makes some NaN or infinite.
bool lacksNormals(const Document& document, const Primitive& primitive, std::size_t target) {
    if (!findAttribute(primitive.targets[target], "NORMAL")) return true;
    const std::vector<Vec3> offsets = readOffsets(document, primitive, target, "NORMAL");
    const auto is_finite = [](const Vec3& offset) { return isFinite(offset); };
    return std::all_of(offsets.begin(), offsets.end(), isZero) ||
           !std::all_of(offsets.begin(), offsets.end(), is_finite);
}

/// Targets that get new offsets of normals that stay; empty: none does.
std::vector<bool> morphNormals(const Document& document, const Primitive& primitive, MorphNormals which) {
    std::vector<bool> targets;
    if (which == MorphNormals::keep || !hasSurface(primitive) || !primitive.find("NORMAL")) return targets;
    for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
        const bool moves = findAttribute(primitive.targets[i], "POSITION").has_value();
        targets.push_back(moves && (which == MorphNormals::all || lacksNormals(document, primitive, i)));
    }
    if (std::count(targets.begin(), targets.end(), true) == 0) targets.clear();
    return targets;
}

/// What is computed but for tangents.
struct NormalsPlan {
    bool anew = false;
    std::vector<bool> morphs = {};
};

/// Whether nothing is to be computed because nobody asks for it. Fills action and reason then.
bool isLeftAlone(PrimitiveReport& report, const Document& document, const Primitive& primitive,
                 const std::vector<TangentUse>& uses, const GenerateOptions& options, const NormalsPlan& normals) {
    const bool follows = normals.anew && primitive.find("TANGENT") && !tangentsGo(primitive, uses, options);
    std::string why;
    if (!hasTriangles(primitive.mode)) {
        report.action = PrimitiveAction::notTriangles;
        why = std::string("it draws ") + modeName(primitive.mode) + ", which have no tangents";
    } else if (uses.empty() && !options.all && !follows) {
        report.action = PrimitiveAction::notNeeded;
        why = primitive.material ? "its material has no texture that needs tangents" : "it has no material";
    } else {
        return false;
    }
    const std::string reader =
        primitive.find("TANGENT") && uses.empty() ? otherTangentReader(document, primitive) : std::string();
    if (!reader.empty()) {
        why += "; " + reader + " may be about its tangents";
    } else if (tangentsGo(primitive, uses, options)) {
        report.action = PrimitiveAction::removed;
        why = "nothing needs its tangents: " + why;
    } else if (options.strip && uses.empty() && primitive.find("TANGENT")) {
        why += "; its tangents stay, because a morph target moves nothing else";
    }
    report.reason = std::move(why);
    return true;
}

constexpr const char* kKeptReason = "it has tangents, and overwriting was not asked for";

/// Fills action and reason. Returns true when tangents are to be computed; the action is then known only
/// later, unless they are kept and only deltas of morph targets are computed.
bool decide(PrimitiveReport& report, const Document& document, const Primitive& primitive,
            const std::vector<TangentUse>& uses, const GenerateOptions& options, const NormalsPlan& normals) {
    const auto leave = [&](PrimitiveAction action, std::string reason) {
        report.action = action;
        report.reason = std::move(reason);
        return false;
    };
    if (isLeftAlone(report, document, primitive, uses, options, normals)) return false;
    // What would be made in their place is less than what they were packed from.
    const bool can_overwrite = primitive.find("NORMAL") && options.existing == ExistingTangents::replace;
    if (const std::string packed = can_overwrite ? "" : packedAlone(document, primitive); !packed.empty())
        return leave(PrimitiveAction::kept, "its frames are packed in " + packed);
    const bool keeps = hasUsableTangents(primitive) && options.existing == ExistingTangents::keep && !normals.anew;
    if (keeps && !lacksDeltas(primitive) && normals.morphs.empty()) return leave(PrimitiveAction::kept, kKeptReason);
    const auto cannot = [&](const std::string& reason) {
        if (!keeps) return leave(PrimitiveAction::impossible, reason);
        return leave(PrimitiveAction::kept,
                     std::string(kKeptReason) + "; its morph targets get no tangent deltas, because " + reason);
    };
    if (!primitive.find("POSITION")) return cannot("it has no positions");
    if (primitive.triangleCount() == 0) return cannot("it has no triangle");
    if (options.tangents.method != Method::basis) {
        if (!primitive.find(uvsOf(uses))) return cannot("it has no " + uvsOf(uses) + " for the tangents to follow");
        report.uv_set = static_cast<std::int32_t>(uses.empty() ? 0 : uses[0].uv_set);
    }
    report.reason = !uses.empty() ? needWords(uses[0])
                    : options.all ? "all primitives were asked for"
                                  : "it has tangents";
    if (hasUsableTangents(primitive) && options.existing == ExistingTangents::replace) {
        report.reason += ", and overwriting was asked for";
    } else if (hasUsableTangents(primitive) && normals.anew) {
        report.reason += ", and old ones would not fit its new normals";
    }
    if (keeps) leave(PrimitiveAction::kept, kKeptReason);
    return true;
}

/// A note where computed tangents take the place of some that no texture is read with: somebody may have drawn them.
/// Empty: there are none such.
std::string noteOnDrawn(const Document& document, const Primitive& primitive, const std::vector<TangentUse>& uses,
                        bool along_u) {
    if (std::any_of(uses.begin(), uses.end(), [](const TangentUse& use) { return use.has_texture; })) return {};
    std::string reader = otherTangentReader(document, primitive);
    if (reader.empty() && !uses.empty()) reader = uses[0].needed_by + " without a texture";
    if (reader.empty()) return {};
    return "tangents that somebody may have drawn (" + reader + ") were computed anew" + (along_u ? " along u" : "");
}

/// Two primitives with the same key share every vertex.
std::string poolKey(const Primitive& primitive, std::int32_t uv_set, const UvMatrix& matrix, bool makes_tangents,
                    bool overwrites_normals) {
    const auto append = [](std::string& key, AttributeList list) {
        sortList(list.begin(), list.end());
        for (const auto& [name, accessor] : list)
            key += std::to_string(name.size()) + name + ' ' + std::to_string(accessor) + ' ';
        key += '|';
    };
    std::string key = std::to_string(uv_set) + (makes_tangents ? "" : "without") + (overwrites_normals ? "anew" : "");
    for (const double entry : {matrix.uu, matrix.uv, matrix.vu, matrix.vv})
        key += ',' + std::to_string(std::bit_cast<std::uint64_t>(entry));
    // Plain triangles without indices need no split, so no other primitive may force one on them.
    key += !primitive.indices && primitive.mode == Mode::triangles ? "n|" : "i|";
    append(key, primitive.attributes);
    for (const AttributeList& target : primitive.targets) append(key, target);
    return key;
}

bool comesFromBlender(const Document& document) {
    const Json* asset = readObject(document.json, "asset", "");
    return asset != nullptr && readString(*asset, "generator", "/asset").find("Blender") != std::string::npos;
}

}  // namespace

bool lacksDeltas(const Primitive& primitive) {
    return std::any_of(primitive.targets.begin(), primitive.targets.end(), [](const AttributeList& target) {
        return movesFrames(target) && !findAttribute(target, "TANGENT");
    });
}

GeneratePlan planGenerate(const Document& document, std::span<const Primitive> primitives,
                          const GenerateOptions& options) {
    GeneratePlan plan;
    const std::set<std::string> animated = animatedPointers(document);
    const bool is_blenders = comesFromBlender(document);
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
        report.morph_target_count = static_cast<std::uint32_t>(primitive.targets.size());
        report.vertices_before = report.vertices_after = primitive.vertex_count;
        const std::vector<TangentUse> uses = tangentUses(document, primitive);
        NormalsPlan normals{.anew = makesNormalsAnew(report, document, primitive, uses, options)};
        if (!normals.anew) normals.morphs = morphNormals(document, primitive, options.morph_normals);
        const bool computes = decide(report, document, primitive, uses, options, normals);
        if (hasTriangles(primitive.mode)) {
            const bool follows = computes && report.uv_set >= 0 && report.action != PrimitiveAction::kept;
            for (std::string& note : notesOf(uses, animated, options.texture_transform, follows))
                report.notes.push_back(std::move(note));
        }
        if (!computes && !normals.anew && normals.morphs.empty()) continue;
        if (computes && primitive.find("TANGENT") && !hasUsableTangents(primitive))
            report.notes.emplace_back("the tangents that it had did not count, because it had no normals");

        const bool replaces = options.existing == ExistingTangents::replace || normals.anew;
        if (computes && replaces && report.action != PrimitiveAction::kept && hasUsableTangents(primitive)) {
            std::string note = noteOnDrawn(document, primitive, uses, report.uv_set >= 0);
            if (!note.empty()) report.notes.push_back(std::move(note));
        }

        UvMatrix matrix;
        if (computes && report.uv_set >= 0 && !uses.empty()) {
            matrix = uvMatrixOf(uses[0], options.texture_transform);
            plan.has_texture_transforms =
                plan.has_texture_transforms || !uvMatrixOf(uses[0], TextureTransform::apply).isIdentity();
        }
        const auto [pool_entry, is_new_pool] =
            pool_of.try_emplace(poolKey(primitive, report.uv_set, matrix, computes, normals.anew), plan.pools.size());
        const std::size_t pool_number = pool_entry->second;
        if (is_new_pool) {
            Pool& created = plan.pools.emplace_back();
            created.makes_tangents = computes;
            created.uses_uvs = computes && report.uv_set >= 0;
            created.uv_matrix = matrix;
            created.uv_set = created.uses_uvs ? static_cast<std::size_t>(report.uv_set) : 0;
            created.vertex_count = primitive.vertex_count;
            created.overwrites_normals = normals.anew && primitive.find("NORMAL");
            created.has_normals = primitive.find("NORMAL") && !normals.anew;
            created.morph_normals = std::move(normals.morphs);
            created.has_tangents = hasUsableTangents(primitive);
            created.keeps_tangents = computes && report.action == PrimitiveAction::kept;
            created.tries_quads =
                computes && options.tangents.method == Method::mikktspace && options.faces != Faces::triangles;
            created.is_blenders = is_blenders;
        }
        Pool& pool = plan.pools[pool_number];
        pool.primitives.push_back(i);
        const std::size_t no_indices = rootArray(document, "accessors").size();
        const auto [geometry_entry, is_new_geometry] = geometry_of.try_emplace(
            {pool_number, primitive.indices.value_or(no_indices), primitive.mode}, pool.geometries.size());
        if (is_new_geometry) {
            pool.geometries.emplace_back();
            pool.corner_count += std::uint64_t{3} * primitive.triangleCount();
        }
        pool.geometries[geometry_entry->second].primitives.push_back(i);
    }
    return plan;
}

}  // namespace tspace::gltf
