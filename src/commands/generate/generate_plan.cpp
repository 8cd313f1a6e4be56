// SPDX-License-Identifier: MIT
// Chooses an action for each primitive, and groups primitives into pools of shared vertices.
#include "commands/generate/generate_plan.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "commands/generate/edit_attributes.h"
#include "core/base/vec_math.h"
#include "model/gltf/component_rules.h"
#include "model/gltf/material_needs.h"
#include "model/gltf/packed_frames.h"
#include "model/gltf/read_scene.h"
#include "model/io/file_error.h"

namespace tspace::gltf {
namespace {

std::string uvName(std::size_t set) { return "TEXCOORD_" + std::to_string(set); }

/// Returns whether the primitive has tangents and normals: tangents without normals must be ignored (glTF 2.0, section
/// 3.7.2.1).
bool hasUsableTangents(const Primitive& primitive) {
    return primitive.find("TANGENT").has_value() && primitive.find("NORMAL").has_value();
}

/// Returns the start of a reason, such as "its material needs tangents for ...".
std::string needWords(const TangentUse& use) {
    return std::string(use.only_in_variant ? "a material variant" : "its material") + " needs tangents for " +
           use.needed_by;
}

bool shouldStripTangents(const Primitive& primitive, const std::vector<TangentUse>& uses,
                         const GenerateOptions& options) {
    return options.selection.strip && uses.empty() && canStripTangents(primitive);
}

std::string uvsOf(const std::vector<TangentUse>& uses) { return uvName(uses.empty() ? 0 : uses[0].uv_set); }

const AttributeFault* findFault(const Primitive& primitive, const std::string& name) {
    const auto& faults = primitive.attribute_faults;
    const auto found = std::find_if(faults.begin(), faults.end(), [&](const AttributeFault& fault) {
        return fault.target < 0 && fault.name == name;
    });
    return found == faults.end() ? nullptr : &*found;
}

/// Returns whether the primitive has the attribute, or has it after a repair.
bool canHave(const Primitive& primitive, const std::string& name) {
    const AttributeFault* const fault = findFault(primitive, name);
    return primitive.find(name) || (fault != nullptr && fault->repair == AttributeRepair::resize);
}

bool drawsTriangles(const Primitive& primitive) {
    return hasTriangles(primitive.mode) && primitive.triangleCount() != 0;
}

/// Returns whether glTF forbids the normals, by their type or by their values. Unlit materials do not use normals, so
/// only such normals of unlit primitives are recomputed.
bool areNormalsInvalid(const Document& document, const Primitive& primitive) {
    return findFault(primitive, "NORMAL") != nullptr || areUnsigned(document, primitive.find("NORMAL")) ||
           usesInvalidNormals(document, primitive);
}

/// Returns whether normals that are to be overwritten can be recomputed. Then the tangents are recomputed too, because
/// they would not fit the new normals. If they cannot be, adds the reason to `notes`.
bool canRegenerateNormals(const Document& document, const Primitive& primitive, const std::vector<TangentUse>& uses,
                          const GenerateOptions& options, std::vector<std::string>& notes) {
    if (!drawsTriangles(primitive) || !canHave(primitive, "POSITION") || !primitive.canRepairFaults()) return false;
    if (!packedAlone(document, primitive).empty()) return false;
    const bool can_follow = options.tangents.compute.method == Method::basis || canHave(primitive, uvsOf(uses));
    if (!primitive.find("TANGENT") || shouldStripTangents(primitive, uses, options) || can_follow) return true;
    notes.push_back("its normals were kept: its tangents would not fit new ones and cannot be recomputed, because " +
                    (findFault(primitive, uvsOf(uses)) == nullptr ? "it has no " + uvsOf(uses)
                                                                  : "its " + uvsOf(uses) + " cannot be read"));
    return false;
}

/// Returns whether the normals of the primitive are recomputed.
bool regeneratesNormals(PrimitiveReport& report, const Document& document, const Primitive& primitive,
                        const std::vector<TangentUse>& uses, const GenerateOptions& options, bool is_requested,
                        bool are_lost) {
    if (!options.normals.overwrite && !is_requested && !are_lost) return false;
    const bool is_unused = surfaceKind(document, primitive).is_unlit && !are_lost;
    if (is_unused && !areNormalsInvalid(document, primitive)) return false;
    return canRegenerateNormals(document, primitive, uses, options, report.notes);
}

/// Returns whether a target does not change the normals, or makes some of them NaN or infinite.
bool lacksNormals(const Document& document, const Primitive& primitive, std::size_t target) {
    if (!findAttribute(primitive.targets[target], "NORMAL")) return true;
    const std::vector<Vec3> offsets = readOffsets(document, primitive, target, "NORMAL");
    const auto is_finite = [](const Vec3& offset) { return isFinite(offset); };
    return std::all_of(offsets.begin(), offsets.end(), isZero) ||
           !std::all_of(offsets.begin(), offsets.end(), is_finite);
}

/// Returns the targets that get new normal offsets although the base normals are kept; empty: none.
std::vector<bool> morphNormals(const Document& document, const Primitive& primitive, MorphNormals which) {
    std::vector<bool> targets;
    if (which == MorphNormals::keep || !primitive.find("POSITION") || !primitive.find("NORMAL")) return targets;
    if (!drawsTriangles(primitive)) return targets;
    for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
        const bool moves = findAttribute(primitive.targets[i], "POSITION").has_value();
        targets.push_back(moves && (which == MorphNormals::all || lacksNormals(document, primitive, i)));
    }
    if (std::count(targets.begin(), targets.end(), true) == 0) targets.clear();
    return targets;
}

/// The computations of normals that are planned for a primitive.
struct NormalsPlan {
    bool recompute = false;
    std::vector<bool> morphs = {};
};

/// Returns whether nothing is computed because it is not needed or not possible. If so, fills action and reason.
bool isSkipped(PrimitiveReport& report, const Document& document, const Primitive& primitive,
               const std::vector<TangentUse>& uses, const GenerateOptions& options, const NormalsPlan& normals) {
    const bool follows =
        normals.recompute && primitive.find("TANGENT") && !shouldStripTangents(primitive, uses, options);
    std::string why;
    if (!hasTriangles(primitive.mode)) {
        report.action = PrimitiveAction::notTriangles;
        why = std::string("it draws ") + modeName(primitive.mode) + ", which have no tangents";
    } else if (uses.empty() && !options.selection.all && !follows) {
        report.action = PrimitiveAction::notNeeded;
        why = primitive.material ? "no texture of its material needs tangents" : "it has no material";
    } else {
        return false;
    }
    const std::string reader =
        primitive.find("TANGENT") && uses.empty() ? otherTangentReader(document, primitive) : std::string();
    if (!reader.empty()) {
        why += "; " + reader + " may refer to its tangents";
    } else if (shouldStripTangents(primitive, uses, options)) {
        report.action = PrimitiveAction::removed;
        why = "nothing needs its tangents: " + why;
    } else if (options.selection.strip && uses.empty() && primitive.find("TANGENT")) {
        why += "; its tangents were kept, because a morph target has nothing but tangent deltas, and cannot be empty";
    }
    report.reason = std::move(why);
    return true;
}

constexpr const char* kKeptReason = "it has tangents, and overwriting was not requested";

/// Fills action and reason. Returns true if tangents are to be computed; then the action is set later, unless the
/// tangents are kept and only deltas of morph targets are computed.
bool decide(PrimitiveReport& report, const Document& document, const Primitive& primitive,
            const std::vector<TangentUse>& uses, const GenerateOptions& options, const NormalsPlan& normals) {
    const auto leave = [&](PrimitiveAction action, std::string reason) {
        report.action = action;
        report.reason = std::move(reason);
        return false;
    };
    if (isSkipped(report, document, primitive, uses, options, normals)) return false;
    // Recomputed frames would be less exact than the packed frames, so the packed frames are kept.
    const bool can_overwrite = primitive.find("NORMAL") && options.selection.existing == ExistingTangents::replace;
    if (const std::string packed = can_overwrite ? "" : packedAlone(document, primitive); !packed.empty())
        return leave(PrimitiveAction::kept, "its frames are packed in " + packed);
    const bool keeps =
        hasUsableTangents(primitive) && options.selection.existing == ExistingTangents::keep && !normals.recompute;
    if (keeps && !lacksDeltas(primitive) && normals.morphs.empty()) return leave(PrimitiveAction::kept, kKeptReason);
    if (!primitive.attribute_faults.empty()) {
        const AttributeFault& fault = primitive.attribute_faults.front();
        const char* remedy = primitive.canRepairFaults() ? "; use --repair or --overwrite-normals to fix this"
                                                         : "; no command can repair it, so export the mesh again";
        return leave(PrimitiveAction::impossible, "the elements of its " + attributeText(fault.name, fault.target) +
                                                      " cannot be read: " + fault.why + remedy);
    }
    const auto cannot = [&](const std::string& reason) {
        if (!keeps) return leave(PrimitiveAction::impossible, reason);
        return leave(PrimitiveAction::kept,
                     std::string(kKeptReason) + "; its morph targets got no tangent deltas, because " + reason);
    };
    if (!primitive.find("POSITION")) return cannot("it has no positions");
    if (primitive.triangleCount() == 0) return cannot("it has no triangle");
    if (options.tangents.compute.method != Method::basis) {
        if (!primitive.find(uvsOf(uses)))
            return cannot("it has no " + uvsOf(uses) + ", from which tangents are computed");
        report.uv_set = static_cast<std::int32_t>(uses.empty() ? 0 : uses[0].uv_set);
    }
    report.reason = !uses.empty()           ? needWords(uses[0])
                    : options.selection.all ? "requested for all primitives"
                                            : "it has tangents";
    if (hasUsableTangents(primitive) && options.selection.existing == ExistingTangents::replace) {
        report.reason += ", and overwriting was requested";
    } else if (hasUsableTangents(primitive) && normals.recompute) {
        report.reason += ", which would not fit its new normals";
    }
    if (keeps) leave(PrimitiveAction::kept, kKeptReason);
    return true;
}

/// Returns a note if computed tangents replace tangents that no texture uses, because these may be authored; otherwise
/// empty.
std::string noteOnAuthored(const Document& document, const Primitive& primitive, const std::vector<TangentUse>& uses,
                           bool along_u) {
    if (std::any_of(uses.begin(), uses.end(), [](const TangentUse& use) { return use.has_texture; })) return {};
    std::string reader = otherTangentReader(document, primitive);
    if (reader.empty() && !uses.empty()) reader = uses[0].needed_by + " without a texture";
    if (reader.empty()) return {};
    return "its tangents were recomputed" + std::string(along_u ? " along u" : "") +
           ", although they may have been authored for " + reader;
}

/// Returns a key; primitives with equal keys are computed together.
std::string poolKey(const Primitive& primitive, std::int32_t uv_set, const UvMatrix& matrix, bool makes_tangents,
                    bool overwrites_normals) {
    std::string key = std::to_string(uv_set) + (makes_tangents ? "" : "without") + (overwrites_normals ? "anew" : "");
    for (const double entry : {matrix.uu, matrix.uv, matrix.vu, matrix.vv})
        key += ',' + std::to_string(std::bit_cast<std::uint64_t>(entry));
    // A triangle list without indices never needs a split, because each corner has its own vertex. It gets a pool of
    // its own, because other primitives of a pool could cause a split.
    key += !primitive.indices && primitive.mode == Mode::triangles ? "n|" : "i|";
    return key + vertexKey(primitive);
}

bool isFromBlender(const Document& document) {
    const Json* asset = readObject(document.json, "asset", "");
    return asset != nullptr && readString(*asset, "generator", "/asset").find("Blender") != std::string::npos;
}

}  // namespace

bool lacksDeltas(const Primitive& primitive) {
    return std::any_of(primitive.targets.begin(), primitive.targets.end(), [](const AttributeList& target) {
        return movesFrames(target) && !findAttribute(target, "TANGENT");
    });
}

bool overwritesNormals(const Document& document, const Primitive& primitive, const GenerateOptions& options) {
    PrimitiveReport report;
    return regeneratesNormals(report, document, primitive, tangentUses(document, primitive), options, false, false);
}

GeneratePlan planGenerate(const Document& document, std::span<const Primitive> primitives,
                          const GenerateOptions& options, const RecomputedNormals& recomputed) {
    const auto isIn = [](const std::vector<bool>& list, std::size_t i) { return i < list.size() && list[i]; };
    GeneratePlan plan;
    const std::set<std::string> animated = animatedPointers(document);
    const bool is_from_blender = isFromBlender(document);
    plan.reports.resize(primitives.size());
    std::map<std::string, std::size_t> pool_of;
    VertexLists lists;
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
        report.source_list = report.split_list = lists.numberOf(primitive);
        const std::vector<TangentUse> uses = tangentUses(document, primitive);
        NormalsPlan normals{.recompute = regeneratesNormals(report, document, primitive, uses, options,
                                                            isIn(recomputed.base, i), isIn(recomputed.lost, i))};
        if (!normals.recompute)
            normals.morphs = morphNormals(document, primitive,
                                          isIn(recomputed.morphs, i) ? MorphNormals::all : options.normals.morphs);
        const bool computes = decide(report, document, primitive, uses, options, normals);
        if (hasTriangles(primitive.mode)) {
            const bool follows = computes && report.uv_set >= 0 && report.action != PrimitiveAction::kept;
            for (std::string& note : notesOf(uses, animated, options.tangents.texture_transform, follows))
                report.notes.push_back(std::move(note));
        }
        if (!computes && !normals.recompute && normals.morphs.empty()) continue;
        if (computes && primitive.find("TANGENT") && !hasUsableTangents(primitive))
            report.notes.emplace_back("its existing tangents were ignored, because it had no normals");

        const bool replaces = options.selection.existing == ExistingTangents::replace || normals.recompute;
        if (computes && replaces && report.action != PrimitiveAction::kept && hasUsableTangents(primitive)) {
            std::string note = noteOnAuthored(document, primitive, uses, report.uv_set >= 0);
            if (!note.empty()) report.notes.push_back(std::move(note));
        }

        UvMatrix matrix;
        if (computes && report.uv_set >= 0 && !uses.empty()) {
            matrix = uvMatrixOf(uses[0], options.tangents.texture_transform);
            plan.has_texture_transforms =
                plan.has_texture_transforms || !uvMatrixOf(uses[0], TextureTransform::apply).isIdentity();
        }
        const auto [pool_entry, is_new_pool] = pool_of.try_emplace(
            poolKey(primitive, report.uv_set, matrix, computes, normals.recompute), plan.pools.size());
        const std::size_t pool_number = pool_entry->second;
        if (is_new_pool) {
            PoolPlan& created = plan.pools.emplace_back();
            created.makes_tangents = computes;
            created.uses_uvs = computes && report.uv_set >= 0;
            created.uv_matrix = matrix;
            created.uv_set = created.uses_uvs ? static_cast<std::size_t>(report.uv_set) : 0;
            created.vertex_count = primitive.vertex_count;
            created.overwrites_normals = normals.recompute && primitive.find("NORMAL");
            created.has_normals = primitive.find("NORMAL") && !normals.recompute;
            created.morph_normals = std::move(normals.morphs);
            created.has_tangents = hasUsableTangents(primitive);
            created.keeps_tangents = computes && report.action == PrimitiveAction::kept;
            created.tries_quads = computes && options.tangents.compute.method == Method::mikktspace &&
                                  options.tangents.faces != Faces::triangles;
            created.is_from_blender = is_from_blender;
        }
        PoolPlan& pool = plan.pools[pool_number];
        pool.primitives.push_back(i);
        report.split_list = static_cast<std::uint32_t>(pool.primitives.front());
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
