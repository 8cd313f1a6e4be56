// SPDX-License-Identifier: MIT
// Image of a model, shaded with its frames, or showing the frames themselves. CMake target tspace::asset. A
// visualization of the shading reference, not a renderer: no shadows, and reflections show no objects.
// docs/guides/render.md shows every view.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tspace/callbacks.h"
#include "tspace/execution.h"
#include "tspace/generate.h"
#include "tspace/maps.h"
#include "tspace/result.h"
#include "tspace/span.h"
#include "tspace/tangents.h"

namespace tspace {

/// What an image shows of a surface.
enum class RenderShow : std::uint32_t {
    lit = 0,       ///< base color lit by one light, with the normal map, by Lambert's law
    normals = 1,   ///< interpolated N, normalized, in world space: red, green, blue = 0.5 (x, y, z) + 0.5
    tangents = 2,  ///< T, in the colors of `normals`
    /// w: blue +1, orange -1, magenta other values; stripes where the UV map is mirrored, red where w and UVs disagree
    sign = 3,
    error = 4,   ///< angle between the stored frames and the frames of a method, as a heat map with a scale
    uv = 5,      ///< UV map: islands in different colors, mirrored ones striped
    mapped = 6,  ///< the normal that `lit` shades, in the colors of `normals`
    both = 7,    ///< `lit` with the stored frames left of a line, with the frames of a method right of it
};
/// Returns the name of the enumerator: "lit", "normals", ...
const char* renderShowName(RenderShow show);

/// Source of the tangents that are shown.
enum class RenderFrames : std::uint32_t {
    automatic = 0,  ///< tangents of the file; if missing, tangents of a method, as glTF requires of renderers
    stored = 1,     ///< only tangents of the file
    computed = 2,   ///< computed tangents everywhere, as by generateFile with ExistingTangents::replace
};

struct RenderOptions {
    RenderShow show = RenderShow::lit;
    std::uint32_t width = 1024, height = 1024;  ///< 16 to 8192 pixels
    /// Samples along each side of a pixel, 1 to 4. 1: the pixel center. width * samples and height * samples may be at
    /// most 16384, and their product at most 2^26.
    std::uint32_t samples = 2;
    /// Direction of the camera. Yaw 0: from +z, the front of a glTF model; 90: from +x. Pitch 90: from +y. The whole
    /// model is in the image.
    double yaw_deg = 35, pitch_deg = 20;
    double field_of_view_deg = 30;  ///< angle of view along the shorter side of the image, 0 to 120; 0: parallel rays
    /// Direction to the light in camera space: x to the right, y up, z towards the camera. Any length except 0.
    Vec3 to_light = {-0.45f, 0.65f, 0.8f};
    RenderFrames frames = RenderFrames::automatic;
    /// Method for frames that are computed because the file's are not shown, and for frames that `error` compares.
    /// Always in glTF's convention, which is the convention of the image.
    Method method = Method::mikktspace;
    /// Interpretation of normal-map texels; its scale is multiplied by the material's scale.
    MapReading reading = {};
    bool textures = true;  ///< false: only base color factors, no textures and no normal maps
    bool pose = true;      ///< false: skins in bind pose, without morph targets
    /// Add a legend below the image: meaning of the colors and source of the tangents. It takes at most a third of the
    /// rows; images narrower than 200 columns get none.
    bool legend = true;
    /// Number of images of a turn about the vertical axis in equal steps: 1 to 999. With more than one, OUT.png is
    /// written as OUT_000.png and so on, all with the same camera distance.
    std::uint32_t turntable = 1;
    /// Textures with more pixels are not shown. Default: 8192 x 8192.
    std::uint64_t most_pixels = std::uint64_t{1} << 26;
    FileOptions file = {};
    Execution execution = {};  ///< does not affect the image; an allocator is not used
    Sink sink = {};            ///< receives the PNG instead of a file
    bool dry_run = false;      ///< true: nothing is written
    /// Called between stages, and for each image of `turntable`, on the calling thread; may throw Cancelled.
    Progress progress = {};
};

struct RenderReport {
    RenderShow show = RenderShow::lit;
    std::uint32_t width = 0, height = 0;
    std::uint32_t picture_count = 1;           ///< images of `turntable`
    std::uint64_t triangle_count = 0;          ///< triangles drawn; a primitive counts once per node that draws it
    std::uint64_t primitive_count = 0;         ///< primitives of the file
    std::uint64_t without_tangents_count = 0;  ///< primitives without tangents, both in the file and in the image
    std::uint64_t computed_count = 0;          ///< primitives whose tangents were computed for the picture
    /// For `error`: statistics over the samples that have both frames; 0 if there are none.
    std::uint64_t error_sample_count = 0;
    double mean_error_deg = 0, max_error_deg = 0;
    /// One sentence each: textures that were not shown, and warnings about the file.
    std::vector<std::string> warnings = {};
};

/// Draws the model into an 8-bit PNG. Pixels have the same bytes on every machine and for any number of threads.
///
/// Nodes of the file's scene place the surfaces; joints and morph weights pose them. Supported material properties:
/// baseColorFactor and baseColorTexture, COLOR_0, normalTexture with its scale, doubleSided, alphaMode MASK,
/// KHR_texture_transform, KHR_materials_unlit. alphaMode BLEND is not blended: `lit` draws such a surface where its
/// alpha is at least half of the material's. Back faces are drawn only for double-sided materials. Textures are sampled
/// bilinearly, without mipmaps.
/// Errors: those of generateFile for reading; invalidOption (a size, angle or direction out of range); tooLarge (also
/// if nodes draw too many triangles, or these cover the image a hundred times over); unsupportedFile if tspace was
/// built without libspng; cannotWrite. On error, no file is changed. Time: linear in triangles and samples. Memory: 8
/// bytes per sample, and the model. Thread-safe.
Result<RenderReport> renderFile(const std::string& input, const std::string& output, const RenderOptions& options = {});

}  // namespace tspace
