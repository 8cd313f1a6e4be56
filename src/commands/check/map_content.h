// SPDX-License-Identifier: MIT
// What an image that is used as a normal map holds: vectors in tangent space, as glTF wants them, or something else.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "images/image.h"
#include "maps/layout/uv_coverage.h"
#include "tspace/map_files.h"
#include "tspace/span.h"

namespace tspace {

enum class MapContent {
    normals,      ///< vectors in tangent space; or nothing that says otherwise
    twoChannels,  ///< x and y in red and green; blue says nothing about z
    unsignedZ,    ///< blue is z itself, and not (z + 1) / 2
    xInAlpha,     ///< x in alpha and y in green (DXT5nm)
    exchanged,    ///< z is in another channel than blue, or inverted
    encoded,      ///< vectors, but stored as colours: with the sRGB curve put on, or taken off
    objectSpace,  ///< directions in the coordinates of the mesh or the scene
    height,       ///< grey, or nearly
    picture,      ///< colours, which are no unit vectors under any reading
    /// Hemi-octahedral: x + y and x - y of (x, y, z) / (|x| + |y| + z), in the channels that the layout has as x and y.
    hemiOctahedral,
};

/// A texel: red, green, blue, alpha.
using TexelBytes = std::array<std::uint8_t, 4>;

/// Sample of the map on a triangle.
struct TexelOnSurface {
    Vec3 normal = {};  ///< normal of the mesh, possibly rotated by a node; unit
    TexelBytes texel = {};
    double weight = 0;  ///< area
    Vec2 uv = {};
};

struct MapLook {
    MapContent content = MapContent::normals;
    /// How a reader gets vectors in tangent space (or object space) out of it.
    MapLayout layout = {};
    std::uint64_t count = 0, total = 0;  ///< texels that say so, of those that were looked at
    /// With objectSpace: the normals of the mesh show it. Otherwise the directions only point all around.
    bool follows_mesh = false;
    /// With picture: y alone is there, in green, as in a DXT5nm map that lost its alpha, and x with it.
    bool is_x_lost = false;
    /// With objectSpace: the normals are as a node of the scene turns them.
    bool is_in_world = false;
    /// With two channels: there is relief, and as x and y these channels are the slopes of no height.
    bool is_doubtful = false;
    bool is_declared = false;  ///< the texture file declares the layout
};

/// Some of the texels in `inside`, spread evenly: at most about 2^18. `alpha`: one per pixel, or empty.
std::vector<TexelBytes> sampleTexels(const RgbImage& image, std::span<const std::uint8_t> alpha,
                                     const TexelMask& inside);

/// Decides by the texels that triangles show. Three tests: the lengths of the vectors, where they point in the mean, and
/// whether a channel is constant or all are equal. `surface`: tells object space from exchanged channels; may be empty.
/// `in_world`: these points with the normals that the scene shows; empty where no node turns them.
MapLook lookAtTexels(std::span<const TexelBytes> texels, bool has_alpha, std::span<const TexelOnSurface> surface,
                     std::span<const TexelOnSurface> in_world = {});

/// Whether red has no information, so that alpha has to be looked at.
bool mayHaveXInAlpha(std::span<const TexelBytes> texels);

/// Whether blue has no information.
bool isBlueConstant(std::span<const TexelBytes> texels);

/// Whether the layout reads vectors in tangent space out of the image.
inline bool holdsNormals(MapContent content) {
    return content != MapContent::objectSpace && content != MapContent::height && content != MapContent::picture &&
           content != MapContent::hemiOctahedral;
}

/// Makes of the image what a reader of the layout sees: x, y and z in red, green and blue. Without an alpha channel, 255
/// counts.
void readByLayout(RgbImage& image, std::span<const std::uint8_t> alpha, const MapLayout& layout);

}  // namespace tspace
