// SPDX-License-Identifier: MIT
// Draws surfaces, and computes the color of each of their points, for the views of docs/guides/render.md.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "commands/shared/picture/visible_triangles.h"
#include "core/base/parallel.h"
#include "core/mesh/surface/affine.h"
#include "images/image.h"
#include "maps/texels/shading.h"
#include "maps/texels/texture_sample.h"
#include "tspace/render.h"
#include "tspace/span.h"

namespace tspace {

// Textures of a picture. 8-bit textures are not expanded to floats, because textures are many and large.

struct PictureTexture {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> bytes = {};  ///< 8 bits: three per texel; otherwise empty
    std::vector<Vec3> texels = {};         ///< more than 8 bits: one per texel; otherwise empty
    std::vector<float> values = {};        ///< 256 entries: decoded value of each byte
    std::vector<float> alpha = {};         ///< one per texel; empty: opaque, or not requested

    [[nodiscard]] Vec3 at(std::size_t texel) const {
        if (bytes.empty()) return texels[texel];
        const std::uint8_t* rgb = bytes.data() + 3 * texel;
        return {values[rgb[0]], values[rgb[1]], values[rgb[2]]};
    }
};

/// Samples a texture bilinearly.
inline Vec3 sampleTexture(const PictureTexture& texture, const TextureShape& shape, Vec2 uv) {
    const BilinearTaps taps = bilinearTaps(shape, uv);
    Vec3 sum{};
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 texel = texture.at(taps.texels[i]);
        const float weight = taps.weights[i];
        sum = {sum.x + weight * texel.x, sum.y + weight * texel.y, sum.z + weight * texel.z};
    }
    return sum;
}

/// Values of a primitive, one per vertex or one per corner.
template <class T>
struct CornerValues {
    std::span<const T> values = {};
    bool is_per_corner = false;

    [[nodiscard]] bool empty() const { return values.empty(); }
    [[nodiscard]] const T& at(std::size_t corner, std::uint32_t vertex) const {
        return values[is_per_corner ? corner : vertex];
    }
};

/// A texture and its UVs.
struct PlacedTexture {
    TextureShape shape = {};
    const PictureTexture* image = nullptr;  ///< null if there is no texture
    std::span<const Vec2> uvs = {};         ///< one per vertex, after any transform
};

/// Samples a texture, which must have an image, at a point of the triangle with these vertices.
Vec3 sampleAt(const PlacedTexture& texture, const std::array<std::uint32_t, 3>& vertices,
              const std::array<double, 3>& weights);

/// Orientation of a triangle's texture: unmirrored (`plain`) or mirrored.
enum class UvSide : std::uint8_t { unknown, plain, mirrored };

/// Data of one primitive for all views.
struct ShownSurface {
    std::span<const std::uint32_t> corners = {};
    CornerValues<Vec3> normals = {};
    CornerValues<Vec4> tangents = {};  ///< stored tangents; empty if there are none
    CornerValues<Vec4> expected = {};  ///< tangents to compare with in `error`; empty: none
    /// Normals to compare with in `error`; empty: normals are not compared.
    CornerValues<Vec3> expected_normals = {};
    std::span<const UvSide> sides = {};              ///< one per triangle; empty: all unknown
    std::span<const std::uint32_t> islands = {};     ///< one per triangle; used by `uv`
    std::array<float, 4> base_color = {1, 1, 1, 1};  ///< linear color and alpha
    PlacedTexture base = {};                         ///< texture of the base color, converted to linear
    PlacedTexture normal_map = {};
    MapReading reading = {};
    float alpha_cutoff = 0;
    bool is_unlit = false;
    std::span<const Vec4> colors = {};  ///< vertex colors, linear; empty: none
};

struct Lighting {
    DVec3 to_light = {0, 0, 1};  ///< unit vector in world space
    DVec3 to_eye = {0, 0, 1};    ///< unit vector in world space
};

/// A visible point of a triangle.
struct SurfacePoint {
    std::size_t triangle = 0;
    std::array<double, 3> weights = {};
    bool is_back = false;  ///< the point is seen from behind
    std::uint32_t column = 0, row = 0;
};

/// Returns whether the surface is opaque at a point: its alpha is not below the cutoff.
bool isOpaqueAt(const ShownSurface& surface, std::size_t triangle, const std::array<double, 3>& weights);

/// Returns linear light for the view `lit`, and the stored color for other views. `to_world`: transform of the surface.
Vec3 shadePoint(RenderShow show, const ShownSurface& surface, const Affine& to_world, const Lighting& lighting,
                const SurfacePoint& point);

/// Returns the unit normal in world space that `lit` shades, flipped if the surface is seen from behind; zero if there
/// is none.
DVec3 mappedNormal(const ShownSurface& surface, const Affine& to_world, const SurfacePoint& point);

/// Returns the largest angle in degrees between stored and expected T, B and, if compared, N at a point; NaN if one of
/// them is missing. If neither side has tangents, only normals are compared.
double frameError(const ShownSurface& surface, const SurfacePoint& point);

struct PictureSize {
    std::uint32_t width = 0, height = 0;  ///< in pixels
    std::uint32_t samples = 1;            ///< along each side of a pixel
};

/// Statistics of the angles of all samples that have an angle.
struct ErrorStatistics {
    std::uint64_t count = 0;
    double sum_deg = 0, max_deg = 0;

    void add(double degrees);
    void add(const ErrorStatistics& other);
};

struct SurfacePicture {
    RgbImage image = {};
    ErrorStatistics errors = {};  ///< statistics of RenderShow::error
};

/// Draws a picture. `surfaces`: one per mesh. `camera`: for width * samples by height * samples. Throws FileError if
/// `work_limit` is exhausted. The result does not depend on the number of threads.
SurfacePicture drawSurfaces(RenderShow show, std::span<const DrawnMesh> meshes,
                            std::span<const ShownSurface* const> surfaces, const Camera& camera, const DVec3& to_light,
                            const PictureSize& size, WorkLimit& work_limit, Parallel& parallel);

}  // namespace tspace
