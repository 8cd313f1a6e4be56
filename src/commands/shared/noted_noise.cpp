// SPDX-License-Identifier: MIT
#include "commands/shared/noted_noise.h"

#include "tspace/position_noise.h"

namespace tspace {

double notedNoise(const MeshView& mesh, double position_step) {
    constexpr std::size_t kLeastFaces = 1000;
    constexpr double kLeastNoise = 0.03;
    if (mesh.faceCount() < kLeastFaces) return 0;
    const Result<PositionNoise> found = measurePositionNoise(mesh);
    if (!found || found->noise < kLeastNoise || found->noise * found->mean_edge < position_step) return 0;
    return double{found->noise};
}

}  // namespace tspace
