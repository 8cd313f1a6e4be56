// SPDX-License-Identifier: MIT
// What stands under a picture: the colours of its view and their meaning, and whose tangents it shows.
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

/// A colour, perhaps with stripes of another one, and what it means; or words alone.
struct LegendEntry {
    std::optional<Vec3> color;
    std::optional<Vec3> stripes;
    std::string text;  ///< in capitals
};

struct Legend {
    bool has_heat_scale = false;  ///< the colours of heatColor, above the entries
    std::vector<LegendEntry> entries = {};
};

/// Sources of the tangents in a picture.
struct TangentSources {
    bool stored = false, computed = false;
    bool missing = false;    ///< some surfaces have no tangents
    bool has_map = false;    ///< some surface has a normal map
    bool has_other = false;  ///< `error` compares with another model
};

/// Legend of all views except `both`.
Legend legendOf(RenderShow show, const TangentSources& sources, Method method);
Legend legendOfBoth(const TangentSources& left, const TangentSources& right, Method method);

/// Height of a legend in rows of the picture: at most a third. 0: there is no room, or the legend is empty.
std::uint32_t legendRows(const Legend& legend, std::uint32_t width, std::uint32_t height);
/// Adds these rows below a picture, with the legend in them.
void addLegend(const Legend& legend, std::uint32_t rows, RgbImage& image);

}  // namespace tspace
