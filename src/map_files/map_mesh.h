// SPDX-License-Identifier: MIT
// The part of a model that shows a normal map, as arrays of corners.
#pragma once

#include <string>
#include <vector>

#include "tspace/map_convert_file.h"

namespace tspace {

/// Three entries per triangle in all of them.
struct MapMesh {
    std::vector<Vec2> uvs = {};  ///< as the texture is read with them
    std::vector<Vec3> positions = {}, normals = {};
    std::vector<Vec4> tangents = {};
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;  ///< of the first primitive's texture
    MapMeshReport report = {};
};

struct MapMeshChoice {
    std::string material = {};    ///< ConvertMapFileOptions::material
    std::string image_name = {};  ///< the file name of the map, without folder
};

/// Reads a model and takes the triangles that show the map. Throws FileError: invalidFile where there are none.
MapMesh readMapMesh(const std::string& model, const MapMeshChoice& choice, const TangentOptions& tangents,
                    const FileOptions& file);

}  // namespace tspace
