// SPDX-License-Identifier: MIT
// A picture of a model: as its frames shade it, or of the frames themselves. CMake target tspace::asset. This is the
// shading reference made visible, no renderer: no shadows, no objects in reflections. docs/guides/render.md shows every view.
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

/// What a picture shows of a surface.
enum class RenderShow : std::uint32_t {
    lit = 0,       ///< base colour in the light of one lamp, with the normal map, by Lambert's law
    normals = 1,   ///< N as interpolated, made unit, in the world: red, green, blue = 0.5 (x, y, z) + 0.5
    tangents = 2,  ///< T, likewise
    sign =
        3,  ///< w: blue +1, orange -1, magenta neither; stripes where the UV map is mirrored, red where both disagree
    error = 4,   ///< the angle between the stored frames and those of a method, as a heat map with a scale
    uv = 5,      ///< the UV map: its islands in colours, mirrored ones with stripes
    mapped = 6,  ///< the normal that `lit` shades, in the colours of `normals`
    both = 7,    ///< `lit`, left of a line with the stored frames, right of it with those of a method
};
/// "lit", "normals", ...: the name of the enumerator.
const char* renderShowName(RenderShow show);

/// Whose tangents are shown.
enum class RenderFrames : std::uint32_t {
    automatic = 0,  ///< those of the file; where it has none those of a method, as glTF asks of renderers
    stored = 1,     ///< those of the file alone
    computed = 2,   ///< those of a method everywhere, as generateFile with ExistingTangents::replace makes them
};

struct RenderOptions {
    RenderShow show = RenderShow::lit;
    std::uint32_t width = 1024, height = 1024;  ///< 16 to 8192 pixels
    /// Points that are looked at along each side of a pixel, 1 to 4. With 1 the point is its centre. width * samples and
    /// height * samples may be 16384 at most, and their product 2^26.
    std::uint32_t samples = 2;
    /// Where the camera stands. Yaw 0 looks from +z, which is the front of a glTF model, 90 from +x; pitch 90 looks from
    /// +y. All of the model is in the picture.
    double yaw_deg = 35, pitch_deg = 20;
    double field_of_view_deg = 30;  ///< of the shorter side, 0 to 120; 0: parallel rays
    /// Towards the lamp, as seen from the camera: x to the right, y up, z to the camera. Any length but 0.
    Vec3 to_light = {-0.45f, 0.65f, 0.8f};
    RenderFrames frames = RenderFrames::automatic;
    /// Whose frames are computed where the file's are not shown, and compared with those by `error`. Its convention is
    /// always glTF's, which is that of the picture.
    Method method = Method::mikktspace;
    /// How texels of normal maps become normals; its scale is multiplied with that of the material.
    MapReading reading = {};
    bool textures = true;  ///< false: surfaces in their plain colour, without normal maps
    bool pose = true;      ///< false: skins as they were bound, without morph targets
    /// Under the picture what its colours mean and whose tangents it shows, in a third of its rows at most; a picture of less
    /// than 200 columns has no room for it.
    bool legend = true;
    /// Pictures of a turn about the vertical axis, each as far on as the others: 1 to 999. With more than one, OUT.png is
    /// written as OUT_000.png and so on, and the distance of the camera is the same in all.
    std::uint32_t turntable = 1;
    /// Images of more pixels are not shown. The default is 8192 x 8192.
    std::uint64_t most_pixels = std::uint64_t{1} << 26;
    FileOptions file = {};
    Execution execution = {};  ///< changes no bit of the picture; an allocator is not used
    Sink sink = {};            ///< takes the PNG in place of a file
    bool dry_run = false;      ///< everything but writing
    /// Called between stages, and for each picture of `turntable`, on the calling thread; may throw Cancelled.
    Progress progress = {};
};

struct RenderReport {
    RenderShow show = RenderShow::lit;
    std::uint32_t width = 0, height = 0;
    std::uint32_t picture_count = 1;    ///< of `turntable`
    std::uint64_t triangle_count = 0;   ///< drawn, each primitive as often as nodes draw it
    std::uint64_t primitive_count = 0;  ///< in the file
    std::uint64_t without_tangents_count =
        0;                             ///< primitives whose file has none and that have none in the picture either
    std::uint64_t computed_count = 0;  ///< primitives whose tangents were computed for the picture
    /// Of `error`: over the samples of the picture that have both frames. 0 where there are none.
    std::uint64_t error_sample_count = 0;
    double mean_error_deg = 0, max_error_deg = 0;
    std::vector<std::string> warnings =
        {};  ///< one sentence each: textures that were not shown, and what reading had to say
};

/// Draws the model into a PNG of 8 bits. Pixels have the same bytes on every machine and for any number of threads.
///
/// Surfaces are drawn where the nodes of the file's scene put them, as its joints and the weights of its morph targets pose
/// them. Materials: baseColorFactor and baseColorTexture, COLOR_0, normalTexture with its scale, doubleSided, alphaMode MASK,
/// KHR_texture_transform, KHR_materials_unlit. Nothing shows through alphaMode BLEND: `lit` draws such a surface where its alpha is
/// at least half of the material's. Back faces of other materials than double-sided ones are not drawn. Textures
/// are read bilinearly, without mipmaps. Errors: those of generateFile for reading; invalidOption (a size, angle or
/// direction out of range); tooLarge (also where nodes draw triangles without
/// end, or these cover the picture a hundred times over); unsupportedFile
/// where tspace was built without libspng; cannotWrite. On error nothing on disk has changed. Time: linear in triangles and
/// samples. Memory: 8 bytes per sample, and the model. Thread-safe.
Result<RenderReport> renderFile(const std::string& input, const std::string& output, const RenderOptions& options = {});

}  // namespace tspace
