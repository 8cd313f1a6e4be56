// SPDX-License-Identifier: MIT
#include "commands/generate/generate_steps.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "model/io/file_error.h"

namespace tspace {
namespace {

/// The primitives of one mesh as one surface. Primitives that draw the same triangles of the same vertices are added
/// once.
class MeshSurface {
  public:
    explicit MeshSurface(gltf::Model& model) : model_(model) {}

    void add(std::size_t number, bool with_normals) {
        const gltf::Primitive& primitive = model_.primitives()[number];
        const auto positions = primitive.find("POSITION");
        if (!positions || !hasTriangles(primitive.mode)) return;
        const auto key = std::tuple(primitive.indices, *positions, primitive.mode, primitive.corner_count);
        const auto known = pieces_.find(key);
        if (known != pieces_.end()) return known->second.numbers.push_back(number);
        Piece piece{.first = indices_.size() / 3, .numbers = {number}};
        const std::uint32_t first_vertex = addVertices(primitive, *positions, with_normals);
        const SharedArray<std::uint32_t> corners = model_.arrays().borrowCorners(primitive);
        for (const std::uint32_t corner : corners) indices_.push_back(first_vertex + corner);
        piece.count = indices_.size() / 3 - piece.first;
        pieces_.emplace(key, std::move(piece));
    }

    void mend(const GenerateOptions& options, MendedWindingReport& report, WindingPlan& plan) {
        MeshView mesh;
        mesh.positions = positions_;
        if (has_normals_) mesh.normals = normals_;
        mesh.indices = std::span<const std::uint32_t>(indices_);
        std::vector<std::uint8_t> flipped(indices_.size() / 3);
        const WindingOptions how{.weld_distance = options.normals.compute.weld_distance};
        report.winding = valueOrThrow(mendWinding(mesh, how, flipped, options.execution));
        for (const auto& [key, piece] : pieces_) {
            const auto begin = flipped.begin() + static_cast<std::ptrdiff_t>(piece.first);
            const std::vector<std::uint8_t> own(begin, begin + static_cast<std::ptrdiff_t>(piece.count));
            if (std::find(own.begin(), own.end(), 1) == own.end()) continue;
            for (const std::size_t number : piece.numbers) plan.flipped[number] = own;
        }
    }
    [[nodiscard]] bool empty() const { return indices_.empty(); }

  private:
    struct Piece {
        std::size_t first = 0, count = 0;  ///< first triangle and number of triangles
        std::vector<std::size_t> numbers = {};
    };

    /// Adds the vertices of a list and returns their first index. A list is added once, because primitives often share
    /// it.
    std::uint32_t addVertices(const gltf::Primitive& primitive, std::size_t accessor, bool with_normals) {
        const auto normals = with_normals ? primitive.find("NORMAL") : std::nullopt;
        const auto [place, is_new] =
            first_vertices_.try_emplace({accessor, normals}, static_cast<std::uint32_t>(positions_.size()));
        if (!is_new) return place->second;
        const SharedArray<Vec3> points = model_.arrays().borrowVec3(primitive, "POSITION");
        positions_.insert(positions_.end(), points.begin(), points.end());
        if (normals) {
            const SharedArray<Vec3> directions = model_.arrays().borrowVec3(primitive, "NORMAL");
            normals_.insert(normals_.end(), directions.begin(), directions.end());
            has_normals_ = true;
        }
        normals_.resize(positions_.size());
        return place->second;
    }

    gltf::Model& model_;
    std::vector<Vec3> positions_ = {}, normals_ = {};
    std::vector<std::uint32_t> indices_ = {};
    bool has_normals_ = false;
    std::map<std::pair<std::size_t, std::optional<std::size_t>>, std::uint32_t> first_vertices_ = {};
    std::map<std::tuple<std::optional<std::size_t>, std::size_t, gltf::Mode, std::size_t>, Piece> pieces_ = {};
};

}  // namespace

bool WindingPlan::flipsAny() const {
    return std::any_of(flipped.begin(), flipped.end(), [](const auto& faces) { return !faces.empty(); });
}

WindingPlan planWinding(gltf::Model& model, const GenerateOptions& options, std::span<const std::uint32_t> kept) {
    WindingPlan plan;
    const std::vector<gltf::Primitive>& primitives = model.primitives();
    plan.flipped.resize(primitives.size());
    for (std::size_t i = 0, past = 0; i < primitives.size(); i = past) {
        std::uint64_t corners = 0, vertices = 0;
        for (past = i; past < primitives.size() && primitives[past].mesh == primitives[i].mesh; ++past) {
            corners += 3 * primitives[past].triangleCount();
            vertices += primitives[past].vertex_count;
        }
        if (std::find(kept.begin(), kept.end(), primitives[i].mesh) != kept.end()) continue;
        model.document().memory->require(48 * corners + 80 * vertices, primitives[i].place());
        MeshSurface surface(model);
        for (std::size_t number = i; number < past; ++number) surface.add(number, !options.normals.overwrite);
        if (surface.empty()) continue;
        MendedWindingReport& report = plan.reports.emplace_back();
        report.mesh = primitives[i].mesh;
        report.mesh_name = primitives[i].mesh_name;
        surface.mend(options, report, plan);
    }
    return plan;
}

void listFlipped(std::uint64_t face, PrimitiveReport& report) {
    ++report.winding_mended_count;
    std::vector<FaceRange>& ranges = report.winding_mended;
    if (!ranges.empty() && ranges.back().first + ranges.back().count == face)
        ++ranges.back().count;
    else if (ranges.size() < kMostMendedRanges)
        ranges.push_back({face, 1});
}

void countFlipped(const WindingPlan& plan, std::vector<PrimitiveReport>& primitives) {
    for (std::size_t i = 0; i < plan.flipped.size(); ++i) {
        for (std::size_t face = 0; face < plan.flipped[i].size(); ++face) {
            if (plan.flipped[i][face] != 0) listFlipped(face, primitives[i]);
        }
    }
}

std::vector<std::uint8_t> fixObjWinding(obj::Model& model, const GenerateOptions& options, GenerateReport& report) {
    std::vector<std::uint32_t> indices, normals, sizes;
    const auto no_normal = static_cast<std::uint32_t>(model.normals.size());
    std::vector<Vec3> directions = model.normals;
    directions.emplace_back();
    for (const obj::Face& face : model.faces) {
        sizes.push_back(face.corner_count);
        for (std::uint32_t c = 0; c < face.corner_count; ++c) {
            const obj::Corner& corner = model.corners[face.first_corner + c];
            indices.push_back(corner.position);
            normals.push_back(corner.normal == obj::kNone ? no_normal : corner.normal);
        }
    }
    MeshView mesh;
    mesh.positions = model.positions;
    mesh.normals = directions;
    mesh.indices = std::span<const std::uint32_t>(indices);
    mesh.normal_indices = std::span<const std::uint32_t>(normals);
    mesh.face_sizes = sizes;
    const WindingOptions how{.use_normals = !options.normals.overwrite,
                             .weld_distance = options.normals.compute.weld_distance};
    std::vector<std::uint8_t> flipped(model.faces.size());
    MendedWindingReport& mended = report.windings.emplace_back();
    mended.winding = valueOrThrow(mendWinding(mesh, how, flipped, options.execution));
    for (std::size_t f = 0; f < flipped.size(); ++f) {
        const auto begin = model.corners.begin() + model.faces[f].first_corner;
        // The first corner of the face remains the first.
        if (flipped[f] != 0) std::reverse(begin + 1, begin + model.faces[f].corner_count);
    }
    return flipped;
}

}  // namespace tspace
