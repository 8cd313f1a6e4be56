// SPDX-License-Identifier: MIT
// Images that hold something else than glTF reads, written anew as normal maps.
#pragma once

#include <string>

#include "commands/check/judge_maps.h"
#include "model/io/file_io.h"
#include "model/scene/scene.h"

namespace tspace {

/// The image of `map` as a PNG that glTF reads. `bytes`: the image file, or what became of it. Empty where it stays, with
/// the reason in `map.report`, which else says what the image held. Throws FileError.
Bytes mendMap(const Scene& scene, ByteSpan bytes, const GenerateOptions& options, JudgedMap& map);

struct MadeOfHeights {
    /// The image is grey, or broken. If not, it is taken as a normal map.
    bool is_height_map = false;
    Bytes file = {};           ///< a PNG; empty where there is none
    std::string why_not = {};  ///< half a sentence
    double mean_lean_deg = 0;  ///< HeightToNormalReport
};

/// A normal map of image `image`, on all primitives of the material, white being `strength` units high. Throws FileError.
MadeOfHeights makeOfHeights(const Scene& scene, std::size_t material, std::size_t image, double strength,
                            const GenerateOptions& options);

}  // namespace tspace
