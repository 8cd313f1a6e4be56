// SPDX-License-Identifier: MIT
// Model files as arrays for baking, and the results of a bake: pictures, and the model with its maps.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "commands/bake/high_maps.h"
#include "core/base/owned_mesh.h"
#include "images/float_image.h"
#include "maps/layout/uv_coverage.h"
#include "maps/rays/map_surfaces.h"
#include "model/gltf/model.h"
#include "model/io/atomic_output.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/read/read_scene.h"
#include "model/scene/scene.h"
#include "tspace/bake_file.h"
#include "tspace/maps.h"

namespace tspace {

// Writes a low poly whose materials use the maps that were baked for it.

/// A primitive, and the UVs with which its map is sampled.
struct MappedPrimitive {
    std::uint32_t mesh = 0, primitive = 0;
    bool had_map = false;  ///< the material already has a normal map with these UVs
    std::size_t uv_set = 0;
    UvTransform transform = {};
};

/// Texture slot of a material.
enum class MapSlot { normal, occlusion, metal, occlusion_and_metal, color, emission };

/// A baked image, and the primitives that use it.
struct ModelMap {
    std::string path = {};  ///< path of the image file
    Bytes png = {};
    std::vector<MappedPrimitive> primitives = {};
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    MapSlot slot = MapSlot::normal;
};

struct ModelWithMaps {
    gltf::Model model;        ///< low poly with the frames for which the maps were baked
    std::string output = {};  ///< path of the output, .glb or .gltf
    std::vector<ModelMap> maps = {};
};

/// Adds the model with its maps to `model_files`, and the maps to `map_files`, which may be the same object. A GLB
/// embeds the maps; a .gltf references them if they are in its folder or a subfolder, and embeds them otherwise.
/// Previous maps are removed unless something else uses them. Throws FileError.
void addModelWithMaps(ModelWithMaps&& model, AtomicOutput& model_files, AtomicOutput& map_files,
                      std::vector<std::string>& warnings);

/// Returns the result of `body`; if it fails, the error refers to this input.
template <class Body>
auto tagInput(BakeInput input, Body&& body) {
    std::optional<std::invoke_result_t<Body>> made;
    if (std::optional<Error> error = tryFile([&] { made.emplace(body()); })) {
        error->element = static_cast<std::uint64_t>(input);
        throw FileError{*std::move(error)};
    }
    return *std::move(made);
}

/// Triangles of a low poly.
struct LowPart {
    OwnedMesh corners = {};  ///< one vertex per corner
    std::vector<Vec3> cage = {};
    std::vector<std::uint32_t> groups = {};
    /// Part of the mesh that the map does not cover, see LowPoly.
    std::vector<Vec3> rest_positions = {}, rest_normals = {};

    [[nodiscard]] LowPoly view() const {
        return {.positions = corners.positions,
                .normals = corners.normals,
                .tangents = corners.tangents,
                .uvs = corners.uvs,
                .cage = cage,
                .groups = groups,
                .rest_positions = rest_positions,
                .rest_normals = rest_normals};
    }
    [[nodiscard]] std::size_t triangleCount() const { return corners.positions.size() / 3; }
    /// Appends a triangle of another part.
    void addTriangle(const LowPart& from, std::size_t triangle);
    void addToRest(const LowPart& from, std::size_t triangle);
};

/// Triangles of a low poly, with one part for each material, and therefore for each image.
struct LowModel {
    struct Image {
        std::string material = {};
        LowPart part = {};
        std::vector<MappedPrimitive> primitives = {};
        TextureWrap wrap_u = TextureWrap::repeat,
                    wrap_v = TextureWrap::repeat;  ///< wrap modes of the first primitive's texture
    };
    std::vector<Image> images = {};
    std::vector<std::string> warnings = {};
    bool frames_made = false;
    PositionBox all_places = {};  ///< bounding box of all instances; `images` has the first instance of each primitive
    /// Origin of the positions in world space; nonzero if both models are far from the origin.
    DVec3 origin = {};

    [[nodiscard]] std::size_t triangleCount() const;
};

/// Triangles of the high poly, starting at `first_triangle`, that belong to one placement in the scene.
struct HighPart {
    std::uint32_t first_triangle = 0;
    std::size_t placement = 0;
};

struct HighModel {
    std::vector<HighPart> parts = {};  ///< parts in ascending order of their first triangle
    OwnedMesh mesh = {};               ///< has tangents and UVs if the high poly has normal maps
    std::vector<std::uint32_t> groups = {};
    std::vector<std::uint32_t> map_of = {};  ///< map index per triangle; empty if there are no maps
    HighMaps shown = {};
    std::vector<std::string> warnings = {};
    /// Largest quantization step of all primitives with positions stored as integers, in world space.
    double position_step = 0;

    [[nodiscard]] HighPoly view() const {
        return {.positions = mesh.positions,
                .normals = mesh.normals,
                .corners = mesh.indices,
                .groups = groups,
                .maps = shown.maps,
                .map_of = map_of,
                .tangents = mesh.tangents,
                .uvs = mesh.uvs};
    }
    [[nodiscard]] std::size_t triangleCount() const { return mesh.indices.size() / 3; }
};

/// Both models of a bake.
struct BakeModels {
    LowModel low = {};
    HighModel high = {};
    DrawnScene high_scene = {};  ///< scene of the high poly if maps need its materials or names; otherwise empty
    std::optional<gltf::Model> low_model = {};  ///< the low poly with its frames, if `out_mesh` is given
    bool matched_by_name = false;

    FloatImage skew = {};  ///< without texels if no skew image is given
    /// Returns the ray options of a bake or a measurement: the requested ones, with the skew image and these wrap
    /// modes.
    [[nodiscard]] RayOptions rays(const RayOptions& asked, TextureWrap wrap_u, TextureWrap wrap_v) const;
    /// Returns the ray distance for all images: the requested one, or one derived from the sizes of both models.
    [[nodiscard]] double reach(double asked) const;
    /// Returns the bounding box of the low poly: that of the first instance of each primitive, or that of all
    /// instances, whichever is nearer to the box of the high poly. The high poly may have all instances of the low
    /// poly, or only one.
    [[nodiscard]] PositionBox lowBox() const;
};

/// Returns the corner of the primitive that becomes corner `i` of its placed triangles. A mirroring transform reverses
/// the order of the corners in each triangle.
std::size_t placedCorner(const Affine& place, std::size_t i);

/// Returns how a primitive samples its normal map, or will sample it: the normal map of its material, or else the first
/// texture that needs tangents, whose UVs the tangents follow. Null: the first UV set, without a transform.
const TangentUse* mapUse(const ScenePrimitive& primitive);

/// Reads an image that is an input of the call, with readMapImage.
FloatImage readFloatImage(const std::string& path, const FileOptions& options, ImageUse use = ImageUse::vectors);

/// Models in memory that a bake uses instead of files; the paths then only provide names. Null: the file is read. The
/// bake modifies the models.
struct BakeSources {
    ModelFile *low = nullptr, *high = nullptr;
};

/// Reads the models, computes missing frames of the low poly, and matches meshes by name. Throws FileError if a file
/// cannot be read, if the low poly has no UVs, if the cage has different triangles, or if a model has no triangles. The
/// error's element is the BakeInput that it refers to.
BakeModels readBakeModels(const std::string& low, const std::string& high, const BakeFileOptions& options,
                          const BakeSources& sources = {});

/// Returns the triangles of a low poly grouped by image, in file order, to derive file names. Throws FileError.
LowModel readLowImages(const std::string& low, const BakeFileOptions& options);

/// Returns the low poly with tangents that are recomputed on `faces` as `options.tangents` specifies, in the order of
/// readBakeModels, or nothing if the method yields a different number of triangles. Throws FileError.
std::optional<LowModel> readLowRecomputed(const std::string& low, const BakeFileOptions& options, Faces faces,
                                          const LowModel& known);

bool shows(const LayerOptions& layers, MapLayer layer);
/// Returns whether a layer uses materials.
bool showsMaterials(const LayerOptions& layers);

// Pictures of a bake: the state of each texel, and its error.

/// Returns a picture of the texel states. Red: no hit; yellow: several triangles; green: baked; dark green: padding;
/// black: background.
std::vector<Vec3> pictureOfOrigins(const BakedMap& map);

/// Returns a heat map of the error per texel: black (0), blue, red, yellow, white (`top_deg` or more). Texels without
/// triangles are dark gray.
std::vector<Vec3> pictureOfHeat(const std::vector<float>& heat, double top_deg);

}  // namespace tspace
