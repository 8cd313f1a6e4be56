// SPDX-License-Identifier: MIT
// Creates meshes of single primitives, which copy the parts of the pool that they use. To compute normals, a mesh and
// the triangles around it become one mesh for the duration of the call.
#include "core/mesh/pools/local_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/near_positions.h"
#include "core/base/parallel.h"
#include "core/base/unique_index.h"
#include "core/base/vec_math.h"
#include "core/estimate/pose_normals.h"
#include "core/mesh/surface/surface.h"
#include "tspace/indexed_frames.h"

namespace tspace {
namespace {

constexpr std::uint32_t kNoSlot = 0xffffffffu;

}  // namespace

MeshView viewInPool(const PoolView& pool, const PrimitiveGeometry& primitive) {
    MeshView mesh;
    mesh.positions = pool.positions;
    mesh.normals = pool.normals;
    mesh.uvs = pool.uvs;
    mesh.indices = IndexView(spanOf(primitive.indices));
    mesh.face_sizes = primitive.face_sizes;
    return mesh;
}

void replaceFaces(QuadFaces&& faces, LocalMesh& mesh) {
    mesh.own.indices = gather(mesh.indices, faces.corners);
    mesh.useOwnIndices();
    mesh.own.face_sizes = std::move(faces.sizes);
    mesh.face_sizes = mesh.own.face_sizes;
    mesh.face_corners = std::move(faces.face_corners);
}

LocalMesh LocalMeshes::make(const PrimitiveGeometry& primitive) {
    LocalMesh mesh;
    mesh.face_sizes = primitive.face_sizes;
    if (primitive_count_ > 1 || pool_.positions.count > primitive.indices.size()) {
        copyUsedPart(primitive, mesh);
        return mesh;
    }
    mesh.positions = pool_.positions;
    mesh.normals = pool_.normals;
    mesh.uvs = pool_.uvs;
    mesh.indices = primitive.indices;
    return mesh;
}

/// Copies the used part of the pool, with vertices in order of first use.
void LocalMeshes::copyUsedPart(const PrimitiveGeometry& primitive, LocalMesh& mesh) {
    local_of_vertex_.resize(pool_.positions.count, kNoSlot);
    std::vector<std::uint32_t>& sources = mesh.sources;
    mesh.own.indices.reserve(primitive.indices.size());
    for (const std::uint32_t vertex : primitive.indices) {
        std::uint32_t& local = local_of_vertex_[vertex];
        if (local == kNoSlot) {
            local = static_cast<std::uint32_t>(sources.size());
            sources.push_back(vertex);
        }
        mesh.own.indices.push_back(local);
    }
    for (const std::uint32_t vertex : sources) local_of_vertex_[vertex] = kNoSlot;
    mesh.own.positions = gather(pool_.positions, sources);
    mesh.own.normals = gather(pool_.normals, sources);
    mesh.own.uvs = gather(pool_.uvs, sources);
    mesh.useOwnIndices();
    mesh.useOwnVertices();
}

std::vector<Vec3> gatherNormals(const std::vector<Vec3>& normals, const std::vector<std::uint32_t>& corners) {
    std::vector<Vec3> result;
    result.reserve(corners.size());
    for (const std::uint32_t corner : corners) result.push_back(corner == kNoCorner ? Vec3{0, 0, 1} : normals[corner]);
    return result;
}

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
/// Maximum angle, in degrees, between a computed normal and a stored normal at the same position that replaces it. If
/// the stored normal was computed without the faces across the border, the two differ by half of the bend at the
/// border; a stored normal that differs by more is an intended hard edge.
constexpr double kMostAdoptedDeg = 30;

}  // namespace

BorderedNormals::BorderedNormals(const LocalMesh& mesh, const Surroundings* around, const NormalOptions& options,
                                 const Execution& execution)
    : mesh_(mesh), around_(around), options_(options), execution_(execution) {
    if (around_ == nullptr) return;
    const OwnedMesh& others = around->mesh;
    whole_.positions.reserve(mesh.positions.count + others.positions.size());
    for (std::size_t v = 0; v < mesh.positions.count; ++v) whole_.positions.push_back(mesh.positions[v]);
    whole_.positions.insert(whole_.positions.end(), others.positions.begin(), others.positions.end());
    const auto first = static_cast<std::uint32_t>(mesh.positions.count);
    first_corner_ = 3 * around->triangles_before;
    std::vector<std::uint32_t>& indices = whole_.indices;
    indices.reserve(mesh.indices.size() + others.indices.size());
    for (std::size_t c = 0; c < first_corner_; ++c) indices.push_back(first + others.indices[c]);
    indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
    for (std::size_t c = first_corner_; c < others.indices.size(); ++c) indices.push_back(first + others.indices[c]);
}

Result<NormalReport> BorderedNormals::base(StridedSpan<Vec3> out) {
    if (around_ == nullptr) return generateNormals(mesh_.view(), options_, out, execution_);
    // Counts the degenerate faces of the surroundings, which the report must exclude.
    const MeshView others = around_->mesh.view();
    std::vector<Vec3> normals(others.cornerCount());
    NormalOptions flat = options_;
    flat.weighting = NormalWeighting::flat;
    const Result<NormalReport> counted = generateNormals(others, flat, normals, execution_);
    if (!counted) return counted;
    degenerate_around_ = counted->degenerate_face_count;

    normals.resize(whole_.indices.size());
    const Result<NormalReport> made = generateNormals(whole_.view(), options_, normals, execution_);
    if (!made) return made;
    choose(std::span<const Vec3>(normals).subspan(first_corner_, mesh_.indices.size()));
    const NormalReport report = take(*made, normals, out);
    for (std::size_t c = 0; c < stays_.size(); ++c) {
        if (stays_[c] == kNone) continue;
        DVec3 normal = toDouble(around_->mesh.normals[stays_[c]]);
        normalize(normal);
        out[c] = toFloat(normal);
    }
    return report;
}

Result<NormalReport> BorderedNormals::pose(const StridedSpan<const Vec3>& positions, std::size_t target,
                                           StridedSpan<Vec3> out) {
    if (around_ == nullptr) return generatePoseNormals(mesh_.view(), positions, options_, out, execution_);
    MorphOffsets offsets;
    if (around_->read) {
        Result<MorphOffsets> read = around_->read(target);
        if (!read) return std::move(read).error();
        offsets = *std::move(read);
    }
    std::vector<Vec3> moved = whole_.positions;
    const std::size_t own = mesh_.positions.count;
    for (std::size_t v = 0; v < own; ++v) moved[v] = positions[v];
    for (std::size_t v = 0; v < offsets.positions.size(); ++v) moved[own + v] = moved[own + v] + offsets.positions[v];
    std::vector<Vec3> normals(whole_.indices.size());
    const Result<NormalReport> made = generatePoseNormals(
        whole_.view(), StridedSpan<const Vec3>(std::span<const Vec3>(moved)), options_, normals, execution_);
    if (!made) return made;
    const NormalReport report = take(*made, normals, out);
    for (std::size_t c = 0; c < stays_.size(); ++c) {
        if (stays_[c] == kNone) continue;
        const Vec3& stayed = around_->mesh.normals[stays_[c]];
        DVec3 normal = toDouble(offsets.normals.empty() ? stayed : stayed + offsets.normals[stays_[c]]);
        if (normalize(normal)) out[c] = toFloat(normal);
    }
    return report;
}

/// Chooses the corners that use existing normals of surrounding vertices.
void BorderedNormals::choose(std::span<const Vec3> normals) {
    if (around_->mesh.normals.empty()) return;
    Parallel parallel(execution_, whole_.indices.size());
    const MeshView whole = whole_.view();
    const float distance = options_.weld_positions ? options_.weld_distance : 0;
    const NearMesh near(whole, distance, execution_.allocator, parallel);
    const StridedSpan<const Vec3>& positions = near.view().positions;
    UniqueIndex<std::array<std::uint32_t, 3>> places;
    std::vector<std::vector<std::uint32_t>> at;
    for (std::uint32_t v = 0; v < around_->mesh.normals.size(); ++v) {
        if (!isDirection(around_->mesh.normals[v])) continue;
        const std::uint32_t place = places.indexOf(positionKey(positions[mesh_.positions.count + v]));
        if (place == at.size()) at.emplace_back();
        at[place].push_back(v);
    }
    const bool has_angle = options_.crease_angle_deg != NormalOptions::crease_auto;
    const double most = has_angle ? std::min(kMostAdoptedDeg, double{options_.crease_angle_deg}) : kMostAdoptedDeg;
    stays_.assign(normals.size(), kNone);
    for (std::size_t c = 0; c < normals.size(); ++c) {
        const std::uint32_t place = places.find(positionKey(positions[mesh_.indices[c]]));
        if (place == kNone) continue;
        double least = most;
        for (const std::uint32_t v : at[place]) {
            DVec3 stayed = toDouble(around_->mesh.normals[v]);
            normalize(stayed);
            const double apart = angleBetween(stayed, toDouble(normals[c])) * 180 / kPi;
            if (apart > least) continue;
            least = apart;
            stays_[c] = v;
        }
    }
}

NormalReport BorderedNormals::take(const NormalReport& of_whole, std::span<const Vec3> normals,
                                   StridedSpan<Vec3> out) const {
    for (std::size_t c = 0; c < mesh_.indices.size(); ++c) out[c] = normals[first_corner_ + c];
    NormalReport report;
    report.face_count = mesh_.indices.size() / 3;
    report.degenerate_face_count = of_whole.degenerate_face_count - degenerate_around_;
    report.fallback_corner_count = std::min<std::uint64_t>(of_whole.fallback_corner_count, mesh_.indices.size());
    report.noise = of_whole.noise;
    report.crease_angle_deg = of_whole.crease_angle_deg;
    return report;
}

}  // namespace tspace
