// SPDX-License-Identifier: MIT
#include "raster.h"

#include <algorithm>
#include <cmath>

#include "core/vec_math.h"
#include "tspace/frame.h"

namespace picture {
namespace {

using tspace::Vec2;
using tspace::Vec3;
using tspace::Vec4;

constexpr int kSamples = 4;  ///< along each side of a pixel
constexpr float kFar = 1e30f;
constexpr Vec3 kBackground{0.80f, 0.82f, 0.85f};

Vec3 unit(const Vec3& v) { return (1 / length(v)) * v; }

/// Stored colours are taken as the roots of light: near enough to sRGB, and no pow.
Vec3 light(const Vec3& stored) { return {stored.x * stored.x, stored.y * stored.y, stored.z * stored.z}; }
/// Six bits of eight: nobody sees the difference, and the file is half as large.
std::uint8_t stored(float light) {
    const float value = std::sqrt(std::clamp(light, 0.0f, 1.0f));
    return static_cast<std::uint8_t>(static_cast<int>(value * 63 + 0.5f) * 255 / 63);
}

/// The mean of the four texels around (u, v); v = 0 is the first row.
Vec3 sample(const crate::Image& image, const Vec2& uv) {
    const float size = static_cast<float>(image.size), x = uv.x * size - 0.5f, y = uv.y * size - 0.5f;
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    const float right = x - static_cast<float>(column), down = y - static_cast<float>(row);
    const auto texel = [&image](int c, int r) {
        const int last = image.size - 1;
        const std::uint8_t* rgb = &image.rgb[3 * (std::clamp(r, 0, last) * image.size + std::clamp(c, 0, last))];
        return (1 / 255.0f) * Vec3{static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
    };
    return (1 - down) * ((1 - right) * texel(column, row) + right * texel(column + 1, row)) +
           down * ((1 - right) * texel(column, row + 1) + right * texel(column + 1, row + 1));
}

/// x^32.
float shininess(float x) {
    for (int i = 0; i < 5; ++i) x *= x;
    return x;
}

/// What leaves the surface towards the eye: Lambert, a sky, and Blinn's highlight. The normal is the one that
/// docs/conventions.md asks of shaders: nothing is normalised before the end.
Vec3 shade(const Scene& scene, const Corner& at) {
    const Vec3 texel = tspace::decodeNormal(sample(scene.textures->normal, at.uv));
    const Vec3 n = tspace::objectNormalMikktspace(at.normal, at.tangent, texel);
    const Vec3 to_light = unit(scene.to_key_light), to_eye = unit(scene.eye - at.position);
    const float key = std::max(0.0f, dot(n, to_light)), sky = 0.5f + 0.5f * n.y;
    const float shine = key * shininess(std::max(0.0f, dot(n, unit(to_light + to_eye))));
    const Vec3 paint = light(sample(scene.textures->base_color, at.uv));
    return (1.75f * key) * paint + sky * Vec3{paint.x * 0.20f, paint.y * 0.22f, paint.z * 0.26f} +
           shine * Vec3{0.6f, 0.57f, 0.5f};
}

/// The mean of a triangle's corners; the weights' sum is 1. All three have the same sign.
Corner mix(const Corner* corners, const float (&weights)[3]) {
    Corner mean{};
    mean.tangent.w = corners[0].tangent.w;
    for (int k = 0; k < 3; ++k) {
        const float w = weights[k];
        const Corner& c = corners[k];
        mean.position = mean.position + w * c.position;
        mean.normal = mean.normal + w * c.normal;
        mean.uv = {mean.uv.x + w * c.uv.x, mean.uv.y + w * c.uv.y};
        const Vec3 tangent = xyz(mean.tangent) + w * xyz(c.tangent);
        mean.tangent = {tangent.x, tangent.y, tangent.z, mean.tangent.w};
    }
    return mean;
}

struct Sample {
    Vec3 color = kBackground;
    float depth = kFar;
};

struct Projected {
    float x, y;  ///< in samples, y downwards
    float inverse_depth;
};

void drawTriangle(const Scene& scene, const Corner* corners, const Projected (&p)[3], int width,
                  std::vector<Sample>& samples) {
    const float area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    if (!(area < 0)) return;  // seen from behind
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
    const auto first = [](float low) { return std::max(0, static_cast<int>(low)); };
    const auto last = [width](float high) { return std::min(width - 1, static_cast<int>(high)); };
    for (int row = first(top); row <= last(bottom); ++row) {
        for (int column = first(left); column <= last(right); ++column) {
            const float x = static_cast<float>(column) + 0.5f, y = static_cast<float>(row) + 0.5f;
            float weights[3], inverse_depth = 0;
            for (int k = 0; k < 3; ++k) {
                const Projected &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
                weights[k] = ((a.x - x) * (b.y - y) - (b.x - x) * (a.y - y)) / area * p[k].inverse_depth;
                inverse_depth += weights[k];
            }
            Sample& sample = samples[row * width + column];
            const bool inside = weights[0] >= 0 && weights[1] >= 0 && weights[2] >= 0;
            if (!inside || 1 / inverse_depth >= sample.depth) continue;
            for (float& weight : weights) weight /= inverse_depth;
            sample = {shade(scene, mix(corners, weights)), 1 / inverse_depth};
        }
    }
}

}  // namespace

std::vector<std::uint8_t> draw(const Scene& scene, int size) {
    const int width = size * kSamples;
    std::vector<Sample> samples(width * width);
    const Vec3 back = unit(scene.eye - scene.target), right = unit(cross(Vec3{0, 1, 0}, back)), up = cross(back, right);
    const auto project = [&](const Corner& corner) {
        const Vec3 seen = corner.position - scene.eye;
        const float half = 0.5f * static_cast<float>(width), depth = -dot(seen, back),
                    scale = half * scene.zoom / depth;
        return Projected{half + scale * dot(seen, right), half - scale * dot(seen, up), 1 / depth};
    };
    for (std::size_t c = 0; c + 2 < scene.corners.size(); c += 3) {
        const Corner* corners = &scene.corners[c];
        drawTriangle(scene, corners, {project(corners[0]), project(corners[1]), project(corners[2])}, width, samples);
    }
    std::vector<std::uint8_t> pixels;
    for (int pixel = 0; pixel < size * size; ++pixel) {
        Vec3 sum;
        for (int k = 0; k < kSamples * kSamples; ++k) {
            const int row = pixel / size * kSamples + k / kSamples, column = pixel % size * kSamples + k % kSamples;
            sum = sum + samples[row * width + column].color;
        }
        const Vec3 mean = (1.0f / (kSamples * kSamples)) * sum;
        for (const float channel : {mean.x, mean.y, mean.z}) pixels.push_back(stored(channel));
    }
    return pixels;
}

}  // namespace picture
