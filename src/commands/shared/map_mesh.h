// SPDX-License-Identifier: MIT
// The part of a model that shows a normal map, as arrays of corners.
#pragma once

#include <string>
#include <vector>

#include "model/scene/scene.h"
#include "tspace/map_convert_file.h"

namespace tspace {

/// Three entries per triangle in all of them.
struct MapMesh {
    std::vector<Vec2> uvs = {};  ///< as the texture is read with them
    std::vector<Vec3> positions = {}, normals = {};
    std::vector<Vec4> tangents = {};
    /// In world space: one per triangle, where the axes of its mesh point, for directions of normals.
    std::vector<MapAxes> axes = {};
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;  ///< of the first primitive's texture
    MapMeshReport report = {};
};

/// Whether the image is a normal map.
bool showsNormals(const TangentUse& use);

/// Appends the corners of a primitive as a map is read there; `use`: what reads it, null for the first UVs as they are. Missing
/// frames are made, along the UVs that generate takes. Throws FileError.
void addMapCorners(const ScenePrimitive& primitive, const TangentUse* use, const TangentOptions& tangents,
                   const Execution& execution, MapMesh& mesh);

struct MapMeshChoice {
    std::string material = {};    ///< ConvertMapFileOptions::material
    std::string image_name = {};  ///< the file name of the map, without folder
    bool in_world = false;        ///< normals and tangents as the nodes of the scene turn them
    std::uint32_t tile = 0;       ///< ConvertMapFileOptions::tile
};

/// Reads a model and takes the triangles that show the map. Throws FileError: invalidFile where there are none, where their
/// materials give the map several scales or none, and, in the world, where they stand there in several ways or not at all.
MapMesh readMapMesh(const std::string& model, const MapMeshChoice& choice, const TangentOptions& tangents,
                    const FileOptions& file, const Execution& execution);

}  // namespace tspace
