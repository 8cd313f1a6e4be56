// SPDX-License-Identifier: MIT
// From heights to normals (map_height.h), from file to file. CMake target tspace::asset.
#pragma once

#include <string>
#include <vector>

#include "tspace/asset.h"
#include "tspace/map_convert_file.h"
#include "tspace/map_height.h"

namespace tspace {

struct HeightToNormalFileOptions {
    /// How high white stands above black: with `mesh` in the units of the model, else in texels.
    double strength = 1;
    std::string mesh = {};      ///< the model that shows the map; empty: none
    std::string material = {};  ///< as ConvertMapFileOptions::material
    Green green = Green::up;    ///< of the output
    bool clamp = false;  ///< the image ends at its borders; else it repeats, or does what the mesh's texture does
    unsigned bits = 16;  ///< of a channel of the output: 8 or 16
    TangentOptions tangents{.convention = conventions::gltf};  ///< as ConvertMapFileOptions::tangents
    FileOptions file = {};                                     ///< as ConvertMapFileOptions::file
    std::span<const std::uint8_t> content = {};                ///< the image, in place of the file `input`
    Sink sink = {};                                            ///< takes the output in place of a file
    bool dry_run = false;                                      ///< everything but writing
    Execution execution = {};
};

struct HeightToNormalFileReport {
    std::uint32_t width = 0, height = 0;
    unsigned bits_before = 8, bits = 16;  ///< of a channel
    MapMeshReport mesh = {};              ///< empty where there is none
    HeightToNormalReport texels = {};
    std::vector<std::string> warnings = {};  ///< one sentence each
};

/// Makes a normal map, `output` (.png), of the height map `input` (PNG, JPEG, WebP, EXR, KTX2, DDS, TGA; of colours the mean counts).
/// Errors: those of heightToNormal and of convertMapFile. Thread-safe.
Result<HeightToNormalFileReport> heightToNormalFile(const std::string& input, const std::string& output,
                                                    const HeightToNormalFileOptions& options = {});

}  // namespace tspace
