// SPDX-License-Identifier: MIT
// Finds the adjacent triangles of other primitives that computed normals depend on, and other meshes of one surface.
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "commands/generate/generate_plan.h"
#include "core/mesh/pools/local_mesh.h"
#include "core/mesh/surface/surface.h"
#include "model/gltf/read_scene.h"
#include "model/io/file_error.h"

namespace tspace::gltf {

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
        : document_(model.document()), arrays_(model.arrays()), primitives_(model.primitives()),
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
