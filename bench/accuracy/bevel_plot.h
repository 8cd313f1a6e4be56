// SPDX-License-Identifier: MIT
// Errors over the flat face of a bevel, as colors.
#pragma once

#include <string>
#include <vector>

#include "test_mesh.h"

namespace tspace::accuracy {

/// One square of the image: a vector per corner of the mesh, which is interpolated and compared with `exact`.
struct BevelPanel {
    std::string name;
    std::vector<Vec3> vectors;
};

std::string bevelPlot(const std::string& title, const TestMesh& mesh, const DVec3& exact,
                      const std::vector<BevelPanel>& panels);

}  // namespace tspace::accuracy
