// SPDX-License-Identifier: MIT
// Small random meshes for which implementations of MikkTSpace differ easily: soups and sheets of triangles and quads
// with equal, collapsed, mirrored and huge values.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "core/tangents/shapes.h"

namespace tspace::test {

/// Random numbers with few distinct values, so that many are equal, collapsed or parallel.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : random_(seed) {}

    int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
    float fraction() { return static_cast<float>(random_() >> 40) / 16777216.0f; }
    /// Returns a number. `kind`: 0 integers, 1 halves, 2 any number from -1 to 1, 3 numbers of any size, 4 like 2 but
    /// sometimes NaN, infinite, 3e38 or -0.
    float number(int kind) {
        switch (kind) {
            case 0: return static_cast<float>(below(3) - 1);
            case 1: return static_cast<float>(below(5)) * 0.5f - 1;
            case 3: return std::ldexp(fraction() * 2 - 1, below(60) - 30);
            case 4: {
                constexpr float kInfinity = std::numeric_limits<float>::infinity();
                constexpr float kStrange[] = {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity, 3e38f,
                                              -0.0f};
                const int pick = below(40);
                return pick < 5 ? kStrange[pick] : fraction() * 2 - 1;
            }
            default: return fraction() * 2 - 1;
        }
    }
    /// Returns a normal, with length 1 in three of four cases.
    Vec3 normal(int kind) {
        const Vec3 n{number(kind), number(kind), number(kind)};
        const float length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        return below(4) == 0 || !(length > 1e-6f) ? n : Vec3{n.x / length, n.y / length, n.z / length};
    }

  private:
    std::mt19937_64 random_;
};

using Faces = std::vector<std::vector<std::uint32_t>>;

/// Adds a sheet of up to 5 x 5 cells, quads or triangles, whose UVs alternate in direction and sometimes collapse.
inline Faces addSheet(Dice& dice, SimpleMesh& shape, int normal_kind) {
    const std::uint32_t width = 1 + dice.below(5), height = 1 + dice.below(5);
    const bool flat = dice.below(2) != 0;
    const float fold = static_cast<float>(1 + dice.below(3));
    for (std::uint32_t y = 0; y <= height; ++y) {
        for (std::uint32_t x = 0; x <= width; ++x) {
            const auto column = static_cast<float>(x), row = static_cast<float>(y);
            const Vec3 position{column + 0.3f * dice.fraction(), row + 0.3f * dice.fraction(),
                                flat ? 0 : dice.fraction()};
            const float u = dice.below(12) == 0 ? 0 : std::fabs(std::fmod(column, 2 * fold) - fold);
            shape.addVertex(position, flat ? kUp : dice.normal(normal_kind), {u, row * 0.5f + 0.1f * dice.fraction()});
        }
    }
    Faces faces;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::uint32_t a = y * (width + 1) + x, b = a + 1, d = a + width + 1, c = d + 1;
            const int cut = dice.below(3);
            if (cut == 0) faces.push_back({a, b, c, d});
            if (cut == 1) faces.insert(faces.end(), {{a, b, c}, {a, c, d}});
            if (cut == 2) faces.insert(faces.end(), {{a, b, d}, {b, c, d}});
        }
    }
    return faces;
}

/// Adds triangles and quads over a few positions, normals and UVs.
inline Faces addSoup(Dice& dice, SimpleMesh& shape, int position_kind, int normal_kind, int uv_kind) {
    std::vector<Vec3> positions(2 + dice.below(9)), normals(1 + dice.below(4));
    std::vector<Vec2> uvs(2 + dice.below(7));
    for (Vec3& p : positions) {
        p = {dice.number(position_kind), dice.number(position_kind), dice.below(2) ? 0 : dice.number(position_kind)};
    }
    for (Vec3& n : normals) n = dice.normal(normal_kind);
    for (Vec2& uv : uvs) uv = {dice.number(uv_kind), dice.number(uv_kind)};
    const auto any = [&dice](const auto& list) { return list[dice.below(static_cast<int>(list.size()))]; };
    const int vertices = 3 + dice.below(20);
    for (int v = 0; v < vertices; ++v) shape.addVertex(any(positions), any(normals), any(uvs));
    Faces faces(1 + dice.below(24));
    const int quads = dice.below(3);  // none of the faces, about half of them, or all of them
    for (auto& face : faces) {
        face.resize(quads == 0 || (quads == 1 && dice.below(2) != 0) ? 3 : 4);
        for (std::uint32_t& v : face) v = dice.below(vertices);
    }
    return faces;
}

/// Returns a mesh whose faces are in random order and start at any corner. `strange`: some values are NaN, infinite or
/// 3e38.
inline SimpleMesh randomShape(Dice& dice, bool strange) {
    SimpleMesh shape;
    const int position_kind = strange ? 4 : dice.below(4);
    const int normal_kind = strange ? 2 + 2 * dice.below(2) : dice.below(4);
    const int uv_kind = strange ? 1 + 3 * dice.below(2) : dice.below(4);
    Faces faces = dice.below(4) == 0 ? addSheet(dice, shape, normal_kind)
                                     : addSoup(dice, shape, position_kind, normal_kind, uv_kind);
    for (std::size_t i = faces.size(); i > 1; --i) std::swap(faces[i - 1], faces[dice.below(static_cast<int>(i))]);
    for (auto& face : faces) {
        std::rotate(face.begin(), face.begin() + dice.below(static_cast<int>(face.size())), face.end());
        shape.addFace(face);
    }
    return shape;
}

inline float randomThreshold(Dice& dice) {
    constexpr float kUsual[] = {180, 180, 180, 180, 0, 10, 45, 90, 135, 179, 181, 270, 360};
    return dice.below(4) == 0 ? dice.fraction() * 360 : kUsual[dice.below(std::size(kUsual))];
}

struct RandomCase {
    SimpleMesh shape;
    float threshold_deg = 180;
};

/// Returns random case `number`, which is the same on all machines. Every fifth case has values that are not finite.
inline RandomCase randomCase(std::uint64_t number) {
    Dice dice(0x9E3779B97F4A7C15u * (number + 1));
    SimpleMesh shape = randomShape(dice, number % 5 == 4);
    return {std::move(shape), randomThreshold(dice)};
}

}  // namespace tspace::test
