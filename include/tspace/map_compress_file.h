// SPDX-License-Identifier: MIT
// Normal maps as compressed textures for engines. CMake target tspace::asset.
#pragma once

#include <string>
#include <vector>

#include "tspace/asset.h"
#include "tspace/map_convert_file.h"

namespace tspace {

struct CompressMapFileOptions {
    bool is_signed = false;  ///< BC5 with a sign: 0 is exact, which flat parts of maps of more than 8 bits gain by
    bool levels = true;      ///< all smaller levels too
    /// Limits for the image: as ConvertMapFileOptions::file.
    FileOptions file = {};
    std::span<const std::uint8_t> content = {};  ///< the image, in place of the file `input`; must stay while it runs
    Sink sink = {};                              ///< takes the output, a KTX2, in place of a file
    bool dry_run = false;                        ///< everything but writing
    Execution execution = {};
};

struct CompressMapFileReport {
    std::uint32_t width = 0, height = 0;
    unsigned bits_before = 8;       ///< of a channel of the input
    std::uint32_t level_count = 1;  ///< in the output
    std::uint64_t output_bytes = 0;
    /// Between the map as three channels of full depth and as the texture, of the first level: bilinear, then unit, at 3 x 3
    /// points a texel (of some rows, where it is large). What rebuilding z after the filter costs is in it.
    double mean_error_deg = 0, p99_error_deg = 0, max_error_deg = 0;
    std::uint64_t below_horizon = 0;         ///< texels whose z is below 0, which two channels cannot say
    std::uint64_t not_unit = 0;              ///< texels that are a tenth or more longer or shorter than unit vectors
    std::vector<std::string> warnings = {};  ///< one sentence each
};

/// Packs a normal map in tangent space as BC5: x in red, y in green; z is made by who reads it. `output` ends in .dds or .ktx2.
/// From PNG of 16 bits or EXR that is better than from 8 bits. Errors: those of convertMapFile. Thread-safe; the same bytes
/// for any number of threads.
Result<CompressMapFileReport> compressMapFile(const std::string& input, const std::string& output,
                                              const CompressMapFileOptions& options = {});

}  // namespace tspace
