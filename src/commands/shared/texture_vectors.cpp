// SPDX-License-Identifier: MIT
#include "commands/shared/texture_vectors.h"

#include <utility>

namespace tspace {

namespace {

/// Puts x, y and z where glTF has them. Gives half a sentence that says so.
std::string applyLayout(FloatImage& image) {
    const MapLayout layout = image.texture.layout;
    if (layout == MapLayout{}) return {};
    const auto readsAlpha = [](const MapComponent& component) { return component.channel == MapChannel::alpha; };
    for (std::size_t i = 0; i < image.texels.size(); ++i)
        image.texels[i] = readTexel(image.texels[i], image.alpha.empty() ? 1 : image.alpha[i], layout);
    if (readsAlpha(layout.x) || readsAlpha(layout.y)) image.alpha.clear();
    image.texture.layout = {};
    constexpr const char* kNames[] = {"red", "green", "blue", "alpha", ""};
    const auto nameOf = [&](const MapComponent& component) {
        return kNames[static_cast<std::size_t>(component.channel)];
    };
    const std::string where = std::string("x is read from ") + nameOf(layout.x) + " and y from " + nameOf(layout.y) +
                              (layout.z.channel == MapChannel::none ? ", and z is reconstructed from them" : "");
    return "the map is " + image.texture.name +
           (image.texture.is_guessed ? ", whose texels look as if only x and y were stored: " : ": ") + where;
}

}  // namespace

std::string readTextureVectors(FloatImage& image) {
    std::string text = applyLayout(image);
    if (!image.range_text.empty()) text += (text.empty() ? "" : "; ") + std::exchange(image.range_text, {});
    return text;
}

}  // namespace tspace
