// SPDX-License-Identifier: MIT
// First which triangle each sample sees, then the colour of each sample, and the mean of each pixel.
#include "commands/shared/picture/draw_surfaces.h"

#include <algorithm>
#include <cmath>

#include "commands/shared/picture/colors.h"

namespace tspace {

namespace {

class RowShader {
  public:
    RowShader(RenderShow show, const VisibleTriangles& visible, std::span<const DrawnMesh> meshes,
              std::span<const ShownSurface* const> surfaces, const Lighting& lighting, const PictureSize& size)
        : show_(show), visible_(visible), meshes_(meshes), surfaces_(surfaces), lighting_(lighting), size_(size) {
        if (show == RenderShow::lit) {
            background_ = {static_cast<float>(srgbToLight(kBackground.x)),
                           static_cast<float>(srgbToLight(kBackground.y)),
                           static_cast<float>(srgbToLight(kBackground.z))};
        }
    }

    /// A row of pixels: three bytes each.
    void shade(std::uint32_t row, std::span<std::uint8_t> pixels, ErrorStatistics& errors) const {
        std::vector<Vec3> sums(size_.width);
        for (std::uint32_t k = 0; k < size_.samples; ++k) addSamples(row, row * size_.samples + k, sums, errors);
        const float share = 1.0f / static_cast<float>(size_.samples * size_.samples);
        for (std::uint32_t x = 0; x < size_.width; ++x) {
            const float color[3] = {share * sums[x].x, share * sums[x].y, share * sums[x].z};
            for (std::size_t c = 0; c < 3; ++c)
                pixels[3 * x + c] = show_ == RenderShow::lit ? lightToSrgb(color[c]) : storedByte(color[c]);
        }
    }

  private:
    void addSamples(std::uint32_t row, std::uint32_t sample_row, std::span<Vec3> sums, ErrorStatistics& errors) const {
        const std::span<const std::uint32_t> numbers = visible_.row(sample_row);
        std::uint32_t known = VisibleTriangles::kNone;
        VisibleTriangles::Place place;
        SeenTriangle seen({});
        for (std::uint32_t x = 0; x < numbers.size(); ++x) {
            const std::uint32_t column = x / size_.samples;
            Vec3 color = background_;
            if (numbers[x] != VisibleTriangles::kNone) {
                if (numbers[x] != known) {
                    known = numbers[x];
                    place = visible_.placeOf(known);
                    seen = visible_.seen(place);
                }
                const DrawnMesh& mesh = meshes_[place.mesh];
                const SurfacePoint point{.triangle = place.triangle,
                                         .weights = seen.weightsAt(x + 0.5, sample_row + 0.5),
                                         .is_back = seen.isFront() == (mesh.to_world.determinant() < 0),
                                         .column = column,
                                         .row = row};
                const ShownSurface& surface = *surfaces_[place.mesh];
                color = shadePoint(show_, surface, mesh.to_world, lighting_, point);
                if (show_ == RenderShow::error) errors.add(frameError(surface, point));
            }
            sums[column] = {sums[column].x + color.x, sums[column].y + color.y, sums[column].z + color.z};
        }
    }

    RenderShow show_;
    const VisibleTriangles& visible_;
    std::span<const DrawnMesh> meshes_;
    std::span<const ShownSurface* const> surfaces_;
    Lighting lighting_;
    PictureSize size_;
    Vec3 background_ = kBackground;
};

}  // namespace

void ErrorStatistics::add(double degrees) {
    if (!std::isfinite(degrees)) return;
    ++count;
    sum_deg += degrees;
    max_deg = std::max(max_deg, degrees);
}

void ErrorStatistics::add(const ErrorStatistics& other) {
    count += other.count;
    sum_deg += other.sum_deg;
    max_deg = std::max(max_deg, other.max_deg);
}

SurfacePicture drawSurfaces(RenderShow show, std::span<const DrawnMesh> meshes,
                            std::span<const ShownSurface* const> surfaces, const Camera& camera, const DVec3& to_light,
                            const PictureSize& size, Effort& effort, Parallel& parallel) {
    const VisibleTriangles visible(meshes, camera, size.width * size.samples, size.height * size.samples, effort);
    const RowShader shader(show, visible, meshes, surfaces, {.to_light = to_light, .to_eye = camera.back()}, size);
    SurfacePicture picture{.image = {.width = size.width, .height = size.height}};
    const std::size_t row_bytes = std::size_t{3} * size.width;
    picture.image.rgb.resize(row_bytes * size.height);
    std::vector<ErrorStatistics> errors(size.height);
    parallel.forRanges(size.height, 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            shader.shade(static_cast<std::uint32_t>(row),
                         std::span(picture.image.rgb).subspan(row * row_bytes, row_bytes), errors[row]);
        }
    });
    for (const ErrorStatistics& row : errors) picture.errors.add(row);
    return picture;
}

}  // namespace tspace
