// SPDX-License-Identifier: MIT
// Layout shared by the mesh and the textures of the crate: a rounded cube whose left half uses the right half's
// texture, mirrored.
//
// Layout of the texture (u right, v down), in units of the cube's edge; one edge is half of the texture:
//
//     0    0.25   0.5          1
//     +-----+-----+-----------+
//     | top |under|           |     top, front, under, back: half a side each. u is the distance from the plane
//     |     |     |   right   |     x = 0, so the halves x > 0 and x < 0 share it, the second one mirrored.
//     +-----+-----+-----------+     top continues into front, under into back; right and left are separate.
//     |front| back|           |
//     |     |     |   left    |
//     +-----+-----+-----------+
#pragma once

#include <cstdint>
#include <vector>

namespace crate {

/// Half of the cube's edge, in meters.
inline constexpr double kHalfEdge = 0.5;
/// Radius of the rounded edges, in meters.
inline constexpr double kBevelRadius = 0.08;
/// Arc length of the bevel's cross section from a flat side to the middle of the edge: an eighth of a circle, pi/4 * r.
inline constexpr double kBevelArc = 0.78539816339744831 * kBevelRadius;
/// Half of an unrolled side: the flat part and the bevel up to its middle.
inline constexpr double kHalfUnrolled = kHalfEdge - kBevelRadius + kBevelArc;

enum class Side { top, front, under, back, right, left };
inline constexpr int kSideCount = 6;

/// Texture coordinates per meter: a side uses half of the texture, the rest is a gutter around it.
inline constexpr double kUvPerMeter = 0.5;

/// Texture coordinates of the center of a side.
struct Place {
    double u, v;
};
constexpr Place placeOf(Side side) {
    constexpr double half = kUvPerMeter * kHalfUnrolled;
    constexpr double strip_u = (0.25 - half) / 2, strip_v = (1 - 4 * half) / 2;
    switch (side) {
        case Side::top: return {strip_u, strip_v + half};
        case Side::front: return {strip_u, strip_v + 3 * half};
        case Side::under: return {0.25 + strip_u, strip_v + half};
        case Side::back: return {0.25 + strip_u, strip_v + 3 * half};
        case Side::right: return {0.75, 0.25};
        case Side::left: return {0.75, 0.75};
    }
    return {0, 0};
}
/// Returns whether the halves x > 0 and x < 0 of the side use the same texels.
constexpr bool isMirrored(Side side) { return side != Side::right && side != Side::left; }

struct Mesh {
    std::vector<float> positions;  ///< 3 per vertex
    std::vector<float> normals;    ///< 3 per vertex
    std::vector<float> uvs;        ///< 2 per vertex
    std::vector<std::uint16_t> indices;
};

/// Creates the mesh. Normals are smooth across the bevels; UV seams run along the middle of most bevels.
Mesh makeMesh();

struct Image {
    int size = 0;  ///< width and height, in texels
    std::vector<std::uint8_t> rgb;
};

struct Textures {
    Image base_color;  ///< sRGB
    Image normal;      ///< tangent space, green up
};

/// Creates images of `size` by `size` texels.
Textures makeTextures(int size = 1024);

}  // namespace crate
