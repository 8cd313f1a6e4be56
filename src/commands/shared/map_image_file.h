// SPDX-License-Identifier: MIT
// Image files as the input of calls on maps, and the part of a model that shows one, as arrays of corners. Functions throw
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

// The part of a model that shows a normal map, as arrays of corners.

struct MapMesh {
    OwnedMesh corners = {};  ///< a vertex for each corner; UVs as the texture is read with them
    /// In world space: one per triangle, where the axes of its mesh point, for directions of normals.
    std::vector<MapAxes> axes = {};
    TextureWrap wrap_u = TextureWrap::repeat,
                wrap_v = TextureWrap::repeat;  ///< wrap modes of the first primitive's texture
    MapMeshReport report = {};
};

/// Whether the image is a normal map.
bool showsNormals(const TangentUse& use);

/// Appends the corners of a primitive as a map is read there, a vertex for each; `use`: what reads it, null for the first UVs
/// as they are. Missing frames are made, along the UVs that generate takes. Returns whether they were. Throws FileError.
bool addMapCorners(const ScenePrimitive& primitive, const TangentUse* use, const TangentOptions& tangents,
                   const Execution& execution, OwnedMesh& mesh);

struct MapMeshChoice {
    std::string material = {};    ///< ConvertMapFileOptions::material
    std::string image_name = {};  ///< the file name of the map, without folder
    bool in_world = false;        ///< normals and tangents as the nodes of the scene turn them
    std::uint32_t tile = 0;       ///< ConvertMapFileOptions::tile
    /// Fails where neither the name of the material nor that of the image says which materials show the map, and their UVs lie
    /// over each other.
    bool needs_material = false;
};

/// Reads a model and takes the triangles that show the map. Throws FileError: invalidFile where there are none, where their
/// materials give the map several scales or none, and, in the world, where they stand there in several ways or not at all.
MapMesh readMapMesh(const std::string& model, const MapMeshChoice& choice, const TangentOptions& tangents,
                    const FileOptions& file, const Execution& execution);

/// `content`: the image in place of the file, where it has data. Within file.memory_limit_bytes, and 2^28 pixels.
FloatImage readMapImage(const std::string& input, ByteSpan content, const FileOptions& file,
                        ImageUse use = ImageUse::vectors);

/// readMapMesh, whose errors name the model: those of a call are printed with the name of the image.
MapMesh readNamedMapMesh(const std::string& model, const MapMeshChoice& choice, const TangentOptions& tangents,
                         const FileOptions& file, const Execution& execution);

/// The path without folders.
std::string fileNameOf(const std::string& path);

/// Whether an image of this name is a TGA.
bool isTgaName(const std::string& path);
/// The file of an image: a TGA where its name says so, which has 8 bits, else a PNG. Nothing where it cannot be packed. Throws
/// FileError where it is too large for a TGA.
std::optional<std::vector<std::uint8_t>> encodeByName(const std::string& name, const FloatImage& image, unsigned bits);
std::optional<std::vector<std::uint8_t>> encodeByName(const std::string& name, const RgbImage& image);

/// The image as a TGA where the output's name says so, else as a PNG or EXR; by `way` as AtomicOutput writes.
void writeMapImage(const FloatImage& image, ImageFormat format, unsigned bits, const std::string& output,
                   const OutputWay& way);

/// Whether the channels of all texels are equal, or nearly: a height map, or an image without colors.
bool isGreyImage(const FloatImage& image);
/// The mean of the three channels.
std::vector<float> heightsOf(const FloatImage& image);

/// In tangent space, as glTF reads it. `mesh` has a vertex for each corner.
MapSide tangentSide(const OwnedMesh& mesh, double scale = 1);

}  // namespace tspace
