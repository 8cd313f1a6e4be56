// SPDX-License-Identifier: MIT
// Normal maps that other commands make, as textures.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tspace/execution.h"
#include "tspace/map_files.h"
#include "tspace/span.h"

namespace tspace {

/// Whether the name ends in .ktx2 or .dds.
bool isTextureName(const std::string& path);

/// The file of that name: BC5 with all levels, as compressMapFile makes it by default. `texels`: of a map in tangent space, from 0 to 1; the
/// vectors need not be unit: what the filter makes of them is what the blocks are fitted to.
/// `coverage`: how much of each texel is surface; empty: all of it.
std::vector<std::uint8_t> packTexture(const std::string& name, std::uint32_t width, std::uint32_t height,
                                      std::span<const Vec3> texels, const Execution& execution,
                                      std::vector<float> coverage = {}, DdsHeader header = DdsHeader::dx10);

}  // namespace tspace
