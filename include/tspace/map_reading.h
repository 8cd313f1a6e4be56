// SPDX-License-Identifier: MIT
// How a renderer turns a texel of a normal map, and the frames of the mesh, into the normal that it shades. A map is
// right only for the reading that it was made for. CMake target tspace::maps.
#pragma once

#include <cstdint>

#include "tspace/convention.h"

namespace tspace {

/// Where B = w * cross(N, T) is computed.
enum class BitangentPlace : std::uint32_t {
    perPixel = 0,  ///< from the interpolated N and T
    perVertex = 1  ///< at the vertices, and interpolated
};

/// The default is green up as in glTF, and MikkTSpace's rule, since glTF specifies none: unit(x T + y B + z N),
/// (x, y, z) = 2c - 1, with T and N as interpolated.
struct MapReading {
    Green green = Green::up;
    BitangentPlace bitangent = BitangentPlace::perPixel;
    bool unit_vectors = false;  ///< N, T and B are made unit, each, before the texel is applied
    bool two_channels = false;  ///< z is the root of 1 - x^2 - y^2, and blue is not read
    float scale = 1.0f;         ///< x and y times this (glTF's normalTexture.scale); not 0

    friend bool operator==(const MapReading&, const MapReading&) = default;
};

/// Finds the reading of a program by its name in lower case: the names of findConvention, and "three". `gltf`, `blender`
/// and `opengl` are the default; `directx` has green down; `unreal` green down and two channels; `unity` (URP and HDRP) two
/// channels; `godot` and `three` a bitangent per vertex and unit vectors, and `godot` two channels. From the shader
/// sources of these programs as they stood in 2026 (docs/shaders.md). Null for any other name. Thread-safe.
const MapReading* findMapReading(const char* name);

}  // namespace tspace
