// SPDX-License-Identifier: MIT
// Mesh by mesh: all of its triangles are read, but only what is near a border is kept.
#include "model/gltf/plan_surroundings.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "core/mesh/pools/local_mesh.h"
#include "core/mesh/surface/surface.h"
#include "model/io/file_error.h"

namespace tspace::gltf {

namespace {

/// What reading and joining take for a while, about.
constexpr std::uint64_t kBytesPerVertex = 48, kBytesPerCorner = 40;

/// A vertex around a geometry: whose it is, and which.
struct NearVertex {
    std::uint32_t piece = 0, vertex = 0;

    friend auto operator<=>(const NearVertex&, const NearVertex&) = default;
};

/// The primitives of one mesh that have triangles.
class MeshPieces {
  public:
    MeshPieces(Model& model, std::vector<std::size_t> numbers)
        : document_(model.document()),
          arrays_(model.arrays()),
          primitives_(model.primitives()),
          numbers_(std::move(numbers)) {
        std::map<std::size_t, std::size_t> list_of;  // POSITION -> number of its vertex list
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
        joined_ = std::make_unique<JoinedPieces>(vertex_spans_, pieces_);
    }

    /// Null where no other is one surface with it. `makes_normals`: per primitive of the document.
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
                result->indices.push_back(entry->second);
            }
        }
        for (const NearVertex& source : sources)
            result->positions.push_back(vertices_[lists_[source.piece]][source.vertex]);
        takeNormals(sources, makes_normals, *result);
        // Both directions of the budget's books: what stays is small beside the mesh.
        document_.memory->take(64 * sources.size() + 12 * triangles.size(), primitives_[numbers_[piece]].place());
        result->read = offsetsOf(std::move(sources));
        return result;
    }

    [[nodiscard]] std::size_t othersOf(std::uint32_t piece) const { return joined_->othersOf(piece); }
    /// Whether another one of its surface keeps its normals.
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
                     Surroundings& result) const {
        std::map<std::uint32_t, SharedArray<Vec3>> normals;  // of pieces that keep theirs
        for (std::size_t i = 0; i < sources.size(); ++i) {
            const auto [piece, vertex] = sources[i];
            if (!keeps(piece, makes_normals)) continue;
            const auto [entry, is_new] = normals.try_emplace(piece);
            if (is_new) entry->second = arrays_.borrowVec3(primitives_[numbers_[piece]], "NORMAL");
            result.normals.resize(sources.size());
            result.normals[i] = entry->second[vertex];
        }
    }

    /// What targets add to these vertices. The result does not need this.
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
    std::vector<std::size_t> numbers_;  ///< of the primitives
    std::vector<SharedArray<Vec3>> vertices_ = {};
    std::vector<std::span<const Vec3>> vertex_spans_ = {};
    std::vector<std::size_t> lists_ = {};  ///< per piece
    std::vector<SharedArray<std::uint32_t>> corners_ = {};
    std::vector<SurfacePiece> pieces_ = {};
    std::unique_ptr<JoinedPieces> joined_;
};

std::string noteOf(std::size_t others, std::uint64_t points, bool any_keeps) {
    std::string note = "its normals are smooth over the border to " + std::to_string(others) +
                       (others == 1 ? " other primitive" : " other primitives") + " of the mesh, at " +
                       std::to_string(points) + (points == 1 ? " position" : " positions") +
                       " (--normals-per-primitive makes each alone)";
    if (any_keeps) note += "; where another one has normals these stay, and are taken on at the border if they fit";
    return note;
}

/// How far a normal looks. A step of `best` looks one triangle further, and what removes noise through three rings, over
/// which it averages eight times what it found; so far away it does not count any more.
unsigned ringsAround(const NormalOptions& options) {
    if (options.weighting != NormalWeighting::best) return 1;
    return options.refine + (options.denoise == 0 ? 1 : 8);
}

}  // namespace

void planSurroundings(Model& model, const GenerateOptions& options, GeneratePlan& plan) {
    if (options.normals_per_primitive || options.normals.weighting == NormalWeighting::flat) return;
    const std::span<const Primitive> primitives = model.primitives();
    std::vector<bool> makes_normals(primitives.size(), false);
    std::map<std::size_t, PoolGeometry*> geometry_of;  // first primitive -> its geometry
    for (Pool& pool : plan.pools) {
        if (pool.has_normals) continue;
        for (const std::size_t number : pool.primitives) makes_normals[number] = true;
        for (PoolGeometry& geometry : pool.geometries) geometry_of.emplace(geometry.primitives[0], &geometry);
    }
    const unsigned rings = ringsAround(options.normals);
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
        const MeshPieces pieces(model, numbers);
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
}

}  // namespace tspace::gltf
