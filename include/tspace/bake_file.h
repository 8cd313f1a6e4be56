// SPDX-License-Identifier: MIT
// Normal maps of model files: baked from a high poly, and measured against it. CMake target tspace::asset.
//
// A low poly is taken with the frames that are in its file; missing ones are made as generateFile makes them. Meshes stand
// where the nodes of their files put them: a low poly at the first place, a high poly at all of them. Models of more than one
// object are matched by name: NAME, NAME_low and NAME_lp with NAME, NAME_high, NAME_hp and NAME_high_ANYTHING, of which there may
// be several. Names of nodes come first, then those of meshes.
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

/// Which file an error is about: bakeFile and mapErrorFile tell its number as Error::element, where it is about one.
enum class BakeInput : std::uint32_t { low = 0, high = 1, cage = 2, map = 3, skew = 4 };

/// How it is known which way green of a high poly's normal map points.
enum class GreenSource : std::uint32_t {
    assumed = 0,   ///< default of the format: up in glTF
    told = 1,      ///< BakeFileOptions::high_green
    declared = 2,  ///< the file says so
    seen = 3,      ///< the slopes of the map say so
};

/// A normal map that the high poly shows itself, and that is baked through.
struct BakedHighMap {
    std::string image = {};     ///< its URI or name
    std::string material = {};  ///< material of the first primitive that uses it; may be empty
    double scale = 1;           ///< factor of x and y
    Green green = Green::up;
    GreenSource green_is = GreenSource::assumed;
    std::uint64_t triangle_count = 0;
};

/// Items that get a number of their own in MapLayer::id.
enum class BakeIds : std::uint32_t {
    material = 0,  ///< materials by their names
    object = 1,    ///< nodes of the high poly by their names, or meshes where nodes have none
    shell = 2      ///< connected components by position
};

struct BakeFileOptions {
    /// Its wrap modes are those of the low poly's textures. Its limit on memory is that of `file`, or 16 GB, where it is 0.
    BakeOptions map = {};
    /// Frames that the low poly lacks: as GenerateOptions has them.
    TangentOptions tangents{.convention = conventions::gltf};
    NormalOptions normals{.weighting = NormalWeighting::flat};
    /// For high polys with noisy positions, such as scans: as NormalOptions::denoise. Normals of what is noisy are made anew, by
    /// `best`, without hard edges.
    float denoise = 0;
    FileOptions file = {};
    std::string cage = {};  ///< a model with the low poly's triangles, moved to where rays begin; empty: none
    std::string skew = {};  ///< an image for `map.rays.skew`; empty: none
    /// Which objects look at which: "names"; "all": at everything; else a file with lines LOW = HIGH, names of nodes or
    /// meshes as they are. What has no partner sees everything, or is seen by everything, and a warning names it.
    std::string match = "names";
    /// Without the normal maps that materials of the high poly have: its own normals alone are what is seen.
    bool ignore_high_maps = false;
    /// Direction of green in these maps. Nothing: as the file declares, or as their slopes show, or up.
    std::optional<Green> high_green = {};
    std::string misses = {};  ///< path of a picture of the texel states; empty: none
    std::string heat = {};    ///< path of a heat map of the error; empty: none
    /// Where to write the low poly with the frames that were used and the maps as its normal textures: .glb (holds them) or
    /// .gltf (names them). As a part of the same whole: all files appear, or none. Not with `udim`, object space or green
    /// down, which glTF does not have (invalidOption). Empty: nowhere.
    std::string out_mesh = {};
    /// Texels of length 1, for formats of two channels, from whose x and y readers make z (BC5, DXT5nm): what
    /// `map.reading.two_channels` says, whatever the reading.
    bool unit = false;
    bool udim = false;  ///< a file per tile of UVs: NAME.1001.png
    /// Triangles whose UVs have their middle outside of 0 to 1 are baked too, where the texture shows them again. Without this,
    /// and without `udim`, they have no say: so artists put copies of what shares texels aside. A material that has
    /// no other triangles is baked so in any case.
    bool wrap = false;
    /// Which maps. `ids`, `material` and the box of positions are set by the call. The normal map has the name of the output, the others
    /// NAME_ao.png and so on; where both are made, red of `orm` is `ao`.
    LayerOptions layers = {};
    BakeIds ids = BakeIds::material;
    Execution execution = {};
    Progress progress = {};
};

/// How rays went.
struct UsedRays {
    RayTarget target = RayTarget::outermost;
    RayDirections directions = RayDirections::automatic;
    bool has_skew = false;  ///< an image said where they point
    bool has_cage = false;  ///< a cage of the low poly's own said all of it
};

/// Meaning of a color of MapLayer::id.
struct BakedId {
    std::string name = {};  ///< name of the material or object; may be empty; shells have none
    std::array<std::uint8_t, 3> color = {};
};

/// An image beside the normal map.
struct BakedLayerFile {
    MapLayer layer = MapLayer::ao;
    std::string path = {};
    unsigned bits = 8;     ///< bits per channel
    bool is_srgb = false;  ///< its numbers have the sRGB curve
    /// Values of black and white for each channel, in model units.
    std::array<double, 3> least = {0, 0, 0}, most = {1, 1, 1};
    std::uint64_t id_count = 0;     ///< for MapLayer::id: number of items of the high poly
    std::vector<BakedId> ids = {};  ///< the first 256 of them
};

/// One image, and those beside it.
struct BakedFile {
    std::string path = {};      ///< path of the normal map; empty if it was not requested
    std::string material = {};  ///< its name; may be empty
    std::uint32_t tile = 0;     ///< 1001 and on with `udim`, else 0
    std::uint64_t triangle_count = 0;
    std::uint64_t outside_count = 0;  ///< triangles of the material that have no say: see BakeFileOptions::wrap
    UsedRays rays = {};
    BakedMap map = {};        ///< without texels
    double heat_top_deg = 0;  ///< value of the brightest color of the heat map
    std::vector<BakedLayerFile> layers = {};
};

struct BakeFileReport {
    std::vector<BakedFile> files = {};
    std::vector<BakedHighMap> high_maps = {};  ///< normal maps that were baked through
    bool frames_made = false;                  ///< the low poly had no tangents, or no normals, in part at least
    bool matched_by_name = false;              ///< objects of the low poly saw their own of the high poly alone
    std::uint64_t low_triangle_count = 0, high_triangle_count = 0;
    std::vector<std::string> output_files = {};  ///< everything that was written
    /// What makes maps useless, and why: rays that mostly met nothing, normals of the high poly that point inwards. Where no
    /// ray of an image met anything, nothing is written.
    std::vector<std::string> findings = {};
    std::vector<std::string> warnings = {};  ///< one sentence each
};

/// Bakes the maps of `low` from `high`; the normal map is `output`, a PNG. A low poly of several materials gives a file each:
/// NAME.MATERIAL.png. All files appear at once or not at all. Errors: those of bakeMap, but for rays that meet nothing, which
/// are findings; and cannotRead, invalidFile,
/// unsupportedFile (also a build that writes no PNG), forbiddenPath, tooLarge, cannotWrite.
Result<BakeFileReport> bakeFile(const std::string& low, const std::string& high, const std::string& output,
                                const BakeFileOptions& options = {});

struct MapErrorFileOptions {
    MapErrorOptions map = {};                                  ///< how the map is interpreted and measured
    TangentOptions tangents{.convention = conventions::gltf};  ///< as in BakeFileOptions
    NormalOptions normals{.weighting = NormalWeighting::flat};
    FileOptions file = {};
    std::string cage = {}, skew = {}, match = "names";  ///< as in BakeFileOptions
    bool ignore_high_maps = false;                      ///< likewise
    std::optional<Green> high_green = {};               ///< likewise
    bool two_channels = false;  ///< z is made from x and y: `map.reading.two_channels`, whatever the reading
    std::string material = {};  ///< only triangles of the material with this name; empty: all
    std::uint32_t tile = 0;     ///< only triangles of this UDIM tile, 1001 and on; 0: all
    std::string heat = {};      ///< path of a heat map of the error; empty: none
    Execution execution = {};
    Progress progress = {};
};

/// One way to read a map, and the error that it has then.
struct ExplainedReading {
    std::string frames =
        {};             ///< "file", a method, "quads" (mikktspace on quads), or "object" (no frames: object space)
    MapAxes axes = {};  ///< axes of object space
    MapReading reading = {};
    MapError error = {};
};

/// One way in which rays may have gone when a map was baked, and the error of the map against what they meet.
struct ExplainedRays {
    UsedRays rays = {};
    MapError error = {};  ///< with the reach and the offset that were tried
};

struct MapErrorFileReport {
    std::uint32_t width = 0, height = 0;
    unsigned bits = 8;
    MapError error = {};  ///< error as requested, without heat
    /// All that were tried, the best first. The first is how the map was baked, if any of them is. At 20,000 points, read as
    /// the best of the readings under the rays that were asked for. With a cage of the low poly's own nothing else is tried.
    std::vector<ExplainedRays> rays = {};
    std::vector<ExplainedReading> readings = {};  ///< all that were tried, the best first; measured with the best rays
    bool fits = false;                            ///< no other reading and no other rays are much better
    std::string verdict = {};                     ///< for an artist
    bool frames_made = false, matched_by_name = false;
    std::vector<BakedHighMap> high_maps = {};  ///< maps of the high poly that are a part of the truth
    double heat_top_deg = 0;
    std::vector<std::string> warnings = {};
};

/// Measures a normal map of a low poly against its high poly, and finds which way to read it explains it best: green up or down,
/// the frames that are in the file or those of a method, on triangles or quads, a bitangent per pixel or per vertex, two
/// channels or three, tangent or object space; and which rays it was baked with. Errors as bakeFile; also those of readers of images.
Result<MapErrorFileReport> mapErrorFile(const std::string& map, const std::string& low, const std::string& high,
                                        const MapErrorFileOptions& options = {});

// A mesh of a generator or a scanner made ready for use: winding, normals, tangents, and with a low poly all maps baked onto it.
// CMake target tspace::asset. What generateFile, bakeFile and checkFile do, in one call: nothing is done that is right already.

/// Normals that are recomputed.
enum class FinishNormals : std::uint32_t {
    missing = 0,  ///< missing normals, and those that checkFile reports as errors
    all = 1,      ///< everywhere
    none = 2,     ///< only those that tangents need
};

/// BakeFileOptions with all maps.
BakeFileOptions allMaps();

struct FinishOptions {
    FinishNormals normals = FinishNormals::missing;
    /// Of normals that are made, by `best`: as NormalOptions has them. Those of the low poly have no hard edges, which would need
    /// seams of UVs.
    float crease_angle_deg = NormalOptions::crease_auto;
    float denoise = NormalOptions::denoise_auto;
    /// Weld distance for computing normals and turning triangles: as NormalOptions::weld_distance.
    float weld_distance = NormalOptions::weld_auto;
    /// As GenerateOptions. A mesh stays as it is wound where check then finds more normals against their triangles than before:
    /// its normals fit its triangles as they are, and it renders right.
    bool mend_winding = true;
    bool images = true;  ///< as CheckOptions::images and GenerateOptions::images; maps are baked in any case
    /// A model with UVs in the place of the input, of which it is the high poly: the output is this one, with all maps. Empty:
    /// the output is the input.
    std::string low = {};
    /// How maps are baked. Its models, `out_mesh`, file, execution and progress are set by the call.
    BakeFileOptions bake = allMaps();
    std::string page = {};  ///< path of an HTML report with pictures before and after; empty: none
    std::string page_date = {},
                page_command = {};  ///< of the run, as the page says them: any text; empty: only the version
    FileOptions file = {};          ///< without `content`
    Execution execution = {};
    Progress progress = {};
};

/// Changes to a model.
struct FinishedModel {
    std::string path = {};
    GenerateReport made = {};  ///< winding, normals and tangents; names no output
    CheckReport before = {};
    std::uint64_t without_uvs_count = 0;  ///< primitives with triangles and without UVs
    /// Triangles that would have been turned in meshes that stay as they are wound.
    std::uint64_t left_winding_count = 0;
};

struct FinishReport {
    FinishedModel model = {};
    std::optional<FinishedModel> low = {};
    std::optional<BakeFileReport> bake = {};
    CheckReport check = {};  ///< check of the output
    std::vector<std::string> remarks =
        {};  ///< actions that were not possible, and which tools do them: one sentence each
    std::vector<std::string> output_files = {};  ///< the model first. Empty where no ray of an image met anything
    std::uint64_t output_bytes = 0;              ///< size of the model file
};

/// Reads `input` (any format), and writes `output`, a GLB. Right normals and tangents stay; where nothing is wrong a GLB is
/// copied byte for byte. Maps stand beside the output, OUT_normal.png, OUT_ao.png and so on, and those that glTF has a place for
/// in it too. All files appear at once or not at all. Errors: those of generateFile and bakeFile; Error::element is a BakeInput:
/// `high` for the input and `low` for the low poly.
Result<FinishReport> finishFile(const std::string& input, const std::string& output, const FinishOptions& options = {});

}  // namespace tspace
