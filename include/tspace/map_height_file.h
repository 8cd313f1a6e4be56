// SPDX-License-Identifier: MIT
// From heights to normals (map_height.h), from file to file. CMake target tspace::asset.
#pragma once

#include <string>
#include <vector>

#include "tspace/asset.h"
#include "tspace/map_convert_file.h"
#include "tspace/map_height.h"

namespace tspace {

/// How an image stores heights.
enum class HeightEncoding : std::uint32_t {
    gray = 0,  ///< from 0 (black) to 1 (white)
    terrainRgb =
        1,         ///< meters, as Mapbox's tiles have them: -10000 + (65536 R + 256 G + B) / 10, with bytes R, G and B
    terrarium = 2  ///< meters, as Mapzen's tiles have them: 256 R + G + B / 256 - 32768
};

struct HeightToNormalFileOptions {
    /// Factor of the heights. Of gray images: the height of white above black, with `mesh` in units of the model, else in the unit of
    /// texel_size. Of heights in meters: 1 keeps them, 2 makes slopes twice as steep.
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
    HeightEncoding encoding = HeightEncoding::gray;
    /// Width and height of a texel without `mesh`, in the unit of the heights: meters for terrain. Above 0. A tile of 256 texels of Web
    /// Mercator has 156543.03 m * cos(latitude) / 2^zoom.
    double texel_size = 1;
};

struct HeightToNormalFileReport {
    std::uint32_t width = 0, height = 0;
    unsigned bits_before = 8, bits = 16;  ///< of a channel
    MapMeshReport mesh = {};              ///< empty where there is none
    HeightToNormalReport texels = {};
    std::vector<std::string> warnings = {};  ///< one sentence each
};

/// Makes a normal map, `output` (.png), of the height map `input` (PNG, JPEG, WebP, EXR, KTX2, DDS, TGA; of colors the mean counts,
/// unless `encoding` says otherwise).
/// Errors: those of heightToNormal and of convertMapFile. Thread-safe.
Result<HeightToNormalFileReport> heightToNormalFile(const std::string& input, const std::string& output,
                                                    const HeightToNormalFileOptions& options = {});

}  // namespace tspace
