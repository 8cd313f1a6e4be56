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

/// Runs the shader. Returns an empty string, or a description of what failed.
using Evaluate = std::function<std::string(EvaluateBuffers&)>;

/// Indices of the words of the settings.
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
    bool collapses = false;  ///< some triangles have no area
};

/// Returns the mesh with its own pose and another pose that changes the shape of all triangles.
PosedMesh withBentPose(std::string name, test::SimpleMesh mesh, float threshold_deg = 180);
/// Returns regular and degenerate meshes, some of which contain NaN and huge values.
std::vector<PosedMesh> generatedMeshes();
/// Returns the meshes of the shared test data with their own pose and a bent one. Returns none if the data is absent.
std::vector<PosedMesh> sharedMeshes();

/// Differences over many poses. Results that are not finite in the library are ignored.
struct Differences {
    std::size_t count = 0, wrong_signs = 0, not_finite = 0, not_zero = 0;
    /// Only their signs are compared, because changing each coordinate by its last bit rotates the library's result by
    /// kUnstable.
    std::size_t unstable = 0;
    std::size_t huge = 0;  ///< only required to be finite, because intermediate results exceed the range of floats
    static constexpr double kUnstable = 0.0002;  ///< degrees
    std::string failure;                         ///< failure of the shader, or of the library
    std::string where;                           ///< location of the largest difference
    float worst_deg = 0;
    std::vector<float> degrees;

    /// Adds the difference between a result and the expected one. `nearby`: the library's results for poses with other
    /// last bits.
    void add(const Vec4& expected, std::span<const Vec4> nearby, const Vec4& found, const std::string& place,
             bool is_huge = false);
    /// Returns the difference that this share of all results does not exceed.
    [[nodiscard]] float percentile(double share);
    [[nodiscard]] std::string text();
};

struct EvaluateOptions {
    Method method = Method::mikktspace;
    bool makes_normals = false;  ///< uses the vertices of makeIndexedFrames; only for meshes of triangles
    NormalWeighting weighting = NormalWeighting::angle;
    float crease_angle_deg = 180;
};

/// Differences of tangents over all poses and, if the plan computes normals, of normals. `spoil`: changes the buffers
/// before the shader uses them.
struct Outcome {
    Differences tangents, normals;
    std::size_t plan_words = 0, triangles = 0;
};
Outcome evaluateAll(const std::vector<PosedMesh>& meshes, const EvaluateOptions& options, const Evaluate& evaluate,
                    const std::function<void(EvaluateBuffers&)>& spoil = {});

/// Returns settings for tightly packed positions, normals and tangents, all of them floats.
std::vector<std::uint32_t> plainSettings(bool writes_normals);

}  // namespace tspace::shaders
