// SPDX-License-Identifier: MIT
// What a report says about the file as a whole.
#pragma once

#include "tspace/asset.h"

namespace tspace {

/// Adds to the warnings: triangles that are wound against their neighbours, new normals that point behind their triangles,
/// and options that are not the default and had nothing to work on.
void addWarnings(const GenerateOptions& options, GenerateReport& report);

}  // namespace tspace
