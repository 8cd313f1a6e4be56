// SPDX-License-Identifier: MIT
// The checks of a whole scene: its normal maps, its packed frames, and seams between its primitives.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/check/map_content.h"
#include "commands/check/normal_map.h"
#include "commands/check/remedy.h"
#include "model/scene/scene.h"
#include "tspace/check.h"

namespace tspace {

// The normal maps of a scene.

/// What is known of green in one normal map, or in the part of it that one primitive shows. Where the file declares that it
/// points down, and it does, that is up: its readers turn it.
enum class GreenSide {
    noMap,    ///< the primitive's tangents are for no normal map
    unread,   ///< the image could not be looked at
    unknown,  ///< it was, and says nothing: flat, or no height field
    up,
    down,
    mixed,  ///< up in one part and down in another
};

struct ImageFindings {
    std::vector<Finding> findings = {};
    std::vector<std::size_t> images = {};     ///< per finding: which image
    std::vector<GreenSide> image_green = {};  ///< per image of the scene
    /// Per primitive of the scene: of the normal map that its tangents are for (the first of its uses), in those texels
    /// that the primitive shows.
    std::vector<GreenSide> primitive_green = {};
    std::uint64_t looked_at = 0;           ///< images that could be decoded
    std::uint64_t green_told = 0;          ///< maps of these whose direction of green is known
    std::vector<MapLook> looks = {};       ///< per image of the scene: what its channels hold
    std::vector<bool> is_y_inverted = {};  ///< per image: y is, and no finding on green says so, since it is elsewhere
    std::vector<bool> is_declared = {};    ///< per image: the file says that green points down (TangentUse)
};

/// Looks at every image that is a normal map, once.
ImageFindings checkImages(const Scene& scene, const CheckOptions& options);

/// Looks at scene.images[0], which no primitive shows, as checkImages does. Throws FileError where it cannot be read.
struct LoneMap {
    MapLook look = {};
    GreenTest test = {};
    RgbImage pixels = {};  ///< pixels as stored, 8 bits
    std::vector<Finding> findings = {};
};
LoneMap checkLoneMap(const Scene& scene, const CheckOptions& options);

/// A note for each normal map whose scale is 0 or below.
std::vector<Finding> checkMapScales(const Scene& scene);

/// The file of an image that has no name of its own, or none that can be a word of a command line.
inline constexpr const char* kUnnamed = "MAP";

/// An image as findings name it.
struct NamedImage {
    std::string name = {};  ///< with quotes
    std::string file = {};  ///< in a command line; or kUnnamed
    bool is_alone = false;  ///< no model shows it, so there is nothing that generate could do
};

/// `verb` on the image, with OUT.png as output.
RemedyCommand imageCommand(const char* verb, const NamedImage& image);
RemedyCommand convertCommand(const NamedImage& image);

/// `green_is_down`: the channel that holds y is also inverted. Nothing for normals.
std::optional<Finding> contentFinding(const NamedImage& image, const MapLook& look, bool green_is_down);

// The packed frames of a scene.

struct PackedFindings {
    std::vector<Finding> findings = {};
    std::vector<PackedFramesInfo> infos = {};  ///< all that there are, in the order of the scene
};

/// Reads all packed frames back and compares them with the normals and tangents beside them; each once, however many
/// primitives share them.
PackedFindings checkPacked(const Scene& scene, const CheckOptions& options);

// Seams in the shading between primitives of one mesh.

/// Notes on pairs of primitives of a mesh that are one smooth surface, but whose normals differ at their border because each
/// has those of its own triangles alone. A note stands only where the border cannot be an intended hard edge: its bend is no
/// larger than what both sides smooth over elsewhere, and smaller than any edge that they have hard.
std::vector<Finding> checkSeams(const Scene& scene, const CheckOptions& options);

}  // namespace tspace
