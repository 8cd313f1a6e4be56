// SPDX-License-Identifier: MIT
// Conversion of normal maps (map_convert.h) from file to file, with the frames of model files. CMake target tspace::asset.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tspace/asset.h"
#include "tspace/map_convert.h"
#include "tspace/map_layout.h"

namespace tspace {

/// The space of the vectors of a map in a file.
enum class MapFileSpace : std::uint32_t {
    tangent = 0,
    object = 1,  ///< the coordinates of the mesh, as the model file has them
    world = 2    ///< those of the scene: the mesh's nodes, which must agree, turn and squeeze them
};

/// The meaning of the alpha channel of a normal map from which smaller mip levels are made.
enum class MapAlpha : std::uint32_t {
    automatic = 0,  ///< coverage where texels with alpha 0 hold no unit vectors and nearly all others do; else data
    coverage =
        1,    ///< how much of a texel is surface, as in sprites and foliage: smaller levels are means weighted by it
    data = 2  ///< anything else, such as heights: it is left out
};

/// The header of a DDS.
enum class DdsHeader : std::uint32_t {
    dx10 = 0,    ///< that of Direct3D 10, with a number of DXGI: the only one that names every format
    legacy = 1,  ///< that of Direct3D 9: BC5 as FourCC ATI2 (with a sign BC5S), plain texels by masks
    bc5u = 2     ///< as legacy, but BC5 as FourCC BC5U
};

struct ConvertMapFileOptions {
    std::string mesh = {};     ///< the model that the map was made for; empty: none is needed
    std::string to_mesh = {};  ///< the model that it is to be shown on: the same surface and UVs; empty: `mesh`
    /// Takes the primitives of the material with this name. Empty: those whose material names an image of the map's name,
    /// else all that have UVs.
    std::string material = {};
    std::uint32_t tile = 0;  ///< takes the triangles of this UDIM tile, whose file the map is: 1001 and on; 0: all
    MapFileSpace from = MapFileSpace::tangent, to = MapFileSpace::tangent;
    MapReading from_reading = {}, to_reading = {};
    /// Of the side that is in object or world space, where the other is in tangent space. Nothing: those of the mesh, or, where a
    /// map that is read looks as if z pointed up in it, those of Blender (a warning says so).
    std::optional<MapAxes> axes = {};
    /// Where `input` keeps its vectors: it is read by this first. The output always has x, y and z in red, green and blue,
    /// and alpha only where that was none of them.
    MapLayout layout = {};
    /// Bits of a channel: 8 or 16 in a PNG; 16 (half) or 32 (float) in an EXR. 0: the most that the format has.
    unsigned bits = 0;
    TexelLengths lengths = TexelLengths::even;  ///< ConvertMapOptions::lengths
    std::uint32_t padding = 0;                  ///< ConvertMapOptions::padding
    /// For meshes without tangents, which get them as generateFile gives them.
    TangentOptions tangents{.convention = conventions::gltf};
    /// How models and the image are read. A limit on memory counts for the image too; without one, images of up to 2^24
    /// pixels are read whatever their files weigh.
    FileOptions file = {};
    std::span<const std::uint8_t> content = {};  ///< the image, in place of the file `input`; must stay while it runs
    Sink sink = {};                              ///< takes the output in place of a file
    bool dry_run = false;                        ///< everything but writing
    Execution execution = {};
    Progress progress = {};
    MapAlpha alpha = MapAlpha::automatic;    ///< of `input`, where the output has levels (KTX2, DDS)
    DdsHeader dds_header = DdsHeader::dx10;  ///< of an output in DDS
};

/// What was taken of a model file.
struct MapMeshReport {
    std::uint32_t primitive_count = 0;
    std::uint64_t triangle_count = 0;
    std::vector<std::string> materials = {};  ///< names, each once
    bool tangents_made = false;               ///< by `tangents`, for some of them at least
    double scale = 1;                         ///< what their materials multiply x and y of the map by
};

struct ConvertMapFileReport {
    std::uint32_t width = 0, height = 0;
    unsigned bits_before = 8,
             bits = 16;                ///< of a channel in the files: whole numbers of 8 or 16, or floats of 16 or 32
    MapMeshReport from = {}, to = {};  ///< empty where there is no mesh
    ConvertMapReport texels = {};
    std::vector<std::string> warnings = {};  ///< one sentence each
};

/// Converts the image `input` (PNG, JPEG, WebP, EXR, KTX2, DDS, TGA) into `output` (.png or .exr), which appears at once, or not at all. Alpha stays. The
/// output has no word on colours. In tangent space the scale that a model's material gives the map counts on its side.
///
/// Errors: those of convertMap and of readers of models; cannotRead, cannotWrite, unsupportedFile, invalidFile (an image that
/// is broken; a model without what is needed, or whose primitives need a map each), invalidOption, tooLarge, outOfMemory. Thread-safe.
Result<ConvertMapFileReport> convertMapFile(const std::string& input, const std::string& output,
                                            const ConvertMapFileOptions& options = {});

}  // namespace tspace
