// SPDX-License-Identifier: MIT

#include "commands/shared/map_image_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

#include "commands/shared/image_budget.h"
#include "commands/shared/uv_reading.h"
#include "images/image.h"
#include "images/tga.h"
#include "maps/layout/uv_coverage.h"
#include "maps/texels/gray.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/read/read_scene.h"
#include "tspace/indexed_frames.h"

namespace tspace {
namespace {

/// Returns the name of an image without folders and extension.
std::string stemOf(const std::string& name) {
    const std::size_t folder = name.find_last_of("/\\");
    const std::string file = folder == std::string::npos ? name : name.substr(folder + 1);
    return file.substr(0, file.find_last_of('.'));
}

/// Returns the primitive's use of the map, or null.
const TangentUse* useOfImage(const Scene& scene, const ScenePrimitive& primitive, const std::string& stem) {
    for (const TangentUse& use : primitive.uses) {
        if (!use.image || !showsNormals(use)) continue;
        const SceneImage& image = scene.images[*use.image];
        if (!stem.empty() && (stemOf(image.uri) == stem || stemOf(image.name) == stem)) return &use;
    }
    return nullptr;
}

const TangentUse* firstNormalMap(const ScenePrimitive& primitive) {
    for (const TangentUse& use : primitive.uses) {
        if (showsNormals(use)) return &use;
    }
    return nullptr;
}

struct ChosenPrimitive {
    const ScenePrimitive* primitive = nullptr;
    std::size_t number = 0;  ///< index in the scene
    /// use of the map, with its UV set and transform; null: the first UV set without a transform
    const TangentUse* use = nullptr;
    bool is_guess = false;  ///< no material references an image with the name of the map
};

std::vector<ChosenPrimitive> choosePrimitives(const Scene& scene, const MapMeshChoice& choice) {
    const std::string stem = stemOf(choice.image_name);
    const bool by_image = choice.material.empty() &&
                          std::any_of(scene.primitives.begin(), scene.primitives.end(), [&](const auto& primitive) {
                              return useOfImage(scene, primitive, stem) != nullptr;
                          });
    std::vector<ChosenPrimitive> chosen;
    for (const ScenePrimitive& primitive : scene.primitives) {
        if (!choice.material.empty() && primitive.material_name != choice.material) continue;
        const TangentUse* use = useOfImage(scene, primitive, stem);
        if (by_image && use == nullptr) continue;
        if (use == nullptr) use = firstNormalMap(primitive);
        const std::size_t set = use == nullptr ? 0 : use->uv_set;
        if (primitive.corners.empty() || set >= primitive.uv_sets.size() || primitive.uv_sets[set].empty()) continue;
        const auto number = static_cast<std::size_t>(&primitive - scene.primitives.data());
        chosen.push_back({&primitive, number, use, !by_image});
    }
    return chosen;
}

template <class T>
void gatherCorners(std::span<const T> from, std::span<const std::uint32_t> indices, std::vector<T>& to) {
    to.reserve(to.size() + indices.size());
    for (const std::uint32_t index : indices) to.push_back(from[index]);
}

/// Appends normals and tangents of the corners, and computes them if they are missing. Returns whether they were
/// computed.
bool addFrames(const ScenePrimitive& primitive, std::span<const Vec2> uvs, const TangentOptions& options,
               const Execution& execution, OwnedMesh& mesh) {
    if (!primitive.normals.empty() && !primitive.tangents.empty()) {
        gatherCorners(primitive.normals.span(), primitive.corners.span(), mesh.normals);
        gatherCorners(primitive.tangents.span(), primitive.corners.span(), mesh.tangents);
        return false;
    }
    IndexedFramesOptions frames{.tangents = options, .normals = {.weighting = NormalWeighting::flat}};
    const IndexedFrames made = valueOrThrow(makeIndexedFrames(primitive.view(uvs), frames, execution));
    gatherCorners(std::span<const Vec3>(made.normals), made.indices, mesh.normals);
    gatherCorners(std::span<const Vec4>(made.tangents), made.indices, mesh.tangents);
    return true;
}

/// Returns the scale of the map's x and y. Fails if the primitives have different scales.
double scaleOf(std::span<const ChosenPrimitive> chosen) {
    const auto scale_of = [](const ChosenPrimitive& one) { return one.use == nullptr ? 1.0 : one.use->scale; };
    const ChosenPrimitive& first = chosen.front();
    for (const ChosenPrimitive& one : chosen) {
        const std::string material = "the material " + inQuotes(one.primitive->material_name);
        const auto scale = static_cast<float>(scale_of(one));
        if (scale == 0 || !std::isfinite(scale))
            failFile(ErrorCode::invalidFile, material +
                                                 " sets the scale of its normal map to 0 or to a value outside the "
                                                 "range of floats, so the map cannot be used");
        if (scale_of(one) != scale_of(first)) {
            failFile(ErrorCode::invalidFile, material + " sets a different scale of the map than " +
                                                 inQuotes(first.primitive->material_name) +
                                                 "; select one of them with --material");
        }
    }
    return scale_of(first);
}

/// Fails if several materials may use the map and their UVs overlap, because a map fits only one of them.
void checkMaterials(std::span<const ChosenPrimitive> chosen) {
    constexpr std::uint32_t kSide = 512;
    constexpr std::uint64_t kOneOf = 100;
    const auto countOf = [](const TexelMask& mask) {
        return mask.count({.left = 0, .top = 0, .right = kSide, .bottom = kSide});
    };
    std::map<std::string, TexelMask> masks;
    std::uint64_t steps = kCoverSteps;
    for (const ChosenPrimitive& one : chosen) {
        const TangentUse plain, &use = one.use == nullptr ? plain : *one.use;
        const std::vector<Vec2> uvs = textureUvs(one.primitive->uv_sets[use.uv_set].span(), use.transform);
        TexelMask& mask = masks.try_emplace(one.primitive->material_name, kSide, kSide).first->second;
        coverTexels({one.primitive->corners.span(), uvs, use.wrap_u, use.wrap_v}, mask, steps);
    }
    std::string names;
    for (const auto& [name, mask] : masks) names += (names.empty() ? "" : ", ") + inQuotes(name);
    for (auto one = masks.begin(); one != masks.end(); ++one) {
        for (auto other = std::next(one); other != masks.end(); ++other) {
            TexelMask both = one->second;
            both.add(other->second);
            const std::uint64_t a = countOf(one->second), b = countOf(other->second), shared = a + b - countOf(both);
            if (kOneOf * shared <= std::min(a, b)) continue;
            failFile(ErrorCode::invalidFile, "the UVs of the materials " + inQuotes(one->first) + " and " +
                                                 inQuotes(other->first) +
                                                 " overlap, and no material references an image with the name of the "
                                                 "map; select one with --material: " +
                                                 names);
        }
    }
}

/// Returns whether two transforms rotate directions equally; translation and uniform scale are ignored.
bool rotateAlike(const Affine& a, const Affine& b) {
    constexpr double kSame = 1e-6;
    const auto size = [](const Affine& place) {
        return std::sqrt(dot(place.x, place.x) + dot(place.y, place.y) + dot(place.z, place.z));
    };
    const auto apart = [&](const DVec3& p, const DVec3& q) { return length(size(b) * p - size(a) * q); };
    return std::max({apart(a.x, b.x), apart(a.y, b.y), apart(a.z, b.z)}) <= kSame * size(a) * size(b);
}

/// Returns the transform with which the scene draws a primitive, or nothing if the scene does not draw it.
std::optional<Affine> placeOf(const DrawnScene& drawn, const ChosenPrimitive& chosen) {
    std::optional<Affine> place;
    for (const ScenePlacement& placement : drawn.placements) {
        if (placement.primitive != chosen.number) continue;
        if (!place) place = placement.to_world;
        if (rotateAlike(*place, placement.to_world)) continue;
        failFile(ErrorCode::invalidFile,
                 "several nodes use the mesh " + inQuotes(chosen.primitive->mesh_name) +
                     " with different rotations or scales, but a map in world space fits only one of them");
    }
    return place;
}

/// Transforms the normals and tangents of all corners with index `first` or higher to world space.
void placeCorners(const Affine& place, std::size_t first, MapMesh& mesh) {
    OwnedMesh& corners = mesh.corners;
    for (std::size_t i = first; i < corners.normals.size(); ++i) {
        corners.normals[i] = normalAt(place, corners.normals[i]);
        corners.tangents[i] = tangentAt(place, corners.tangents[i]);
    }
    std::array<DVec3, 3> axes{place.normal({1, 0, 0}), place.normal({0, 1, 0}), place.normal({0, 0, 1})};
    const double size = std::max({length(axes[0]), length(axes[1]), length(axes[2])});
    if (size > 0) {
        for (DVec3& axis : axes) axis = (1 / size) * axis;
    }
    mesh.axes.resize(corners.normals.size() / 3, {toFloat(axes[0]), toFloat(axes[1]), toFloat(axes[2])});
}

/// Removes the triangles outside the tile, from corner `first` on.
void keepTile(std::uint32_t tile, std::size_t first, OwnedMesh& mesh) {
    std::size_t kept = first;
    for (std::size_t i = first; i < mesh.uvs.size(); i += 3) {
        if (tileOf(&mesh.uvs[i]) != tile) continue;
        for (std::size_t k = 0; k < 3; ++k, ++kept) {
            mesh.uvs[kept] = mesh.uvs[i + k];
            mesh.positions[kept] = mesh.positions[i + k];
            mesh.normals[kept] = mesh.normals[i + k];
            mesh.tangents[kept] = mesh.tangents[i + k];
        }
    }
    mesh.uvs.resize(kept);
    mesh.positions.resize(kept);
    mesh.normals.resize(kept);
    mesh.tangents.resize(kept);
}

void reportPrimitive(const ScenePrimitive& primitive, bool frames_made, MapMesh& mesh) {
    MapMeshReport& report = mesh.report;
    report.tangents_made = report.tangents_made || frames_made;
    if (std::find(report.materials.begin(), report.materials.end(), primitive.material_name) == report.materials.end())
        report.materials.push_back(primitive.material_name);
    ++report.primitive_count;
    report.triangle_count = mesh.corners.uvs.size() / 3;
}

}  // namespace

bool showsNormals(const TangentUse& use) { return use.needed_by != "anisotropy"; }

bool addMapCorners(const ScenePrimitive& primitive, const TangentUse* use, const TangentOptions& tangents,
                   const Execution& execution, OwnedMesh& mesh) {
    const auto uvs_of = [&](const TangentUse& of) {
        return textureUvs(primitive.uv_sets[of.uv_set].span(), of.transform);
    };
    const TangentUse plain;
    const TangentUse& reading = use == nullptr ? plain : *use;
    const std::vector<Vec2> uvs = uvs_of(reading);
    const TangentUse* const first = primitive.uses.empty() ? nullptr : &primitive.uses.front();
    const bool has_first =
        first != nullptr && first->uv_set < primitive.uv_sets.size() && !primitive.uv_sets[first->uv_set].empty();
    const bool frames_made = addFrames(primitive, has_first ? uvs_of(*first) : uvs, tangents, execution, mesh);
    gatherCorners(std::span<const Vec2>(uvs), primitive.corners.span(), mesh.uvs);
    gatherCorners(primitive.positions.span(), primitive.corners.span(), mesh.positions);
    return frames_made;
}

MapMesh readMapMesh(const std::string& model, const MapMeshChoice& choice, const TangentOptions& tangents,
                    const FileOptions& file, const Execution& execution) {
    const DrawnScene drawn = readDrawnScene(model, file, false);
    const Scene& scene = drawn.scene;
    const std::vector<ChosenPrimitive> chosen = choosePrimitives(scene, choice);
    if (chosen.empty()) {
        const std::string which = choice.material.empty() ? "the model" : "the material " + inQuotes(choice.material);
        failFile(ErrorCode::invalidFile, "no triangle of " + which + " has the UVs that a normal map needs");
    }
    if (choice.needs_material && choice.material.empty() && chosen.front().is_guess) checkMaterials(chosen);
    MapMesh mesh;
    mesh.warnings = scene.normalsWarnings();
    mesh.report.scale = scaleOf(chosen);
    // Tiles of UDIM layouts are adjacent, so the wrap mode of the texture is not used.
    if (chosen.front().use != nullptr && choice.tile == 0) {
        mesh.wrap_u = chosen.front().use->wrap_u;
        mesh.wrap_v = chosen.front().use->wrap_v;
    }
    constexpr std::size_t kCornerBytes = sizeof(Vec2) + 2 * sizeof(Vec3) + sizeof(Vec4) + sizeof(MapAxes) / 3;
    for (const ChosenPrimitive& one : chosen) {
        std::optional<Affine> place;
        if (choice.in_world) {
            place = placeOf(drawn, one);
            if (!place) continue;
        }
        const std::size_t first = mesh.corners.normals.size();
        scene.memory->take(4 * kCornerBytes * one.primitive->corners.size(), one.primitive->place);
        const bool frames_made = addMapCorners(*one.primitive, one.use, tangents, execution, mesh.corners);
        if (choice.tile != 0) keepTile(choice.tile, first, mesh.corners);
        if (mesh.corners.uvs.size() != first) reportPrimitive(*one.primitive, frames_made, mesh);
        if (place) placeCorners(*place, first, mesh);
    }
    if (mesh.corners.uvs.empty() && choice.tile != 0)
        failFile(ErrorCode::invalidFile, "no triangle is in the UDIM tile " + std::to_string(choice.tile));
    if (mesh.corners.uvs.empty())
        failFile(ErrorCode::invalidFile, "no node of the scene uses the mesh, so its world space is undefined");
    return mesh;
}

namespace {

constexpr std::uint64_t kMaxMapPixels = std::uint64_t{1} << 28;

}  // namespace

FloatImage readMapImage(const std::string& input, ByteSpan content, const FileOptions& file, ImageUse use) {
    Bytes read;
    ByteSpan bytes = content;
    if (bytes.data() == nullptr) {
        read = readFile(input);
        bytes = read;
    }
    if (const char* why_not = whyNotRead(imageFormat(bytes))) failFile(ErrorCode::unsupportedFile, why_not);
    imageBudget(bytes, file)->require(imageNeed(bytes), {});
    std::string why;
    std::optional<FloatImage> image = decodeFloatImage(bytes, kMaxMapPixels, why, use);
    if (!image) failFile(ErrorCode::invalidFile, why);
    return *std::move(image);
}

MapMesh readNamedMapMesh(const std::string& model, const MapMeshChoice& choice, const TangentOptions& tangents,
                         const FileOptions& file, const Execution& execution) {
    try {
        MapMesh mesh = readMapMesh(model, choice, tangents, file, execution);
        for (std::string& warning : mesh.warnings) warning = "the model " + pathInQuotes(model) + ": " + warning;
        return mesh;
    } catch (FileError& failure) {
        failure.error.message = "the model " + pathInQuotes(model) + ": " + failure.error.message;
        throw;
    }
}

std::string fileNameOf(const std::string& path) {
    const std::size_t folder = path.find_last_of("/\\");
    return folder == std::string::npos ? path : path.substr(folder + 1);
}

bool isTgaName(const std::string& path) { return lowerExtension(path) == ".tga"; }

namespace {

std::vector<std::uint8_t> tgaOf(std::optional<std::vector<std::uint8_t>>&& file) {
    if (!file) failFile(ErrorCode::tooLarge, "a TGA can have at most 65535 pixels per side");
    return *std::move(file);
}

}  // namespace

std::optional<std::vector<std::uint8_t>> encodeByName(const std::string& name, const FloatImage& image, unsigned bits) {
    return isTgaName(name) ? tgaOf(encodeTga(image)) : encodePng(image, bits);
}

std::optional<std::vector<std::uint8_t>> encodeByName(const std::string& name, const RgbImage& image) {
    return isTgaName(name) ? tgaOf(encodeTga(image)) : encodePng(image);
}

void writeMapImage(const FloatImage& image, ImageFormat format, unsigned bits, const std::string& output,
                   const OutputOptions& way) {
    const std::optional<std::vector<std::uint8_t>> file =
        format == ImageFormat::exr ? encodeExr(image, bits) : encodeByName(way.sink ? "" : output, image, bits);
    if (!file) failFile(ErrorCode::outOfMemory, "the output image cannot be encoded; there may not be enough memory");
    AtomicOutput files(way);
    files.add(output, std::span<const std::uint8_t>(*file));
    files.commit();
}

bool isGrayImage(const FloatImage& image) {
    return isGray(image.texels.size(), [&](std::size_t i) {
        const Vec3& texel = image.texels[i];
        return std::array<double, 3>{255 * double{texel.x}, 255 * double{texel.y}, 255 * double{texel.z}};
    });
}

std::vector<float> heightsOf(const FloatImage& image) {
    std::vector<float> heights;
    heights.reserve(image.texels.size());
    for (const Vec3& texel : image.texels) {
        const bool is_one = texel.x == texel.y && texel.y == texel.z;
        heights.push_back(is_one ? texel.x : (texel.x + texel.y + texel.z) / 3);
    }
    return heights;
}

MapSide tangentSide(const OwnedMesh& mesh, double scale) {
    return {.reading = {.scale = static_cast<float>(scale)},
            .uvs = mesh.uvs,
            .normals = mesh.normals,
            .tangents = mesh.tangents,
            .positions = mesh.positions};
}

}  // namespace tspace
