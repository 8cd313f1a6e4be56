// SPDX-License-Identifier: MIT
#include "pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/vec_math.h"

namespace tspace::bench {

namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kGain = 100;

struct Point2 {
    double u, v;
};

struct Mesh {
    std::vector<DVec3> positions;
    std::vector<Point2> uvs;
    test::FrameList frames;
    std::vector<std::size_t> indices;
};

DVec3 unitOf(const DVec3& v) { return (1 / length(v)) * v; }
Vec4 withSign(const DVec3& v, double sign) {
    const Vec3 f = toFloat(v);
    return {f.x, f.y, f.z, static_cast<float>(sign)};
}

/// Rotates to a view from the front and above.
DVec3 turned(const DVec3& v) {
    constexpr double kTilt = 0.5;
    const double c = std::cos(kTilt), s = std::sin(kTilt);
    return {v.x, c * v.y - s * v.z, s * v.y + c * v.z};
}

/// Returns a grid of a closed surface around the y axis. at(longitude, latitude), both from 0 to 1, returns a point. u
/// runs from the front to the back on both sides, so that one half is mirrored.
template <class At>
Mesh gridOf(At at) {
    constexpr int kAround = 96, kAcross = 48;
    Mesh mesh;
    for (int side = 0; side < 2; ++side) {
        const std::size_t first = mesh.positions.size();
        for (int i = 0; i <= kAround / 2; ++i) {
            for (int j = 0; j <= kAcross; ++j) {
                const double u = 2.0 * i / kAround, v = static_cast<double>(j) / kAcross;
                const double way = side == 0 ? 0.5 : -0.5, h = 1e-4;
                const double inner = std::clamp(v, h, 1 - h);  // poles have no direction along u
                const DVec3 along_u = way * (at(way * u + h, inner) - at(way * u - h, inner));
                const DVec3 along_v = at(way * u, inner + h) - at(way * u, inner - h);
                const DVec3 n = unitOf((side == 0 ? 1.0 : -1.0) * cross(along_u, along_v)), t = unitOf(along_u);
                mesh.positions.push_back(turned(at(way * u, v)));
                mesh.uvs.push_back({u, v});
                mesh.frames.add(toFloat(turned(n)), withSign(turned(t), side == 0 ? 1 : -1));
            }
        }
        for (std::size_t i = 0; i < kAround / 2; ++i) {
            for (std::size_t j = 0; j < kAcross; ++j) {
                const std::size_t a = first + i * (kAcross + 1) + j, b = a + kAcross + 1;
                mesh.indices.insert(mesh.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
            }
        }
    }
    return mesh;
}

Mesh sphere() {
    return gridOf([](double around, double across) {
        const double lon = 2 * kPi * around, lat = kPi * (across - 0.5);
        return DVec3{0.95 * std::cos(lat) * std::sin(lon), 0.95 * std::sin(lat), 0.95 * std::cos(lat) * std::cos(lon)};
    });
}
Mesh torus() {
    return gridOf([](double around, double across) {
        const double lon = 2 * kPi * around, lat = 2 * kPi * (across - 0.5), r = 0.62 + 0.32 * std::cos(lat);
        return DVec3{r * std::sin(lon), 0.32 * std::sin(lat), r * std::cos(lon)};
    });
}

/// Returns a tangent-space normal of a bumpy map.
DVec3 texelAt(double u, double v) {
    const double bumps = 2 * kPi * 8;
    return unitOf({0.35 * std::cos(bumps * u), 0.35 * std::cos(bumps * v), 1});
}

/// Shades as MikkTSpace prescribes, with one light and its specular highlight.
double shade(const DVec3& normal, const DVec3& tangent, double sign, double u, double v) {
    const DVec3 texel = texelAt(u, v), bitangent = sign * cross(normal, tangent);
    const DVec3 n = unitOf(texel.x * tangent + texel.y * bitangent + texel.z * normal);
    const DVec3 light = unitOf({-0.5, 0.7, 1}), half_way = unitOf(light + DVec3{0, 0, 1});
    const double highlight = std::pow(std::max(0.0, dot(n, half_way)), 60);
    return 0.05 + 0.55 * std::max(0.0, dot(n, light)) + 0.4 * highlight;
}

struct Pixels {
    std::vector<double> shade, depth;
};

/// Draws an orthographic view along -z with a depth test. Shades below 0 mark the background.
Pixels draw(const Mesh& mesh, const test::FrameList& frames, int size) {
    const std::size_t count = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    Pixels pixels{std::vector<double>(count, -1), std::vector<double>(count, std::numeric_limits<double>::lowest())};
    const double scale = size / 2.0;
    for (std::size_t at = 0; at < mesh.indices.size(); at += 3) {
        const std::size_t* v = &mesh.indices[at];
        const DVec3 &a = mesh.positions[v[0]], &b = mesh.positions[v[1]], &c = mesh.positions[v[2]];
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (area == 0) continue;
        const auto first = [&](double low) { return std::max(0, static_cast<int>((low + 1) * scale)); };
        const auto last = [&](double high) { return std::min(size - 1, static_cast<int>((high + 1) * scale)); };
        for (int row = first(std::min({a.y, b.y, c.y})); row <= last(std::max({a.y, b.y, c.y})); ++row) {
            for (int column = first(std::min({a.x, b.x, c.x})); column <= last(std::max({a.x, b.x, c.x})); ++column) {
                const double x = (column + 0.5) / scale - 1, y = (row + 0.5) / scale - 1;
                const double wb = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
                const double wc = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area, wa = 1 - wb - wc;
                if (wa < 0 || wb < 0 || wc < 0) continue;
                const double z = wa * a.z + wb * b.z + wc * c.z;
                const auto pixel = static_cast<std::size_t>((size - 1 - row) * size + column);
                if (z <= pixels.depth[pixel]) continue;
                pixels.depth[pixel] = z;
                const double weights[3] = {wa, wb, wc};
                DVec3 n{}, t{};
                double uv[2] = {0, 0};
                for (int k = 0; k < 3; ++k) {
                    const Vec4& tangent = frames.tangents[v[k]];
                    n = n + weights[k] * toDouble(frames.normals[v[k]]);
                    t = t + weights[k] * toDouble(Vec3{tangent.x, tangent.y, tangent.z});
                    uv[0] += weights[k] * mesh.uvs[v[k]].u;
                    uv[1] += weights[k] * mesh.uvs[v[k]].v;
                }
                pixels.shade[pixel] = shade(n, t, frames.tangents[v[0]].w, uv[0], uv[1]);
            }
        }
    }
    return pixels;
}

std::uint8_t grayOf(double x) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.0, 1.0))); }

}  // namespace

Picture differencePicture(const std::vector<Code>& codes, int size) {
    const int columns = static_cast<int>(codes.size()) + 1;
    Picture picture{columns * size, 2 * size, {}};
    picture.gray.assign(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), 255);
    const Mesh meshes[] = {sphere(), torus()};
    for (int row = 0; row < 2; ++row) {
        const Mesh& mesh = meshes[row];
        const Pixels exact = draw(mesh, mesh.frames, size);
        for (int column = 0; column < columns; ++column) {
            test::FrameList frames = mesh.frames;
            if (column > 0) {
                frames.resize(kBatch);  // pads to a full batch with zero frames, which the encoder repairs
                codes[static_cast<std::size_t>(column - 1)].encode(frames);
                codes[static_cast<std::size_t>(column - 1)].decode(frames);
            }
            const Pixels shaded = draw(mesh, frames, size);
            for (std::size_t i = 0; i < exact.shade.size(); ++i) {
                if (exact.shade[i] < 0) continue;
                const std::size_t y = static_cast<std::size_t>(row * size) + i / static_cast<std::size_t>(size);
                const std::size_t x = static_cast<std::size_t>(column * size) + i % static_cast<std::size_t>(size);
                picture.gray[y * static_cast<std::size_t>(picture.width) + x] =
                    grayOf(column == 0 ? exact.shade[i] : kGain * std::fabs(shaded.shade[i] - exact.shade[i]));
            }
        }
    }
    return picture;
}

}  // namespace tspace::bench
