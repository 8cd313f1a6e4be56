// SPDX-License-Identifier: MIT
// File names of the outputs of a bake.
#pragma once

#include <string>
#include <vector>

#include "commands/bake/model_surfaces.h"
#include "tspace/bake_file.h"

namespace tspace {

/// Returns "dir/name.SUFFIX.png" for "dir/name.png", or the path itself for an empty suffix.
std::string withSuffix(const std::string& path, const std::string& suffix);

/// Returns "dir/name_LAYER.png" for "dir/name.png".
std::string withLayer(const std::string& path, MapLayer layer);

/// Returns the file name suffix of each image of a low poly, in order: the name of its material, made unique if names
/// repeat. A single image has an empty suffix.
std::vector<std::string> imageSuffixes(const LowModel& low);

/// Returns the file name suffix of a UDIM tile of an image.
std::string tileSuffix(const std::string& image, std::uint32_t tile);

/// Paths from which the names of maps are derived.
struct BakeNames {
    std::string output = {};         ///< path of the normal map
    std::string layers_output = {};  ///< path from which the paths of all other maps are derived; empty: `output`
};

/// Returns all outputs of a bake for a low poly with one image and no tiles. Reads no file.
std::vector<std::string> plainOutputs(const BakeNames& bake, const BakeFileOptions& options);

/// Returns all outputs of a bake for this low poly, which is read for its materials and tiles. Throws FileError.
std::vector<std::string> outputsFor(const std::string& low, const BakeNames& bake, const BakeFileOptions& options);

/// Returns all outputs of a bake, for a comparison with `others`: the other outputs of the command line, or empty
/// strings. The low poly is read only if a map could get one of the names in `others` through its materials or tiles.
std::vector<std::string> outputsToCompare(const std::vector<std::string>& others, const std::string& low,
                                          const BakeNames& bake, const BakeFileOptions& options);

/// Returns the paths that become this path with a suffix: "dir/a.b.png" and "dir/a.png" for "dir/a.b.c.png".
std::vector<std::string> withoutSuffixes(const std::string& path);

}  // namespace tspace
