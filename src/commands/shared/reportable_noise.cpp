// SPDX-License-Identifier: MIT
#include "commands/shared/reportable_noise.h"

#include "core/base/border.h"
#include "core/base/near_positions.h"
#include "core/base/parallel.h"
#include "core/estimate/denoise.h"
#include "tspace/execution.h"

namespace tspace {

std::uint64_t reportableNoiseMemory(const MeshView& mesh) {
    constexpr std::uint64_t kCornerBytes = 96, kVertexBytes = 112;
    return kCornerBytes * mesh.cornerCount() + kVertexBytes * mesh.positions.count;
}

double reportableNoise(const MeshView& mesh, double position_step, float weld_distance) {
    constexpr std::size_t kMinFaces = 1000;
    constexpr double kMinNoise = 0.03;
    if (mesh.faceCount() < kMinFaces) return 0;
    const Arena arena;  // the arena is freed as a whole; without it, a thousand calls fragmented the heap by 63 MB
    const Execution execution{.allocator = arena.allocator()};
    const Result<PositionNoise> found = atBorder([&]() -> Result<PositionNoise> {
        Parallel parallel(execution, mesh.cornerCount());
        const NearMesh near(mesh, weld_distance, execution.allocator, parallel);
        return measureSureNoise(near.view(), kMinNoise, execution);
    });
    if (!found || found->noise < kMinNoise || found->noise * found->mean_edge < position_step) return 0;
    return double{found->noise};
}

}  // namespace tspace
