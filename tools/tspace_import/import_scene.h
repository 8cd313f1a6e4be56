// SPDX-License-Identifier: MIT
// Converts a file that Assimp reads to the bytes of a GLB.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tspace::import {

struct Imported {
    std::vector<std::uint8_t> glb = {};
    std::string error = {};        ///< one sentence; empty: the file was read
    bool has_no_tangents = false;  ///< the file contains no tangents, according to its text
    std::vector<std::string> warnings = {};
    bool keeps_coordinates = false;  ///< floats cannot represent the shape, and ImportRules::keep_coordinates was set
    double offset[3] = {0, 0, 0};    ///< offset subtracted from coordinates; it is the translation of their nodes
};

/// Options for reading a file.
struct ImportRules {
    /// Referenced files may be anywhere. If false, the rule for glTF URIs applies (src/model/io/folder_rule.h).
    bool anywhere = false;
    /// Keep coordinates with which floats cannot represent the shape. If false, an offset is subtracted from such
    /// coordinates, provided that the file has more precision than floats.
    bool keep_coordinates = false;
};

/// Reads a scene. Meshes are neither joined nor split: one primitive per mesh of the file, polygons are triangulated by
/// tspace's rule, and vertices are merged only if all their attributes have equal bits. Nodes, materials (base color
/// and normal map), all UV sets, colors, skins, morph targets and animations are preserved. UVs are flipped so that v
/// points down.
Imported importScene(const std::string& path, const ImportRules& rules);

}  // namespace tspace::import
