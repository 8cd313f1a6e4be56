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
#include "core/mesh/pools/local_mesh.h"
#include "core/mesh/surface/surface.h"
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

bool hasSurface(const Primitive& primitive) {
    return hasTriangles(primitive.mode) && primitive.find("POSITION") && primitive.triangleCount() != 0;
}

/// Returns whether the primitive's normals are recomputed. Then its tangents are recomputed too, because they would not
/// fit the new normals.
bool regeneratesNormals(PrimitiveReport& report, const Document& document, const Primitive& primitive,
                        const std::vector<TangentUse>& uses, const GenerateOptions& options, bool is_requested) {
    if (!options.normals.overwrite && !is_requested) return false;
    if (!hasSurface(primitive) || surfaceKind(document, primitive).is_unlit) return false;
    if (!packedAlone(document, primitive).empty()) return false;
    const bool can_follow = options.tangents.compute.method == Method::basis || primitive.find(uvsOf(uses));
    if (!primitive.find("TANGENT") || shouldStripTangents(primitive, uses, options) || can_follow) return true;
    report.notes.push_back(
        "its normals were kept: its tangents would not fit new ones and cannot be recomputed, because it has no " +
        uvsOf(uses));
    return false;
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
    if (which == MorphNormals::keep || !hasSurface(primitive) || !primitive.find("NORMAL")) return targets;
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
        why += "; its tangents were kept, because a morph target stores only tangent deltas";
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
    return "tangents that may have been authored (" + reader + ") were recomputed" + (along_u ? " along u" : "");
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
        NormalsPlan normals{
            .recompute = regeneratesNormals(report, document, primitive, uses, options, isIn(recomputed.base, i))};
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

// Processing of meshes one by one: all triangles of a mesh are read, but only those near a border are kept.

namespace {

/// Approximate temporary memory for reading and joining.
constexpr std::uint64_t kBytesPerVertex = 48, kBytesPerCorner = 40;

/// A vertex near a geometry: its piece, and its index in that piece.
struct NearVertex {
    std::uint32_t piece = 0, vertex = 0;

    friend auto operator<=>(const NearVertex&, const NearVertex&) = default;
};

/// The primitives of one mesh that have triangles.
class MeshPieces {
  public:
    MeshPieces(Model& model, std::vector<std::size_t> numbers, float weld_distance)
        : document_(model.document()),
          arrays_(model.arrays()),
          primitives_(model.primitives()),
          numbers_(std::move(numbers)) {
        std::map<std::size_t, std::size_t> list_of;  // POSITION -> index of its vertex list
        for (const std::size_t number : numbers_) {
            const Primitive& primitive = primitives_[number];
            document_.memory->require(
                kBytesPerVertex * primitive.vertex_count + kBytesPerCorner * 3 * primitive.triangleCount(),
                primitive.place());
            const auto [entry, is_new] = list_of.try_emplace(*primitive.find("POSITION"), vertices_.size());
            if (is_new) vertices_.push_back(arrays_.borrowVec3(primitive, "POSITION"));
            lists_.push_back(entry->second);
            corners_.push_back(arrays_.borrowCorners(primitive));
        }
        for (const SharedArray<Vec3>& list : vertices_) vertex_spans_.push_back(list.span());
        for (std::size_t i = 0; i < numbers_.size(); ++i) pieces_.push_back({lists_[i], corners_[i].span()});
        joined_ = std::make_unique<JoinedPieces>(vertex_spans_, pieces_, weld_distance);
    }

    /// Returns the triangles around a piece, or null if no other piece forms one surface with it. `makes_normals`: for
    /// each primitive of the document, whether its normals are computed.
    [[nodiscard]] std::shared_ptr<const Surroundings> around(std::uint32_t piece, unsigned rings,
                                                             const std::vector<bool>& makes_normals) const {
        const std::vector<PieceTriangle> triangles = joined_->around(piece, rings);
        if (triangles.empty()) return nullptr;
        auto result = std::make_shared<Surroundings>();
        result->point_count = joined_->sharedPoints(piece).size();
        std::map<NearVertex, std::uint32_t> number_of;
        std::vector<NearVertex> sources;
        for (const PieceTriangle& at : triangles) {
            result->triangles_before += at.piece < piece;
            for (std::size_t k = 0; k < 3; ++k) {
                const NearVertex source{at.piece, corners_[at.piece][3 * std::size_t{at.triangle} + k]};
                const auto [entry, is_new] = number_of.try_emplace(source, static_cast<std::uint32_t>(sources.size()));
                if (is_new) sources.push_back(source);
                result->mesh.indices.push_back(entry->second);
            }
        }
        for (const NearVertex& source : sources)
            result->mesh.positions.push_back(vertices_[lists_[source.piece]][source.vertex]);
        takeNormals(sources, makes_normals, result->mesh.normals);
        // The surroundings stay in memory until normals are computed; they are small compared with the mesh.
        document_.memory->take(64 * sources.size() + 12 * triangles.size(), primitives_[numbers_[piece]].place());
        result->read = offsetsOf(std::move(sources));
        return result;
    }

    [[nodiscard]] std::size_t othersOf(std::uint32_t piece) const { return joined_->othersOf(piece); }
    struct OtherMesh {
        std::size_t primitive = 0;  ///< index of the other mesh's first primitive at the border
        std::set<std::uint32_t> points = {};
    };
    /// Returns the other meshes that form one surface with a piece, and the shared points; key: piece and mesh.
    [[nodiscard]] std::map<std::pair<std::uint32_t, std::uint32_t>, OtherMesh> otherMeshes() const {
        std::map<std::pair<std::uint32_t, std::uint32_t>, OtherMesh> others;
        for (const JoinedPieces::Border& border : joined_->borders()) {
            for (const std::size_t side : {0, 1}) {
                const std::uint32_t piece = border.triangles[side].piece;
                const std::size_t number = numbers_[border.triangles[1 - side].piece];
                if (primitives_[number].mesh == primitives_[numbers_[piece]].mesh) continue;
                OtherMesh& other =
                    others.try_emplace({piece, primitives_[number].mesh}, OtherMesh{number, {}}).first->second;
                other.points.insert(border.points.begin(), border.points.end());
            }
        }
        return others;
    }
    /// Returns whether any other piece of the same surface keeps its normals.
    [[nodiscard]] bool anyKeeps(std::uint32_t piece, const std::vector<bool>& makes_normals) const {
        for (std::uint32_t other = 0; other < numbers_.size(); ++other) {
            if (other != piece && joined_->areJoined(piece, other) && keeps(other, makes_normals)) return true;
        }
        return false;
    }

  private:
    [[nodiscard]] bool keeps(std::uint32_t piece, const std::vector<bool>& makes_normals) const {
        return !makes_normals[numbers_[piece]] && primitives_[numbers_[piece]].find("NORMAL");
    }

    void takeNormals(const std::vector<NearVertex>& sources, const std::vector<bool>& makes_normals,
                     std::vector<Vec3>& result) const {
        std::map<std::uint32_t, SharedArray<Vec3>> normals;  // normals of pieces that keep them
        for (std::size_t i = 0; i < sources.size(); ++i) {
            const auto [piece, vertex] = sources[i];
            if (!keeps(piece, makes_normals)) continue;
            const auto [entry, is_new] = normals.try_emplace(piece);
            if (is_new) entry->second = arrays_.borrowVec3(primitives_[numbers_[piece]], "NORMAL");
            result.resize(sources.size());
            result[i] = entry->second[vertex];
        }
    }

    /// Returns a function that reads the morph offsets at these vertices. The function may outlive this object.
    [[nodiscard]] std::function<Result<MorphOffsets>(std::size_t)> offsetsOf(std::vector<NearVertex> sources) const {
        std::vector<const Primitive*> of_pieces;
        bool any = false;
        for (const std::size_t number : numbers_) {
            of_pieces.push_back(&primitives_[number]);
            any = any || !primitives_[number].targets.empty();
        }
        if (!any) return {};
        return [&document = document_, of_pieces = std::move(of_pieces),
                sources = std::move(sources)](std::size_t target) -> Result<MorphOffsets> {
            return atFileBorder([&]() -> Result<MorphOffsets> {
                MorphOffsets all{.positions = std::vector<Vec3>(sources.size()),
                                 .normals = std::vector<Vec3>(sources.size())};
                std::map<std::uint32_t, MorphOffsets> of_piece;
                for (std::size_t i = 0; i < sources.size(); ++i) {
                    const Primitive& primitive = *of_pieces[sources[i].piece];
                    if (target >= primitive.targets.size()) continue;
                    const auto [entry, is_new] = of_piece.try_emplace(sources[i].piece);
                    if (is_new) {
                        entry->second.positions = readOffsets(document, primitive, target, "POSITION");
                        entry->second.normals = readOffsets(document, primitive, target, "NORMAL");
                    }
                    const auto at = [&](const std::vector<Vec3>& list) {
                        return sources[i].vertex < list.size() ? list[sources[i].vertex] : Vec3{};
                    };
                    all.positions[i] = at(entry->second.positions);
                    all.normals[i] = at(entry->second.normals);
                }
                return all;
            });
        };
    }

    const Document& document_;
    DecodedArrays& arrays_;
    std::span<const Primitive> primitives_;
    std::vector<std::size_t> numbers_;  ///< indices of the primitives
    std::vector<SharedArray<Vec3>> vertices_ = {};
    std::vector<std::span<const Vec3>> vertex_spans_ = {};
    std::vector<std::size_t> lists_ = {};  ///< vertex list of each piece
    std::vector<SharedArray<std::uint32_t>> corners_ = {};
    std::vector<SurfacePiece> pieces_ = {};
    std::unique_ptr<JoinedPieces> joined_;
};

std::string noteOf(std::size_t others, std::uint64_t points, bool any_keeps) {
    std::string note = "its normals are smooth across the border to " + std::to_string(others) +
                       (others == 1 ? " other primitive" : " other primitives") + " of the mesh, at " +
                       std::to_string(points) + (points == 1 ? " position" : " positions") +
                       " (--normals-per-primitive disables that)";
    if (any_keeps) note += "; existing normals on the other side were kept, and used at the border if they fit";
    return note;
}

std::string noteOf(const Primitive& other, std::size_t points) {
    const std::string name = other.mesh_name.empty() ? "" : " \"" + other.mesh_name + "\"";
    return "it forms one surface with mesh " + std::to_string(other.mesh) + name + " (" + std::to_string(points) +
           " shared border positions), but normals are only smoothed within each mesh; join the meshes if no edge is "
           "intended";
}

/// Groups primitives with triangles by their world transform. A primitive with several placements is only in the group
/// of the first.
std::vector<std::vector<std::size_t>> primitivesByPlace(const Document& document,
                                                        std::span<const Primitive> primitives) {
    std::vector<ScenePlacement> placements;
    if (tryFile([&] { placements = readPlacements(document, primitives); })) return {};
    std::map<std::array<double, 12>, std::vector<std::size_t>> at;
    std::vector<bool> is_known(primitives.size(), false);
    for (const ScenePlacement& placement : placements) {
        const Primitive& primitive = primitives[placement.primitive];
        if (is_known[placement.primitive] || !hasTriangles(primitive.mode) || !primitive.find("POSITION") ||
            primitive.triangleCount() == 0) {
            continue;
        }
        is_known[placement.primitive] = true;
        const auto& [x, y, z, o] = placement.to_world;
        at[{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z, o.x, o.y, o.z}].push_back(placement.primitive);
    }
    std::vector<std::vector<std::size_t>> groups;
    for (auto& [place, numbers] : at) {
        std::sort(numbers.begin(), numbers.end());
        groups.push_back(std::move(numbers));
    }
    return groups;
}

/// Adds notes to primitives with computed normals that form one surface with another mesh.
void noteOtherMeshes(Model& model, const GenerateOptions& options, const std::vector<bool>& makes_normals,
                     GeneratePlan& plan) {
    constexpr std::size_t kMaxNotes = 4;
    const std::span<const Primitive> primitives = model.primitives();
    if (std::find(makes_normals.begin(), makes_normals.end(), true) == makes_normals.end()) return;
    if (primitives.front().mesh == primitives.back().mesh) return;
    for (const std::vector<std::size_t>& numbers : primitivesByPlace(model.document(), primitives)) {
        std::uint64_t bytes = 0;
        bool any_made = false;
        for (const std::size_t number : numbers) {
            const Primitive& primitive = primitives[number];
            bytes += kBytesPerVertex * primitive.vertex_count + kBytesPerCorner * 3 * primitive.triangleCount();
            any_made = any_made || makes_normals[number];
        }
        if (!any_made || primitives[numbers.front()].mesh == primitives[numbers.back()].mesh) continue;
        if (!model.document().memory->has(bytes)) continue;
        const MeshPieces pieces(model, numbers, options.normals.compute.weld_distance);
        std::map<std::uint32_t, std::size_t> counts;
        for (const auto& [key, other] : pieces.otherMeshes()) {
            const std::size_t number = numbers[key.first];
            if (makes_normals[number] && ++counts[key.first] <= kMaxNotes)
                plan.reports[number].notes.push_back(noteOf(primitives[other.primitive], other.points.size()));
        }
    }
}

/// Returns the number of triangle rings that influence a normal: one, or eight with denoising (beyond which its weights
/// are negligible), plus one per refinement step of `best`.
unsigned ringsAround(const NormalOptions& options) {
    if (options.weighting != NormalWeighting::best) return 1;
    return options.refine + (options.denoise == 0 ? 1 : 8);
}

}  // namespace

void planSurroundings(Model& model, const GenerateOptions& options, GeneratePlan& plan) {
    if (options.normals.per_primitive || options.normals.compute.weighting == NormalWeighting::flat) return;
    const std::span<const Primitive> primitives = model.primitives();
    std::vector<bool> makes_normals(primitives.size(), false);
    std::map<std::size_t, GeometryPlan*> geometry_of;  // first primitive of a geometry -> geometry
    for (PoolPlan& pool : plan.pools) {
        if (pool.has_normals) continue;
        for (const std::size_t number : pool.primitives) makes_normals[number] = true;
        for (GeometryPlan& geometry : pool.geometries) geometry_of.emplace(geometry.primitives[0], &geometry);
    }
    const unsigned rings = ringsAround(options.normals.compute);
    for (std::size_t first = 0, past = 0; first < primitives.size(); first = past) {
        std::vector<std::size_t> numbers;
        bool any = false;
        for (; past < primitives.size() && primitives[past].mesh == primitives[first].mesh; ++past) {
            const Primitive& primitive = primitives[past];
            if (!hasTriangles(primitive.mode) || !primitive.find("POSITION") || primitive.triangleCount() == 0)
                continue;
            numbers.push_back(past);
            any = any || geometry_of.contains(past);
        }
        if (numbers.size() < 2 || !any) continue;
        const MeshPieces pieces(model, numbers, options.normals.compute.weld_distance);
        for (std::uint32_t piece = 0; piece < numbers.size(); ++piece) {
            const auto found = geometry_of.find(numbers[piece]);
            if (found == geometry_of.end()) continue;
            found->second->around = pieces.around(piece, rings, makes_normals);
            if (!found->second->around) continue;
            for (const std::size_t number : found->second->primitives) {
                const std::uint64_t points = found->second->around->point_count;
                plan.reports[number].normals_joined_count = points;
                plan.reports[number].notes.push_back(
                    noteOf(pieces.othersOf(piece), points, pieces.anyKeeps(piece, makes_normals)));
            }
        }
    }
    noteOtherMeshes(model, options, makes_normals, plan);
}

}  // namespace tspace::gltf
