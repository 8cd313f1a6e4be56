// SPDX-License-Identifier: MIT
// Which meshes of a low poly look at which meshes of a high poly.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/scene/scene.h"
#include "tspace/file_options.h"

namespace tspace {

/// Object groups of both models, for LowPoly::groups and HighPoly::groups.
struct MeshMatch {
    bool is_used = false;                    ///< else all look at all
    std::vector<std::uint32_t> low = {};     ///< one per primitive
    std::vector<std::uint32_t> high = {};    ///< one per placement
    std::vector<std::string> warnings = {};  ///< one sentence each: what has no partner
};

/// The file of pairs that BakeFileOptions::match names; empty where it is `names` or `all`.
std::string matchFileOf(const std::string& how);

/// `how`: BakeFileOptions::match. By the names of nodes, and where one has no partner by those of meshes. Throws FileError for
/// a file of pairs that cannot be read.
MeshMatch matchMeshes(const DrawnScene& low, const DrawnScene& high, const std::string& how, const FileOptions& file);

}  // namespace tspace
