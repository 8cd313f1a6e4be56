// SPDX-License-Identifier: MIT
// An OBJ file as a Scene: the primitives that a glTF made from it would have, before missing normals are computed.
#include "model/obj/read_scene.h"

#include <map>

#include "model/io/file_error.h"
#include "model/io/uri.h"
#include "model/obj/obj_reader.h"
#include "tspace/triangulate.h"

namespace tspace::obj {

namespace {

/// Number of each texture among the images of the scene, one per file.
class ImageFiles {
  public:
    ImageFiles(const NamedFiles& files, bool with_bytes, MemoryBudget& memory)
        : files_(files), with_bytes_(with_bytes), memory_(memory) {}

    std::size_t indexOf(const Texture& texture) {
        const auto [entry, is_new] = numbers_.emplace(texture.path(), images.size());
        if (is_new) {
            SceneImage& image = images.emplace_back();
            image.uri = texture.file;
            if (with_bytes_) readBytes(texture, image);
        }
        return entry->second;
    }

    std::vector<SceneImage> images = {};

  private:
    void readBytes(const Texture& texture, SceneImage& image) const {
        // An image that cannot be read does not affect geometry.
        tryFile([&] {
            const Bytes bytes = files_.read(files_.resolve(texture.folder, percentEncode(texture.file), "material"));
            memory_.allow(bytes.size());
            memory_.take(bytes.size(), "material");
            image.bytes.assign(bytes.begin(), bytes.end());
        });
    }

    const NamedFiles& files_;
    bool with_bytes_;
    MemoryBudget& memory_;
    std::map<std::string, std::size_t> numbers_ = {};
};

SharedArray<std::uint32_t> triangleCorners(const ObjGeometry& geometry) {
    const Triangulation triangles = valueOrThrow(triangulate(geometry.view()));
    std::vector<std::uint32_t> corners;
    corners.reserve(triangles.corners.size());
    for (const std::uint32_t corner : triangles.corners) corners.push_back(geometry.polygons.indices[corner]);
    return corners;
}

ScenePrimitive loadPrimitive(const Model& model, const ObjPrimitive& primitive, ImageFiles& maps) {
    const Material& material = model.materials[primitive.material];
    ObjGeometry geometry = buildGeometry(model, primitive);
    ScenePrimitive result;
    result.place = "usemtl " + material.name;
    result.mesh = primitive.shape;
    result.mesh_name = model.shape_names[primitive.shape];
    result.material_name = material.name;
    result.mode = geometry.polygons.face_sizes.empty() ? "triangles" : "polygons";
    result.corners = triangleCorners(geometry);
    result.positions = std::move(geometry.pool.positions);
    result.normals = std::move(geometry.pool.normals);
    if (primitive.has_uvs) result.uv_sets.emplace_back(std::move(geometry.pool.uvs));
    if (material.normal_texture.used()) {
        result.uses.push_back({.needed_by = "normalTexture",
                               .place = result.place,
                               .image = maps.indexOf(material.normal_texture),
                               .may_be_heights = material.normal_is_bump,
                               .material = primitive.material});
    }
    return result;
}

}  // namespace

namespace {

/// The scene without images; their names go to `files`.
Scene loadScene(const Model& model, std::span<const ObjPrimitive> primitives, ImageFiles& files) {
    Scene scene;
    scene.format = "obj";
    scene.memory = model.memory;
    scene.warnings = model.warnings;
    scene.offset = model.offset;
    std::vector<std::uint32_t> next_in_mesh(model.shape_names.size(), 0);
    for (const ObjPrimitive& primitive : primitives) {
        scene.primitives.push_back(loadPrimitive(model, primitive, files));
        scene.primitives.back().primitive = next_in_mesh[primitive.shape]++;
    }
    return scene;
}

SurfaceLook lookOf(const Material& material, ImageFiles& files) {
    SurfaceLook look;
    look.base_color = {material.base_color.x, material.base_color.y, material.base_color.z, 1};
    if (material.base_color_texture.used())
        look.base_texture = TextureReading{.image = files.indexOf(material.base_color_texture)};
    if (material.normal_texture.used())
        look.normal_texture = TextureReading{.image = files.indexOf(material.normal_texture)};
    look.normal_scale = material.normal_scale;
    look.is_double_sided = true;
    return look;
}

}  // namespace

Scene sceneOf(const Model& model, std::span<const ObjPrimitive> primitives, bool with_images) {
    ImageFiles files(model.files, with_images, *model.memory);
    Scene scene = loadScene(model, primitives, files);
    scene.images = std::move(files.images);
    return scene;
}

DrawnScene drawnSceneOf(const Model& model, std::span<const ObjPrimitive> primitives, bool with_images) {
    ImageFiles files(model.files, with_images, *model.memory);
    DrawnScene drawn{.scene = loadScene(model, primitives, files)};
    for (const ObjPrimitive& primitive : primitives) {
        drawn.placements.push_back({drawn.looks.size(), {.origin = model.offset}, {}});
        drawn.looks.push_back(lookOf(model.materials[primitive.material], files));
    }
    drawn.scene.images = std::move(files.images);
    return drawn;
}

}  // namespace tspace::obj
