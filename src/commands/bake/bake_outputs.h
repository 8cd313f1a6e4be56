// SPDX-License-Identifier: MIT
// How a bake names its files.
#pragma once

#include <string>
#include <vector>

#include "commands/bake/model_surfaces.h"
#include "tspace/bake_file.h"

namespace tspace {

/// "dir/name.WORD.png" of "dir/name.png"; the path itself without a word.
std::string withWord(const std::string& path, const std::string& word);

/// "dir/name_LAYER.png" of "dir/name.png".
std::string withLayer(const std::string& path, MapLayer layer);

/// The word of each image of a low poly, in its order: its material, told apart where two are alike. One image has none.
std::vector<std::string> imageWords(const LowModel& low);

/// The word of a tile of an image.
std::string tileWord(const std::string& image, std::uint32_t tile);

/// From which paths the names of maps are made.
struct BakeNames {
    std::string output = {};         ///< path of the normal map
    std::string layers_output = {};  ///< path from which those of all other maps are derived; empty: `output`
};

/// Everything that a bake writes for a low poly of one image and without tiles. Reads no file.
std::vector<std::string> plainOutputs(const BakeNames& bake, const BakeFileOptions& options);

/// Everything that a bake writes for this low poly, which is read for its materials and tiles. Throws FileError.
std::vector<std::string> outputsFor(const std::string& low, const BakeNames& bake, const BakeFileOptions& options);

/// Everything that a bake writes, for a comparison with `others`: further outputs of the same command line, or empty texts.
/// The low poly is read only where its materials or tiles could give a map one of these names.
std::vector<std::string> outputsBeside(const std::vector<std::string>& others, const std::string& low,
                                       const BakeNames& bake, const BakeFileOptions& options);

/// Names of which an image of a low poly makes this one: "dir/a.b.png" and "dir/a.png" of "dir/a.b.c.png".
std::vector<std::string> withoutWords(const std::string& path);

}  // namespace tspace
