// SPDX-License-Identifier: MIT
// Normal maps of model files: baking from a high poly, and comparison with it. CMake target tspace::asset.
//
// The low poly's frames are read from its file; missing ones are computed as by generateFile. Meshes are transformed by
// the nodes of their files: a low poly by its first node, a high poly by all of its nodes. Models with more than one
// object are matched by name: NAME, NAME_low and NAME_lp match NAME, NAME_high, NAME_hp and any number of
// NAME_high_ANYTHING. Node names take precedence over mesh names.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tspace/callbacks.h"
#include "tspace/check.h"
#include "tspace/execution.h"
#include "tspace/generate.h"
#include "tspace/maps.h"
#include "tspace/normals.h"
#include "tspace/result.h"
#include "tspace/tangents.h"

namespace tspace {

/// File that an error refers to: value of Error::element in errors of bakeFile and mapErrorFile about one file.
enum class BakeInput : std::uint32_t { low = 0, high = 1, cage = 2, map = 3, skew = 4 };

/// Source of the green direction of a high poly's normal map.
enum class GreenSource : std::uint32_t {
    assumed = 0,   ///< default of the format: up in glTF
    told = 1,      ///< BakeFileOptions::high_green
    declared = 2,  ///< declared in the file
    seen = 3,      ///< detected from the slopes of the map
};

/// A normal map of the high poly that is included in the bake.
struct BakedHighMap {
    std::string image = {};     ///< URI of the image, or its name
    std::string material = {};  ///< material of the first primitive that uses it; may be empty
    double scale = 1;           ///< factor of x and y of the vectors
    Green green = Green::up;
    GreenSource green_is = GreenSource::assumed;
    std::uint64_t triangle_count = 0;
};

/// Rule by which MapLayer::id assigns IDs.
enum class BakeIds : std::uint32_t {
    material = 0,  ///< one ID per material name
    object = 1,    ///< one ID per node name of the high poly, or per mesh name if nodes have no names
    shell = 2      ///< one ID per connected component by position
};

struct BakeFileOptions {
    /// Bake options. The wrap modes are replaced by those of the low poly's textures. The memory limit is that of
    /// `file`, or 16 GB if that is 0.
    BakeOptions map = {};
    /// Options for computing missing tangents and normals of the low poly. The defaults are those of GenerateOptions.
    TangentOptions tangents{.convention = conventions::gltf};
    NormalOptions normals{.weighting = NormalWeighting::flat};
    /// Denoising of high polys with noisy positions, such as scans; same values as NormalOptions::denoise. Normals of
    /// noisy meshes are recomputed with `best`, without hard edges.
    float denoise = 0;
    FileOptions file = {};
    std::string cage = {};  ///< model with the low poly's triangles, moved to the start of the rays; empty: none
    std::string skew = {};  ///< image for `map.rays.skew`; empty: none
    /// Rule by which objects of the low poly are matched with objects of the high poly. "names": by node or mesh names;
    /// "all": rays of every object hit every object; otherwise: path of a file with lines LOW = HIGH, with node or mesh
    /// names. An object without a match is not restricted, and a warning names it.
    std::string match = "names";
    /// Ignore the normal maps of the high poly's materials: bake its vertex normals only.
    bool ignore_high_maps = false;
    /// Green direction of the high poly's normal maps. Unset: as declared in the file, otherwise as detected from their
    /// slopes, otherwise up.
    std::optional<Green> high_green = {};
    std::string misses = {};  ///< path of an image that shows the state of each texel (TexelOrigin); empty: none
    std::string heat = {};    ///< path of an image of the error as a heat map; empty: none
    /// Path for the low poly with the frames that were used and the maps as its textures: .glb (embeds them) or .gltf
    /// (refers to them). All files appear together, or none. Not with `udim`, object space or green down, which glTF
    /// does not support (invalidOption). Empty: not written.
    std::string out_mesh = {};
    /// Bake texels of unit length, for two-channel formats whose readers reconstruct z from x and y (BC5, DXT5nm): sets
    /// `map.reading.two_channels` for any reading.
    bool unit = false;
    bool udim = false;  ///< one file per UDIM tile: NAME.1001.png
    /// Also bake triangles whose UV center lies outside 0-1, into the texels that a repeating texture shows there.
    /// Otherwise (and without `udim`) they are ignored as offset copies, which artists use for surfaces that share
    /// texels. A material with only such triangles is always baked this way.
    bool wrap = false;
    /// Layers to bake. The call sets `ids`, `material` and the box of positions. The normal map is written to the
    /// output path, the others to NAME_ao.png and so on; the red channel of `orm` is `ao`, if both are requested.
    LayerOptions layers = {};
    BakeIds ids = BakeIds::material;
    Execution execution = {};
    Progress progress = {};
};

/// Ray settings that were used.
struct UsedRays {
    RayTarget target = RayTarget::outermost;
    RayDirections directions = RayDirections::automatic;
    bool has_skew = false;  ///< the directions came from an image
    bool has_cage = false;  ///< the rays came from a cage mesh of the low poly
};

/// Meaning of a color of MapLayer::id.
struct BakedId {
    std::string name = {};  ///< name of the material or object; may be empty; shells have none
    std::array<std::uint8_t, 3> color = {};
};

/// Image of a layer that was written in addition to the normal map.
struct BakedLayerFile {
    MapLayer layer = MapLayer::ao;
    std::string path = {};
    unsigned bits = 8;     ///< bits per channel
    bool is_srgb = false;  ///< true: its values are sRGB-encoded
    /// Quantities that black and white represent, per channel, in model units.
    std::array<double, 3> least = {0, 0, 0}, most = {1, 1, 1};
    std::uint64_t id_count = 0;     ///< number of IDs in the high poly, for MapLayer::id
    std::vector<BakedId> ids = {};  ///< meaning of the first 256 IDs
};

/// Normal map of one material or tile, and its layers.
struct BakedFile {
    std::string path = {};      ///< path of the normal map; empty if it was not requested
    std::string material = {};  ///< name of the material; may be empty
    std::uint32_t tile = 0;     ///< UDIM number, from 1001, with `udim`; otherwise 0
    std::uint64_t triangle_count = 0;
    std::uint64_t outside_count = 0;  ///< ignored triangles of the material: see BakeFileOptions::wrap
    UsedRays rays = {};
    BakedMap map = {};        ///< the baked map, without its texels
    double heat_top_deg = 0;  ///< angle that the brightest color of the heat map shows
    std::vector<BakedLayerFile> layers = {};
};

struct BakeFileReport {
    std::vector<BakedFile> files = {};
    std::vector<BakedHighMap> high_maps = {};  ///< normal maps that were included in the bake
    /// true: tangents or normals of the low poly were computed, at least in part
    bool frames_made = false;
    /// true: rays of the objects of the low poly hit only the matching objects of the high poly
    bool matched_by_name = false;
    std::uint64_t low_triangle_count = 0, high_triangle_count = 0;
    std::vector<std::string> output_files = {};  ///< all files that were written
    /// Defects that make maps useless, with causes: most rays hit nothing, normals of the high poly point inwards. An
    /// image without any hits is not written.
    std::vector<std::string> findings = {};
    std::vector<std::string> warnings = {};  ///< one sentence per warning
};

/// Bakes the maps of `low` from `high`; the normal map is `output`, a PNG. A low poly with several materials gets one
/// file per material: NAME.MATERIAL.png. All files appear at once or not at all. Errors: those of bakeMap, except that
/// rays without a hit are reported as a finding; also cannotRead, invalidFile, unsupportedFile (also a build that
/// writes no PNG), forbiddenPath, tooLarge, cannotWrite.
Result<BakeFileReport> bakeFile(const std::string& low, const std::string& high, const std::string& output,
                                const BakeFileOptions& options = {});

struct MapErrorFileOptions {
    MapErrorOptions map = {};                                  ///< interpretation and measurement of the map
    TangentOptions tangents{.convention = conventions::gltf};  ///< same meaning as in BakeFileOptions
    NormalOptions normals{.weighting = NormalWeighting::flat};
    FileOptions file = {};
    std::string cage = {}, skew = {}, match = "names";  ///< same meaning as in BakeFileOptions
    bool ignore_high_maps = false;                      ///< same meaning as in BakeFileOptions
    std::optional<Green> high_green = {};               ///< same meaning as in BakeFileOptions
    bool two_channels = false;  ///< true: z is computed from x and y; sets `map.reading.two_channels` for any reading
    std::string material = {};  ///< only triangles of the material with this name; empty: all
    std::uint32_t tile = 0;     ///< only triangles of this UDIM tile, from 1001; 0: all
    std::string heat = {};      ///< path of a heat map of the error; empty: none
    Execution execution = {};
    Progress progress = {};
};

/// Interpretation of the map, with the error that it has under this interpretation.
struct ExplainedReading {
    /// Source of the frames: "file" (stored tangents), the name of a method, "quads" (mikktspace on quads), or "object"
    /// (an object-space map without frames).
    std::string frames = {};
    MapAxes axes = {};  ///< axes of the map, in object space
    MapReading reading = {};
    MapError error = {};
};

/// Ray settings with which a map may have been baked, and the error of the map against what these rays hit.
struct ExplainedRays {
    UsedRays rays = {};
    MapError error = {};  ///< error with the tested reach and offset
};

struct MapErrorFileReport {
    std::uint32_t width = 0, height = 0;
    unsigned bits = 8;
    MapError error = {};  ///< error with the requested interpretation and rays; without `heat`
    /// All ray settings that were tried, best first; the first is how the map was probably baked. Measured at 20,000
    /// points with the best interpretation for the requested rays. With a cage mesh no other setting is tried.
    std::vector<ExplainedRays> rays = {};
    /// All interpretations that were tried, best first; measured with the best rays.
    std::vector<ExplainedReading> readings = {};
    bool fits = false;         ///< true: no other interpretation and no other rays are much better
    std::string verdict = {};  ///< summary for artists
    bool frames_made = false, matched_by_name = false;
    std::vector<BakedHighMap> high_maps = {};  ///< normal maps of the high poly that are included in the true normals
    double heat_top_deg = 0;
    std::vector<std::string> warnings = {};
};

/// Measures a normal map of a low poly against its high poly, and finds the interpretation that explains it best: green
/// up or down, frames of the file or of a method, on triangles or quads, bitangent per pixel or per vertex, two or
/// three channels, tangent or object space; and the rays it was baked with. Errors: those of bakeFile and of image
/// readers.
Result<MapErrorFileReport> mapErrorFile(const std::string& map, const std::string& low, const std::string& high,
                                        const MapErrorFileOptions& options = {});

// Preparation of a generated or scanned mesh for use: winding, normals, tangents, and, with a low poly, all maps baked
// onto it. CMake target tspace::asset. Combines generateFile, bakeFile and checkFile in one call; correct data is kept.

/// Normals to recompute.
enum class FinishNormals : std::uint32_t {
    missing = 0,  ///< missing normals, and those that checkFile reports as errors
    all = 1,      ///< all normals
    none = 2,     ///< only normals that tangents need
};

/// Returns BakeFileOptions with all maps.
BakeFileOptions allMaps();

struct FinishOptions {
    FinishNormals normals = FinishNormals::missing;
    /// Crease angle and denoising of computed normals, with the values of NormalOptions; their weighting is `best`.
    /// Computed normals of the low poly have no hard edges, which would require UV seams.
    float crease_angle_deg = NormalOptions::crease_auto;
    float denoise = NormalOptions::denoise_auto;
    /// Weld distance for computing normals and flipping triangles. Same meaning as NormalOptions::weld_distance.
    float weld_distance = NormalOptions::weld_auto;
    /// true: flip triangles that are wound the wrong way, as GenerateOptions::mend_winding does. A mesh keeps its
    /// winding if checkFile would otherwise find more normals against their triangles than before: its normals match
    /// its triangles, and it renders correctly.
    bool mend_winding = true;
    /// read the pixels of normal maps, to check and repair (CheckOptions::images, GenerateOptions::Maps::read); does
    /// not affect baking
    bool images = true;
    /// Low poly with UVs: all maps are baked onto it from the input, and it is written to the output with them. Empty:
    /// the input itself is written to the output.
    std::string low = {};
    /// Options for baking maps. The call sets its models, `out_mesh`, file, execution and progress.
    BakeFileOptions bake = allMaps();
    std::string page = {};  ///< path of an HTML report with pictures before and after; empty: none
    std::string page_date = {};
    /// Command line of the run, as shown in the page: any text; empty: only the version.
    std::string page_command = {};
    FileOptions file = {};  ///< `content` is not supported
    Execution execution = {};
    Progress progress = {};
};

/// Changes to a model.
struct FinishedModel {
    std::string path = {};
    GenerateReport made = {};  ///< changes to winding, normals and tangents; names no output file
    CheckReport before = {};
    std::uint64_t without_uvs_count = 0;  ///< primitives with triangles and without UVs
    /// Triangles that were not flipped, because their mesh keeps its winding (FinishOptions::mend_winding).
    std::uint64_t left_winding_count = 0;
    std::uint64_t normals_scaled_count = 0;  ///< primitives whose normals were scaled to length 1
    bool attributes_repaired = false;        ///< attributes that could not be read were repaired or removed
};

struct FinishReport {
    FinishedModel model = {};
    std::optional<FinishedModel> low = {};
    std::optional<BakeFileReport> bake = {};
    CheckReport check = {};  ///< check of the output
    /// Actions that were not possible, with the tools that can do them: one sentence each.
    std::vector<std::string> remarks = {};
    /// All written files, the model first; empty if no ray of any image hit anything.
    std::vector<std::string> output_files = {};
    std::uint64_t output_bytes = 0;  ///< size of the model file
};

/// Reads `input` (any format), and writes `output`, a GLB. Correct normals and tangents are kept; a GLB without faults
/// is copied byte for byte. Maps are written next to the output, as OUT_normal.png, OUT_ao.png and so on, and those
/// that glTF supports are also embedded. All files appear at once or not at all. Errors: those of generateFile and
/// bakeFile; Error::element is a BakeInput: `high` for the input and `low` for the low poly.
Result<FinishReport> finishFile(const std::string& input, const std::string& output, const FinishOptions& options = {});

}  // namespace tspace
