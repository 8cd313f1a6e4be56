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
    bool keeps_coordinates = false;  ///< floats do not hold the shape, and ImportRules::keep_coordinates was given
    double offset[3] = {0, 0, 0};    ///< taken out of coordinates, and the translation of their nodes
};

/// The options of reading.
struct ImportRules {
    bool anywhere =
        false;  ///< files that it names are read wherever they are; else where the URIs of glTF may lead (src/model/io/folder_rule.h)
    bool keep_coordinates =
        false;  ///< else an offset is taken out where floats do not hold the shape, and the file has more than floats
};

/// Meshes are neither joined nor split: one primitive per mesh of the file, polygons cut by tspace's own rule, vertices
/// joined only when all their attributes have the same bits. Nodes, materials (base colour and normal map), all UV
/// sets, colours, skins, morph targets and animations go along. UVs are turned so that v runs down.
Imported importScene(const std::string& path, const ImportRules& rules);

}  // namespace tspace::import
