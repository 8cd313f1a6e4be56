// SPDX-License-Identifier: MIT
// Diagnoses why most rays of a low poly hit no high poly.
#pragma once

#include <memory>
#include <string>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "maps/rays/rays.h"
#include "tspace/maps.h"

namespace tspace {

/// Ray structure of a high poly, shared by bakes of several maps and by the diagnosis of misses. It is empty until the
/// first bake.
struct SharedRays {
    std::shared_ptr<const RaySurface> surface = {};
};

/// Returns the likely reason for the misses, as a clause: inward faces, a reach that is too short, a different up axis,
/// or a different unit. Inward faces are named if at least half of the rays hit only back faces. Every other correction
/// is tried, and named if at least four of five rays then hit. Returns an empty string if no reason is found. Requires
/// checked meshes. `surface`: ray structure of the high poly; `reach`: the reach used by the rays.
std::string causeOfMisses(const LowPoly& low, const HighPoly& high, const RaySurface& surface, double reach);

/// Diagnoses a bake with hits in most places. Returns the change of axes or unit with which rays from more than 95 % of
/// the low poly hit the high poly, if less than half of them hit without this change. Returns an empty string if there
/// is none.
std::string likelyPlacementOf(const LowPoly& low, const HighPoly& high, const RaySurface& surface);

/// Bakes like bakeMaps, but if there is no hit at all, returns a map without texels instead of an error. `shared`: ray
/// structure of this high poly; set if it is empty.
Result<BakedMaps> bakeAllowingMisses(const LowPoly& low, const HighPoly& high, const BakeOptions& options,
                                     const LayerOptions& layers, const Execution& execution, const Progress& progress,
                                     SharedRays& shared);

}  // namespace tspace
