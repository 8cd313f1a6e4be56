// SPDX-License-Identifier: MIT
// Normal maps whose green channel is inverted, or that are written anew: which they are, where they lie in a glTF file, who else
// reads them, and putting the new ones in their place.
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

// Decides which normal maps get their green channel inverted, and rewrites their files.

/// One image that is a normal map.
struct JudgedMap {
    std::size_t image = 0;
    Bytes flipped = {};          ///< the image file with green inverted; empty: it stays as it is
    MapLook look = {};           ///< content of the image
    bool is_y_inverted = false;  ///< y is, which is not in green
    NormalMapReport report = {};
};

/// The image file with its green channel inverted; nothing, with the reason in `why` (half a sentence), where that is not
/// possible.
Bytes flipImage(std::span<const std::uint8_t> bytes, const MemoryBudget& budget, std::string& why);

/// Looks at the normal maps of the scene, which has its images, and inverts those that FlipGreen says (all stay with
/// FlipGreen::none).
///
/// keeps_tangents    per primitive of the scene: its tangents stay, or a repair leaves what a normal map cancels. Where
///                   their signs are inverted too, the two cancel out, and FlipGreen::down leaves the map alone
///
/// Throws FileError.
std::vector<JudgedMap> judgeMaps(const Scene& scene, const std::vector<bool>& keeps_tangents,
                                 const GenerateOptions& options);

// Images that hold something else than glTF reads, written anew as normal maps.

/// The image of `map` as a PNG that glTF reads. `bytes`: the image file, or what became of it. Empty where it stays, with
/// the reason in `map.report`, which else says what the image held. Throws FileError.
Bytes mendMap(const Scene& scene, ByteSpan bytes, const GenerateOptions& options, JudgedMap& map);

struct MadeOfHeights {
    /// The image is grey, or broken. If not, it is taken as a normal map.
    bool is_height_map = false;
    Bytes file = {};           ///< a PNG; empty where there is none
    std::string why_not = {};  ///< half a sentence
    double mean_lean_deg = 0;  ///< like HeightToNormalReport::mean_lean_deg
};

/// A normal map of image `image`, on all primitives of the material, white being `strength` units high. Throws FileError.
MadeOfHeights makeOfHeights(const Scene& scene, std::size_t material, std::size_t image, double strength,
                            const GenerateOptions& options);

}  // namespace tspace

namespace tspace::gltf {

struct MapFlips {
    std::map<std::size_t, Bytes> images = {};  ///< image files with green inverted, by number of their image
    std::map<std::size_t, Bytes> mended = {};  ///< images that are rewritten, with or without inverted green
    std::vector<NormalMapReport> reports = {};
};

/// Decides about the normal maps of the document, before anything in it is changed. An image that another format of the
/// same texture stands beside goes only with it. `reports`: what becomes of the tangents of its primitives, which are all
/// of the document's.
MapFlips planFlips(Model& model, std::span<const PrimitiveReport> reports, const GenerateOptions& options);

/// Puts them in. An image that is something else as well, such as a base colour, stays, and the normal maps get one of
/// their own. Files beside the document are never changed: the output has new ones.
void applyFlips(Document& document, Editor& editor, const OutputTarget& target, MapFlips&& flips);

}  // namespace tspace::gltf
