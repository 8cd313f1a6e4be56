// SPDX-License-Identifier: MIT
// Image files as the input of calls on maps, and the model that shows one. Functions throw FileError.
#pragma once

#include <string>
#include <vector>

#include "commands/shared/map_mesh.h"
#include "images/float_image.h"
#include "model/io/atomic_output.h"
#include "tspace/map_convert.h"

namespace tspace {

/// `content`: the image in place of the file, where it has data. Within file.memory_limit_bytes, and 2^28 pixels.
FloatImage readMapImage(const std::string& input, ByteSpan content, const FileOptions& file);

/// readMapMesh, whose errors name the model: those of a call are printed with the name of the image.
MapMesh readNamedMapMesh(const std::string& model, const MapMeshChoice& choice, const TangentOptions& tangents,
                         const FileOptions& file, const Execution& execution);

/// The path without folders.
std::string fileNameOf(const std::string& path);

/// The image as a PNG or EXR; by `way` as AtomicOutput writes.
void writeMapImage(const FloatImage& image, ImageFormat format, unsigned bits, const std::string& output,
                   const OutputWay& way);

/// Where the format of a texture file (KTX2, DDS) has x and y alone, or its texels look so: puts x, y and a z made of them in red,
/// green and blue. Gives one sentence that says so; empty where nothing is done.
std::string readTextureVectors(FloatImage& image);

/// Whether the channels of all texels are equal, or nearly: a height map, or an image without colors.
bool isGreyImage(const FloatImage& image);
/// The mean of the three channels.
std::vector<float> heightsOf(const FloatImage& image);

/// In tangent space, as glTF reads it; without a scale.
MapSide tangentSide(const MapMesh& mesh);

}  // namespace tspace
