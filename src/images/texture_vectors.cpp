// SPDX-License-Identifier: MIT
#include "images/texture_vectors.h"

#include <string_view>
#include <utility>

namespace tspace {

std::string takeChannels(const std::string& letters, MapLayout& layout) {
    constexpr const char* kWrong =
        "must be two or three of r, g, b and a (or x, y, z and w), such as rg, ag or bgr; a capital letter inverts a "
        "channel";
    constexpr std::string_view kLetters = "rgbaRGBAxyzwXYZW";
    if (letters.size() != 2 && letters.size() != 3) return kWrong;
    MapComponent* const components[] = {&layout.x, &layout.y, &layout.z};
    layout.z = {MapChannel::none, false};
    for (std::size_t i = 0; i < letters.size(); ++i) {
        const std::size_t at = kLetters.find(letters[i]);
        if (at == std::string_view::npos || letters.find(letters[i], i + 1) != std::string::npos) return kWrong;
        *components[i] = {static_cast<MapChannel>(at % 4), at % 8 >= 4};
    }
    return {};
}

const char* channelName(MapChannel channel) {
    constexpr const char* kNames[] = {"red", "green", "blue", "alpha", "no channel"};
    return kNames[static_cast<std::size_t>(channel)];
}

bool readsAlpha(const MapLayout& layout) {
    return layout.x.channel == MapChannel::alpha || layout.y.channel == MapChannel::alpha ||
           layout.z.channel == MapChannel::alpha;
}

void readTexels(const MapLayout& layout, FloatImage& image) {
    for (std::size_t i = 0; i < image.texels.size(); ++i)
        image.texels[i] = readTexel(image.texels[i], image.alpha.empty() ? 1 : image.alpha[i], layout);
    if (readsAlpha(layout)) image.alpha.clear();
}

namespace {

/// Moves x, y and z to the channels that glTF uses. Returns part of a sentence that describes the change.
std::string applyLayout(FloatImage& image) {
    const MapLayout layout = image.texture.layout;
    if (layout == MapLayout{}) return {};
    readTexels(layout, image);
    image.texture.layout = {};
    const std::string where = std::string("x is read from ") + channelName(layout.x.channel) + " and y from " +
                              channelName(layout.y.channel) +
                              (layout.z.channel == MapChannel::none ? ", so z is reconstructed from them" : "");
    return "the map is " + image.texture.name +
           (image.texture.is_guessed ? ", whose texels look as if only x and y were stored: " : ": ") + where;
}

void addClause(const std::string& clause, std::string& text) {
    if (!clause.empty()) text += (text.empty() ? "" : "; ") + clause;
}

}  // namespace

std::string notFiniteText(std::uint64_t count) {
    if (count == 0) return {};
    return std::to_string(count) + (count == 1 ? " texel of the image is" : " texels of the image are") +
           " NaN or infinite; " + (count == 1 ? "it was" : "they were") + " filled from the nearest finite texels";
}

std::string takeRemarks(FloatImage& image) {
    std::string text = std::exchange(image.range_text, {});
    addClause(notFiniteText(std::exchange(image.not_finite, 0)), text);
    addClause(std::exchange(image.layer_text, {}), text);
    return text;
}

std::string readTextureVectors(FloatImage& image) {
    std::string text = applyLayout(image);
    addClause(takeRemarks(image), text);
    return text;
}

}  // namespace tspace
