// SPDX-License-Identifier: MIT
// Mip levels of a normal map and of a roughness texture that belongs to it, on arrays. No file is read or written, and
// only out-of-memory exceptions are thrown: the module "textures" of the npm package uses these functions too.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "images/float_image.h"
#include "textures/blocks/filtered_error.h"
#include "textures/blocks/normal_levels.h"
#include "textures/blocks/roughness_levels.h"
#include "textures/write_texture.h"
#include "tspace/map_files.h"

namespace tspace {

/// Mip level, as encoded bytes and as decoded vectors.
struct PackedLevel {
    std::vector<std::uint8_t> bytes = {};
    std::vector<Vec3> texels = {};
};

/// Encodes a level. Returns nothing if the library astcenc fails.
std::optional<PackedLevel> packLevel(const NormalLevel& level, const CompressMapFileOptions& options,
                                     Parallel& parallel);

TexelKind textureKind(const CompressMapFileOptions& options);

/// Returns the DDS file of a texture, with the given type of header.
std::vector<std::uint8_t> ddsFileOf(const Texture& texture, DdsHeader header);

/// Returns an error if a texture is not possible with these options; otherwise nothing.
std::optional<Error> textureFault(const CompressMapFileOptions& options, bool is_dds);

/// Records the size and bit depth of the image. A two-channel image is converted to vectors, with a warning that names
/// the channels.
void beginReport(FloatImage& image, CompressMapFileReport& report);

struct MapLevels {
    std::vector<NormalLevel> levels = {};  ///< with spreads if there is a roughness texture
    /// the first level before vectors were projected onto the horizon; empty if none were projected
    NormalLevel truth = {};
};

/// Computes all levels, or only the first if no others are needed. `has_three`: three channels are written, which can
/// represent vectors below the horizon. Adds warnings.
MapLevels makeMapLevels(FloatImage image, const CompressMapFileOptions& options, bool has_roughness, bool has_three,
                        Parallel& parallel, CompressMapFileReport& report);

void keepError(const FilteredError& error, CompressMapFileReport& report);

/// Encodes all of map.levels, and measures the error of the first. Returns nothing if the library astcenc fails.
std::optional<Texture> packLevels(const MapLevels& map, const CompressMapFileOptions& options, Parallel& parallel,
                                  CompressMapFileReport& report);

/// Computes the levels of the roughness texture `first`: all levels, or only the first, according to the options.
/// Requires that whyGridsDiffer returns an empty string.
std::vector<RoughnessLevel> makeRoughness(const RoughnessLevel& first, const CompressMapFileOptions& options,
                                          const MapLevels& map, Parallel& parallel, CompressMapFileReport& report);
/// Returns the texture in R8G8B8A8.
Texture roughnessTexture(std::span<const RoughnessLevel> levels);

}  // namespace tspace
