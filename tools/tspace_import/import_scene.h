// SPDX-License-Identifier: MIT
// A file that Assimp reads, as the bytes of a GLB.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tspace::import {

struct Imported {
    std::vector<std::uint8_t> glb = {};
    std::string error = {};        ///< one sentence; empty: it was read
    bool has_no_tangents = false;  ///< the file has none, as far as its text says
    std::vector<std::string> warnings = {};
};

/// Meshes are neither joined nor split: one primitive per mesh of the file, polygons cut by tspace's own rule, vertices
/// joined only when all their attributes have the same bits. Nodes, materials (base colour and normal map), all UV
/// sets, colours, skins, morph targets and animations go along. UVs are turned so that v runs down. Files that it names are
/// read where the URIs of glTF may lead (src/asset/folder_rule.h); `anywhere`: all.
Imported importScene(const std::string& path, bool anywhere);

}  // namespace tspace::import
