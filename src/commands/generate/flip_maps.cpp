// SPDX-License-Identifier: MIT
// Decides which normal maps are inverted, and replaces their images in the textures that use them.
#include "commands/generate/flip_maps.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "commands/check/scene_checks.h"
#include "commands/check/scene_verdict.h"
#include "commands/generate/map_references.h"
#include "images/flip_green.h"
#include "images/image.h"
#include "model/gltf/read_scene.h"
#include "model/io/file_error.h"
#include "model/io/uri.h"
#include "tspace/map_files.h"

namespace tspace {

// Decides which maps are inverted, from the findings of `check` on green channels and tangent signs.

namespace {

/// Returns per image whether it is used with kept tangents whose signs were, or may have been, computed for green
/// pointing down.
std::vector<bool> findCancelled(const Scene& scene, ImageFindings& found, const std::vector<bool>& keeps_tangents,
                                const CheckOptions& check) {
    std::vector<bool> cancelled(scene.images.size());
    if (std::count(found.image_green.begin(), found.image_green.end(), GreenSide::down) == 0) return cancelled;
    if (std::count(keeps_tangents.begin(), keeps_tangents.end(), true) == 0) return cancelled;
    std::vector<PrimitiveJudgement> judgements = judgePrimitives(scene, check);
    applyImageVerdicts(scene, check, found, judgements);
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        if (!keeps_tangents[i] || judgements[i].signs == SignVerdict::plain) continue;
        for (const TangentUse& use : scene.primitives[i].uses) {
            if (use.image) cancelled[*use.image] = true;
        }
    }
    return cancelled;
}

/// Returns why FlipGreen::down leaves a map unchanged; empty: the map is inverted.
std::string whyUnchanged(GreenSide side, bool is_cancelled, bool is_declared, const Convention& convention) {
    if (is_declared) return "the file declares that green points down, so programs that read it already invert green";
    switch (side) {
        case GreenSide::up: return "green points up already";
        case GreenSide::mixed: return "green points down in one part and up in another (see tspace check)";
        case GreenSide::unread: return "the map could not be examined (see tspace check)";
        case GreenSide::down:
            if (convention.green == Green::down) return "green points down, as the requested convention expects";
            if (!is_cancelled) return {};
            return "green points down, but the signs of kept tangents are inverted too, and the two inversions cancel "
                   "out; --overwrite fixes both";
        case GreenSide::noMap:
        case GreenSide::unknown: break;
    }
    return "the direction of green cannot be determined";
}

/// Returns the inverted image. If that is not possible, returns nothing, and `why` is the reason.
Bytes flipSceneImage(const Scene& scene, std::size_t image, std::string& why) {
    const std::vector<std::uint8_t>& bytes = scene.images[image].bytes;
    if (bytes.empty()) {
        why = scene.images[image].why_empty;
        return {};
    }
    Bytes flipped = flipImage(bytes, *scene.memory, why);
    scene.memory->take(flipped.size(), "images");
    return flipped;
}

}  // namespace

Bytes flipImage(std::span<const std::uint8_t> bytes, const MemoryBudget& budget, std::string& why) {
    const std::uint64_t work_bytes = flipWorkBytes(bytes);
    if (!budget.has(work_bytes)) {
        why = "it " + budget.whyNot(work_bytes);
        return {};
    }
    Bytes made;
    const std::optional<Error> failure = tryFile([&] {
        FlipGreenOptions options{.memory_limit_bytes = kNoMemoryLimit};
#ifndef TSPACE_SMALL
        // glTF does not support TGA.
        if (imageFormat(bytes) == ImageFormat::tga) options.format = ImageFileFormat::png;
#endif
        const FlippedImage flipped = valueOrThrow(flipGreen(bytes, options));
        made.assign(flipped.bytes.begin(), flipped.bytes.end());
    });
    if (!failure) return made;
    if (failure->code == ErrorCode::outOfMemory) throw FileError{*failure};
    why = failure->message;
    return {};
}

std::vector<JudgedMap> judgeMaps(const Scene& scene, const std::vector<bool>& keeps_tangents,
                                 const GenerateOptions& options) {
    CheckOptions check;
    check.convention = options.tangents.compute.convention;
    check.execution = options.execution;
    check.execution.allocator = nullptr;
    ImageFindings found = checkImages(scene, check);
    const std::vector<bool> cancelled = findCancelled(scene, found, keeps_tangents, check);
    std::vector<JudgedMap> maps;
    for (std::size_t i = 0; i < scene.images.size(); ++i) {
        if (found.image_green[i] == GreenSide::noMap) continue;
        JudgedMap& map = maps.emplace_back();
        const SceneImage& image = scene.images[i];
        map.image = i;
        map.report = {.image = static_cast<std::uint32_t>(i), .name = image.uri.empty() ? image.name : image.uri};
        std::string& why = map.report.reason;
        map.analysis = found.analyses[i];
        map.is_y_inverted = found.is_y_inverted[i];
        if (options.maps.flip_green == FlipGreen::none) continue;
        if (options.maps.flip_green == FlipGreen::down)
            why = whyUnchanged(found.image_green[i], cancelled[i], found.is_declared[i],
                               options.tangents.compute.convention);
        if (why.empty()) map.flipped = flipSceneImage(scene, i, why);
        map.report.flipped = !map.flipped.empty();
    }
    return maps;
}

Bytes rewriteJudgedMap(const Scene& scene, const GenerateOptions& options, JudgedMap& map) {
    const std::string why_not_flipped = map.report.reason;
    const ByteSpan image = map.flipped.empty() ? ByteSpan(scene.images[map.image].bytes) : ByteSpan(map.flipped);
    Bytes made = rewriteMap(scene, image, options, map);
    if (made.empty() && (map.report.flipped || !why_not_flipped.empty())) map.report.reason = why_not_flipped;
    return made;
}

}  // namespace tspace

namespace tspace::gltf {
namespace {

/// Uses of textures and images. References to images from outside of textures are not examined.
class TextureUses {
  public:
    explicit TextureUses(Document& document) : document_(document) {
        for (const char* list : {"textures", "materials"}) {
            if (!document.json.contains(list) || !document.json[list].is_array()) return;
        }
        uses_.resize(textures().size());
        forTextureReferences(document.json["materials"], [&](const std::string& name, Json& reference) {
            const Json& index = reference["index"];
            if (!index.is_number_unsigned() || index.get<std::size_t>() >= uses_.size()) return;
            Use& use = uses_[index.get<std::size_t>()];
            (isNormalMap(name) ? use.is_normal_map : use.is_other) = true;
        });
        for (std::size_t i = 0; i < uses_.size(); ++i) {
            for (const std::size_t image : sourcesOf(i)) textures_of_[image].push_back(i);
        }
    }

    /// Returns whether the image is also used as something other than a normal map.
    [[nodiscard]] bool isOther(std::size_t image) {
        const std::vector<std::size_t>& all = textures_of_[image];
        return std::any_of(all.begin(), all.end(), [&](std::size_t texture) { return uses_[texture].is_other; });
    }
    /// Returns images that viewers may show instead of this one, in the normal maps that use it.
    [[nodiscard]] std::set<std::size_t> alternatives(std::size_t image) {
        std::set<std::size_t> others;
        for (const std::size_t texture : textures_of_[image]) {
            if (uses_[texture].is_normal_map) others.merge(sourcesOf(texture));
        }
        others.erase(image);
        return others;
    }
    /// Replaces image `from` by image `to` in normal maps; other uses are unchanged. Call applyRedirections at the end.
    void redirect(std::size_t from, std::size_t to) {
        for (const std::size_t shared : textures_of_[from]) {
            if (!uses_[shared].is_normal_map) continue;
            const std::size_t texture = uses_[shared].is_other ? ownTexture(shared) : shared;
            forSources(textures()[texture], [&](Json& source) {
                if (isNumber(source, from)) source = to;
            });
        }
    }
    void applyRedirections() {
        if (own_textures_.empty()) return;
        forTextureReferences(document_.json["materials"], [&](const std::string& name, Json& reference) {
            Json& index = reference["index"];
            if (!isNormalMap(name) || !index.is_number_unsigned()) return;
            const auto own = own_textures_.find(index.get<std::size_t>());
            if (own != own_textures_.end()) index = own->second;
        });
    }

  private:
    struct Use {
        bool is_normal_map = false, is_other = false;
    };
    Json& textures() { return document_.json["textures"]; }
    std::set<std::size_t> sourcesOf(std::size_t texture) {
        std::set<std::size_t> sources;
        forSources(textures()[texture], [&](const Json& source) {
            if (source.is_number_unsigned()) sources.insert(source.get<std::size_t>());
        });
        return sources;
    }
    /// Returns a copy of the texture for normal maps only; all redirected images of a texture share one copy.
    std::size_t ownTexture(std::size_t shared) {
        const auto [own, is_new] = own_textures_.try_emplace(shared, textures().size());
        if (is_new) {
            Json copy = textures()[shared];
            textures().push_back(std::move(copy));
        }
        return own->second;
    }

    Document& document_;
    std::vector<Use> uses_ = {};  ///< uses of each texture; indexed by texture
    /// Indices of the textures that use an image; key: image.
    std::map<std::size_t, std::vector<std::size_t>> textures_of_ = {};
    std::map<std::size_t, std::size_t> own_textures_ = {};  ///< shared texture -> its copy for normal maps
};

/// Images that may be shown instead of one another, such as a PNG and a WebP of one texture, are inverted together. If
/// one of them cannot or must not be inverted, none is, because viewers choose among them.
class Alternatives {
  public:
    Alternatives(Document& document, MapFlips& flips) : document_(document), uses_(document), flips_(flips) {
        for (NormalMapReport& report : flips.reports) judged_[report.image] = &report;
    }

    void decide() {
        for (const NormalMapReport& report : flips_.reports) {
            if (report.flipped && !report.mended && !is_settled_.contains(report.image)) settle(together(report.image));
        }
    }

  private:
    /// Returns the image and all images that are directly or indirectly its alternatives.
    std::vector<std::size_t> together(std::size_t image) {
        std::vector<std::size_t> images{image};
        is_settled_.insert(image);
        for (std::size_t i = 0; i < images.size(); ++i) {
            for (const std::size_t other : uses_.alternatives(images[i])) {
                if (is_settled_.insert(other).second) images.push_back(other);
            }
        }
        return images;
    }

    void settle(const std::vector<std::size_t>& images) {
        std::string why;
        for (const std::size_t image : images) {
            if (why.empty()) why = whyUnchanged(image);
        }
        if (why.empty()) return;
        for (const std::size_t image : images) {
            flips_.images.erase(image);
            const auto judged = judged_.find(image);
            if (judged == judged_.end() || !judged->second->flipped) continue;
            judged->second->flipped = false;
            judged->second->reason = why;
        }
    }

    /// Returns why the image is not inverted; empty if it is. Inverts the image first if it was not judged yet.
    std::string whyUnchanged(std::size_t image) {
        const std::string start =
            "image " + std::to_string(image) + ", which stores the same map in another format and must match, ";
        const auto judged = judged_.find(image);
        if (judged != judged_.end()) return judged->second->flipped ? "" : start + "was not inverted";
        std::string why = "it cannot be read";
        Bytes bytes;
        if (image < rootArray(document_, "images").size()) bytes = tryReadImage(document_, image);
        if (!bytes.empty()) bytes = flipImage(bytes, *document_.memory, why);
        if (bytes.empty()) return start + "cannot be inverted: " + why;
        document_.memory->take(bytes.size(), join("/images", image));
        flips_.images[image] = std::move(bytes);
        return {};
    }

    Document& document_;
    TextureUses uses_;
    MapFlips& flips_;
    std::map<std::size_t, NormalMapReport*> judged_ = {};  ///< reports of the judged images; key: image
    std::set<std::size_t> is_settled_ = {};
};

/// Rewrites the map as glTF expects it, inverted if requested, unless it also exists in another format.
void rewriteInPlace(Document& document, const Scene& scene, const GenerateOptions& options, JudgedMap& map,
                    MapFlips& flips) {
    if (!TextureUses(document).alternatives(map.image).empty()) {
        if (!map.report.flipped)
            map.report.reason =
                "the texture also has an image in another format (such as WebP or KTX2), which would no longer match";
        return;
    }
    Bytes mended = rewriteJudgedMap(scene, options, map);
    if (!mended.empty()) flips.mended[map.image] = std::move(mended);
}

}  // namespace

MapFlips planFlips(Model& model, std::span<const PrimitiveReport> reports, const GenerateOptions& options) {
    Document& document = model.document();
    MapFlips flips;
    std::vector<bool> keeps_tangents;
    for (const PrimitiveReport& report : reports) {
        keeps_tangents.push_back(report.action == PrimitiveAction::kept ||
                                 options.selection.existing != ExistingTangents::replace);
    }
    Scene scene = model.scene();
    const std::int64_t left = document.memory->left();
    readImages(document, scene);
    setPlaces(document, model.primitives(), scene);
    std::vector<JudgedMap> maps = judgeMaps(scene, keeps_tangents, options);
    for (JudgedMap& map : maps) {
        if (options.maps.mend) rewriteInPlace(document, scene, options, map, flips);
        if (map.report.flipped && !map.report.mended) flips.images[map.image] = std::move(map.flipped);
        flips.reports.push_back(std::move(map.report));
    }
    document.memory->restore(left);
    for (const auto& [image, bytes] : flips.images) document.memory->take(bytes.size(), join("/images", image));
    for (const auto& [image, bytes] : flips.mended) document.memory->take(bytes.size(), join("/images", image));
    Alternatives(document, flips).decide();
    for (const auto& [image, bytes] : flips.images) noteInputFile(document, image);
    for (const auto& [image, bytes] : flips.mended) noteInputFile(document, image);
    return flips;
}

void applyFlips(Document& document, Editor& editor, const OutputTarget& target, MapFlips&& flips) {
    TextureUses uses(document);
    std::vector<std::size_t> new_images;
    const auto placeAll = [&](std::map<std::size_t, Bytes>& made, const char* ending) {
        ImagePlacer placer(document, editor, target, ending);
        for (auto& [image, bytes] : made) {
            if (!uses.isOther(image)) {
                placer.place(image, std::move(bytes), false);
                new_images.push_back(image);
                continue;
            }
            Json& images = document.json["images"];
            Json copy = images[image];
            images.push_back(std::move(copy));
            const std::size_t own = images.size() - 1;
            placer.place(own, std::move(bytes), true);
            uses.redirect(image, own);
            new_images.push_back(own);
        }
    };
    placeAll(flips.images, "-green-up");
    new_images.clear();
    placeAll(flips.mended, "-mended");
    uses.applyRedirections();
    // Rewritten images are always PNG.
    MapReferences references(document, {});
    for (const std::size_t image : new_images) references.makeOnlySource(image);
}

}  // namespace tspace::gltf
