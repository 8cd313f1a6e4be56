// SPDX-License-Identifier: MIT
// Plots of the errors on the flat face of a bevel, as colors.
#pragma once

#include <string>
#include <vector>

#include "test_mesh.h"

namespace tspace::accuracy {

/// One square of the plot. `vectors`: one per corner of the mesh; they are interpolated and compared with the exact
/// vector.
struct BevelPanel {
    std::string name;
    std::vector<Vec3> vectors;
};

std::string bevelPlot(const std::string& title, const TestMesh& mesh, const DVec3& exact,
                      const std::vector<BevelPanel>& panels);

}  // namespace tspace::accuracy
