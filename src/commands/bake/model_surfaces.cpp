// SPDX-License-Identifier: MIT
// Reads model files into the arrays that baking uses.
#include "commands/bake/model_surfaces.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "commands/bake/match_meshes.h"
#include "commands/generate/generate_model.h"
#include "commands/shared/map_image_file.h"
#include "commands/shared/report.h"
#include "commands/shared/uv_reading.h"
#include "core/base/numbers.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/float_loss.h"
#include "maps/rays/map_surfaces.h"
#include "model/gltf/load_document.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/read/read_scene.h"
#include "model/scene/scene.h"
#include "tspace/generate.h"
#include "tspace/maps.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"

namespace tspace {

bool shows(const LayerOptions& layers, MapLayer layer) {
    return std::find(layers.layers.begin(), layers.layers.end(), layer) != layers.layers.end();
}

bool showsMaterials(const LayerOptions& layers) {
    return shows(layers, MapLayer::color) || shows(layers, MapLayer::orm) || shows(layers, MapLayer::emission);
}

std::size_t placedCorner(const Affine& place, std::size_t i) {
    constexpr std::size_t kMirrored[3] = {0, 2, 1};
    return place.determinant() < 0 ? i - i % 3 + kMirrored[i % 3] : i;
}

namespace {

/// Returns the UVs with which the map is read: those of the existing normal map, or else of the first texture that
/// needs tangents.
std::vector<Vec2> mapUvs(const ScenePrimitive& primitive) {
    const TangentUse* const use = mapUse(primitive);
    const std::size_t set = use == nullptr ? 0 : use->uv_set;
    if (set >= primitive.uv_sets.size() || primitive.uv_sets[set].empty()) return {};
    return textureUvs(primitive.uv_sets[set].span(), use == nullptr ? UvTransform{} : use->transform);
}

/// Returns whether a primitive that draws triangles lacks normals or tangents.
bool lacksFrames(gltf::Model& model) {
    const std::vector<gltf::Primitive>& primitives = model.primitives();
    return std::any_of(primitives.begin(), primitives.end(), [](const gltf::Primitive& primitive) {
        const bool draws = gltf::hasTriangles(primitive.mode) && primitive.find("POSITION") &&
                           primitive.vertex_count != 0 && primitive.triangleCount() != 0;
        return draws && (!primitive.find("NORMAL") || !primitive.find("TANGENT"));
    });
}

GenerateOptions allFrames(const BakeFileOptions& options, ExistingTangents existing, Faces faces) {
    GenerateOptions generate;
    generate.selection.all = true;
    generate.selection.existing = existing;
    generate.tangents.faces = faces;
    generate.tangents.compute = options.tangents;
    generate.normals.compute = options.normals;
    generate.file = options.file;
    generate.execution = options.execution;
    generate.progress = options.progress;
    return generate;
}

/// Returns the step that reads a model for a bake. Attributes that cannot be read are repaired, because all triangles
/// need frames.
GenerateStep withAttributesRepaired() { return {.repairs_attributes = true}; }

/// Reads the low poly and keeps the model, so that it can be written with its maps. The bake uses the frames that will
/// be written.
DrawnScene readToWrite(const std::string& low, const BakeFileOptions& options, ModelFile* source, BakeModels& models) {
    const GenerateOptions generate = allFrames(options, ExistingTangents::keep, Faces::triangles);
    const GenerateStep step = withAttributesRepaired();
    gltf::GeneratedModel made = source != nullptr ? generateModel(std::move(*source), low, generate, true, step)
                                                  : generateModel(low, generate, true, step);
    models.low.frames_made =
        std::any_of(made.report.primitives.begin(), made.report.primitives.end(),
                    [](const PrimitiveReport& primitive) { return primitive.action == PrimitiveAction::generated; });
    models.low.warnings = std::move(made.report.warnings);
    models.low_model = std::move(made.model);
    return models.low_model->drawnScene(false);
}

/// Returns whether a model lacks frames. OBJ has no tangents, and the reader computes missing normals.
bool lacksFrames(ModelFile& model) {
    if (!model.isObj()) return lacksFrames(model.gltf());
    const DrawnScene drawn = model.drawnScene(false);
    return std::any_of(drawn.scene.primitives.begin(), drawn.scene.primitives.end(),
                       [](const ScenePrimitive& primitive) { return !primitive.corners.empty(); });
}

DrawnScene readWithFrames(const std::string& low, const BakeFileOptions& options, ModelFile* source,
                          BakeModels& models) {
    if (!options.out_mesh.empty()) return readToWrite(low, options, source, models);
    std::optional<ModelFile> read;
    if (source == nullptr) source = &read.emplace(low, options.file, options.execution, options.progress);
    models.low.frames_made = lacksFrames(*source);
    if (!models.low.frames_made) return source->drawnScene(false);
    const GenerateOptions generate = allFrames(options, ExistingTangents::keep, Faces::triangles);
    return generateModel(std::move(*source), low, generate, false, withAttributesRepaired()).model.drawnScene(false);
}

/// Returns the transform of the first placement of a primitive in the scene.
Affine firstPlace(const DrawnScene& drawn, std::size_t primitive) {
    for (const ScenePlacement& placement : drawn.placements) {
        if (placement.primitive == primitive) return placement.to_world;
    }
    return {};
}

/// Returns the offset to subtract if the model is so far from the origin that floats would not preserve its shape;
/// otherwise zero.
DVec3 originOffset(const DrawnScene& drawn) {
    return offsetForFloats([&](const auto& visit) {
        for (const ScenePlacement& placement : drawn.placements) {
            const ScenePrimitive& primitive = drawn.scene.primitives[placement.primitive];
            const auto at = [&](std::size_t corner) {
                return placement.to_world.point(toDouble(primitive.positions[primitive.corners[corner]]));
            };
            for (std::size_t i = 0; i < primitive.corners.size(); ++i) visit(at(i), at(i - i % 3 + (i + 1) % 3));
        }
    });
}

void moveBy(const DVec3& offset, DrawnScene& drawn) {
    for (ScenePlacement& placement : drawn.placements) placement.to_world.origin = placement.to_world.origin - offset;
}

/// Appends transformed triangles with one vertex per corner. Missing normals and tangents are zero.
void addPlaced(const MeshView& triangles, std::span<const Vec4> tangents, const Affine& place, OwnedMesh& mesh) {
    for (std::size_t i = 0; i < triangles.cornerCount(); ++i) {
        const std::uint32_t vertex = triangles.indices[placedCorner(place, i)];
        mesh.positions.push_back(toFloat(place.point(toDouble(triangles.positions[vertex]))));
        mesh.normals.push_back(normalAt(place, triangles.normals.empty() ? Vec3{} : triangles.normals[vertex]));
        mesh.tangents.push_back(tangentAt(place, tangents.empty() ? Vec4{} : tangents[vertex]));
        mesh.uvs.push_back(triangles.uvs[vertex]);
    }
}

/// Extends `box` by all placements of a primitive in the scene.
void addPlaces(const DrawnScene& drawn, std::size_t primitive, PositionBox& box) {
    const PositionBox own(drawn.scene.primitives[primitive].positions);
    if (own.isEmpty()) return;
    for (const ScenePlacement& placement : drawn.placements) {
        if (placement.primitive != primitive) continue;
        for (unsigned corner = 0; corner < 8; ++corner)
            box.add(placement.to_world.point({(corner & 1) != 0 ? own.most.x : own.least.x,
                                              (corner & 2) != 0 ? own.most.y : own.least.y,
                                              (corner & 4) != 0 ? own.most.z : own.least.z}));
    }
}

void addCage(const ScenePrimitive& cage, const Affine& place, LowPart& part) {
    for (std::size_t i = 0; i < cage.corners.size(); ++i)
        part.cage.push_back(toFloat(place.point(toDouble(cage.positions[cage.corners[placedCorner(place, i)]]))));
}

LowModel lowModel(const DrawnScene& drawn, const DrawnScene* cage, const MeshMatch* match) {
    const Scene& scene = drawn.scene;
    LowModel model;
    std::size_t without_uvs = 0;
    std::map<std::string, std::size_t> images;
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        const ScenePrimitive& primitive = scene.primitives[i];
        if (primitive.corners.empty()) continue;
        const std::vector<Vec2> uvs = mapUvs(primitive);
        if (uvs.empty()) {
            ++without_uvs;
            continue;
        }
        const TangentUse* const use = mapUse(primitive);
        const auto [image, is_new] = images.emplace(primitive.material_name, model.images.size());
        if (is_new) {
            model.images.push_back({.material = primitive.material_name,
                                    .wrap_u = use != nullptr ? use->wrap_u : TextureWrap::repeat,
                                    .wrap_v = use != nullptr ? use->wrap_v : TextureWrap::repeat});
        }
        const std::uint32_t group = match != nullptr ? match->low[i] : 0;
        LowPart& part = model.images[image->second].part;
        model.images[image->second].primitives.push_back(
            {.mesh = primitive.mesh,
             .primitive = primitive.primitive,
             .had_map = use != nullptr && use->needed_by == "normalTexture" && !use->only_in_variant,
             .uv_set = use != nullptr ? use->uv_set : 0,
             .transform = use != nullptr ? use->transform : UvTransform{}});
        addPlaced(primitive.view(uvs), primitive.tangents.span(), firstPlace(drawn, i), part.corners);
        addPlaces(drawn, i, model.all_places);
        part.groups.insert(part.groups.end(), primitive.corners.size() / 3, group);
        if (cage != nullptr) addCage(cage->scene.primitives[i], firstPlace(*cage, i), part);
    }
    if (model.images.empty()) {
        failFile(ErrorCode::missingAttribute,
                 without_uvs > 0 ? "the low poly has no UVs" : "the low poly has no triangles");
    }
    if (without_uvs > 0)
        model.warnings.push_back("ignored " + report::counted(without_uvs, "primitive") +
                                 " of the low poly without UVs");
    for (LowModel::Image& image : model.images) {
        if (match == nullptr) image.part.groups.clear();
    }
    return model;
}

/// Fails unless the cage has as many primitives as the low poly, and each as many triangles.
void checkCage(const Scene& low, const Scene& cage) {
    bool fits = low.primitives.size() == cage.primitives.size();
    for (std::size_t i = 0; fits && i < low.primitives.size(); ++i)
        fits = low.primitives[i].corners.size() == cage.primitives[i].corners.size();
    if (!fits) failFile(ErrorCode::countMismatch, "the cage must have the same triangles as the low poly");
}

/// Adds the flat triangles of a primitive, with one vertex per corner, because each triangle has a separate normal.
void addFlat(const ScenePrimitive& primitive, const Affine& place, OwnedMesh& mesh) {
    for (std::size_t i = 0; i < primitive.corners.size(); i += 3) {
        std::array<Vec3, 3> at{};
        for (std::size_t k = 0; k < 3; ++k)
            at[k] = toFloat(place.point(toDouble(primitive.positions[primitive.corners[placedCorner(place, i + k)]])));
        // Zero for a degenerate triangle; ray hits then use the normal that is computed at the hit.
        const Vec3 normal = cross(at[1] - at[0], at[2] - at[0]);
        for (const Vec3& corner : at) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(corner);
            mesh.normals.push_back(normal);
        }
    }
}

void addSmooth(const ScenePrimitive& primitive, std::span<const Vec3> normals, const Affine& place, OwnedMesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3& position : primitive.positions) mesh.positions.push_back(toFloat(place.point(toDouble(position))));
    for (const Vec3& normal : normals) mesh.normals.push_back(normalAt(place, normal));
    for (std::size_t i = 0; i < primitive.corners.size(); ++i)
        mesh.indices.push_back(first + primitive.corners[placedCorner(place, i)]);
}

/// Returns smooth normals, one per vertex.
std::vector<Vec3> smoothNormals(const ScenePrimitive& primitive, const BakeFileOptions& options) {
    std::vector<Vec3> of_corners(primitive.corners.size()), normals(primitive.positions.size());
    valueOrThrow(generateNormals(primitive.view(),
                                 {.weighting = NormalWeighting::angle,
                                  .convention = conventions::gltf,
                                  .weld_distance = options.map.rays.weld_distance},
                                 of_corners, options.execution));
    for (std::size_t i = 0; i < of_corners.size(); ++i) normals[primitive.corners[i]] = of_corners[i];
    return normals;
}

/// Adds a primitive that has a normal map: one vertex per corner, with the frames with which the map is read.
void addMapped(const ScenePrimitive& primitive, const TangentUse& use, const Affine& place, std::uint32_t map,
               const BakeFileOptions& options, HighModel& model) {
    OwnedMesh corners;
    addMapCorners(primitive, &use, options.tangents, options.execution, corners);
    OwnedMesh& mesh = model.mesh;
    const std::size_t first = mesh.positions.size();
    mesh.tangents.resize(first);
    mesh.uvs.resize(first);
    model.map_of.resize(model.triangleCount(), kNoHighMap);
    addPlaced(corners.view(), corners.tangents, place, mesh);
    for (std::size_t i = first; i < mesh.positions.size(); ++i) mesh.indices.push_back(static_cast<std::uint32_t>(i));
    model.map_of.resize(model.triangleCount(), map);
}

/// Returns normals for BakeFileOptions::denoise, one per vertex, if positions are noisy; otherwise an empty list.
std::vector<Vec3> denoisedNormals(const ScenePrimitive& primitive, const BakeFileOptions& options, double& max_noise) {
    std::vector<Vec3> of_corners(primitive.corners.size());
    const NormalOptions how{.weighting = NormalWeighting::best,
                            .convention = conventions::gltf,
                            .weld_distance = options.map.rays.weld_distance,
                            .denoise = options.denoise};
    const NormalReport report = valueOrThrow(generateNormals(primitive.view(), how, of_corners, options.execution));
    if (!(report.noise > 0)) return {};
    max_noise = std::max(max_noise, double{report.noise});
    std::vector<Vec3> normals(primitive.positions.size());
    for (std::size_t i = 0; i < of_corners.size(); ++i) normals[primitive.corners[i]] = of_corners[i];
    return normals;
}

std::string denoisedText(double noise, bool has_maps) {
    const std::string left = has_maps ? "; meshes with a normal map keep the normals for which the map was made" : "";
    if (noise == 0)
        return "--denoise has no effect: no positions of the high poly are noisy" +
               std::string(has_maps ? " where it has no normal map" : "");
    return "positions of the high poly are noisy (" + shortNumber(noise) +
           " of an edge length), so normals were computed without the noise (--denoise)" + left;
}

HighModel highModel(const DrawnScene& drawn, const MeshMatch* match, const std::string& path,
                    const BakeFileOptions& options) {
    HighModel model;
    std::size_t made = 0;
    double noise = 0;
    // Without normals, glTF and OBJ models are shaded flat; models of scanners and sculpting tools are meant to be
    // smooth.
    const std::string extension = lowerExtension(path);
    const bool is_flat = isGltfName(path) || extension == ".obj";
    HighMapReading maps(drawn.scene, options);
    for (std::size_t i = 0; i < drawn.placements.size(); ++i) {
        const ScenePlacement& placement = drawn.placements[i];
        const ScenePrimitive& primitive = drawn.scene.primitives[placement.primitive];
        const Affine& place = placement.to_world;
        if (primitive.corners.empty()) continue;
        model.parts.push_back({static_cast<std::uint32_t>(model.triangleCount()), i});
        const double scale = std::max({length(place.x), length(place.y), length(place.z)});
        model.position_step = std::max(model.position_step, scale * primitive.position_step);
        const TangentUse* const use = maps.find(primitive);
        std::vector<Vec3> denoised;
        if (options.denoise != 0 && use == nullptr) denoised = denoisedNormals(primitive, options, noise);
        // Normals of STL define the orientation of triangles, not their shading.
        if (use != nullptr) {
            addMapped(primitive, *use, place, maps.numberOf(primitive, *use, primitive.corners.size() / 3), options,
                      model);
        } else if (!denoised.empty()) {
            addSmooth(primitive, denoised, place, model.mesh);
        } else if (!primitive.normals.empty() && extension != ".stl") {
            addSmooth(primitive, primitive.normals.span(), place, model.mesh);
        } else {
            ++made;
            if (is_flat) {
                addFlat(primitive, place, model.mesh);
            } else {
                addSmooth(primitive, smoothNormals(primitive, options), place, model.mesh);
            }
        }
        if (match != nullptr) model.groups.insert(model.groups.end(), primitive.corners.size() / 3, match->high[i]);
    }
    if (model.mesh.indices.empty()) failFile(ErrorCode::missingAttribute, "the high poly has no triangles");
    model.shown = maps.take();
    model.warnings = std::exchange(model.shown.warnings, {});
    if (!model.shown.maps.empty()) {
        model.mesh.tangents.resize(model.mesh.positions.size());
        model.mesh.uvs.resize(model.mesh.positions.size());
        model.map_of.resize(model.triangleCount(), kNoHighMap);
    }
    if (options.denoise != 0) model.warnings.push_back(denoisedText(noise, !model.shown.maps.empty()));
    if (made > 0)
        model.warnings.push_back(std::string("primitives of the high poly without vertex normals were baked with ") +
                                 (is_flat ? "flat shading, as the file format specifies" : "computed smooth normals"));
    return model;
}

}  // namespace

const TangentUse* mapUse(const ScenePrimitive& primitive) {
    for (const TangentUse& use : primitive.uses) {
        if (use.needed_by == "normalTexture" && !use.only_in_variant) return &use;
    }
    return primitive.uses.empty() ? nullptr : &primitive.uses.front();
}

void LowPart::addTriangle(const LowPart& from, std::size_t triangle) {
    corners.addVertices(from.corners, 3 * triangle, 3);
    const auto first = static_cast<std::ptrdiff_t>(3 * triangle);
    if (!from.cage.empty()) cage.insert(cage.end(), from.cage.begin() + first, from.cage.begin() + first + 3);
    if (!from.groups.empty()) groups.push_back(from.groups[triangle]);
}

void LowPart::addToRest(const LowPart& from, std::size_t triangle) {
    const auto first = static_cast<std::ptrdiff_t>(3 * triangle);
    const auto add = [first](const std::vector<Vec3>& values, std::vector<Vec3>& to) {
        to.insert(to.end(), values.begin() + first, values.begin() + first + 3);
    };
    add(from.corners.positions, rest_positions);
    add(from.corners.normals, rest_normals);
}

RayOptions BakeModels::rays(const RayOptions& asked, TextureWrap wrap_u, TextureWrap wrap_v) const {
    RayOptions rays = asked;
    if (!skew.texels.empty()) rays.skew = {skew.width, skew.height, skew.texels, wrap_u, wrap_v};
    return rays;
}

double BakeModels::reach(double asked) const {
    return asked != 0 ? asked : reachBetween(lowBox(), PositionBox(high.view().positions));
}

PositionBox BakeModels::lowBox() const {
    PositionBox box;
    for (const LowModel::Image& image : low.images) {
        const PositionBox part(image.part.view().positions);
        if (part.isEmpty()) continue;
        box.add(part.least);
        box.add(part.most);
    }
    const PositionBox of_high(high.view().positions);
    if (box.isEmpty() || of_high.isEmpty()) return box;
    return low.all_places.difference(of_high) < box.difference(of_high) ? low.all_places : box;
}

std::size_t LowModel::triangleCount() const {
    std::size_t count = 0;
    for (const Image& image : images) count += image.part.triangleCount();
    return count;
}

LowModel readLowImages(const std::string& low, const BakeFileOptions& options) {
    return lowModel(readDrawnScene(low, options.file, false), nullptr, nullptr);
}

std::optional<LowModel> readLowRecomputed(const std::string& low, const BakeFileOptions& options, Faces faces,
                                          const LowModel& known) {
    const GenerateOptions generate = allFrames(options, ExistingTangents::replace, faces);
    DrawnScene scene = generateModel(low, generate, false, withAttributesRepaired()).model.drawnScene(false);
    moveBy(known.origin, scene);
    LowModel model = lowModel(scene, nullptr, nullptr);
    bool fits = model.images.size() == known.images.size();
    for (std::size_t i = 0; fits && i < model.images.size(); ++i)
        fits = model.images[i].part.corners.positions == known.images[i].part.corners.positions;
    return fits ? std::optional(std::move(model)) : std::nullopt;
}

FloatImage readFloatImage(const std::string& path, const FileOptions& options, ImageUse use) {
    if (options.opened) options.opened(path);
    return readMapImage(path, {}, options, use);
}

namespace {

void addNormalsWarnings(const char* which, const Scene& scene, std::vector<std::string>& warnings) {
    for (const std::string& warning : scene.normalsWarnings())
        warnings.push_back(std::string("the ") + which + " poly: " + warning);
}

}  // namespace

BakeModels readBakeModels(const std::string& low, const std::string& high, const BakeFileOptions& options,
                          const BakeSources& sources) {
    BakeModels models;
    const auto reportProgress = [&] {
        if (options.progress) options.progress("reading", 0, 1);
    };
    DrawnScene low_scene = tagInput(BakeInput::low, [&] { return readWithFrames(low, options, sources.low, models); });
    const bool frames_made = models.low.frames_made;
    const std::vector<std::string> warnings = std::move(models.low.warnings);
    DrawnScene cage_scene;
    if (!options.cage.empty()) {
        cage_scene = tagInput(BakeInput::cage, [&] {
            DrawnScene read = readDrawnScene(options.cage, options.file, false);
            checkCage(low_scene.scene, read.scene);
            return read;
        });
    }
    reportProgress();
    DrawnScene high_scene = tagInput(BakeInput::high, [&] {
        std::optional<ModelFile> read;
        ModelFile& model = sources.high != nullptr ? *sources.high : read.emplace(high, options.file);
        return showsMaterials(options.layers) ? model.materialScene(!options.ignore_high_maps)
                                              : model.drawnScene(!options.ignore_high_maps);
    });
    reportProgress();
    const DVec3 of_high = originOffset(high_scene);
    const DVec3 origin = length(of_high) > 0 ? of_high : originOffset(low_scene);
    for (DrawnScene* const scene : {&low_scene, &cage_scene, &high_scene}) moveBy(origin, *scene);
    const MeshMatch match = matchMeshes(low_scene, high_scene, options.match, options.file);
    models.matched_by_name = match.is_used;
    const MeshMatch* const used = match.is_used ? &match : nullptr;
    models.low = tagInput(BakeInput::low,
                          [&] { return lowModel(low_scene, options.cage.empty() ? nullptr : &cage_scene, used); });
    models.low.frames_made = frames_made;
    models.low.warnings.insert(models.low.warnings.begin(), warnings.begin(), warnings.end());
    // The report of a written low poly contains these warnings already.
    if (!models.low_model) addNormalsWarnings("low", low_scene.scene, models.low.warnings);
    models.low.origin = origin;
    reportProgress();
    std::vector<std::string> of_normals;
    addNormalsWarnings("high", high_scene.scene, of_normals);
    const std::string high_name = sources.high != nullptr && !isGlbName(high) ? high + ".glb" : high;
    models.high = tagInput(BakeInput::high, [&] { return highModel(high_scene, used, high_name, options); });
    if (showsMaterials(options.layers) || shows(options.layers, MapLayer::id))
        models.high_scene = std::move(high_scene);
    if (!options.skew.empty())
        models.skew =
            tagInput(BakeInput::skew, [&] { return readFloatImage(options.skew, options.file, ImageUse::numbers); });
    reportProgress();
    models.high.warnings.insert(models.high.warnings.end(), match.warnings.begin(), match.warnings.end());
    models.high.warnings.insert(models.high.warnings.end(), of_normals.begin(), of_normals.end());
    const std::string why = misplacement(models.lowBox(), PositionBox(models.high.view().positions));
    if (!why.empty()) models.high.warnings.push_back(why);
    return models;
}

}  // namespace tspace
