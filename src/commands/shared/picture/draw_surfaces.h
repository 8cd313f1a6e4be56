// SPDX-License-Identifier: MIT
// A picture of surfaces.
#pragma once

#include <span>

#include "commands/shared/picture/camera.h"
#include "commands/shared/picture/surface_shader.h"
#include "commands/shared/picture/visible_triangles.h"
#include "core/base/parallel.h"
#include "images/image.h"

namespace tspace {

struct PictureSize {
    std::uint32_t width = 0, height = 0;  ///< in pixels
    std::uint32_t samples = 1;            ///< along each side of a pixel
};

/// Angles over all samples that have one.
struct ErrorStatistics {
    std::uint64_t count = 0;
    double sum_deg = 0, max_deg = 0;

    void add(double degrees);
    void add(const ErrorStatistics& other);
};

struct SurfacePicture {
    RgbImage image = {};
    ErrorStatistics errors = {};  ///< of RenderShow::error
};

/// `surfaces`: one per mesh. `camera`: of width * samples by height * samples. Throws FileError where `effort` ends. The same
/// bytes for any number of threads.
SurfacePicture drawSurfaces(RenderShow show, std::span<const DrawnMesh> meshes,
                            std::span<const ShownSurface* const> surfaces, const Camera& camera, const DVec3& to_light,
                            const PictureSize& size, Effort& effort, Parallel& parallel);

}  // namespace tspace
