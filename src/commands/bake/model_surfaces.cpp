// SPDX-License-Identifier: MIT
// Model files as the arrays that baking takes, and which meshes of a low poly look at which of a high poly.
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

#include "commands/bake/all_maps.h"
#include "commands/generate/generate_model.h"
#include "commands/shared/map_image_file.h"
#include "commands/shared/uv_reading.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/float_loss.h"
#include "maps/map_surfaces.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/read/read_scene.h"
#include "model/scene/scene.h"
#include "tspace/asset.h"
#include "tspace/map_error.h"

namespace tspace {

std::size_t placedCorner(const Affine& place, std::size_t i) {
    constexpr std::size_t kMirrored[3] = {0, 2, 1};
    return place.determinant() < 0 ? i - i % 3 + kMirrored[i % 3] : i;
}

namespace {

// Which meshes of a low poly look at which meshes of a high poly.

/// Numbers as LowPoly::groups and HighPoly::groups have them.
struct MeshMatch {
    bool is_used = false;                    ///< else all look at all
    std::vector<std::uint32_t> low = {};     ///< one per primitive
    std::vector<std::uint32_t> high = {};    ///< one per placement
    std::vector<std::string> warnings = {};  ///< one sentence each: what has no partner
};

bool isSeparator(char letter) { return letter == '_' || letter == '-' || letter == '.' || letter == ' '; }

bool isDigits(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char letter) { return letter >= '0' && letter <= '9'; });
}

/// "body" of "Body_low", "BODY_HP", "Body_high_001", "Body_high_buckle" and so on. Behind "low" numbers alone may stand: what
/// follows may tell two low polys apart, and high polys of one low poly may be several.
std::string nameStem(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    for (const std::string_view mark : {"low", "lp", "high", "hp"}) {
        const std::size_t at = name.rfind(mark);
        if (at == std::string::npos || at < 2 || !isSeparator(name[at - 1])) continue;
        const std::string_view rest = std::string_view(name).substr(at + mark.size());
        const bool is_low = mark[0] == 'l';
        if (rest.empty() || (isSeparator(rest[0]) && (!is_low || isDigits(rest.substr(1)))))
            return name.substr(0, at - 1);
    }
    return name;
}

struct Names {
    std::string node = {}, mesh = {};

    [[nodiscard]] const std::string& shown() const { return node.empty() ? mesh : node; }
};

Names namesOf(const DrawnScene& drawn, std::size_t placement) {
    const ScenePlacement& at = drawn.placements[placement];
    return {at.node_name, drawn.scene.primitives[at.primitive].mesh_name};
}

/// Names of each primitive where it stands first.
std::vector<Names> firstNames(const DrawnScene& drawn) {
    std::vector<std::optional<Names>> names(drawn.scene.primitives.size());
    for (std::size_t i = 0; i < drawn.placements.size(); ++i) {
        auto& of_primitive = names[drawn.placements[i].primitive];
        if (!of_primitive) of_primitive = namesOf(drawn, i);
    }
    std::vector<Names> result;
    for (std::size_t i = 0; i < names.size(); ++i)
        result.push_back(names[i].value_or(Names{{}, drawn.scene.primitives[i].mesh_name}));
    return result;
}

using Pairs = std::map<std::string, std::string>;  ///< a name of the high poly, and that of its low poly

/// Lines "LOW = HIGH"; empty ones and those that begin with # are left out.
Pairs readPairs(const std::string& path, const FileOptions& file) {
    if (file.opened) file.opened(path);
    const Bytes bytes = readFile(path);
    const auto trimmed = [](std::string_view text) {
        const auto isBlank = [](char letter) { return letter == ' ' || letter == '\t' || letter == '\r'; };
        while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
        while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
        return text;
    };
    Pairs pairs;
    std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (std::size_t number = 1; !rest.empty(); ++number) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view line = trimmed(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (line.empty() || line[0] == '#') continue;
        const std::size_t equals = line.find('=');
        const std::string_view low = trimmed(line.substr(0, std::min(equals, line.size())));
        const std::string_view high = equals < line.size() ? trimmed(line.substr(equals + 1)) : std::string_view();
        if (low.empty() || high.empty())
            failFile(ErrorCode::invalidFile,
                     pathInQuotes(path) + ", line " + std::to_string(number) + ": this is no LOW = HIGH");
        pairs[std::string(high)] = std::string(low);
    }
    return pairs;
}

/// "'a', 'b' and 3 more".
std::string listOf(const std::set<std::string>& names) {
    constexpr std::size_t kShown = 5;
    std::string text;
    std::size_t count = 0;
    for (const std::string& name : names) {
        if (++count > kShown) break;
        text += (text.empty() ? "" : ", ") + inQuotes(name);
    }
    if (names.size() > kShown) text += " and " + std::to_string(names.size() - kShown) + " more";
    return text;
}

class Matching {
  public:
    Matching(const DrawnScene& low, const DrawnScene& high, const Pairs* pairs)
        : low_(low), high_(high), pairs_(pairs), low_names_(firstNames(low)) {}

    MeshMatch run() {
        numberLow();
        std::set<std::uint32_t> met;
        for (std::size_t i = 0; i < high_.placements.size(); ++i) {
            match_.high.push_back(groupOf(namesOf(high_, i)));
            if (isDrawn(high_, high_.placements[i].primitive) && match_.high.back() != kEveryGroup)
                met.insert(match_.high.back());
        }
        match_.is_used = !met.empty() && (by_node_.size() > 1 || pairs_ != nullptr);
        if (!match_.is_used) return std::move(match_);
        std::set<std::string> lonely_low, lonely_high;
        for (std::size_t i = 0; i < match_.low.size(); ++i) {
            if (met.count(match_.low[i]) != 0) continue;
            match_.low[i] = kEveryGroup;
            if (isDrawn(low_, i)) lonely_low.insert(low_names_[i].shown());
        }
        for (std::size_t i = 0; i < match_.high.size(); ++i) {
            if (match_.high[i] == kEveryGroup && isDrawn(high_, high_.placements[i].primitive))
                lonely_high.insert(namesOf(high_, i).shown());
        }
        if (!lonely_low.empty())
            match_.warnings.push_back("nothing of the high poly has the name of " + listOf(lonely_low) +
                                      ": there everything is looked at");
        if (!lonely_high.empty())
            match_.warnings.push_back("nothing of the low poly has the name of " + listOf(lonely_high) +
                                      " of the high poly: everything looks at it");
        return std::move(match_);
    }

  private:
    static bool isDrawn(const DrawnScene& drawn, std::size_t primitive) {
        return !drawn.scene.primitives[primitive].corners.empty();
    }

    [[nodiscard]] std::string keyOf(const std::string& name) const { return pairs_ != nullptr ? name : nameStem(name); }

    /// What has one name by its nodes, or its meshes where these have none, is one.
    void numberLow() {
        for (std::size_t i = 0; i < low_names_.size(); ++i) {
            const std::string key = keyOf(low_names_[i].shown());
            if (!isDrawn(low_, i)) {
                match_.low.push_back(kEveryGroup);
                continue;
            }
            const auto number = static_cast<std::uint32_t>(by_node_.size());
            match_.low.push_back(by_node_.emplace(key, number).first->second);
            const auto [of_mesh, is_new] = by_mesh_.emplace(keyOf(low_names_[i].mesh), match_.low.back());
            // A mesh at several objects says nothing about them.
            if (!is_new && of_mesh->second != match_.low.back()) of_mesh->second = kEveryGroup;
        }
    }

    /// Of something of the high poly.
    [[nodiscard]] std::uint32_t groupOf(const Names& names) const {
        for (const std::string& name : {names.node, names.mesh}) {
            if (name.empty()) continue;
            std::string key = keyOf(name);
            if (pairs_ != nullptr) {
                const auto pair = pairs_->find(name);
                if (pair == pairs_->end()) continue;
                key = pair->second;
            }
            if (const auto found = by_node_.find(key); found != by_node_.end()) return found->second;
            if (const auto found = by_mesh_.find(key); found != by_mesh_.end()) return found->second;
        }
        return kEveryGroup;
    }

    const DrawnScene &low_, &high_;
    const Pairs* pairs_;
    std::vector<Names> low_names_;
    std::map<std::string, std::uint32_t> by_node_ = {}, by_mesh_ = {};
    MeshMatch match_ = {};
};

/// `how`: BakeFileOptions::match. By the names of nodes, and where one has no partner by those of meshes. Throws FileError for
/// a file of pairs that cannot be read.
MeshMatch matchMeshes(const DrawnScene& low, const DrawnScene& high, const std::string& how, const FileOptions& file) {
    if (how == "all") return {};
    if (how.empty() || how == "names") return Matching(low, high, nullptr).run();
    const Pairs pairs = readPairs(how, file);
    return Matching(low, high, &pairs).run();
}

/// The UVs that the map is read with: those of the normal map that is there, or of the first thing that needs tangents.
std::vector<Vec2> mapUvs(const ScenePrimitive& primitive) {
    const TangentUse* const use = mapUse(primitive);
    const std::size_t set = use == nullptr ? 0 : use->uv_set;
    if (set >= primitive.uv_sets.size() || primitive.uv_sets[set].empty()) return {};
    return textureUvs(primitive.uv_sets[set].span(), use == nullptr ? UvTransform{} : use->transform);
}

/// Whether something that draws triangles lacks normals or tangents.
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
    generate.all = true;
    generate.existing = existing;
    generate.faces = faces;
    generate.tangents = options.tangents;
    generate.normals = options.normals;
    generate.file = options.file;
    generate.execution = options.execution;
    generate.progress = options.progress;
    return generate;
}

/// The low poly as the GLB that is written with its maps later. What is written is what is baked for.
DrawnScene readFromGlb(const std::string& low, const BakeFileOptions& options, BakeModels& models) {
    GenerateOptions generate = allFrames(options, ExistingTangents::keep, Faces::triangles);
    generate.sink = [&](std::span<const std::uint8_t> bytes) {
        models.low_glb.insert(models.low_glb.end(), bytes.begin(), bytes.end());
        return true;
    };
    const GenerateReport report = valueOrThrow(generateFile(low, "low.glb", generate));
    models.low.frames_made =
        std::any_of(report.primitives.begin(), report.primitives.end(),
                    [](const PrimitiveReport& primitive) { return primitive.action == PrimitiveAction::generated; });
    FileOptions in_memory = options.file;
    in_memory.content = models.low_glb;
    return readDrawnScene("low.glb", in_memory, false);
}

/// OBJ has no tangents, and reading it gives normals that it lacks.
DrawnScene readObjWithFrames(const std::string& low, const GenerateOptions& generate, bool& frames_made) {
    DrawnScene drawn = readDrawnScene(low, generate.file, false);
    frames_made = std::any_of(drawn.scene.primitives.begin(), drawn.scene.primitives.end(),
                              [](const ScenePrimitive& primitive) { return !primitive.corners.empty(); });
    if (!frames_made) return drawn;
    drawn = {};
    return generateModel(low, generate, false).model.drawnScene(false);
}

DrawnScene readWithFrames(const std::string& low, const BakeFileOptions& options, BakeModels& models) {
    if (!options.out_mesh.empty()) return readFromGlb(low, options, models);
    const GenerateOptions generate = allFrames(options, ExistingTangents::keep, Faces::triangles);
    if (lowerExtension(low) == ".obj") return readObjWithFrames(low, generate, models.low.frames_made);
    gltf::Document document = gltf::loadDocument(low, options.file, options.execution, options.progress);
    gltf::checkRequiredExtensions(document);
    gltf::Model model(std::move(document));
    models.low.frames_made = lacksFrames(model);
    if (!models.low.frames_made) return model.drawnScene(false);
    return gltf::generateModel(std::move(model), generate, false).model.drawnScene(false);
}

/// Where a primitive stands first.
Affine firstPlace(const DrawnScene& drawn, std::size_t primitive) {
    for (const ScenePlacement& placement : drawn.placements) {
        if (placement.primitive == primitive) return placement.to_world;
    }
    return {};
}

/// Where the models stand, if that is so far from the origin that floats would not hold their shapes there.
DVec3 farPlace(const DrawnScene& drawn) {
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

void addPrimitive(const ScenePrimitive& primitive, std::span<const Vec2> uvs, const Affine& place, std::uint32_t group,
                  LowPart& part) {
    for (std::size_t i = 0; i < primitive.corners.size(); ++i) {
        const std::uint32_t vertex = primitive.corners[placedCorner(place, i)];
        part.positions.push_back(toFloat(place.point(toDouble(primitive.positions[vertex]))));
        const Vec3 normal = primitive.normals.empty() ? Vec3{} : primitive.normals[vertex];
        const Vec4 tangent = primitive.tangents.empty() ? Vec4{} : primitive.tangents[vertex];
        part.normals.push_back(normalAt(place, normal));
        part.tangents.push_back(tangentAt(place, tangent));
        part.uvs.push_back(uvs[vertex]);
    }
    part.groups.insert(part.groups.end(), primitive.corners.size() / 3, group);
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
        addPrimitive(primitive, uvs, firstPlace(drawn, i), group, part);
        if (cage != nullptr) addCage(cage->scene.primitives[i], firstPlace(*cage, i), part);
    }
    if (model.images.empty()) {
        failFile(ErrorCode::missingAttribute,
                 without_uvs > 0 ? "the low poly has no UVs" : "the low poly has no triangles");
    }
    if (without_uvs > 0)
        model.warnings.push_back(std::to_string(without_uvs) +
                                 " primitives of the low poly have no UVs, and are left out");
    for (LowModel::Image& image : model.images) {
        if (match == nullptr) image.part.groups.clear();
    }
    return model;
}

/// Fails where a cage is not the low poly with other positions.
void checkCage(const Scene& low, const Scene& cage) {
    bool fits = low.primitives.size() == cage.primitives.size();
    for (std::size_t i = 0; fits && i < low.primitives.size(); ++i)
        fits = low.primitives[i].corners.size() == cage.primitives[i].corners.size();
    if (!fits) failFile(ErrorCode::countMismatch, "the cage has other triangles than the low poly");
}

/// One vertex per corner where triangles are flat: their normals are their own.
void addFlat(const ScenePrimitive& primitive, const Affine& place, HighModel& model) {
    for (std::size_t i = 0; i < primitive.corners.size(); i += 3) {
        std::array<Vec3, 3> at{};
        for (std::size_t k = 0; k < 3; ++k)
            at[k] = toFloat(place.point(toDouble(primitive.positions[primitive.corners[placedCorner(place, i + k)]])));
        // Without a direction the triangle's own is taken where a ray meets it.
        const Vec3 normal = cross(at[1] - at[0], at[2] - at[0]);
        for (const Vec3& corner : at) {
            model.corners.push_back(static_cast<std::uint32_t>(model.positions.size()));
            model.positions.push_back(corner);
            model.normals.push_back(normal);
        }
    }
}

void addSmooth(const ScenePrimitive& primitive, std::span<const Vec3> normals, const Affine& place, HighModel& model) {
    const auto first = static_cast<std::uint32_t>(model.positions.size());
    for (const Vec3& position : primitive.positions)
        model.positions.push_back(toFloat(place.point(toDouble(position))));
    for (const Vec3& normal : normals) model.normals.push_back(normalAt(place, normal));
    for (std::size_t i = 0; i < primitive.corners.size(); ++i)
        model.corners.push_back(first + primitive.corners[placedCorner(place, i)]);
}

/// Smooth normals, one per vertex.
std::vector<Vec3> smoothNormals(const ScenePrimitive& primitive, const BakeFileOptions& options) {
    std::vector<Vec3> of_corners(primitive.corners.size()), normals(primitive.positions.size());
    const MeshView mesh{.positions = primitive.positions.span(), .indices = {primitive.corners.span()}};
    valueOrThrow(generateNormals(mesh, {.weighting = NormalWeighting::angle, .convention = conventions::gltf},
                                 of_corners, options.execution));
    for (std::size_t i = 0; i < of_corners.size(); ++i) normals[primitive.corners[i]] = of_corners[i];
    return normals;
}

/// One vertex per corner where the primitive shows a map of its own, with the frames that the map is read with.
void addMapped(const ScenePrimitive& primitive, const TangentUse& use, const Affine& place, std::uint32_t map,
               const BakeFileOptions& options, HighModel& model) {
    MapMesh mesh;
    addMapCorners(primitive, &use, options.tangents, options.execution, mesh);
    model.tangents.resize(model.positions.size());
    model.uvs.resize(model.positions.size());
    model.map_of.resize(model.corners.size() / 3, kNoHighMap);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const std::size_t corner = placedCorner(place, i);
        model.corners.push_back(static_cast<std::uint32_t>(model.positions.size()));
        model.positions.push_back(toFloat(place.point(toDouble(mesh.positions[corner]))));
        model.normals.push_back(normalAt(place, mesh.normals[corner]));
        model.tangents.push_back(tangentAt(place, mesh.tangents[corner]));
        model.uvs.push_back(mesh.uvs[corner]);
    }
    model.map_of.resize(model.corners.size() / 3, map);
}

HighModel highModel(const DrawnScene& drawn, const MeshMatch* match, const std::string& path,
                    const BakeFileOptions& options) {
    HighModel model;
    std::size_t made = 0;
    // What glTF and OBJ leave out is flat; meshes of scanners and sculptors are meant to be smooth.
    const std::string extension = lowerExtension(path);
    const bool is_flat = isGltfName(path) || extension == ".obj";
    HighMapReading maps(drawn.scene, options);
    for (std::size_t i = 0; i < drawn.placements.size(); ++i) {
        const ScenePlacement& placement = drawn.placements[i];
        const ScenePrimitive& primitive = drawn.scene.primitives[placement.primitive];
        const Affine& place = placement.to_world;
        if (primitive.corners.empty()) continue;
        model.parts.push_back({static_cast<std::uint32_t>(model.corners.size() / 3), i});
        // Those of STL say where the triangles look, and not how they are shaded.
        if (const TangentUse* const use = maps.find(primitive)) {
            addMapped(primitive, *use, place, maps.numberOf(primitive, *use, primitive.corners.size() / 3), options,
                      model);
        } else if (!primitive.normals.empty() && extension != ".stl") {
            addSmooth(primitive, primitive.normals.span(), place, model);
        } else {
            ++made;
            if (is_flat) {
                addFlat(primitive, place, model);
            } else {
                addSmooth(primitive, smoothNormals(primitive, options), place, model);
            }
        }
        if (match != nullptr) model.groups.insert(model.groups.end(), primitive.corners.size() / 3, match->high[i]);
    }
    if (model.corners.empty()) failFile(ErrorCode::missingAttribute, "the high poly has no triangles");
    model.shown = maps.take();
    model.warnings = std::exchange(model.shown.warnings, {});
    if (!model.shown.maps.empty()) {
        model.tangents.resize(model.positions.size());
        model.uvs.resize(model.positions.size());
        model.map_of.resize(model.corners.size() / 3, kNoHighMap);
    }
    if (made > 0)
        model.warnings.push_back(std::string("the high poly has no normals; its triangles are taken as ") +
                                 (is_flat ? "flat, as glTF says" : "smooth"));
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
    const auto add = [&](auto& to, const auto& values) {
        if (values.empty()) return;
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(3 * triangle);
        to.insert(to.end(), first, first + 3);
    };
    add(positions, from.positions);
    add(normals, from.normals);
    add(tangents, from.tangents);
    add(uvs, from.uvs);
    add(cage, from.cage);
    if (!from.groups.empty()) groups.push_back(from.groups[triangle]);
}

void LowPart::addToRest(const LowPart& from, std::size_t triangle) {
    const auto first = static_cast<std::ptrdiff_t>(3 * triangle);
    rest_positions.insert(rest_positions.end(), from.positions.begin() + first, from.positions.begin() + first + 3);
    rest_normals.insert(rest_normals.end(), from.normals.begin() + first, from.normals.begin() + first + 3);
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
    return box;
}

std::size_t LowModel::triangleCount() const {
    std::size_t count = 0;
    for (const Image& image : images) count += image.part.triangleCount();
    return count;
}

std::optional<LowModel> readLowAnew(const std::string& low, const BakeFileOptions& options, Faces faces,
                                    const LowModel& known) {
    const GenerateOptions generate = allFrames(options, ExistingTangents::replace, faces);
    DrawnScene scene = generateModel(low, generate, false).model.drawnScene(false);
    moveBy(known.origin, scene);
    LowModel model = lowModel(scene, nullptr, nullptr);
    bool fits = model.images.size() == known.images.size();
    for (std::size_t i = 0; fits && i < model.images.size(); ++i)
        fits = model.images[i].part.positions == known.images[i].part.positions;
    return fits ? std::optional(std::move(model)) : std::nullopt;
}

FloatImage readFloatImage(const std::string& path, const FileOptions& options) {
    if (options.opened) options.opened(path);
    return readMapImage(path, {}, options);
}

BakeModels readBakeModels(const std::string& low, const std::string& high, const BakeFileOptions& options) {
    BakeModels models;
    DrawnScene low_scene = aboutInput(BakeInput::low, [&] { return readWithFrames(low, options, models); });
    const bool frames_made = models.low.frames_made;
    DrawnScene cage_scene;
    if (!options.cage.empty()) {
        cage_scene = aboutInput(BakeInput::cage, [&] {
            DrawnScene read = readDrawnScene(options.cage, options.file, false);
            checkCage(low_scene.scene, read.scene);
            return read;
        });
    }
    DrawnScene high_scene = aboutInput(BakeInput::high, [&] {
        return showsMaterials(options.layers) ? readMaterialScene(high, options.file, !options.ignore_high_maps)
                                              : readDrawnScene(high, options.file, !options.ignore_high_maps);
    });
    const DVec3 of_high = farPlace(high_scene);
    const DVec3 origin = length(of_high) > 0 ? of_high : farPlace(low_scene);
    for (DrawnScene* const scene : {&low_scene, &cage_scene, &high_scene}) moveBy(origin, *scene);
    const MeshMatch match = matchMeshes(low_scene, high_scene, options.match, options.file);
    models.matched_by_name = match.is_used;
    const MeshMatch* const used = match.is_used ? &match : nullptr;
    models.low = aboutInput(BakeInput::low,
                            [&] { return lowModel(low_scene, options.cage.empty() ? nullptr : &cage_scene, used); });
    models.low.frames_made = frames_made;
    models.low.origin = origin;
    models.high = aboutInput(BakeInput::high, [&] { return highModel(high_scene, used, high, options); });
    if (showsMaterials(options.layers) || shows(options.layers, MapLayer::id))
        models.high_scene = std::move(high_scene);
    if (!options.skew.empty())
        models.skew = aboutInput(BakeInput::skew, [&] { return readFloatImage(options.skew, options.file); });
    models.high.warnings.insert(models.high.warnings.end(), match.warnings.begin(), match.warnings.end());
    const std::string why = misplacement(models.lowBox(), PositionBox(models.high.view().positions));
    if (!why.empty()) models.high.warnings.push_back(why);
    return models;
}

}  // namespace tspace
