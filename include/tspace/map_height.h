// SPDX-License-Identifier: MIT
// From heights to normals: a bump map as a normal map. CMake target tspace::maps.
#pragma once

#include "tspace/map_convert.h"

namespace tspace {

struct HeightMap {
    std::uint32_t width = 0, height = 0;
    std::span<const float> heights = {};  ///< width * height, row 0 is v = 0; 0 is black and 1 is white
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;  ///< what lies beyond the borders
};

struct HeightToNormalOptions {
    /// How high white stands above black. With a mesh in its units, else in texels. Below 0: white lies deeper.
    double strength = 1;
    Green green = Green::up;  ///< of the normal map
    /// Channels are rounded to n / (2^bits - 1), n whole. 32: as computed.
    unsigned bits = 16;
};

struct HeightToNormalReport {
    std::uint64_t on_mesh = 0;  ///< texels whose size was taken from the triangle that shows them
    double texel_size = 1;      ///< in the units of strength: the mean over the mesh, which all others get
    double mean_lean_deg = 0, max_lean_deg = 0;  ///< angles between the normals and the surface's
};

/// Makes a normal map of heights into `out` (width * height).
///
/// With h from 0 to 1 (any other range works too) and S the strength, in texels: n = unit(-S dh/dx, S dh/drow, 1), y up.
/// Derivatives are differences of the texels on both sides, of three rows (columns) weighted 3 : 10 : 3 (Scharr): exact for
/// planes, and for parabolas. At borders with TextureWrap::clamp they are one-sided: (-3 h0 + 4 h1 - h2) / 2, or h1 - h0 where
/// there are two texels, and 0 where there is one. With a mesh, n = N - S grad h, grad h = (h_u (P_v x N) + h_v (N x P_u)) / (N . (P_u x P_v)) (Blinn 1978), where
/// P_u and P_v are the edges of the texel on its triangle, and n is told in the mesh's frames, as MapSide has them. So the
/// strength does not depend on the size of the image or the UVs. Texels that no triangle shows are squares of the mean size.
///
/// `mesh`    in tangent space; empty: none
///
/// Errors: nullData, countMismatch, strideTooSmall, misaligned, invalidOption (bits; a strength that is not finite),
/// missingAttribute (positions, normals or tangents of the mesh), tooLarge, outOfMemory. Time: linear. The same bits for any
/// number of threads. Thread-safe.
Result<HeightToNormalReport> heightToNormal(const HeightMap& map, const MapSide& mesh,
                                            const HeightToNormalOptions& options, std::span<Vec3> out,
                                            const Execution& execution = {});

}  // namespace tspace
