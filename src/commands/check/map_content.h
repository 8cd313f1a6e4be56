// SPDX-License-Identifier: MIT
// Content of an image that is used as a normal map: vectors in tangent space, as glTF requires, or something else.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "commands/check/map_texels.h"
#include "images/image.h"
#include "maps/layout/uv_coverage.h"
#include "tspace/map_files.h"

namespace tspace {

enum class MapContent {
    normals,      ///< vectors in tangent space; also if nothing else was detected
    twoChannels,  ///< x and y in red and green; blue is unrelated to z
    unsignedZ,    ///< blue is z, not (z + 1) / 2
    xInAlpha,     ///< x or y in alpha: x in alpha and y in green (DXT5nm), or another order
    exchanged,    ///< z is in a channel other than blue, or inverted
    encoded,      ///< vectors stored as colors: with the sRGB curve applied or removed
    objectSpace,  ///< directions in the coordinates of the mesh or the scene
    height,       ///< gray, or nearly gray
    picture,      ///< colors that are no unit vectors by any interpretation
    /// Hemi-octahedral encoding: x + y and x - y of (x, y, z) / (|x| + |y| + z), in the channels that the layout
    /// assigns to x and y.
    hemiOctahedral,
};

struct MapAnalysis {
    MapContent content = MapContent::normals;
    /// Layout for decoding the image to vectors in tangent space (or object space).
    MapLayout layout = {};
    std::uint64_t count = 0, total = 0;  ///< texels that support the result, and examined texels
    /// For objectSpace: the vectors follow the normals of the mesh. False: object space is assumed only because many
    /// vectors point down and none of the axes is their main direction.
    bool follows_mesh = false;
    /// For picture: only y is stored, in green, as in a DXT5nm map that lost its alpha channel with x.
    bool is_x_lost = false;
    /// For picture: red and green store a direction in the tangent plane, as in flow and anisotropy maps.
    bool holds_directions = false;
    /// For objectSpace: the vectors follow the normals as rotated by a node of the scene.
    bool is_in_world = false;
    /// For two channels: there is relief, but the channels may not be x and y, because the slopes fit no height field
    /// or fit better with octahedral encoding.
    bool is_doubtful = false;
    /// For `is_doubtful`: the slopes fit a height field better if the channels are x and y in octahedral encoding,
    /// (x, y, z) / (|x| + |y| + |z|).
    bool may_be_octahedral = false;
    /// For two channels: the slopes fit a height field with x and y in either order.
    bool is_order_open = false;
    bool is_declared = false;  ///< the texture file declares the layout
    /// The texture file declares sRGB, but its values are linear.
    bool is_marked_srgb = false;
};

/// Returns at most about 2^18 of the texels in `inside`, spread evenly. `alpha`: one per pixel, or empty.
std::vector<TexelBytes> sampleTexels(const RgbImage& image, std::span<const std::uint8_t> alpha,
                                     const TexelMask& inside);

/// Detects the content from the texels that triangles cover, using the lengths of the vectors, their mean direction,
/// and whether a channel is constant or all are equal. `surface`: distinguishes object space from exchanged channels;
/// may be empty. `in_world`: the same points with the normals in world space; empty if no node rotates them.
MapAnalysis analyzeTexels(std::span<const TexelBytes> texels, bool has_alpha, std::span<const TexelOnSurface> surface,
                          std::span<const TexelOnSurface> in_world = {});

/// Returns the share of texels that are unit vectors with x, y and z in red, green and blue.
double unitShare(std::span<const TexelBytes> texels);
/// Minimum unitShare of vectors in object space.
inline constexpr double kLeastUnitShare = 0.7;

/// Returns whether blue contains no information.
bool isBlueConstant(std::span<const TexelBytes> texels);

/// Returns whether the image, decoded by its layout, contains vectors in tangent space.
inline bool holdsNormals(MapContent content) {
    return content != MapContent::objectSpace && content != MapContent::height && content != MapContent::picture &&
           content != MapContent::hemiOctahedral;
}

/// Decodes the image by the layout, and stores x, y and z in red, green and blue. An image without alpha is decoded
/// with alpha 255.
void readByLayout(RgbImage& image, std::span<const std::uint8_t> alpha, const MapLayout& layout);

}  // namespace tspace
