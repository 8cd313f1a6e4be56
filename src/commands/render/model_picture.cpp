// SPDX-License-Identifier: MIT

#include "commands/render/model_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "commands/generate/flip_maps.h"
#include "commands/shared/map_image_file.h"
#include "commands/shared/picture/colors.h"
#include "commands/shared/uv_reading.h"
#include "core/base/owned_mesh.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"
#include "core/mesh/surface/uvs.h"
#include "images/float_image.h"
#include "images/image.h"
#include "images/texture_vectors.h"
#include "model/io/file_error.h"
#include "tspace/tangents.h"

namespace tspace {
namespace {

/// Returns one unit normal per corner; zero if the triangle has no area.
std::vector<Vec3> flatNormals(std::span<const Vec3> positions, std::span<const std::uint32_t> corners) {
    std::vector<Vec3> normals;
    normals.reserve(corners.size());
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        const std::array<Vec3, 3> face = {positions[corners[i]], positions[corners[i + 1]], positions[corners[i + 2]]};
        normals.insert(normals.end(), 3, describeFace(face, nullptr).normal);
    }
    return normals;
}

/// Returns the UVs that tangents follow.
UvReading tangentReading(const ScenePrimitive& primitive) {
    if (!primitive.uses.empty()) return readingOf(primitive, primitive.uses.front());
    std::size_t set = 0;
    while (set + 1 < primitive.uv_sets.size() && primitive.uv_sets[set].empty()) ++set;
    return plainReading(primitive, set);
}

template <class T>
std::vector<T> unrolled(std::span<const T> values, std::span<const std::uint32_t> corners) {
    std::vector<T> result;
    result.reserve(corners.size());
    for (const std::uint32_t vertex : corners) result.push_back(values[vertex]);
    return result;
}

/// Finds triangles with a mirrored texture: v increases downward, so unmirrored triangles have a negative determinant.
std::vector<UvSide> sidesOf(const ScenePrimitive& primitive, const CornerValues<Vec3>& normals,
                            std::span<const Vec2> uvs) {
    const Surface surface =
        describeSurface({.positions = primitive.positions.span(), .uvs = uvs, .corners = primitive.corners.span()});
    std::vector<UvSide> sides;
    for (std::size_t i = 0; i < surface.faces.size(); ++i) {
        const SurfaceFrame& face = surface.faces[i];
        bool is_known = face.orientation != 0;
        for (std::size_t k = 0; k < 3; ++k)
            is_known = is_known && facesNormal(face, normals.at(3 * i + k, primitive.corners[3 * i + k]));
        sides.push_back(!is_known ? UvSide::unknown : face.orientation > 0 ? UvSide::mirrored : UvSide::plain);
    }
    return sides;
}

/// Returns the smallest alpha at which a surface is drawn. In `lit` a blended surface is drawn where its alpha is at
/// least half of the material's factor: it is then drawn opaque, so that glass is visible and leaves keep their shape.
float alphaCutoff(const SurfaceLook& look, RenderShow show) {
    if (show != RenderShow::lit || !look.is_blended) return static_cast<float>(look.alpha_cutoff);
    return std::max(0.5f * look.base_color[3], std::numeric_limits<float>::min());
}

/// Returns whether the file is a PNG with 16 bits per channel.
bool isDeepPng(ByteSpan bytes) {
    constexpr std::size_t kBitsAt = 24;
    return imageFormat(bytes) == ImageFormat::png && bytes.size() > kBitsAt && bytes[kBitsAt] == 16;
}

/// Returns whether the file may have more than 8 bits per channel, or a channel layout other than glTF's.
bool isTextureFile(ByteSpan bytes) {
    const ImageFormat format = imageFormat(bytes);
    return format == ImageFormat::ktx2 || format == ImageFormat::dds || format == ImageFormat::exr;
}

ImageUse imageUse(ModelTextures::Use use) {
    return use == ModelTextures::Use::normals ? ImageUse::vectors : ImageUse::numbers;
}

/// Decodes a texture with all of its bits. `how_read`: for a normal map, receives a sentence on its channels if they
/// differ from those of glTF.
std::optional<PictureTexture> decodeDeep(ByteSpan bytes, std::uint64_t most_pixels, ModelTextures::Use use,
                                         std::string& why, std::string& how_read) {
    std::optional<FloatImage> image = decodeFloatImage(bytes, most_pixels, why, imageUse(use));
    if (!image) return {};
    PictureTexture texture{.width = image->width, .height = image->height};
    if (use == ModelTextures::Use::color) {
        const std::vector<float> table = srgbTable(image->bits == 8 ? 8 : 16);
        const auto most = static_cast<float>(table.size() - 1);
        const auto light = [&](float stored) {
            return table[static_cast<std::size_t>(std::clamp(stored, 0.0F, 1.0F) * most + 0.5f)];
        };
        for (Vec3& texel : image->texels) texel = {light(texel.x), light(texel.y), light(texel.z)};
    } else if (use == ModelTextures::Use::normals) {
        how_read = readTextureVectors(*image);
    }
    texture.texels = std::move(image->texels);
    texture.alpha = std::move(image->alpha);
    return texture;
}

std::optional<PictureTexture> decodeBytes(ByteSpan bytes, std::uint64_t most_pixels, ModelTextures::Use use,
                                          std::string& why) {
    std::optional<RgbImage> image = decodeImage(bytes, most_pixels, why, imageUse(use));
    if (!image) return {};
    PictureTexture texture{.width = image->width, .height = image->height, .bytes = std::move(image->rgb)};
    if (use == ModelTextures::Use::color) {
        texture.values = srgbTable(8);
    } else {
        for (int i = 0; i < 256; ++i) texture.values.push_back(static_cast<float>(i) / 255);
    }
    return texture;
}

}  // namespace

std::vector<Vec4> computeCornerTangents(const ScenePrimitive& primitive, const CornerValues<Vec3>& normals,
                                        Method method, const Execution& execution) {
    const UvReading reading = tangentReading(primitive);
    if ((reading.uvs.empty() && method != Method::basis) || primitive.corners.empty()) return {};
    OwnedMesh corners;
    MeshView mesh = primitive.view(reading.uvs);
    if (normals.is_per_corner) {
        corners.positions = unrolled(primitive.positions.span(), primitive.corners.span());
        if (!reading.uvs.empty()) corners.uvs = unrolled(reading.uvs, primitive.corners.span());
        mesh = corners.view();
    }
    mesh.normals = normals.values;
    std::vector<Vec4> tangents(primitive.corners.size());
    valueOrThrow(
        generateTangents(mesh, {.method = method, .convention = conventions::gltf}, {.tangents = tangents}, execution));
    valueOrThrow(sanitizeTangents(mesh, {}, std::span(tangents), execution));
    return tangents;
}

const PictureTexture* ModelTextures::read(const Wanted& wanted) {
    const auto [entry, is_new] = images_.try_emplace(wanted);
    if (is_new) entry->second = decode(wanted);
    return entry->second ? &*entry->second : nullptr;
}

PlacedTexture ModelTextures::find(const ScenePrimitive& primitive, const std::optional<TextureReading>& texture,
                                  Use use, bool alpha) {
    PlacedTexture found;
    if (!texture || !texture->image || *texture->image >= scene_.images.size()) return found;
    if (texture->uv_set >= primitive.uv_sets.size() || primitive.uv_sets[texture->uv_set].empty()) return found;
    found.image = read({*texture->image, use, alpha});
    if (found.image != nullptr)
        found.shape = {found.image->width, found.image->height, texture->wrap_u, texture->wrap_v};
    return found;
}

std::optional<PictureTexture> ModelTextures::decode(const Wanted& wanted) {
    const SceneImage& source = scene_.images[wanted.image];
    const bool in_floats =
        wanted.alpha || isDeepPng(source.bytes) || (wanted.use != Use::color && isTextureFile(source.bytes));
    const std::uint64_t pixels = claimedSize(source.bytes).pixels();
    const std::uint64_t kept = pixels * (in_floats ? sizeof(Vec3) + sizeof(float) : 3);
    const std::uint64_t needed = kept + imageWorkBytes(source.bytes);
    std::string why, how_read;
    std::optional<PictureTexture> texture;
    if (source.bytes.empty()) {
        why = source.why_empty;
    } else if (scene_.memory && !scene_.memory->has(needed)) {
        why = "it " + scene_.memory->whyNot(needed);
    } else {
        texture = in_floats ? decodeDeep(source.bytes, most_pixels_, wanted.use, why, how_read)
                            : decodeBytes(source.bytes, most_pixels_, wanted.use, why);
    }
    if (texture && scene_.memory) scene_.memory->take(kept, {});
    if (!how_read.empty()) warnings.push_back(how_read);
    if (!texture) {
        const std::string& name = source.uri.empty() ? source.name : source.uri;
        warnings.push_back("the texture " + (name.empty() ? "image " + std::to_string(wanted.image) : inQuotes(name)) +
                           " is not shown: " + why);
    }
    return texture;
}

ModelPicture::ModelPicture(const DrawnScene& drawn, RenderShow show, const FrameChoice& choice,
                           const MapReading& reading, ModelTextures* textures, std::span<const ScenePose> poses)
    : drawn_(drawn), show_(show), choice_(choice), reading_(reading), textures_(textures), poses_(poses) {
    surfaces_.resize(drawn.scene.primitives.size());
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
        if (!drawn.scene.primitives[i].corners.empty()) prepare(i);
    }
    place();
}

std::uint64_t ModelPicture::cornerCount() const {
    std::uint64_t count = 0;
    for (const ModelSurface& surface : surfaces_) count += surface.shown.corners.size();
    return count;
}

TangentSources ModelPicture::tangentSources() const {
    TangentSources sources{.has_other = !choice_.others.empty()};
    for (const ModelSurface& surface : surfaces_) {
        const ShownSurface& shown = surface.shown;
        if (shown.corners.empty()) continue;
        const bool is_missing = shown.tangents.empty() || (show_ == RenderShow::error && shown.expected.empty());
        sources.stored |= !shown.tangents.empty() && !shown.tangents.is_per_corner;
        sources.computed |= !shown.tangents.empty() && shown.tangents.is_per_corner;
        sources.missing |= is_missing;
        sources.has_map |= shown.normal_map.image != nullptr;
    }
    return sources;
}

void ModelPicture::prepare(std::size_t primitive) {
    const ScenePrimitive& source = drawn_.scene.primitives[primitive];
    ModelSurface& surface = surfaces_[primitive];
    ShownSurface& shown = surface.shown;
    if (drawn_.scene.memory) {
        constexpr std::uint64_t kCornerBytes = 112;
        drawn_.scene.memory->take(kCornerBytes * source.corners.size() + 40 * source.positions.size(), source.place);
    }
    shown.corners = source.corners.span();
    if (source.normals.empty()) surface.flat_normals = flatNormals(source.positions.span(), source.corners.span());
    shown.normals = source.normals.empty() ? CornerValues<Vec3>{surface.flat_normals, true}
                                           : CornerValues<Vec3>{source.normals.span(), false};
    const SurfaceLook& look = drawn_.looks[primitive];
    shown.base_color = look.base_color;
    shown.alpha_cutoff = alphaCutoff(look, show_);
    shown.is_unlit = look.is_unlit;
    if (primitive < drawn_.colors.size() && drawn_.colors[primitive].size() == source.positions.size())
        shown.colors = drawn_.colors[primitive].span();
    shown.reading = reading_;
    shown.reading.scale *= static_cast<float>(look.normal_scale);
    if (textures_ != nullptr) prepareTextures(primitive);
    prepareFrames(primitive);
}

void ModelPicture::prepareTextures(std::size_t primitive) {
    const ScenePrimitive& source = drawn_.scene.primitives[primitive];
    const SurfaceLook& look = drawn_.looks[primitive];
    ModelSurface& surface = surfaces_[primitive];
    using Use = ModelTextures::Use;
    const auto placed = [&](const std::optional<TextureReading>& texture, Use use, bool alpha, std::vector<Vec2>& uvs) {
        PlacedTexture result = textures_->find(source, texture, use, alpha);
        if (result.image == nullptr) return result;
        uvs = textureUvs(source.uv_sets[texture->uv_set].span(), texture->transform);
        result.uvs = uvs;
        return result;
    };
    const bool is_lit = show_ == RenderShow::lit, reads_alpha = surface.shown.alpha_cutoff > 0;
    if (is_lit || reads_alpha)
        surface.shown.base = placed(look.base_texture, Use::color, reads_alpha, surface.base_uvs);
    const bool reads_map = (is_lit && !look.is_unlit) || show_ == RenderShow::mapped;
    if (reads_map) surface.shown.normal_map = placed(look.normal_texture, Use::normals, false, surface.normal_uvs);
}

void ModelPicture::prepareFrames(std::size_t primitive) {
    const ScenePrimitive& source = drawn_.scene.primitives[primitive];
    ModelSurface& surface = surfaces_[primitive];
    ShownSurface& shown = surface.shown;
    const UvReading reading = tangentReading(source);
    if (show_ == RenderShow::sign || show_ == RenderShow::uv) {
        if (!reading.uvs.empty()) surface.sides = sidesOf(source, shown.normals, reading.uvs);
        shown.sides = surface.sides;
    }
    if (show_ == RenderShow::uv) {
        if (reading.uvs.empty()) return;
        surface.islands = findUvIslands(source.corners.span(), source.positions.span(), reading.uvs).island_of;
        shown.islands = surface.islands;
        for (const Vec2& uv : reading.uvs) surface.uv_positions.push_back({uv.x, -uv.y, 0});
        return;
    }
    if (!choice_.always && shown.normal_map.image == nullptr) return;
    // Tangents without normals count as absent, as glTF specifies.
    const bool has_stored = !source.tangents.empty() && !source.normals.empty();
    const bool shows_stored = has_stored && choice_.frames != RenderFrames::computed;
    const bool may_compute = choice_.frames != RenderFrames::stored;
    if (choice_.compare || (!shows_stored && may_compute))
        surface.computed = computeCornerTangents(source, shown.normals, choice_.method, choice_.execution);
    const CornerValues<Vec4> computed{surface.computed, true};
    if (shows_stored) shown.tangents = {source.tangents.span(), false};
    if (!shows_stored && may_compute) shown.tangents = computed;
    if (choice_.compare) shown.expected = computed;
    if (choice_.others.empty()) return;
    shown.expected = {choice_.others[primitive].tangents, true};
    shown.expected_normals = {choice_.others[primitive].normals, true};
}

void ModelPicture::place() {
    const auto addShown = [&](std::size_t primitive, const ShownSurface& shown, std::span<const Vec3> positions,
                              const Affine& to_world) {
        if (shown.corners.empty() || positions.empty()) return;
        DrawnMesh mesh{.positions = positions,
                       .corners = shown.corners,
                       .to_world = to_world,
                       .is_double_sided = show_ == RenderShow::uv || drawn_.looks[primitive].is_double_sided};
        if (show_ != RenderShow::uv && shown.alpha_cutoff > 0) {
            mesh.is_there = [&shown](std::size_t triangle, const std::array<double, 3>& weights) {
                return isOpaqueAt(shown, triangle, weights);
            };
        }
        meshes_.push_back(std::move(mesh));
        shown_.push_back(&shown);
    };
    const auto add = [&](std::size_t primitive, std::span<const Vec3> positions, const Affine& to_world) {
        addShown(primitive, surfaces_[primitive].shown, positions, to_world);
    };
    if (show_ == RenderShow::uv) {
        for (std::size_t i = 0; i < surfaces_.size(); ++i) add(i, surfaces_[i].uv_positions, {});
        return;
    }
    for (std::size_t i = 0; i < drawn_.placements.size(); ++i) {
        const ScenePlacement& placement = drawn_.placements[i];
        if (!placement.is_visible) continue;
        const std::size_t primitive = placement.primitive;
        const ScenePose* const posed = i < poses_.size() && !poses_[i].empty() ? &poses_[i] : nullptr;
        if (posed == nullptr || surfaces_[primitive].shown.corners.empty()) {
            add(primitive, drawn_.scene.primitives[primitive].positions.span(), placement.to_world);
            continue;
        }
        const PosedSurface& surface = pose(primitive, *posed);
        // Bone matrices transform to world space, so the node of a skinned mesh has no effect.
        addShown(primitive, surface.shown, surface.positions, posed->bones.empty() ? placement.to_world : Affine{});
    }
}

const PosedSurface& ModelPicture::pose(std::size_t primitive, const ScenePose& pose) {
    const ScenePrimitive& source = drawn_.scene.primitives[primitive];
    const ShownSurface& rest = surfaces_[primitive].shown;
    if (drawn_.scene.memory) {
        constexpr std::uint64_t kCornerBytes = sizeof(Vec3) + 2 * sizeof(Vec4),
                                kVertexBytes = 2 * sizeof(Vec3) + sizeof(Vec4);
        drawn_.scene.memory->take(kCornerBytes * rest.corners.size() + kVertexBytes * source.positions.size(),
                                  source.place);
    }
    const auto added = [](const Vec3& to, std::span<const Vec3> offsets, std::size_t vertex) {
        return offsets.empty() ? to : toFloat(toDouble(to) + toDouble(offsets[vertex]));
    };
    PosedSurface& result = posed_.emplace_back();
    result.shown = rest;
    for (std::size_t v = 0; v < source.positions.size(); ++v) {
        const Vec3 at = added(source.positions[v], pose.positions, v);
        result.positions.push_back(pose.bones.empty() ? at : toFloat(pose.bones[v].point(toDouble(at))));
    }
    if (source.normals.empty()) {
        result.normals = flatNormals(result.positions, rest.corners);
    } else {
        for (std::size_t v = 0; v < source.normals.size(); ++v) {
            const Vec3 normal = added(source.normals[v], pose.normals, v);
            result.normals.push_back(withUnitLength(pose.bones.empty() ? normal : normalAt(pose.bones[v], normal)));
        }
    }
    result.shown.normals = {result.normals, source.normals.empty()};
    const auto turned = [&](const CornerValues<Vec4>& values, std::vector<Vec4>& to) {
        if (values.empty()) return values;
        for (std::size_t i = 0; i < values.values.size(); ++i) {
            const std::size_t v = values.is_per_corner ? rest.corners[i] : i;
            const Vec4& before = values.values[i];
            const Vec3 moved = added(xyz(before), pose.tangents, v);
            const Vec4 tangent{moved.x, moved.y, moved.z, before.w};
            to.push_back(pose.bones.empty() ? tangent : tangentAt(pose.bones[v], tangent));
        }
        return CornerValues<Vec4>{to, values.is_per_corner};
    };
    result.shown.tangents = turned(rest.tangents, result.tangents);
    result.shown.expected = turned(rest.expected, result.expected);
    return result;
}

namespace {

/// Visits points of a cylinder around the model, so that all pictures of a rotation about the vertical axis have the
/// same camera distance.
void visitCylinder(const ModelPicture& model, WorkLimit& work_limit, double yaw_deg,
                   const std::function<void(const DVec3&)>& visit) {
    DVec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    const auto forPoints = [&](const auto& take) {
        for (const DrawnMesh& mesh : model.meshes()) {
            work_limit.spend(1 + mesh.corners.size());
            for (const std::uint32_t vertex : mesh.corners) {
                const DVec3 point = mesh.to_world.point(toDouble(mesh.positions[vertex]));
                if (std::isfinite(point.x + point.y + point.z)) take(point);
            }
        }
    };
    forPoints([&](const DVec3& p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    });
    if (low.x > high.x) return;
    const double x = (low.x + high.x) / 2, z = (low.z + high.z) / 2;
    double radius = 0;
    forPoints(
        [&](const DVec3& p) { radius = std::max(radius, std::sqrt((p.x - x) * (p.x - x) + (p.z - z) * (p.z - z))); });
    constexpr int kSides = 48;
    for (int i = 0; i < kSides; ++i) {
        const SineCosine turn = sineCosine((yaw_deg + i * (360.0 / kSides)) * (kPi / 180));
        for (const double y : {low.y, high.y}) visit({x + radius * turn.sine, y, z + radius * turn.cosine});
    }
}

/// Visits all points of the picture; called twice, for the direction and the distance of the camera.
void visitPoints(const ModelPicture& model, WorkLimit& work_limit, bool is_uv,
                 const std::function<void(const DVec3&)>& visit) {
    for (const DrawnMesh& mesh : model.meshes()) {
        work_limit.spend(1 + 2 * mesh.corners.size());
        for (const std::uint32_t vertex : mesh.corners) visit(mesh.to_world.point(toDouble(mesh.positions[vertex])));
    }
    if (!is_uv) return;
    visit({0, 0, 0});
    visit({1, -1, 0});
}

}  // namespace

SurfacePicture drawModel(const ModelPicture& model, const RenderOptions& options) {
    const bool is_uv = options.show == RenderShow::uv;
    const Legend legend = options.legend ? model.legend() : Legend{};
    const std::uint32_t rows = legendRows(legend, options.width, options.height), height = options.height - rows;
    const std::uint64_t samples = std::uint64_t{options.width} * options.samples * options.height * options.samples;
    constexpr std::uint64_t kSteps = std::uint64_t{1} << 28, kMaxLayers = 100, kCornerSteps = 64;
    WorkLimit work_limit(kSteps + kMaxLayers * samples + kCornerSteps * model.cornerCount());
    const ViewAngles angles = is_uv ? ViewAngles{} : ViewAngles{options.yaw_deg, options.pitch_deg};
    const Camera camera = Camera::around(
        [&](const std::function<void(const DVec3&)>& visit) {
            if (options.turntable > 1 && !is_uv)
                visitCylinder(model, work_limit, options.yaw_deg, visit);
            else
                visitPoints(model, work_limit, is_uv, visit);
        },
        angles, is_uv ? 0 : options.field_of_view_deg, options.width * options.samples, height * options.samples);
    const DVec3 light = toDouble(options.to_light);
    DVec3 to_light = light.x * camera.right() + light.y * camera.up() + light.z * camera.back();
    normalize(to_light);
    Parallel parallel(options.execution);
    SurfacePicture picture = drawSurfaces(options.show, model.meshes(), model.surfaces(), camera, to_light,
                                          {options.width, height, options.samples}, work_limit, parallel);
    if (is_uv) drawUvSquare(picture.image, camera, options.samples);
    addLegend(legend, rows, picture.image);
    return picture;
}

RgbImage sideBySide(const RgbImage& left, const RgbImage& right) {
    RgbImage image = left;
    const std::size_t row = std::size_t{3} * image.width, middle = std::size_t{3} * (image.width / 2);
    for (std::size_t y = 0; y < image.height; ++y)
        std::copy_n(right.rgb.data() + y * row + middle, row - middle, image.rgb.data() + y * row + middle);
    drawDividingLine(image);
    return image;
}

std::vector<std::uint8_t> encodePicture(const RgbImage& image) {
    std::optional<std::vector<std::uint8_t>> png = encodePng(image);
    if (!png) failFile(ErrorCode::unsupportedFile, "this build of tspace cannot write PNG");
    return *std::move(png);
}

std::vector<std::string> showHeights(Method method, const Execution& execution, DrawnScene& drawn) {
    GenerateOptions options;
    options.tangents.compute.method = method;
    options.execution = execution;
    std::vector<std::string> warnings;
    Scene& scene = drawn.scene;
    struct Shown {
        bool is_height_map = false;
        std::optional<std::size_t> image = {};
    };
    std::map<std::size_t, Shown> shown_of;  // converted height map of each material
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        SurfaceLook& look = drawn.looks[i];
        for (const TangentUse& use : scene.primitives[i].uses) {
            if (!use.may_be_heights || !use.image || !look.normal_texture) continue;
            const auto [entry, is_new] = shown_of.try_emplace(use.material);
            Shown& shown = entry->second;
            if (is_new) {
                ConvertedHeights made =
                    normalMapFromHeights(scene, use.material, *use.image, look.normal_scale, options);
                shown.is_height_map = made.is_height_map;
                const std::string name = scene.images[*use.image].uri;
                if (made.is_height_map && !made.remarks.empty())
                    warnings.push_back("the height map '" + name + "': " + made.remarks);
                if (!made.file.empty()) {
                    scene.memory->take(made.file.size(), {});
                    shown.image = scene.images.size();
                    scene.images.push_back({.name = name, .uri = name});
                    scene.images.back().bytes.assign(made.file.begin(), made.file.end());
                } else if (made.is_height_map) {
                    warnings.push_back("the height map '" + name + "' is not shown: " + made.why_not);
                }
            }
            if (!shown.is_height_map) continue;
            look.normal_texture->image = shown.image;
            look.normal_scale = 1;
        }
    }
    return warnings;
}

}  // namespace tspace
