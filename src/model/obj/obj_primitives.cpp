// SPDX-License-Identifier: MIT
// Groups faces into primitives, computes missing normals, and merges identical vertices.
#include "model/obj/obj_primitives.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <numeric>
#include <span>

#include "core/base/unique_index.h"
#include "model/io/file_error.h"
#include "model/io/named_files.h"
#include "model/io/uri.h"
#include "model/obj/obj_reader.h"
#include "tspace/mesh.h"

namespace tspace::obj {
namespace {

bool hasUvs(const Model& model, const Face& face) {
    const auto corner = model.corners.begin() + face.first_corner;
    return std::all_of(corner, corner + face.corner_count, [](const Corner& c) { return c.uv != kNone; });
}

bool hasNormals(const Model& model, const Face& face) {
    const auto corner = model.corners.begin() + face.first_corner;
    return std::all_of(corner, corner + face.corner_count, [](const Corner& c) { return c.normal != kNone; });
}

/// A mesh of the faces without normals, which has only positions.
struct BareMesh {
    std::vector<std::uint32_t> faces = {};  // indices into Model::faces
    std::vector<std::uint32_t> indices = {};
    std::vector<std::uint32_t> face_sizes = {};
    std::vector<std::uint32_t> smoothing_groups = {};
};

BareMesh collectBareFaces(const Model& model, std::span<const std::uint32_t> faces) {
    BareMesh mesh;
    for (const std::uint32_t i : faces) {
        const Face& face = model.faces[i];
        if (hasNormals(model, face)) continue;
        mesh.faces.push_back(i);
        mesh.face_sizes.push_back(face.corner_count);
        mesh.smoothing_groups.push_back(face.smoothing_group);
        for (std::uint32_t c = 0; c < face.corner_count; ++c)
            mesh.indices.push_back(model.corners[face.first_corner + c].position);
    }
    return mesh;
}

NormalOptions normalOptions(const Model& model, const BareMesh& mesh, const GenerateOptions& options) {
    NormalOptions result = options.normals.compute;
    if (options.normals.use_smoothing_groups && model.has_smoothing_groups) {
        result.weighting = NormalWeighting::angle;
        result.smoothing_groups = mesh.smoothing_groups;
    }
    return result;
}

/// Computes normals for the faces that lack them.
Result<NormalReport> completeFaces(Model& model, std::span<const std::uint32_t> faces, const GenerateOptions& options) {
    const BareMesh bare = collectBareFaces(model, faces);
    if (bare.faces.empty()) return NormalReport{};
    MeshView view;
    view.positions = model.positions;
    view.indices = std::span<const std::uint32_t>(bare.indices);
    view.face_sizes = bare.face_sizes;
    std::vector<Vec3> normals(bare.indices.size());
    Result<NormalReport> report =
        generateNormals(view, normalOptions(model, bare, options), normals, options.execution);
    if (!report) return report;

    std::size_t next = 0;
    for (const std::uint32_t index : bare.faces) {
        const Face& face = model.faces[index];
        for (std::uint32_t c = 0; c < face.corner_count; ++c) {
            model.corners[face.first_corner + c].normal = static_cast<std::uint32_t>(model.normals.size());
            model.normals.push_back(normals[next++]);
        }
    }
    return report;
}

}  // namespace

bool hasSomeNormals(const Model& model, const ObjPrimitive& primitive) {
    return std::any_of(primitive.faces.begin(), primitive.faces.end(), [&](std::uint32_t number) {
        const auto corner = model.corners.begin() + model.faces[number].first_corner;
        return std::any_of(corner, corner + model.faces[number].corner_count,
                           [](const Corner& c) { return c.normal != kNone; });
    });
}

std::vector<ObjPrimitive> collectPrimitives(const Model& model) {
    UniqueIndex<std::array<std::uint32_t, 3>> keys;
    std::vector<ObjPrimitive> primitives;
    for (std::uint32_t i = 0; i < model.faces.size(); ++i) {
        const Face& face = model.faces[i];
        const bool has_uvs = hasUvs(model, face);
        const std::uint32_t primitive = keys.indexOf({face.shape, face.material, has_uvs});
        if (primitive == primitives.size())
            primitives.push_back({.shape = face.shape, .material = face.material, .has_uvs = has_uvs});
        primitives[primitive].faces.push_back(i);
    }
    return primitives;
}

Result<NormalReport> completeNormals(Model& model, std::vector<ObjPrimitive>& primitives,
                                     const GenerateOptions& options) {
    for (ObjPrimitive& primitive : primitives) {
        primitive.normals_generated = !std::all_of(primitive.faces.begin(), primitive.faces.end(),
                                                   [&](auto face) { return hasNormals(model, model.faces[face]); });
    }
    if (!options.normals.per_primitive) {
        std::vector<std::uint32_t> all(model.faces.size());
        std::iota(all.begin(), all.end(), 0u);
        return completeFaces(model, all, options);
    }
    NormalReport sum;
    for (const ObjPrimitive& primitive : primitives) {
        const Result<NormalReport> made = completeFaces(model, primitive.faces, options);
        if (!made) return made;
        sum.face_count += made->face_count;
        sum.degenerate_face_count += made->degenerate_face_count;
        sum.fallback_corner_count += made->fallback_corner_count;
    }
    return sum;
}

OwnedMesh buildMesh(const Model& model, const ObjPrimitive& primitive) {
    OwnedMesh mesh;
    bool has_normals = true;
    bool all_triangles = true;
    for (const std::uint32_t index : primitive.faces) {
        has_normals = has_normals && hasNormals(model, model.faces[index]);
        all_triangles = all_triangles && model.faces[index].corner_count == 3;
    }
    // Normals are compared by value, because computed ones have a separate index per corner.
    UniqueIndex<std::array<std::uint32_t, 5>> vertices(primitive.faces.size());
    for (const std::uint32_t index : primitive.faces) {
        const Face& face = model.faces[index];
        if (!all_triangles) mesh.face_sizes.push_back(face.corner_count);
        for (std::uint32_t c = 0; c < face.corner_count; ++c) {
            const Corner& corner = model.corners[face.first_corner + c];
            const Vec3 normal = has_normals ? model.normals[corner.normal] : Vec3{};
            const std::uint32_t vertex = vertices.indexOf(
                {corner.position, primitive.has_uvs ? corner.uv : kNone, std::bit_cast<std::uint32_t>(normal.x),
                 std::bit_cast<std::uint32_t>(normal.y), std::bit_cast<std::uint32_t>(normal.z)});
            if (vertex == mesh.positions.size()) {
                mesh.positions.push_back(model.positions[corner.position]);
                if (has_normals) mesh.normals.push_back(normal);
                if (primitive.has_uvs) mesh.uvs.push_back(model.uvs[corner.uv]);
            }
            mesh.indices.push_back(vertex);
        }
    }
    return mesh;
}

std::vector<std::uint32_t> triangleCorners(const OwnedMesh& mesh) {
    const Triangulation triangles = valueOrThrow(triangulate(mesh.view()));
    std::vector<std::uint32_t> corners;
    corners.reserve(triangles.corners.size());
    for (const std::uint32_t corner : triangles.corners) corners.push_back(mesh.indices[corner]);
    return corners;
}

// Conversion of an OBJ file to a Scene. The primitives equal those of a glTF that is converted from the file, before
// missing normals are computed.

namespace {

/// Index of each texture among the images of the scene; one image per file.
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
        // An unreadable image does not affect geometry, so it is not an error.
        const std::optional<Error> failure = tryFile([&] {
            const std::string uri = percentEncode(texture.file);
            const Path file = files_.resolve(texture.folder, uri, "material");
            if (files_.kindOf(file) == NamedFiles::Kind::missing)
                failFile(ErrorCode::invalidFile, "it does not exist", "material");
            const Bytes bytes = files_.read(file);
            memory_.allow(bytes.size());
            memory_.take(bytes.size(), "material");
            image.bytes.assign(bytes.begin(), bytes.end());
        });
        if (!failure) return;
        image.why_empty = failure->message;
        image.is_unavailable = !files_.areNone();
    }

    const NamedFiles& files_;
    bool with_bytes_;
    MemoryBudget& memory_;
    std::map<std::string, std::size_t> numbers_ = {};
};

ScenePrimitive loadPrimitive(const Model& model, const ObjPrimitive& primitive, ImageFiles& maps) {
    const Material& material = model.materials[primitive.material];
    OwnedMesh mesh = buildMesh(model, primitive);
    ScenePrimitive result;
    result.place = "usemtl " + material.name;
    result.mesh = primitive.shape;
    result.mesh_name = model.shape_names[primitive.shape];
    result.material_name = material.name;
    result.mode = mesh.face_sizes.empty() ? "triangles" : "polygons";
    result.corners = triangleCorners(mesh);
    result.positions = std::move(mesh.positions);
    result.normals = std::move(mesh.normals);
    if (primitive.has_uvs) result.uv_sets.emplace_back(std::move(mesh.uvs));
    if (material.normal_texture.used()) {
        result.uses.push_back({.needed_by = "normalTexture",
                               .place = result.place,
                               .image = maps.indexOf(material.normal_texture),
                               .may_be_heights = material.normal_is_bump,
                               .material = primitive.material,
                               .material_name = material.name});
    }
    return result;
}

/// Returns the scene without images, which are added to `files`.
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
    look.metalness = static_cast<double>(material.metallic);
    look.roughness = static_cast<double>(material.roughness);
    look.emission = {static_cast<double>(material.emission.x), static_cast<double>(material.emission.y),
                     static_cast<double>(material.emission.z)};
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
