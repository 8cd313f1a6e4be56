// SPDX-License-Identifier: MIT
// Model files as the arrays that baking takes, and what comes out of a bake: pictures, and the model with its maps.
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
#include "model/scene/scene.h"
#include "tspace/bake_file.h"
#include "tspace/maps.h"

namespace tspace {

// A low poly with the maps that were baked for it as the textures of its materials.

/// A primitive, and the UVs that its map is read with.
struct MappedPrimitive {
    std::uint32_t mesh = 0, primitive = 0;
    bool had_map = false;  ///< its material has a normal map already, with these UVs
    std::size_t uv_set = 0;
    UvTransform transform = {};
};

/// Texture slot of a material.
enum class MapSlot { normal, occlusion, metal, occlusion_and_metal, color, emission };

/// A baked image, and the primitives that read it.
struct ModelMap {
    std::string path = {};  ///< the file that holds it
    Bytes png = {};
    std::vector<MappedPrimitive> primitives = {};
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    MapSlot slot = MapSlot::normal;
};

struct ModelWithMaps {
    gltf::Model model;        ///< with the frames that were baked for
    std::string output = {};  ///< .glb or .gltf
    std::vector<ModelMap> maps = {};
};

/// Adds the model with its maps to `model_files`, and the maps themselves to `map_files`, which may be the same. A GLB holds
/// them; a .gltf names them where they lie in its folder or below, and holds them otherwise. Maps that were there go where
/// nothing else shows them. Throws FileError.
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
    OwnedMesh corners = {};  ///< a vertex for each
    std::vector<Vec3> cage = {};
    std::vector<std::uint32_t> groups = {};
    std::vector<Vec3> rest_positions = {}, rest_normals = {};  ///< like LowPoly's

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
    /// Appends a triangle of another one.
    void addTriangle(const LowPart& from, std::size_t triangle);
    void addToRest(const LowPart& from, std::size_t triangle);
};

/// Parts of a low poly that share a material, and so an image.
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
    DVec3 origin = {};            ///< origin of the positions in world space: not zero if both models are far from it

    [[nodiscard]] std::size_t triangleCount() const;
    [[nodiscard]] bool hasCage() const { return !images.empty() && !images.front().part.cage.empty(); }
};

/// The triangles of a high poly that a placement of its scene gives, from this one on.
struct HighPart {
    std::uint32_t first_triangle = 0;
    std::size_t placement = 0;
};

struct HighModel {
    std::vector<HighPart> parts = {};  ///< in ascending order
    OwnedMesh mesh = {};               ///< with tangents and UVs where it shows maps of its own
    std::vector<std::uint32_t> groups = {};
    std::vector<std::uint32_t> map_of = {};  ///< empty where it shows none
    HighMaps shown = {};
    std::vector<std::string> warnings = {};
    double position_step =
        0;  ///< the largest of its primitives', as they are placed: of positions that are whole numbers

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
    DrawnScene high_scene = {};  ///< scene, if its materials or names are needed for maps; otherwise empty
    std::optional<gltf::Model> low_model = {};  ///< the low poly with its frames, where `out_mesh` asks for it
    bool matched_by_name = false;

    FloatImage skew = {};  ///< without texels where there is none
    /// The rays of a bake or a measure: those asked for, with the image that was read, wrapped so.
    [[nodiscard]] RayOptions rays(const RayOptions& asked, TextureWrap wrap_u, TextureWrap wrap_v) const;
    /// Ray distance for all images: as requested, or derived from the sizes of both models.
    [[nodiscard]] double reach(double asked) const;
    /// Bounding box of the low poly: of the first instances or of all, whichever is nearer to that of the high poly, which may
    /// have as many instances or only one.
    [[nodiscard]] PositionBox lowBox() const;
};

/// The order of the corners of a triangle at a place, which may mirror: corner i of the placed one is that one of its primitive.
std::size_t placedCorner(const Affine& place, std::size_t i);

/// How a primitive reads its normal map, or will: the normal map that its own material has, or the first thing that needs
/// tangents, which they follow. Null: the first UVs, as they are.
const TangentUse* mapUse(const ScenePrimitive& primitive);

/// An image that is an input of the call: readMapImage.
FloatImage readFloatImage(const std::string& path, const FileOptions& options, ImageUse use = ImageUse::vectors);

/// GLBs in the place of the files of a bake, whose names say only what they are called. Empty: the file is read.
struct BakeSources {
    std::span<const std::uint8_t> low = {}, high = {};
};

/// Reads the models, makes the frames that the low poly lacks, and matches meshes by name. Throws FileError, which says as
/// its element which BakeInput it is about: also where the low poly has no UVs, where the cage has other triangles, and
/// where one of them has none at all.
BakeModels readBakeModels(const std::string& low, const std::string& high, const BakeFileOptions& options,
                          const BakeSources& sources = {});

/// The triangles of a low poly by their images, as they are in the file: for what they are called. Throws FileError.
LowModel readLowImages(const std::string& low, const BakeFileOptions& options);

/// The low poly with tangents of `options`.tangents computed anew on these faces, in the order that readBakeModels gives. Nothing
/// where that method gives another number of triangles. Throws FileError.
std::optional<LowModel> readLowAnew(const std::string& low, const BakeFileOptions& options, Faces faces,
                                    const LowModel& known);

bool shows(const LayerOptions& layers, MapLayer layer);
/// Whether a layer shows what materials do.
bool showsMaterials(const LayerOptions& layers);

// Pictures of a bake: what each texel is, and where the error is.

/// Red: nothing was met; yellow: several triangles; green: baked; dark green: padding; black: background.
std::vector<Vec3> pictureOfOrigins(const BakedMap& map);

/// From black (0) over blue, red and yellow to white (`top_deg` and more). Texels without triangles: dark grey.
std::vector<Vec3> pictureOfHeat(const std::vector<float>& heat, double top_deg);

}  // namespace tspace
