// SPDX-License-Identifier: MIT
// How far frames are from the exact ones.
#pragma once

#include "methods.h"

namespace tspace::accuracy {

/// Over corners, in degrees.
struct Spread {
    double mean = 0, p95 = 0, max = 0;
};
Spread spreadOf(std::vector<double> values);

/// Which corners count.
enum class Corners { all, inside, border, measured };

/// Tangents against the exact dP/du made orthogonal to the normal that the mesh has.
Spread tangentErrors(const TestMesh& mesh, const Frames& frames, Corners corners);
/// The separately stored bitangents against dP/dv.
Spread bitangentErrors(const TestMesh& mesh, const Frames& frames, Corners corners);
/// sign * cross(N, T) against dP/dv.
Spread crossErrors(const TestMesh& mesh, const Frames& frames, Corners corners);
/// Tangents on both sides of a fold of the chart, which should be each other's opposite. 0 where there is no fold.
double foldGap(const TestMesh& mesh, const Frames& frames);
Spread normalErrors(const TestMesh& mesh, const std::vector<Vec3>& normals, Corners corners);

/// Points on the mesh, spread by area, with the directions that a normal map gives there.
class Shading {
  public:
    Shading(const TestMesh& mesh, int count, Random random);
    /// Mean angle between the exact directions and those of interpolated frames, as shaders make them: N and T not
    /// normalised, B = sign * cross(N, T), and only the result normalised.
    [[nodiscard]] double meanError(const Frames& frames) const { return meanError(frames, mesh_.normals); }
    /// With other normals, one per vertex.
    [[nodiscard]] double meanError(const Frames& frames, const std::vector<Vec3>& normals) const;
    /// Of interpolated normals alone, as a flat map shows them.
    [[nodiscard]] double meanNormalError(const std::vector<Vec3>& normals) const;
    /// The same between two kinds of frames: what is wrong when a map was baked with the one and is shaded with the
    /// other.
    [[nodiscard]] double meanDifference(const Frames& frames, const Frames& baked) const;

  private:
    struct Sample {
        std::uint32_t triangle;
        double weights[3];
        DVec3 texel;  ///< in tangent space
        DVec3 exact;  ///< in space
        DVec3 normal;
    };
    [[nodiscard]] DVec3 normalAt(const Sample& sample, const std::vector<Vec3>& normals) const;
    [[nodiscard]] DVec3 shade(const Sample& sample, const Frames& frames, const std::vector<Vec3>& normals) const;
    void addSample(std::uint32_t triangle, Random& random);
    const TestMesh& mesh_;
    std::vector<Sample> samples_;
};

}  // namespace tspace::accuracy
