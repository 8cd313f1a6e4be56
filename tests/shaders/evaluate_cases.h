// SPDX-License-Identifier: MIT
// Poses for shaders/tspace_evaluate.*, and the differences between their results and those of the library.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "support/simple_mesh.h"
#include "tspace/plan_buffers.h"

namespace tspace::shaders {

/// The six buffers of a dispatch, in the order of their bindings.
struct EvaluateBuffers {
    enum Binding : std::size_t { plan, settings, positions, deform, normals, tangents, count };
    std::array<std::vector<std::uint32_t>, count> arrays;
    std::size_t result_count = 0;
};

/// Runs the shader; returns an empty string, or what failed.
using Evaluate = std::function<std::string(EvaluateBuffers&)>;

/// Positions of words in the settings.
enum Setting : std::size_t {
    position_format,
    position_offset,
    position_stride,
    position_scale,
    normal_format = 6,
    normal_offset,
    normal_stride,
    tangent_format,
    tangent_offset,
    tangent_stride,
    morph_count,
    morph_weights,
    morph_deltas,
    vertex_count,
    skin,
    skin_joints,
    skin_weights,
    skin_matrices,
    first_result,
    setting_count = 32
};

/// A mesh with the positions of other poses.
struct PosedMesh {
    std::string name;
    test::SimpleMesh mesh;  ///< with normals and UVs
    float angular_threshold_deg = 180;
    std::vector<std::vector<Vec3>> poses;
    bool collapses = false;  ///< has triangles without area
};

/// Returns the mesh in its own pose and in one that changes the shape of all triangles.
PosedMesh withBentPose(std::string name, test::SimpleMesh mesh, float threshold_deg = 180);
/// Returns regular and degenerate meshes, some with NaN and huge values.
std::vector<PosedMesh> generatedMeshes();
/// Returns the meshes of the shared test data, in their own pose and a bent one; empty if the data is absent.
std::vector<PosedMesh> sharedMeshes();

/// Differences of many poses. Results that are not finite in the library are ignored.
struct Differences {
    std::size_t count = 0, wrong_signs = 0, not_finite = 0, not_zero = 0;
    std::size_t unstable =
        0;  ///< skipped, because changing each coordinate by its last bit rotates the library's result by kUnstable
    static constexpr double kUnstable = 0.0002;  ///< degrees
    std::string failure;                         ///< failure of the shader, or of the library
    std::string where;                           ///< location of the largest difference
    float worst_deg = 0;
    std::vector<float> degrees;

    /// `nearby`: results of the library for poses with different last bits.
    void add(const Vec4& expected, std::span<const Vec4> nearby, const Vec4& found, const std::string& place);
    /// Returns the difference that the given share of all results does not exceed.
    [[nodiscard]] float percentile(double share);
    [[nodiscard]] std::string text();
};

struct EvaluateOptions {
    Method method = Method::mikktspace;
    bool makes_normals = false;  ///< with the vertices of makeIndexedFrames; for triangle meshes
    NormalWeighting weighting = NormalWeighting::angle;
    float crease_angle_deg = 180;
};

/// Differences of tangents, and of normals if the plan computes them, over all poses. `spoil`: changes the buffers
/// before they are used.
struct Outcome {
    Differences tangents, normals;
    std::size_t plan_words = 0, triangles = 0;
};
Outcome evaluateAll(const std::vector<PosedMesh>& meshes, const EvaluateOptions& options, const Evaluate& evaluate,
                    const std::function<void(EvaluateBuffers&)>& spoil = {});

/// Returns the settings for contiguous float positions, normals and tangents.
std::vector<std::uint32_t> plainSettings(bool writes_normals);

}  // namespace tspace::shaders
