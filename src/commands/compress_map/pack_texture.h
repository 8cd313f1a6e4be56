// SPDX-License-Identifier: MIT
// Compresses normal maps that other commands produce.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tspace/execution.h"
#include "tspace/map_files.h"
#include "tspace/span.h"

namespace tspace {

/// Returns whether the name ends in .ktx2 or .dds.
bool isTextureName(const std::string& path);

/// Returns the texture file for that name: BC5 with all levels, with the defaults of compressMapFile. `texels`:
/// tangent-space vectors encoded from 0 to 1, of any length; the blocks are fitted to the filtered directions.
/// `coverage`: share of surface in each texel; empty: fully covered.
std::vector<std::uint8_t> packTexture(const std::string& name, std::uint32_t width, std::uint32_t height,
                                      std::span<const Vec3> texels, const Execution& execution,
                                      std::vector<float> coverage = {}, DdsHeader header = DdsHeader::dx10);

}  // namespace tspace
