// SPDX-License-Identifier: MIT
// Normal maps whose green channel is inverted, or that are rewritten: finds them in a glTF file, finds their other
// users, and replaces them.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "commands/check/map_content.h"
#include "model/gltf/container.h"
#include "model/gltf/editor.h"
#include "model/gltf/model.h"
#include "model/io/file_io.h"
#include "model/scene/scene.h"

namespace tspace {

// Decides which normal maps get an inverted green channel, and rewrites their files.

/// An image that is used as a normal map.
struct JudgedMap {
    std::size_t image = 0;
    Bytes flipped = {};          ///< image file with green inverted; empty: the image is unchanged
    MapAnalysis analysis = {};   ///< content of the image
    bool is_y_inverted = false;  ///< y is inverted, but is not stored in green
    NormalMapReport report = {};
};

/// Returns the image file with its green channel inverted. If that is not possible, returns nothing, and `why` is the
/// reason (a clause).
Bytes flipImage(std::span<const std::uint8_t> bytes, const MemoryBudget& budget, std::string& why);

/// Examines the normal maps of the scene, whose images must be loaded, and inverts those that FlipGreen selects
/// (FlipGreen::none: no map).
///
/// keeps_tangents    per primitive of the scene: whether inverted signs of its tangents stay inverted. They stay if the
///                   tangents are kept, and also if a repair or tangents for new normals keep signs that an inverted
///                   map cancels. Then FlipGreen::down leaves the map unchanged, because the two inversions cancel out
///
/// Throws FileError.
std::vector<JudgedMap> judgeMaps(const Scene& scene, const std::vector<bool>& keeps_tangents,
                                 const GenerateOptions& options);

// Rewrites images with contents that glTF does not support as normal maps.

/// Returns the image of `map` as a PNG with the encoding of glTF. `bytes`: the image file, possibly with green
/// inverted. If the image is unchanged, returns nothing, and `map.report` has the reason; otherwise `map.report`
/// describes the former contents. Throws FileError.
Bytes rewriteMap(const Scene& scene, ByteSpan bytes, const GenerateOptions& options, JudgedMap& map);

/// Calls rewriteMap() with the inverted image if there is one, otherwise with the image of the scene. If the image is
/// not rewritten, the reason is the one for which green was not inverted, if it was to be inverted.
Bytes rewriteJudgedMap(const Scene& scene, const GenerateOptions& options, JudgedMap& map);

struct ConvertedHeights {
    /// True if the image is gray, or cannot be decoded. Other images are treated as normal maps.
    bool is_height_map = false;
    Bytes file = {};           ///< PNG; empty: not converted
    std::string why_not = {};  ///< reason why it was not converted, as a clause
    double mean_lean_deg = 0;  ///< same meaning as HeightToNormalReport::mean_lean_deg
    std::string remarks = {};  ///< see takeRemarks
};

/// Converts height map `image` to a normal map for all primitives of the material; white is `strength` units high.
/// Throws FileError.
ConvertedHeights normalMapFromHeights(const Scene& scene, std::size_t material, std::size_t image, double strength,
                                      const GenerateOptions& options);

}  // namespace tspace

namespace tspace::gltf {

struct MapFlips {
    std::map<std::size_t, Bytes> images = {};  ///< image files with green inverted; key: image index
    /// Rewritten image files, with or without inverted green; key: image index.
    std::map<std::size_t, Bytes> mended = {};
    std::vector<NormalMapReport> reports = {};
};

/// Decides which normal maps are changed; call before anything in the document changes. Images that are alternatives in
/// one texture are changed together or not at all. `reports`: planned actions for the tangents, one per primitive of
/// the document.
MapFlips planFlips(Model& model, std::span<const PrimitiveReport> reports, const GenerateOptions& options);

/// Writes the new images into the document. An image with other uses, such as a base color, is kept, and normal maps
/// get a new image. Files referenced by the document are never changed: the output has new files.
void applyFlips(Document& document, Editor& editor, const OutputTarget& target, MapFlips&& flips);

}  // namespace tspace::gltf
