// SPDX-License-Identifier: MIT
// Why most rays of a low poly meet no high poly.
#pragma once

#include <memory>
#include <string>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "maps/rays/rays.h"
#include "tspace/maps.h"

namespace tspace {

/// The surface of a high poly, which bakes of several maps, and what looks for a cause, have in common. Empty until the first
/// bake.
struct SharedRays {
    std::shared_ptr<const RaySurface> surface = {};
};

/// The likely reason, as a part of a sentence about the high poly: faces that point inwards, a reach that is too short,
/// another axis that points up, another unit. Each is tried: it is named where four of five rays then meet the high poly.
/// Empty where none of them is the reason. Checked meshes; `surface`: that of the high poly; `reach`: what the rays had.
std::string causeOfMisses(const LowPoly& low, const HighPoly& high, const RaySurface& surface, double reach);

/// Of a bake that met something in most places: the axes or units in which nearly all of the high poly lies on the low poly,
/// where now less than half of it does. Empty where there are none.
std::string otherPlaceOf(const LowPoly& low, const HighPoly& high, const RaySurface& surface);

/// bakeMaps, but where nothing meets the high poly the result is a map without texels, and no error. `shared`: of this high
/// poly; filled where it is empty.
Result<BakedMaps> bakeEvenIfMissed(const LowPoly& low, const HighPoly& high, const BakeOptions& options,
                                   const LayerOptions& layers, const Execution& execution, const Progress& progress,
                                   SharedRays& shared);

}  // namespace tspace
