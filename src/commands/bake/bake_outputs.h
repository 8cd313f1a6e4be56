// SPDX-License-Identifier: MIT
// File names of the outputs of a bake.
#pragma once

#include <string>
#include <vector>

#include "commands/bake/model_surfaces.h"
#include "tspace/bake_file.h"

namespace tspace {

/// Returns "dir/name.WORD.png" for "dir/name.png", or the path itself for an empty word.
std::string withWord(const std::string& path, const std::string& word);

/// Returns "dir/name_LAYER.png" for "dir/name.png".
std::string withLayer(const std::string& path, MapLayer layer);

/// Returns the word of each image of a low poly, in order: the name of its material, made unique if names repeat. A
/// single image has an empty word.
std::vector<std::string> imageWords(const LowModel& low);

/// Returns the word of a tile of an image.
std::string tileWord(const std::string& image, std::uint32_t tile);

/// Paths from which the names of maps are derived.
struct BakeNames {
    std::string output = {};         ///< path of the normal map
    std::string layers_output = {};  ///< path from which the paths of all other maps are derived; empty: `output`
};

/// Returns all outputs of a bake for a low poly with one image and no tiles. Reads no file.
std::vector<std::string> plainOutputs(const BakeNames& bake, const BakeFileOptions& options);

/// Returns all outputs of a bake for this low poly, which is read for its materials and tiles. Throws FileError.
std::vector<std::string> outputsFor(const std::string& low, const BakeNames& bake, const BakeFileOptions& options);

/// Returns all outputs of a bake, to compare them with `others`, the other outputs of the command line (or empty
/// strings). The low poly is read only if its materials or tiles could give a map one of these names.
std::vector<std::string> outputsToCompare(const std::vector<std::string>& others, const std::string& low,
                                          const BakeNames& bake, const BakeFileOptions& options);

/// Returns the paths from which an image word can lead to this path: "dir/a.b.png" and "dir/a.png" for "dir/a.b.c.png".
std::vector<std::string> withoutWords(const std::string& path);

}  // namespace tspace
