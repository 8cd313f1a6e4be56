// SPDX-License-Identifier: MIT
// What is measured: the methods of tspace, called by users' own way, and the exact frames.
#pragma once

#include <string>
#include <vector>

#include "test_mesh.h"
#include "tspace/normals.h"
#include "tspace/tangents.h"

namespace tspace::accuracy {

/// Frames per corner.
struct Frames {
    std::vector<Vec4> tangents;
    std::vector<Vec3> bitangents;
};

/// The name of the exact frames at vertices: interpolation alone is what they err by.
inline constexpr const char* kFloor = "floor";
/// `best` with other steps than by default: 1 for tangents, 2 for normals.
inline constexpr const char *kFitAlone = "best, 0 steps", *kOneStep = "best, 1 step", *kTwoSteps = "best, 2 steps";

struct NamedMethod {
    std::string name;
    Method method;
    std::uint32_t refine = 1;
};

/// Every method that uses UVs.
std::vector<NamedMethod> methods();
Frames framesBy(Method method, const TestMesh& mesh, std::uint32_t refine = 1);
Frames exactFrames(const TestMesh& mesh);

struct NamedWeighting {
    std::string name;
    NormalWeighting weighting;
    std::uint32_t refine = NormalOptions{}.refine;
};

std::vector<NamedWeighting> weightings();
/// Normals per corner. Vertices on a fold are one point.
std::vector<Vec3> normalsBy(NormalWeighting weighting, const TestMesh& mesh,
                            std::uint32_t refine = NormalOptions{}.refine);

}  // namespace tspace::accuracy
