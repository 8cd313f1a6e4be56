// SPDX-License-Identifier: MIT
// Image files as input of map commands, and the part of a model that uses a map, as arrays of corners. Functions throw
// FileError.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/owned_mesh.h"
#include "images/float_image.h"
#include "model/io/atomic_output.h"
#include "model/scene/scene.h"
#include "tspace/map_files.h"
#include "tspace/maps.h"

namespace tspace {

// The part of a model that uses a normal map, as arrays of corners.

struct MapMesh {
    OwnedMesh corners = {};  ///< one vertex per corner, with the UVs that sample the texture
    /// Directions of the axes of the mesh in world space, one entry per triangle, for transforming normals. Empty in
    /// other spaces.
    std::vector<MapAxes> axes = {};
    TextureWrap wrap_u = TextureWrap::repeat,
                wrap_v = TextureWrap::repeat;  ///< wrap modes of the first primitive's texture
    MapMeshReport report = {};
    std::vector<std::string> warnings = {};  ///< warnings about normals of the model
};

/// Returns whether the image is used as a normal map.
bool showsNormals(const TangentUse& use);

/// Appends one vertex per corner of a primitive, with the UVs at which the material samples the map. `use`: texture
/// reference with UV set and transform; null: the first UV set without a transform. Missing frames are computed along
/// the UVs that generate uses. Returns whether they were computed. Throws FileError.
bool addMapCorners(const ScenePrimitive& primitive, const TangentUse* use, const TangentOptions& tangents,
                   const Execution& execution, OwnedMesh& mesh);

struct MapMeshChoice {
    std::string material = {};    ///< name of the material, see ConvertMapFileOptions::material
    std::string image_name = {};  ///< file name of the map, without folder
    bool in_world = false;        ///< transform normals and tangents by the nodes of the scene
    std::uint32_t tile = 0;       ///< number of the UDIM tile, see ConvertMapFileOptions::tile
    /// If true, reading fails if neither the name of the material nor that of the image identifies the materials that
    /// use the map, and their UVs overlap.
    bool needs_material = false;
};

/// Reads a model and returns the triangles that use the map. Throws FileError: invalidFile if there are none, or if
/// their materials set different scales or scale 0 for the map; in world space also if nodes transform the triangles
/// differently, or if no node draws them.
MapMesh readMapMesh(const std::string& model, const MapMeshChoice& choice, const TangentOptions& tangents,
                    const FileOptions& file, const Execution& execution);

/// Reads an image. `content`: used instead of the file if it has data. Limits: file.memory_limit_bytes and 2^28 pixels.
FloatImage readMapImage(const std::string& input, ByteSpan content, const FileOptions& file,
                        ImageUse use = ImageUse::vectors);

/// Calls readMapMesh, and adds the name of the model to its errors and warnings, because errors of a call are printed
/// with the name of the image.
MapMesh readNamedMapMesh(const std::string& model, const MapMeshChoice& choice, const TangentOptions& tangents,
                         const FileOptions& file, const Execution& execution);

/// Returns the file name of a path, without folders.
std::string fileNameOf(const std::string& path);

/// Returns whether the extension is that of a TGA.
bool isTgaName(const std::string& path);
/// Encodes an image as an 8-bit TGA or as a PNG, depending on the extension. Returns nothing if encoding fails. Throws
/// FileError if the image is too large for a TGA.
std::optional<std::vector<std::uint8_t>> encodeByName(const std::string& name, const FloatImage& image, unsigned bits);
std::optional<std::vector<std::uint8_t>> encodeByName(const std::string& name, const RgbImage& image);

/// Writes the image as a TGA, PNG or EXR, depending on `format` and on the extension of the output. `way`: options of
/// AtomicOutput.
void writeMapImage(const FloatImage& image, ImageFormat format, unsigned bits, const std::string& output,
                   const OutputOptions& way);

/// Returns whether the channels of all texels are nearly equal: a height map, or an image without colors.
bool isGrayImage(const FloatImage& image);
/// Returns the mean of the three channels of each texel.
std::vector<float> heightsOf(const FloatImage& image);

/// Returns a map side in tangent space with the conventions of glTF. `mesh` has one vertex per corner.
MapSide tangentSide(const OwnedMesh& mesh, double scale = 1);

}  // namespace tspace
