// SPDX-License-Identifier: MIT
// Decides which meshes of the high poly the rays of each low-poly mesh may hit.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/scene/scene.h"
#include "tspace/file_options.h"

namespace tspace {

/// Object groups of both models, for LowPoly::groups and HighPoly::groups.
struct MeshMatch {
    bool is_used = false;                    ///< false: all rays may hit all meshes
    std::vector<std::uint32_t> low = {};     ///< group of each primitive of the low poly
    std::vector<std::uint32_t> high = {};    ///< group of each placement of the high poly
    std::vector<std::string> warnings = {};  ///< one sentence per object without a partner
};

/// Returns the path of the file of pairs if `how` (BakeFileOptions::match) names one, or "" for `names` and `all`.
std::string matchFileOf(const std::string& how);

/// Matches objects by names of nodes, and objects without a partner by names of meshes. `how`: BakeFileOptions::match.
/// Throws FileError if the file of pairs cannot be read.
MeshMatch matchMeshes(const DrawnScene& low, const DrawnScene& high, const std::string& how, const FileOptions& file);

}  // namespace tspace
