// SPDX-License-Identifier: MIT
// Errors of frames against exact frames.
#pragma once

#include "methods.h"

namespace tspace::accuracy {

/// Statistics over corners, in degrees.
struct Spread {
    double mean = 0, p95 = 0, max = 0;
};
Spread spreadOf(std::vector<double> values);

/// Selects the corners over which errors are averaged.
enum class Corners { all, inside, border, measured };

/// Returns the errors of tangents against the exact dP/du, orthogonalized against the mesh's normal.
Spread tangentErrors(const TestMesh& mesh, const Frames& frames, Corners corners);
/// Returns the errors of separately stored bitangents against dP/dv.
Spread bitangentErrors(const TestMesh& mesh, const Frames& frames, Corners corners);
/// Returns the errors of sign * cross(N, T) against dP/dv.
Spread crossErrors(const TestMesh& mesh, const Frames& frames, Corners corners);
/// Returns the mean angle, in degrees, between the tangent on one side of a mirrored seam (fold) and the negated
/// tangent on the other side. Returns 0 if the mesh has no such seam.
double foldGap(const TestMesh& mesh, const Frames& frames);
Spread normalErrors(const TestMesh& mesh, const std::vector<Vec3>& normals, Corners corners);

/// Measures shading at points that are distributed over the mesh by area, with normals from a normal map.
class Shading {
  public:
    Shading(const TestMesh& mesh, int count, Random random);
    /// Returns the mean angle between the exact directions and those of interpolated frames, as in shaders: N and T not
    /// normalized, B = sign * cross(N, T), and only the result normalized.
    [[nodiscard]] double meanError(const Frames& frames) const { return meanError(frames, mesh_.normals); }
    /// Returns the mean error as meanError above does, but with these normals, one per vertex.
    [[nodiscard]] double meanError(const Frames& frames, const std::vector<Vec3>& normals) const;
    /// Returns the mean error of interpolated normals, as with a flat map.
    [[nodiscard]] double meanNormalError(const std::vector<Vec3>& normals) const;
    /// Returns the mean angle between two kinds of frames: the error if a map was baked with one kind and is shaded
    /// with the other.
    [[nodiscard]] double meanDifference(const Frames& frames, const Frames& baked) const;

  private:
    struct Sample {
        std::uint32_t triangle;
        double weights[3];
        DVec3 texel;  ///< normal from the map, in tangent space
        DVec3 exact;  ///< exact normal of the map in object space
        DVec3 normal;
    };
    [[nodiscard]] DVec3 normalAt(const Sample& sample, const std::vector<Vec3>& normals) const;
    [[nodiscard]] DVec3 shade(const Sample& sample, const Frames& frames, const std::vector<Vec3>& normals) const;
    void addSample(std::uint32_t triangle, Random& random);
    const TestMesh& mesh_;
    std::vector<Sample> samples_;
};

}  // namespace tspace::accuracy
