// SPDX-License-Identifier: MIT
// generateNormals: validates the input and selects the algorithm: flat or mean normals (core/normals), hard edges, and
// denoising. For another pose, points and components come from the mesh, and faces and weights from the pose.
#include "tspace/normals.h"

#include <cstdint>
#include <vector>

#include "core/base/border.h"
#include "core/base/near_positions.h"
#include "core/base/parallel.h"
#include "core/estimate/creases.h"
#include "core/estimate/denoise.h"
#include "core/estimate/pose_normals.h"
#include "core/normals/normals_call.h"

namespace tspace {
namespace {

/// Time of `best`, and of creases, relative to other weightings, approximately. Both take longer because they group the
/// faces around each point.
constexpr std::uint64_t kSlow = 4;

Error checkOptions(const MeshView& mesh, const NormalOptions& options) {
    if (static_cast<std::uint32_t>(options.weighting) > static_cast<std::uint32_t>(NormalWeighting::best))
        return {ErrorCode::invalidOption, "weighting is not a value of NormalWeighting"};
    if (!((options.crease_angle_deg >= 0 && options.crease_angle_deg <= 180) ||
          options.crease_angle_deg == NormalOptions::crease_auto)) {
        return {ErrorCode::invalidOption, "crease_angle_deg must be from 0 to 180, or crease_auto"};
    }
    if (options.refine > 2) return {ErrorCode::invalidOption, "refine must be 0, 1 or 2"};
    if (!((options.denoise >= 0 && options.denoise <= 4) || options.denoise == NormalOptions::denoise_auto))
        return {ErrorCode::invalidOption, "denoise must be from 0 to 4, or denoise_auto"};
    if (Error e = checkWeldDistance(options.weld_distance); e.code != ErrorCode::ok) return e;
    if (!options.smoothing_groups.empty()) {
        const StridedSpan<const std::uint32_t> groups = options.smoothing_groups;
        if (Error e = checkSpan(groups, mesh.faceCount(), "smoothing_groups"); e.code != ErrorCode::ok) return e;
    }
    return {ErrorCode::ok, {}};
}

/// Computes the weighting `flat`. Corners of degenerate faces get the mean of the other normals at their point; points
/// are searched only if there are degenerate faces.
NormalReport flatNormals(const MeshView& mesh, const MeshView& posed, const Call<NormalOptions>& options,
                         StridedSpan<Vec3> out, Parallel& parallel) {
    Call<NormalOptions> means = options;
    means.weighting = NormalWeighting::uniform;
    means.crease_angle_deg = 180;
    means.smoothing_groups = {};
    means.weld_positions = false;
    const NormalReport report = writeFaceNormals({mesh, posed, means, out, parallel});
    if (report.degenerate_face_count == 0) return report;
    means.weld_positions = options.weld_positions;
    const NormalsCall call(mesh, posed, means, out, parallel);
    averageNormals(call);
    return writeFaceNormals(call);
}

NormalReport smoothNormals(const MeshView& mesh, const MeshView& posed, const Call<NormalOptions>& options,
                           StridedSpan<Vec3> out, Parallel& parallel, const Creases& creases) {
    NormalsCall call(mesh, posed, options, out, parallel);
    if (!creases.edges.empty()) call.edges = creases.edges.data();
    NormalReport report = call.is_best && options.denoise != 0 ? denoisedNormals(call) : averageNormals(call);
    report.crease_angle_deg = options.crease_angle_deg;
    return report;
}

NormalReport generateChecked(const MeshView& mesh, const MeshView& posed, const Call<NormalOptions>& options,
                             StridedSpan<Vec3> out, Parallel& parallel) {
    if (options.weighting == NormalWeighting::flat) return flatNormals(mesh, posed, options, out, parallel);
    if (options.crease_angle_deg != NormalOptions::crease_auto)
        return smoothNormals(mesh, posed, options, out, parallel, {});
    Call<NormalOptions> found = options;
    const Creases creases = findCreases(mesh, options, options.execution, parallel);
    found.crease_angle_deg = creases.are_all_soft ? 180 : creases.angle_deg;
    NormalReport report = smoothNormals(mesh, posed, found, out, parallel, creases);
    report.crease_angle_deg = creases.angle_deg;
    return report;
}

Result<NormalReport> checkAndGenerate(const MeshView& mesh, const MeshView& posed, const Call<NormalOptions>& options,
                                      StridedSpan<Vec3> out) {
    const bool is_slow = options.weighting == NormalWeighting::best || options.crease_angle_deg < 180;
    Parallel parallel(options.execution, (is_slow ? kSlow : 1) * mesh.cornerCount());
    if (Error e = checkMesh(mesh, &parallel); e.code != ErrorCode::ok) return e;
    if (Error e = checkSpan(posed.positions, mesh.vertexCount(), "positions"); e.code != ErrorCode::ok) return e;
    if (Error e = checkOptions(mesh, options); e.code != ErrorCode::ok) return e;
    if (Error e = checkSpan(out, mesh.cornerCount(), "out"); e.code != ErrorCode::ok) return e;
    const float distance = options.weld_positions ? options.weld_distance : 0;
    const NearMesh near(mesh, distance, options.execution.allocator, parallel);
    if (near.near().empty()) return generateChecked(mesh, posed, options, out, parallel);
    if (posed.positions.data == mesh.positions.data)
        return generateChecked(near.view(), near.view(), options, out, parallel);
    const Buffer<Vec3> positions = near.near().moved(posed.positions);
    MeshView near_pose = posed;
    near_pose.positions = {positions.data(), positions.size()};
    return generateChecked(near.view(), near_pose, options, out, parallel);
}

}  // namespace

Result<PositionNoise> measurePositionNoise(const MeshView& mesh, const Execution& execution) {
    return atBorder([&]() -> Result<PositionNoise> {
        Parallel parallel(execution, kSlow * mesh.cornerCount());
        if (Error e = checkMesh(mesh, &parallel); e.code != ErrorCode::ok) return e;
        return withoutGrowth(noiseOf(mesh, execution, parallel, -1));
    });
}

Result<PositionNoise> measureSureNoise(const MeshView& mesh, double least, const Execution& execution) {
    return atBorder([&]() -> Result<PositionNoise> {
        Parallel parallel(execution, kSlow * mesh.cornerCount());
        if (Error e = checkMesh(mesh, &parallel); e.code != ErrorCode::ok) return e;
        if (PointItems::areTriangles(mesh) && !mayHaveNoise(mesh, least, execution, parallel)) return PositionNoise{};
        return withoutGrowth(noiseOf(mesh, execution, parallel, kFewKinks));
    });
}

Result<NormalReport> generateNormals(const MeshView& mesh, const NormalOptions& options, StridedSpan<Vec3> out,
                                     const Execution& execution) {
    return atBorder([&] { return checkAndGenerate(mesh, mesh, {options, execution}, out); });
}

Result<NormalReport> generatePoseNormals(const MeshView& mesh, const StridedSpan<const Vec3>& positions,
                                         const NormalOptions& options, StridedSpan<Vec3> out,
                                         const Execution& execution) {
    return atBorder([&] {
        MeshView posed = mesh;
        posed.positions = positions;
        return checkAndGenerate(mesh, posed, {options, execution}, out);
    });
}

Result<std::vector<std::uint32_t>> findSharedNormals(const MeshView& given, const NormalOptions& options,
                                                     const Execution& execution) {
    Parallel parallel(execution, kSlow * given.cornerCount());
    if (Error e = checkMesh(given, &parallel); e.code != ErrorCode::ok) return e;
    if (Error e = checkOptions(given, options); e.code != ErrorCode::ok) return e;
    if (!PointItems::areTriangles(given))
        return Error{ErrorCode::invalidOption, "shared normals need a triangle mesh; triangulate the mesh first"};
    std::vector<std::uint32_t> shared(given.cornerCount());
    for (std::uint32_t c = 0; c < shared.size(); ++c) shared[c] = c;
    if (options.weighting == NormalWeighting::flat || shared.empty()) return shared;
    const NearMesh near(given, options.weld_positions ? options.weld_distance : 0, execution.allocator, parallel);
    const MeshView& mesh = near.near().empty() ? given : near.view();
    Call<NormalOptions> used{options, execution};
    Creases creases;
    if (options.crease_angle_deg == NormalOptions::crease_auto) {
        creases = findCreases(mesh, options, execution, parallel);
        used.crease_angle_deg = creases.are_all_soft ? 180 : creases.angle_deg;
    }
    Buffer<Vec3> unused(execution.allocator, mesh.cornerCount());
    NormalsCall call(mesh, mesh, used, {unused.data(), unused.size()}, parallel);
    if (!creases.edges.empty()) call.edges = creases.edges.data();
    call.shared = shared.data();
    smoothFaces(call);
    for (std::uint32_t c = 0; c < shared.size(); ++c) {
        if (call.items.pointOf(call.faces.previous(c)) == call.items.pointOf(c)) shared[c] |= kNoSharedNormal;
    }
    return shared;
}

}  // namespace tspace
