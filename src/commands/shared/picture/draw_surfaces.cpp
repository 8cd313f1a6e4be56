// SPDX-License-Identifier: MIT
// Draws surfaces, and computes the color of each of their points.
#include "commands/shared/picture/draw_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "commands/shared/picture/colors.h"

namespace tspace {
namespace {

/// Intensities of the ambient light and of the lamp.
constexpr float kAmbient = 0.12f, kLamp = 0.88f;
/// Period of stripes in pixels, along both axes.
constexpr std::uint32_t kStripe = 8;

using Weights = std::array<double, 3>;

struct ShownTriangle {
    std::array<std::size_t, 3> corners;
    std::array<std::uint32_t, 3> vertices;
};

ShownTriangle shownTriangle(const ShownSurface& surface, std::size_t triangle) {
    ShownTriangle result;
    for (std::size_t k = 0; k < 3; ++k) {
        result.corners[k] = 3 * triangle + k;
        result.vertices[k] = surface.corners[3 * triangle + k];
    }
    return result;
}

template <class T>
std::array<T, 3> valuesAt(const CornerValues<T>& values, const ShownTriangle& triangle) {
    return {values.at(triangle.corners[0], triangle.vertices[0]), values.at(triangle.corners[1], triangle.vertices[1]),
            values.at(triangle.corners[2], triangle.vertices[2])};
}

Vec2 uvAt(std::span<const Vec2> uvs, const std::array<std::uint32_t, 3>& vertices, const Weights& weights) {
    double u = 0, v = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        u += weights[k] * uvs[vertices[k]].x;
        v += weights[k] * uvs[vertices[k]].y;
    }
    return {static_cast<float>(u), static_cast<float>(v)};
}

}  // namespace

Vec3 sampleAt(const PlacedTexture& texture, const std::array<std::uint32_t, 3>& vertices,
              const std::array<double, 3>& weights) {
    return sampleTexture(*texture.image, texture.shape, uvAt(texture.uvs, vertices, weights));
}

namespace {

float alphaAt(const PlacedTexture& texture, const ShownTriangle& triangle, const Weights& weights) {
    if (texture.image->alpha.empty()) return 1;
    const BilinearTaps taps = bilinearTaps(texture.shape, uvAt(texture.uvs, triangle.vertices, weights));
    float alpha = 0;
    for (std::size_t i = 0; i < 4; ++i) alpha += taps.weights[i] * texture.image->alpha[taps.texels[i]];
    return alpha;
}

/// Returns the unit normal in world space, flipped if the surface is seen from behind. Zero if it has no direction.
DVec3 worldNormal(const Affine& to_world, DVec3 normal, bool is_back) {
    normalize(normal);
    DVec3 world = to_world.normal(normal);
    if (!normalize(world)) return {};
    return is_back ? -1.0 * world : world;
}

/// Returns whether a transform preserves angles: only rotation, reflection, uniform scale and translation.
bool keepsAngles(const Affine& place) {
    constexpr double kSame = 1e-9;
    const double size = dot(place.x, place.x);
    const auto isSame = [&](double value, double wanted) { return std::fabs(value - wanted) <= kSame * size; };
    return isSame(dot(place.y, place.y), size) && isSame(dot(place.z, place.z), size) &&
           isSame(dot(place.x, place.y), 0) && isSame(dot(place.y, place.z), 0) && isSame(dot(place.z, place.x), 0);
}

DVec3 plainNormal(const ShownSurface& surface, const Affine& to_world, const SurfacePoint& point) {
    const std::array<Vec3, 3> normals = valuesAt(surface.normals, shownTriangle(surface, point.triangle));
    DVec3 normal;
    for (std::size_t k = 0; k < 3; ++k) normal = normal + point.weights[k] * toDouble(normals[k]);
    return worldNormal(to_world, normal, point.is_back);
}

/// Normalizes tangents at the vertices, like glTF viewers, so that relief does not scale with their length.
std::array<Vec4, 3> unitTangents(const CornerValues<Vec4>& tangents, const ShownTriangle& triangle) {
    std::array<Vec4, 3> values = valuesAt(tangents, triangle);
    for (Vec4& value : values) {
        const Vec3 unit = withUnitLength(xyz(value));
        value = {unit.x, unit.y, unit.z, value.w};
    }
    return values;
}

ShadingFrame frameAt(const ShownSurface& surface, const CornerValues<Vec3>& normals, const CornerValues<Vec4>& tangents,
                     const SurfacePoint& point) {
    const ShownTriangle triangle = shownTriangle(surface, point.triangle);
    CornerFrames frames{.normals = valuesAt(normals, triangle)};
    if (!tangents.empty()) frames.tangents = unitTangents(tangents, triangle);
    return shadingFrame(frames, point.weights, surface.reading);
}

/// Darkens a color where the surface turns away from the viewer, to make its shape visible.
Vec3 shaped(const Vec3& color, const DVec3& normal, const Lighting& lighting) {
    const auto facing = static_cast<float>(std::fabs(dot(normal, lighting.to_eye)));
    const float factor = 0.7f + 0.3f * std::min(facing, 1.0f);
    return {factor * color.x, factor * color.y, factor * color.z};
}

bool isInStripe(const SurfacePoint& point) { return (point.column + point.row) % kStripe < kStripe / 2; }

Vec3 product(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vec3 sum(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

Vec4 vertexColor(const ShownSurface& surface, const ShownTriangle& triangle, const Weights& weights) {
    if (surface.colors.empty()) return {1, 1, 1, 1};
    double parts[4] = {};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec4& color = surface.colors[triangle.vertices[k]];
        parts[0] += weights[k] * color.x;
        parts[1] += weights[k] * color.y;
        parts[2] += weights[k] * color.z;
        parts[3] += weights[k] * color.w;
    }
    return {static_cast<float>(parts[0]), static_cast<float>(parts[1]), static_cast<float>(parts[2]),
            static_cast<float>(parts[3])};
}

/// Returns the product of the base color, its texture and the vertex colors.
Vec3 baseColor(const ShownSurface& surface, const SurfacePoint& point) {
    Vec3 color{surface.base_color[0], surface.base_color[1], surface.base_color[2]};
    const ShownTriangle triangle = shownTriangle(surface, point.triangle);
    if (surface.base.image != nullptr) color = product(color, sampleAt(surface.base, triangle.vertices, point.weights));
    if (!surface.colors.empty()) color = product(color, xyz(vertexColor(surface, triangle, point.weights)));
    return color;
}

float alphaOf(const ShownSurface& surface, std::size_t index, const Weights& weights) {
    const ShownTriangle triangle = shownTriangle(surface, index);
    const float texel = surface.base.image == nullptr ? 1 : alphaAt(surface.base, triangle, weights);
    const float vertex = surface.colors.empty() ? 1 : vertexColor(surface, triangle, weights).w;
    return texel * surface.base_color[3] * vertex;
}

Vec3 litColor(const ShownSurface& surface, const Affine& to_world, const Lighting& lighting,
              const SurfacePoint& point) {
    const Vec3 color = baseColor(surface, point);
    if (surface.is_unlit) return color;
    const double cosine = dot(mappedNormal(surface, to_world, point), lighting.to_light);
    const float light = kAmbient + kLamp * static_cast<float>(std::max(0.0, cosine));
    return {light * color.x, light * color.y, light * color.z};
}

Vec3 tangentColor(const ShownSurface& surface, const Affine& to_world, const SurfacePoint& point) {
    if (surface.tangents.empty()) return kNoData;
    DVec3 tangent = frameAt(surface, surface.normals, surface.tangents, point).tangent;
    normalize(tangent);
    DVec3 world = to_world.direction(tangent);
    return normalize(world) ? vectorColor(toFloat(world)) : kNoData;
}

UvSide uvSideOf(const ShownSurface& surface, const SurfacePoint& point) {
    return surface.sides.empty() ? UvSide::unknown : surface.sides[point.triangle];
}

Vec3 islandColor(const ShownSurface& surface, const SurfacePoint& point) {
    constexpr std::array<Vec3, 8> kIslands = {{kIslandColor,
                                               {0.98f, 0.75f, 0.52f},
                                               {0.62f, 0.82f, 0.62f},
                                               {0.94f, 0.62f, 0.60f},
                                               {0.77f, 0.69f, 0.86f},
                                               {0.80f, 0.68f, 0.60f},
                                               {0.93f, 0.72f, 0.84f},
                                               {0.84f, 0.84f, 0.50f}}};
    if (surface.islands.empty()) return kNoData;
    const Vec3& color = kIslands[surface.islands[point.triangle] % kIslands.size()];
    // Adjacent triangles have slightly different shades, so that they can be distinguished.
    const float shade = (point.triangle % 2 != 0 ? 0.93f : 1.0f) *
                        (uvSideOf(surface, point) == UvSide::mirrored && isInStripe(point) ? 0.45f : 1.0f);
    return {shade * color.x, shade * color.y, shade * color.z};
}

Vec3 signColor(const ShownSurface& surface, const SurfacePoint& point) {
    const UvSide side = uvSideOf(surface, point);
    const bool is_mirrored = side == UvSide::mirrored;
    Vec3 color = kNoData;
    bool disagrees = false;
    if (!surface.tangents.empty()) {
        const std::array<Vec4, 3> tangents = valuesAt(surface.tangents, shownTriangle(surface, point.triangle));
        const float w = tangents[0].w;
        const bool is_one = (w == 1 || w == -1) && w == tangents[1].w && w == tangents[2].w;
        color = !is_one ? kSignNeither : w > 0 ? kSignPlus : kSignMinus;
        disagrees = is_one && side != UvSide::unknown && (w < 0) != is_mirrored;
    }
    if (is_mirrored && isInStripe(point)) return disagrees ? kSignWrong : kSignStripes;
    if (disagrees && !is_mirrored && !isInStripe(point)) return kSignWrong;
    return color;
}

}  // namespace

bool isOpaqueAt(const ShownSurface& surface, std::size_t triangle, const Weights& weights) {
    return alphaOf(surface, triangle, weights) >= surface.alpha_cutoff;
}

DVec3 mappedNormal(const ShownSurface& surface, const Affine& to_world, const SurfacePoint& point) {
    if (surface.normal_map.image == nullptr || surface.tangents.empty()) return plainNormal(surface, to_world, point);
    const Vec3 texel = sampleAt(surface.normal_map, shownTriangle(surface, point.triangle).vertices, point.weights);
    const DVec3 vector = decodeTexel(texel, surface.reading);
    if (keepsAngles(to_world)) {
        const ShadingFrame frame = frameAt(surface, surface.normals, surface.tangents, point);
        return worldNormal(to_world, shadedNormal(frame, vector), point.is_back);
    }
    // Transforms frames like three.js and the Khronos viewer: N by the inverse transpose, T by the matrix, both
    // normalized at the vertices, and B from N and T. So a non-uniform scale of the node does not change the tilt of
    // texels.
    const ShownTriangle triangle = shownTriangle(surface, point.triangle);
    CornerFrames frames{valuesAt(surface.normals, triangle), unitTangents(surface.tangents, triangle)};
    for (Vec3& normal : frames.normals) normal = normalAt(to_world, normal);
    for (Vec4& tangent : frames.tangents) tangent = tangentAt(to_world, tangent);
    const DVec3 normal = shadedNormal(shadingFrame(frames, point.weights, surface.reading), vector);
    return point.is_back ? -1.0 * normal : normal;
}

double frameError(const ShownSurface& surface, const SurfacePoint& point) {
    constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
    const bool has_normals = !surface.expected_normals.empty(), has_tangents = !surface.tangents.empty();
    if (has_tangents == surface.expected.empty() || !(has_tangents || has_normals)) return kMissing;
    const ShadingFrame has = frameAt(surface, surface.normals, surface.tangents, point),
                       expected = frameAt(surface, has_normals ? surface.expected_normals : surface.normals,
                                          surface.expected, point);
    double worst = 0;
    const auto compare = [&](const DVec3& a, const DVec3& b) {
        const bool is_there = dot(a, a) > 0 && dot(b, b) > 0;
        const double degrees = is_there ? degreesBetween(a, b) : kMissing;
        if (!std::isnan(worst) && !(degrees <= worst)) worst = degrees;
    };
    if (has_normals) compare(has.normal, expected.normal);
    if (has_tangents) compare(has.tangent, expected.tangent);
    if (has_tangents) compare(has.bitangent, expected.bitangent);
    return worst;
}

Vec3 shadePoint(RenderShow show, const ShownSurface& surface, const Affine& to_world, const Lighting& lighting,
                const SurfacePoint& point) {
    switch (show) {
        case RenderShow::lit:
        case RenderShow::both: return litColor(surface, to_world, lighting, point);
        case RenderShow::normals: return vectorColor(toFloat(plainNormal(surface, to_world, point)));
        case RenderShow::mapped: return vectorColor(toFloat(mappedNormal(surface, to_world, point)));
        case RenderShow::tangents: return tangentColor(surface, to_world, point);
        case RenderShow::sign:
            return shaped(signColor(surface, point), plainNormal(surface, to_world, point), lighting);
        case RenderShow::error: {
            const double degrees = frameError(surface, point);
            const Vec3 color = std::isfinite(degrees) ? heatColor(static_cast<float>(degrees)) : kNoData;
            return shaped(color, plainNormal(surface, to_world, point), lighting);
        }
        case RenderShow::uv: return islandColor(surface, point);
    }
    return kNoData;
}

namespace {

/// The surface that is visible at one sample.
struct SeenSample {
    const ShownSurface* surface = nullptr;  ///< visible surface; null if the sample shows the background
    SurfacePoint point = {};
    Vec3 color = {};
};

class RowShader {
  public:
    RowShader(RenderShow show, std::span<const DrawnMesh> meshes, std::span<const ShownSurface* const> surfaces,
              const Camera& camera, const DVec3& to_light, const PictureSize& size)
        : show_(show), meshes_(meshes), surfaces_(surfaces), lighting_{.to_light = to_light, .to_eye = camera.back()},
          size_(size) {
        if (show == RenderShow::lit) {
            background_ = {static_cast<float>(srgbToLight(kBackground.x)),
                           static_cast<float>(srgbToLight(kBackground.y)),
                           static_cast<float>(srgbToLight(kBackground.z))};
        }
    }

    /// Shades a row of pixels with three bytes each.
    void shade(const VisibleTriangles& visible, std::uint32_t row, std::span<std::uint8_t> pixels,
               ErrorStatistics& errors) const {
        std::vector<Vec3> sums(size_.width);
        for (std::uint32_t k = 0; k < size_.samples; ++k) {
            forSamples(visible, row * size_.samples + k, [&](std::uint32_t x, const SeenSample& seen) {
                Vec3& total = sums[x / size_.samples];
                total = sum(total, seen.color);
                if (show_ == RenderShow::error && seen.surface != nullptr)
                    errors.add(frameError(*seen.surface, seen.point));
            });
        }
        const float share = 1.0f / static_cast<float>(size_.samples * size_.samples);
        for (std::uint32_t x = 0; x < size_.width; ++x) {
            const float color[3] = {share * sums[x].x, share * sums[x].y, share * sums[x].z};
            for (std::size_t c = 0; c < 3; ++c)
                pixels[3 * x + c] = show_ == RenderShow::lit ? lightToSrgb(color[c]) : roundedChannel(color[c]);
        }
    }

    /// Calls take(x, sample) for each sample of a row.
    template <class Take>
    void forSamples(const VisibleTriangles& visible, std::uint32_t sample_row, const Take& take) const {
        const std::span<const std::uint32_t> numbers = visible.row(sample_row);
        std::uint32_t known = VisibleTriangles::kNone;
        VisibleTriangles::Place place;
        SeenTriangle seen({});
        for (std::uint32_t x = 0; x < numbers.size(); ++x) {
            SeenSample sample{.color = background_};
            if (numbers[x] != VisibleTriangles::kNone) {
                if (numbers[x] != known) {
                    known = numbers[x];
                    place = visible.placeOf(known);
                    seen = visible.seen(place);
                }
                const DrawnMesh& mesh = meshes_[place.mesh];
                sample.surface = surfaces_[place.mesh];
                sample.point = {.triangle = place.triangle,
                                .weights = seen.weightsAt(x + 0.5, sample_row + 0.5),
                                .is_back = seen.isFront() == (mesh.to_world.determinant() < 0),
                                .column = x / size_.samples,
                                .row = sample_row / size_.samples};
                sample.color = shadePoint(show_, *sample.surface, mesh.to_world, lighting_, sample.point);
            }
            take(x, sample);
        }
    }

  private:
    RenderShow show_;
    std::span<const DrawnMesh> meshes_;
    std::span<const ShownSurface* const> surfaces_;
    Lighting lighting_;
    PictureSize size_;
    Vec3 background_ = kBackground;
};

}  // namespace

void ErrorStatistics::add(double degrees) {
    if (std::isfinite(degrees)) add(ErrorStatistics{1, degrees, degrees});
}

void ErrorStatistics::add(const ErrorStatistics& other) {
    count += other.count;
    sum_deg += other.sum_deg;
    max_deg = std::max(max_deg, other.max_deg);
}

SurfacePicture drawSurfaces(RenderShow show, std::span<const DrawnMesh> meshes,
                            std::span<const ShownSurface* const> surfaces, const Camera& camera, const DVec3& to_light,
                            const PictureSize& size, WorkLimit& work_limit, Parallel& parallel) {
    const std::uint32_t width = size.width * size.samples, height = size.height * size.samples;
    const RowShader shader(show, meshes, surfaces, camera, to_light, size);
    SurfacePicture picture{.image = {.width = size.width, .height = size.height}};
    const std::size_t row_bytes = std::size_t{3} * size.width;
    picture.image.rgb.resize(row_bytes * size.height);
    const auto pixels = [&](std::size_t row) {
        return std::span(picture.image.rgb).subspan(row * row_bytes, row_bytes);
    };
    const VisibleTriangles visible(meshes, camera, width, height, work_limit);
    std::vector<ErrorStatistics> errors(size.height);
    parallel.forRanges(size.height, 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row)
            shader.shade(visible, static_cast<std::uint32_t>(row), pixels(row), errors[row]);
    });
    for (const ErrorStatistics& row : errors) picture.errors.add(row);
    return picture;
}

}  // namespace tspace
