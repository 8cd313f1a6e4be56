// SPDX-License-Identifier: MIT
#include "commands/bake/high_maps.h"

#include "commands/check/normal_map.h"
#include "commands/shared/map_image_file.h"
#include "images/texture_vectors.h"
#include "model/io/file_error.h"

namespace tspace {
namespace {

/// Returns the direction of the green channel, determined from the slopes of the map.
GreenVerdict greenOf(const FloatImage& image) {
    TexelMask all(image.width, image.height);
    all.fillAll();
    return GreenBlocks(roundedImage(image), all).all().verdict;
}

}  // namespace

std::string HighMapReading::nameOf(std::size_t image) const {
    const SceneImage& of = scene_.images[image];
    if (!of.uri.empty() && of.uri.rfind("data:", 0) != 0) return of.uri;
    return of.name.empty() ? "image " + std::to_string(image) : of.name;
}

const HighMapReading::Image& HighMapReading::imageOf(std::size_t number) {
    const auto [known, is_new] = images_.try_emplace(number);
    Image& image = known->second;
    if (!is_new) return image;
    const auto warnSkipped = [&](const std::string& why) {
        made_.warnings.push_back("the high poly's normal map " + inQuotes(nameOf(number)) +
                                 " was not included: " + why);
    };
    const std::vector<std::uint8_t>& bytes = scene_.images[number].bytes;
    if (bytes.empty()) {
        warnSkipped(scene_.images[number].why_empty);
        return image;
    }
    FloatImage read;
    const std::optional<Error> failure = tryFile([&] { read = readMapImage({}, bytes, options_.file); });
    if (failure && (failure->code == ErrorCode::tooLarge || failure->code == ErrorCode::outOfMemory))
        throw FileError{*failure};
    if (failure) {
        warnSkipped(failure->message);
        return image;
    }
    const std::string how_read = readTextureVectors(read);
    if (!how_read.empty())
        made_.warnings.push_back("the high poly's normal map " + inQuotes(nameOf(number)) + ": " + how_read);
    image.is_gray = isGrayImage(read);
    const GreenVerdict verdict = greenOf(read);
    image.shows_green = verdict == GreenVerdict::up || verdict == GreenVerdict::down;
    image.green = verdict == GreenVerdict::down ? Green::down : Green::up;
    image.number = made_.images.size();
    made_.images.push_back(std::move(read));
    return image;
}

const TangentUse* HighMapReading::find(const ScenePrimitive& primitive) {
    if (options_.ignore_high_maps || primitive.is_unlit || primitive.corners.empty()) return nullptr;
    for (const TangentUse& use : primitive.uses) {
        if (use.needed_by != "normalTexture" || use.only_in_variant || !use.image) continue;
        if (use.uv_set >= primitive.uv_sets.size() || primitive.uv_sets[use.uv_set].empty()) continue;
        const bool was_known = images_.count(*use.image) > 0;
        const Image& image = imageOf(*use.image);
        if (!image.number) return nullptr;
        if (!image.is_gray) return &use;
        if (!was_known)
            made_.warnings.push_back(
                "the high poly's map " + inQuotes(nameOf(*use.image)) +
                " is gray, like a height map, and was not used; convert it with tspace height-to-normal");
        return nullptr;
    }
    return nullptr;
}

std::uint32_t HighMapReading::numberOf(const ScenePrimitive& primitive, const TangentUse& use,
                                       std::size_t triangle_count) {
    const Image& image = imageOf(*use.image);
    const Key key{*use.image, use.scale, use.is_declared_down, use.wrap_u, use.wrap_v};
    const auto [known, is_new] = numbers_.try_emplace(key, static_cast<std::uint32_t>(made_.maps.size()));
    if (is_new) {
        BakedHighMap report{.image = nameOf(*use.image), .material = primitive.material_name, .scale = use.scale};
        if (options_.high_green) {
            report.green = *options_.high_green;
            report.green_is = GreenSource::told;
        } else if (use.is_declared_down) {
            report.green = Green::down;
            report.green_is = GreenSource::declared;
        } else if (image.shows_green) {
            report.green = image.green;
            report.green_is = GreenSource::seen;
        }
        if (report.green_is == GreenSource::seen && report.green == Green::down)
            made_.warnings.push_back("green of the high poly's normal map " + inQuotes(report.image) +
                                     " points down according to its slopes, so it was inverted; use --high-green up to "
                                     "read it as glTF specifies");
        const FloatImage& pixels = made_.images[*image.number];
        made_.maps.push_back({.image = {pixels.width, pixels.height, pixels.texels, use.wrap_u, use.wrap_v},
                              .reading = {.green = report.green, .scale = static_cast<float>(use.scale)}});
        made_.reports.push_back(std::move(report));
    }
    made_.reports[known->second].triangle_count += triangle_count;
    return known->second;
}

}  // namespace tspace
