// SPDX-License-Identifier: MIT
// Legend below a picture: the colors of the view with their meanings, and the source of the tangents.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "images/image.h"
#include "tspace/render.h"
#include "tspace/span.h"
#include "tspace/tangents.h"

namespace tspace {

/// A color, possibly with stripes of another color, and its meaning; or only text.
struct LegendEntry {
    std::optional<Vec3> color;
    std::optional<Vec3> stripes;
    std::string text;  ///< text in capital letters
};

struct Legend {
    bool has_heat_scale = false;  ///< show the colors of heatColor above the entries
    std::vector<LegendEntry> entries = {};
};

/// Sources of the tangents in a picture.
struct TangentSources {
    bool stored = false, computed = false;
    bool missing = false;    ///< some surfaces have no tangents
    bool has_map = false;    ///< some surface has a normal map
    bool has_other = false;  ///< `error` compares with another model
};

/// Returns the legend of any view except `both`.
Legend legendOf(RenderShow show, const TangentSources& sources, Method method);
Legend legendOfBoth(const TangentSources& left, const TangentSources& right, Method method);

/// Returns the height of a legend in rows of the picture, at most a third of it; 0 if the legend does not fit or is
/// empty.
std::uint32_t legendRows(const Legend& legend, std::uint32_t width, std::uint32_t height);
/// Appends `rows` rows with the legend below a picture.
void addLegend(const Legend& legend, std::uint32_t rows, RgbImage& image);

}  // namespace tspace
