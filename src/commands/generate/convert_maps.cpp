// SPDX-License-Identifier: MIT
#include "commands/generate/generate_steps.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "commands/generate/map_references.h"
#include "commands/shared/image_budget.h"
#include "commands/shared/map_image_file.h"
#include "images/texture_vectors.h"
#include "maps/convert/convert_texel.h"
#include "maps/layout/uv_coverage.h"
#include "model/gltf/material_needs.h"
#include "model/gltf/read_scene.h"

namespace tspace::gltf {
namespace {

/// A primitive that uses the map, and the frames of its corners.
struct ShownMap {
    MapUser user = {};
    OwnedMesh from = {}, to = {};  ///< one vertex per corner
    TexelMask texels = {};
    bool is_new = false;       ///< the tangents of the primitive were computed
    bool is_intended = false;  ///< the primitive got normals that change the shading on purpose

    [[nodiscard]] bool readsLike(const ShownMap& other) const {
        const TangentUse &own = *user.use, &others = *other.user.use;
        return own.wrap_u == others.wrap_u && own.wrap_v == others.wrap_v && own.scale == others.scale;
    }
    [[nodiscard]] bool isLike(const ShownMap& other) const {
        return from.uvs == other.from.uvs && from.normals == other.from.normals &&
               from.tangents == other.from.tangents && to.normals == other.to.normals &&
               to.tangents == other.to.tangents;
    }
    /// Returns whether both primitives can share one converted map.
    [[nodiscard]] bool fits(const ShownMap& other) const {
        return readsLike(other) && (!texels.meets(other.texels) || isLike(other));
    }
};

using MapGroup = std::vector<const ShownMap*>;

/// Groups primitives that can share one converted map because they use disjoint texels or have equal frames. Each
/// primitive joins the first group that fits.
std::vector<MapGroup> groupsOf(std::span<const ShownMap> shown) {
    std::vector<MapGroup> groups;
    for (const ShownMap& one : shown) {
        const auto takes = [&](const MapGroup& group) {
            return std::all_of(group.begin(), group.end(), [&](const ShownMap* other) { return one.fits(*other); });
        };
        const auto found = std::find_if(groups.begin(), groups.end(), takes);
        if (found != groups.end()) {
            found->push_back(&one);
        } else {
            groups.push_back({&one});
        }
    }
    return groups;
}

/// Joins the meshes of a group, without duplicate triangles.
OwnedMesh joinedSide(const MapGroup& group, OwnedMesh ShownMap::*side) {
    OwnedMesh mesh;
    for (auto one = group.begin(); one != group.end(); ++one) {
        if (std::any_of(group.begin(), one, [&](const ShownMap* other) { return (*one)->isLike(*other); })) continue;
        const OwnedMesh& part = (*one)->*side;
        mesh.addVertices(part, 0, part.positions.size());
    }
    return mesh;
}

std::string degreesText(double degrees) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, degrees, std::chars_format::general, 2);
    return std::string(text, end.ptr) + " degrees";
}

/// A converted map for a group of primitives, if it improves the shading.
struct NewMap {
    ConvertedMapReport report = {};
    Bytes file = {};
};

void addConversionNotes(const ConvertMapReport& texels, ConvertedMapReport& report) {
    const std::string bits = std::to_string(report.bits) + " bits";
    if (texels.is_below_half_step) {
        report.notes.push_back("The mean change is " + degreesText(texels.mean_change_deg) +
                               ", less than half a quantization step of " + bits + " (" +
                               degreesText(texels.half_step_deg) +
                               "), so the map need not be converted; the converted map has an error of " +
                               degreesText(report.mean_error_deg) + ".");
    }
    if (texels.overlapping > 0) {
        report.notes.push_back(std::to_string(texels.overlapping) +
                               " texels are shared by several triangles of a primitive; the first triangle was used.");
    }
    if (texels.without_frame > 0) {
        report.notes.push_back(std::to_string(texels.without_frame) +
                               " texels were not changed, because their old or new frames are invalid.");
    }
}

NewMap convertFor(const MapGroup& group, const FloatImage& image, const GenerateOptions& options) {
    NewMap made;
    ConvertedMapReport& report = made.report;
    report.primitive_count = static_cast<std::uint32_t>(group.size());
    for (const ShownMap* one : group) {
        const auto material = static_cast<std::uint32_t>(one->user.use->material);
        if (std::find(report.materials.begin(), report.materials.end(), material) == report.materials.end())
            report.materials.push_back(material);
    }
    const TangentUse& use = *group.front()->user.use;
    const double scale = use.scale;
    if (static_cast<float>(scale) == 0) {
        report.reason = "its scale is 0, so it has no visible effect";
        return made;
    }
    const OwnedMesh from = joinedSide(group, &ShownMap::from), to = joinedSide(group, &ShownMap::to);
    const MapImage map{image.width, image.height, image.texels, use.wrap_u, use.wrap_v};
    FloatImage converted{image.width, image.height, image.bits, std::vector<Vec3>(image.texels.size()), image.alpha};
    const MapSide from_side = tangentSide(from, scale), to_side = tangentSide(to, scale);
    const ConvertMapReport texels =
        valueOrThrow(convertMap(map, from_side, to_side, {.bits = image.bits}, converted.texels, options.execution));
    report.changed = texels.changed;
    if (texels.changed == 0) {
        const bool is_intended =
            std::any_of(group.begin(), group.end(), [](const ShownMap* one) { return one->is_intended; });
        report.reason = is_intended ? "only the new normals change the shading, which is intended"
                                    : "the map gives the same shading with the new tangents";
        return made;
    }
    Parallel parallel(options.execution);
    const CarriedError error = measureCarried(map, converted.texels, from_side, to_side, parallel);
    report.mean_error_deg = error.mean_deg;
    report.mean_error_unconverted_deg = error.mean_unconverted_deg;
    if (!(error.mean_deg < error.mean_unconverted_deg)) {
        const char* why = texels.overlapping > 0 ? "several triangles that need different maps share its texels"
                                                 : "rounding would cancel the change";
        report.reason = std::string(why) + ": the mean error would be " + degreesText(error.mean_deg) +
                        " if the map were converted, and is " + degreesText(error.mean_unconverted_deg) +
                        " if it is kept";
        return made;
    }
    const auto file = encodePng(converted, image.bits);
    if (!file) {
        report.reason = "the new map could not be encoded as PNG";
        return made;
    }
    report.bits = image.bits;
    report.converted = true;
    made.file.assign(file->begin(), file->end());
    addConversionNotes(texels, report);
    return made;
}

/// All primitives that use one image, and the conversion of that image for them.
class OneMap {
  public:
    OneMap(const Bytes& file, const GenerateOptions& options) : file_(file), options_(options) {}

    void add(const MapUser& user, const ScenePrimitive& before, const ScenePrimitive& after,
             const PrimitiveReport& report) {
        ShownMap& one = shown_.emplace_back();
        one.user = user;
        one.is_new = report.action == PrimitiveAction::generated || report.action == PrimitiveAction::replaced;
        one.is_intended = report.normals_generated && options_.normals.compute.weighting != NormalWeighting::flat;
        sources_.push_back({&before, &after});
    }
    [[nodiscard]] bool isNeeded() const {
        return std::any_of(shown_.begin(), shown_.end(), [](const ShownMap& one) { return one.is_new; });
    }

    /// Returns the groups that need a new map, each with its map. If there is none, `why` is the reason
    /// (a clause).
    std::vector<std::pair<MapGroup, NewMap>> convert(std::string& why) {
        std::string how_read;
        const std::optional<FloatImage> image = decode(why, how_read);
        if (!image) return {};
        for (std::size_t i = 0; i < shown_.size(); ++i) prepare(shown_[i], sources_[i], *image);
        std::vector<std::pair<MapGroup, NewMap>> made;
        for (MapGroup& group : groupsOf(shown_)) {
            const bool is_needed =
                std::any_of(group.begin(), group.end(), [](const ShownMap* one) { return one->is_new; });
            if (!is_needed) continue;
            NewMap map = convertFor(group, *image, options_);
            if (!how_read.empty()) map.report.notes.push_back("Reading the old map: " + how_read + ".");
            made.emplace_back(std::move(group), std::move(map));
        }
        return made;
    }
    /// Frees the memory of the frames.
    void release() { shown_ = {}; }
    [[nodiscard]] std::size_t userCount() const { return shown_.size(); }

  private:
    struct Source {
        const ScenePrimitive* before;
        const ScenePrimitive* after;
    };

    [[nodiscard]] std::optional<FloatImage> decode(std::string& why, std::string& how_read) const {
        why = "it cannot be read";
        if (file_.empty()) return {};
        if (const char* why_not = whyNotRead(imageFormat(file_))) {
            why = why_not;
            return {};
        }
        const std::shared_ptr<MemoryBudget> budget = imageBudget(file_, options_.file);
        if (const std::uint64_t bytes = imageNeed(file_); !budget->has(bytes)) {
            why = "it " + budget->whyNot(bytes);
            return {};
        }
        std::optional<FloatImage> image = decodeFloatImage(file_, kMaxModelMapPixels, why);
        if (!image) return {};
        how_read = readTextureVectors(*image);
        image->bits = std::min(image->bits, kMaxPngBits);
        return image;
    }

    void prepare(ShownMap& one, const Source& source, const FloatImage& image) const {
        // Viewers compute these tangents for a file without tangents.
        const TangentOptions viewers{.convention = conventions::gltf};
        const TangentUse& use = *one.user.use;
        addMapCorners(*source.before, &use, viewers, options_.execution, one.from);
        addMapCorners(*source.after, &use, viewers, options_.execution, one.to);
        if (one.is_intended || one.from.uvs != one.to.uvs) one.from = one.to;
        one.texels = TexelMask(image.width, image.height);
        std::uint64_t steps = kCoverSteps;
        coverTexels(uvTriangles(one.from.uvs, use), one.texels, steps);
    }

    const Bytes& file_;
    const GenerateOptions& options_;
    std::vector<ShownMap> shown_ = {};
    std::vector<Source> sources_ = {};
};

bool showsImage(const TangentUse& use) { return use.image && showsNormals(use); }

/// Returns whether the primitive has corners and the UV set of this texture.
bool hasMapUvs(const ScenePrimitive& primitive, const TangentUse& use) {
    return !primitive.corners.empty() && use.uv_set < primitive.uv_sets.size() &&
           !primitive.uv_sets[use.uv_set].empty();
}

/// Inserts the converted maps of one image into the document, and completes their reports.
class MapPlacer {
  public:
    MapPlacer(Document& document, std::span<const Primitive> primitives, ImagePlacer& placer)
        : references_(document, primitives), placer_(placer) {}

    void place(std::size_t image, const MapGroup& group, NewMap& map) {
        ConvertedMapReport& report = map.report;
        if (!report.converted) return;
        std::vector<MapUser> users;
        for (const ShownMap* one : group) users.push_back(one->user);
        if (references_.isUsedOnlyBy(image, users)) {
            report.new_image = static_cast<std::uint32_t>(image);
            placer_.placeOwn(image, std::move(map.file));
            references_.makeOnlySource(image);
            return;
        }
        report.reason = references_.whyNotSeparate(users);
        report.converted = report.reason.empty();
        if (!report.converted) return;
        report.new_image = static_cast<std::uint32_t>(placer_.add(image, std::move(map.file)));
        references_.redirect(users, report.new_image);
    }

  private:
    MapReferences references_;
    ImagePlacer& placer_;
};

}  // namespace

MapConversion::MapConversion(Model& model, const GenerateOptions& options) : model_(model), options_(options) {
    Document& document = model.document();
    const std::span<const Primitive> primitives = model.primitives();
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const std::vector<TangentUse> uses = tangentUses(document, primitives[i]);
        if (!hasTriangles(primitives[i].mode) || std::none_of(uses.begin(), uses.end(), showsImage)) continue;
        numbers_.push_back(i);
    }
    before_ = model.sceneOf(numbers_);
    for (const ScenePrimitive& primitive : before_.primitives) {
        for (const TangentUse& use : primitive.uses) {
            if (!showsImage(use) || images_.contains(*use.image)) continue;
            Bytes bytes = tryReadImage(document, *use.image);
            document.memory->take(bytes.size(), join("/images", *use.image));
            if (!bytes.empty()) noteInputFile(document, *use.image);
            images_[*use.image] = std::move(bytes);
        }
    }
}

std::vector<ConvertedMapReport> MapConversion::run(Editor& editor, const OutputTarget& target,
                                                   std::span<const PrimitiveReport> reports) {
    Document& document = model_.document();
    const std::span<const Primitive> primitives = model_.primitives();
    const Scene after = model_.sceneOf(numbers_);
    std::map<std::size_t, OneMap> maps;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        const ScenePrimitive& before = before_.primitives[i];
        for (const TangentUse& use : before.uses) {
            if (!showsImage(use) || !hasMapUvs(before, use) || !hasMapUvs(after.primitives[i], use)) continue;
            const auto map = maps.try_emplace(*use.image, images_[*use.image], options_).first;
            map->second.add({&primitives[numbers_[i]], &use}, before, after.primitives[i], reports[numbers_[i]]);
        }
    }
    ImagePlacer placer(document, editor, target, "-converted");
    MapPlacer places(document, primitives, placer);
    std::vector<ConvertedMapReport> told;
    for (auto& [image, map] : maps) {
        if (!map.isNeeded()) continue;
        const std::string name =
            before_.images[image].name.empty() ? before_.images[image].uri : before_.images[image].name;
        std::string why;
        std::vector<std::pair<MapGroup, NewMap>> made = map.convert(why);
        if (made.empty()) made.push_back({{}, {.report = {.reason = why}}});
        for (auto& [group, one] : made) {
            places.place(image, group, one);
            one.report.image = static_cast<std::uint32_t>(image);
            one.report.name = name;
            if (group.empty()) one.report.primitive_count = static_cast<std::uint32_t>(map.userCount());
            told.push_back(std::move(one.report));
        }
        map.release();
    }
    return told;
}

}  // namespace tspace::gltf
