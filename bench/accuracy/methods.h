// SPDX-License-Identifier: MIT
// Measured methods: the methods of tspace, through the public API, and the exact frames.
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

/// Name of the exact frames at vertices, whose error is due to interpolation only.
inline constexpr const char* kFloor = "floor";
/// `best` with a number of refinement steps other than the default (1 for tangents, 2 for normals).
inline constexpr const char *kFitAlone = "best, 0 steps", *kOneStep = "best, 1 step", *kTwoSteps = "best, 2 steps";

struct NamedMethod {
    std::string name;
    Method method;
    std::uint32_t refine = 1;
};

/// Returns all methods that use UVs.
std::vector<NamedMethod> methods();
Frames framesBy(Method method, const TestMesh& mesh, std::uint32_t refine = 1);
Frames exactFrames(const TestMesh& mesh);

struct NamedWeighting {
    std::string name;
    NormalWeighting weighting;
    std::uint32_t refine = NormalOptions{}.refine;
};

std::vector<NamedWeighting> weightings();
/// Returns normals per corner. The two copies of a vertex on a mirrored seam are welded.
std::vector<Vec3> normalsBy(NormalWeighting weighting, const TestMesh& mesh,
                            std::uint32_t refine = NormalOptions{}.refine);

}  // namespace tspace::accuracy
