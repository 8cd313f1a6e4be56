// SPDX-License-Identifier: MIT
// What a report says about the file as a whole.
#pragma once

#include "tspace/asset.h"

namespace tspace {

/// What options had to work on, where the report does not tell it.
struct WorkedOn {
    bool far_coordinates = false;     ///< an offset that was left in them
    bool texture_transforms = false;  ///< of textures that computed or judged tangents follow
    bool compression = false;         ///< geometry that was packed or unpacked
};

/// Adds to the warnings: triangles that are wound against their neighbours, new normals that point behind their triangles,
/// and options that are not the default and had nothing to work on.
void addWarnings(const GenerateOptions& options, const WorkedOn& worked_on, GenerateReport& report);

}  // namespace tspace
