// SPDX-License-Identifier: MIT
// Checks of a whole scene: its normal maps, its packed frames, and seams between its primitives.
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

struct CheckedModel {
    CheckReport report = {};
    std::uint64_t without_uvs_count = 0;  ///< primitives with triangles, but without UVs
};

/// Checks a model like checkFile, as a step of another command. Throws FileError.
CheckedModel checkModel(const std::string& input, const CheckOptions& options);
/// Checks a scene like checkModel. `options` must be valid; if they include the examination of images, the scene must
/// have been read with its images.
CheckedModel checkScene(const Scene& scene, const CheckOptions& options);

// Normal maps of a scene.

/// Direction of green in one normal map, or in the part of it that one primitive covers. If the file declares
/// green-down and green points down, the value is `up`, because readers invert it.
enum class GreenSide {
    noMap,    ///< the tangents of the primitive belong to no normal map
    unread,   ///< the image could not be examined
    unknown,  ///< examined without result: flat, or not a height field
    up,
    down,
    mixed,  ///< up in one part and down in another
};

struct ImageFindings {
    std::vector<Finding> findings = {};
    std::vector<std::size_t> images = {};     ///< per finding: index of its image
    std::vector<GreenSide> image_green = {};  ///< per image of the scene
    /// Per primitive of the scene: direction of green in the normal map that its tangents belong to (the first of its
    /// uses), in the texels that the primitive covers.
    std::vector<GreenSide> primitive_green = {};
    std::uint64_t examined_count = 0;        ///< number of images that could be decoded
    std::uint64_t green_known_count = 0;     ///< number of decoded maps whose direction of green is known
    std::vector<MapAnalysis> analyses = {};  ///< per image of the scene: content of its channels
    /// Per image: y is inverted but is not stored in green, so no finding on green reports it.
    std::vector<bool> is_y_inverted = {};
    std::vector<bool> is_declared = {};  ///< per image: the file declares that green points down (TangentUse)
};

/// Examines each image that is used as a normal map, once.
ImageFindings checkImages(const Scene& scene, const CheckOptions& options);

/// Result of checkLoneMap, which examines scene.images[0] like checkImages, although no primitive uses the image.
/// Throws FileError if the image cannot be read.
struct LoneMap {
    MapAnalysis analysis = {};
    GreenTest test = {};
    RgbImage pixels = {};  ///< pixels as stored, 8 bits
    std::vector<Finding> findings = {};
};
LoneMap checkLoneMap(const Scene& scene, const CheckOptions& options);

/// Returns a note for each normal map whose scale is 0 or negative.
std::vector<Finding> checkMapScales(const Scene& scene);

/// Placeholder for the file name of an image without a name, or with a name that cannot be one word of a command line.
inline constexpr const char* kUnnamed = "MAP";

/// Names of an image in findings.
struct NamedImage {
    std::string name = {};  ///< name in quotes
    std::string file = {};  ///< name, quoted for a command line, or kUnnamed
    bool is_alone = false;  ///< no model uses the image, so generate does not apply
};

/// Returns the remedy that converts an image to what glTF requires. Each of its commands fixes all faults of the map.
/// `green_is_down`: the channel that contains y is also inverted.
Remedy conversionRemedy(const NamedImage& image, const MapAnalysis& analysis, bool green_is_down);

/// Returns the remedy of greenFlipped. Its commands also convert the channels.
Remedy greenRemedy(const NamedImage& image, const MapAnalysis& analysis);

/// Returns the finding on the content of a map, or nothing for normals. `green_is_down`: see conversionRemedy.
std::optional<Finding> contentFinding(const NamedImage& image, const MapAnalysis& analysis, bool green_is_down);

// Packed frames of a scene.

struct PackedFindings {
    std::vector<Finding> findings = {};
    std::vector<PackedFramesInfo> infos = {};  ///< all packed frames, in the order of the scene
};

/// Unpacks all packed frames and compares them with the normals and tangents of the same primitive. Frames that several
/// primitives share are compared once.
PackedFindings checkPacked(const Scene& scene, const CheckOptions& options);

// Shading seams between primitives of one mesh.

/// Returns notes on pairs of primitives of a mesh that form one smooth surface, but whose normals differ at their
/// border because each uses only its own triangles. A note is made only if the border cannot be an intended hard edge.
/// Its bend must be at most slightly larger than the bend of other smooth edges on both sides, and smaller than the
/// bend of any hard edge.
std::vector<Finding> checkSeams(const Scene& scene, const CheckOptions& options);

}  // namespace tspace
