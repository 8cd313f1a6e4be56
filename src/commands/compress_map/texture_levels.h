// SPDX-License-Identifier: MIT
// A normal map, and a roughness texture that belongs to it, as levels of textures: arrays in, arrays out. No file is read or written, and
// nothing is thrown but for memory: the module "textures" of the npm package has these functions too.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "images/float_image.h"
#include "images/write_texture.h"
#include "maps/blocks/filtered_error.h"
#include "maps/blocks/normal_levels.h"
#include "maps/blocks/roughness_levels.h"
#include "tspace/map_files.h"

namespace tspace {

/// A level as it is written, and as it is decoded.
struct PackedLevel {
    std::vector<std::uint8_t> bytes = {};
    std::vector<Vec3> texels = {};
};

/// Returns nothing if the library astcenc fails.
std::optional<PackedLevel> packLevel(const NormalLevel& level, const CompressMapFileOptions& options,
                                     Parallel& parallel);

TexelKind textureKind(const CompressMapFileOptions& options);

/// The DDS of a texture, with that header.
std::vector<std::uint8_t> ddsFileOf(const Texture& texture, DdsHeader header);

/// Why there is no texture of these options.
std::optional<Error> textureFault(const CompressMapFileOptions& options, bool is_dds);

/// Size and bits of an image. One of two channels becomes vectors, with a warning that says which.
void beginReport(FloatImage& image, CompressMapFileReport& report);

struct MapLevels {
    std::vector<NormalLevel> levels = {};  ///< with spreads where there is a roughness texture
    NormalLevel truth = {};  ///< the first level before vectors were laid on the horizon; empty where none were
};

/// All levels, or the first where no others are needed. `has_three`: for three channels, which can say what looks below the horizon. Adds
/// warnings.
MapLevels makeMapLevels(FloatImage image, const CompressMapFileOptions& options, bool has_roughness, bool has_three,
                        Parallel& parallel, CompressMapFileReport& report);

void keepError(const FilteredError& error, CompressMapFileReport& report);

/// All of map.levels, and how far the first is off. Nothing where the library astcenc fails.
std::optional<Texture> packLevels(const MapLevels& map, const CompressMapFileOptions& options, Parallel& parallel,
                                  CompressMapFileReport& report);

/// Levels of the roughness texture `first`, all or the first, as the options say; whyGridsDiffer must be empty.
std::vector<RoughnessLevel> makeRoughness(const RoughnessLevel& first, const CompressMapFileOptions& options,
                                          const MapLevels& map, Parallel& parallel, CompressMapFileReport& report);
/// R8G8B8A8.
Texture roughnessTexture(std::span<const RoughnessLevel> levels);

}  // namespace tspace
