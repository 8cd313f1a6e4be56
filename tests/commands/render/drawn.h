// SPDX-License-Identifier: MIT
// Pictures of small models, without files.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "images/image.h"
#include "images/images.h"
#include "model/gltf_builder.h"
#include "tspace/render.h"

namespace tspace::test {

using Pixel = std::array<int, 3>;

struct Drawn {
    RgbImage image = {};
    RenderReport report = {};

    [[nodiscard]] Pixel at(std::uint32_t x, std::uint32_t y) const {
        const std::size_t i = 3 * (std::size_t{y} * image.width + x);
        return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
    }
    [[nodiscard]] Pixel center() const { return at(image.width / 2, image.height / 2); }
};

/// Renders a PNG into `png`, through a sink as renderFile uses it.
inline Result<RenderReport> renderTo(std::vector<std::uint8_t>& png, std::span<const std::uint8_t> model,
                                     RenderOptions options) {
    options.file.content = model;
    options.sink = [&](std::span<const std::uint8_t> part) {
        png.insert(png.end(), part.begin(), part.end());
        return true;
    };
    return renderFile("model.glb", "picture.png", options);
}

/// Returns options with one sample in the center of each pixel, from the front, without perspective and without a
/// legend.
inline RenderOptions plainView(RenderShow show, std::uint32_t size = 64) {
    RenderOptions options;
    options.show = show;
    options.width = options.height = size;
    options.samples = 1;
    options.legend = false;
    options.yaw_deg = options.pitch_deg = options.field_of_view_deg = 0;
    return options;
}

inline Drawn draw(const GltfBuilder& model, const RenderOptions& options) {
    Drawn drawn;
    std::vector<std::uint8_t> png;
    const Bytes file = model.glb();
    const Result<RenderReport> report = renderTo(png, file, options);
    EXPECT_TRUE(report.ok()) << (report ? "" : report.error().message);
    std::string why;
    const auto image = decodeImage(png, 1 << 26, why);
    EXPECT_TRUE(image.has_value()) << why;
    if (report && image) drawn = {*image, *report};
    return drawn;
}

/// The square from (-1, -1, 0) to (1, 1, 0). It faces +z, and has correct tangents for glTF and one material. Its upper
/// left corner is at the upper left corner of the texture.
struct SquareModel {
    std::vector<float> positions = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    std::vector<float> normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    std::vector<float> tangents = {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1};
    std::vector<float> uvs = {0, 1, 1, 1, 1, 0, 0, 0};
    std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3};

    [[nodiscard]] GltfBuilder build() const {
        GltfBuilder builder;
        const std::size_t list = builder.addAccessor(indices, 5125, "SCALAR", indices.size());
        Json attributes = {{"POSITION", builder.addFloats(positions, 3)}};
        if (!normals.empty()) attributes["NORMAL"] = builder.addFloats(normals, 3);
        if (!tangents.empty()) attributes["TANGENT"] = builder.addFloats(tangents, 4);
        if (!uvs.empty()) attributes["TEXCOORD_0"] = builder.addFloats(uvs, 2);
        Json& primitive = builder.addPrimitive(attributes);
        primitive["indices"] = list;
        primitive["material"] = 0;
        builder.json()["materials"] = Json::parse("[{}]");
        return builder;
    }
};

/// Adds a texture with this image, and returns its index.
inline std::size_t addTexture(GltfBuilder& builder, const RgbImage& image) {
    Json& json = builder.json();
    for (const char* name : {"images", "textures"}) {
        if (!json.contains(name)) json[name] = Json::array();
    }
    const std::size_t number = json["images"].size();
    const std::size_t view = builder.addView(toBytes(pngFile(image)));
    json["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
    json["textures"].push_back({{"source", number}});
    return number;
}
inline RgbImage plainImage(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    RgbImage image{.width = 2, .height = 2};
    for (int i = 0; i < 4; ++i) image.rgb.insert(image.rgb.end(), {r, g, b});
    return image;
}

}  // namespace tspace::test
