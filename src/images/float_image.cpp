// SPDX-License-Identifier: MIT
#include "images/float_image.h"
#include "images/image.h"

#include "images/codecs.h"

namespace tspace {
namespace {

FloatImage floatsOf(const RgbImage& image) {
    FloatImage out{image.width, image.height, 8, std::vector<Vec3>(std::size_t{image.width} * image.height), {}};
    const std::uint8_t* at = image.rgb.data();
    for (Vec3& texel : out.texels) {
        texel = {static_cast<float>(at[0]) / 255.0f, static_cast<float>(at[1]) / 255.0f,
                 static_cast<float>(at[2]) / 255.0f};
        at += 3;
    }
    return out;
}

}  // namespace

std::optional<FloatImage> decodeFloatImage(ByteSpan bytes, std::uint64_t most_pixels, std::string& why, ImageUse use) {
    const ImageFormat format = imageFormat(bytes);
#ifdef TSPACE_HAS_IMAGES
    if (format == ImageFormat::png) return decodeDeepPng(bytes, most_pixels, why);
#endif
#ifdef TSPACE_HAS_OPENEXR
    if (format == ImageFormat::exr && whyNotRead(format) == nullptr) return decodeExr(bytes, most_pixels, why, use);
#endif
    if (format == ImageFormat::ktx2 || format == ImageFormat::dds)
        return decodeFloatTexture(bytes, most_pixels, why, 0, use);
    if (format == ImageFormat::tga) {
        const std::optional<TgaImage> tga = decodeTgaPixels(bytes, most_pixels, why);
        if (!tga) return {};
        FloatImage out = floatsOf(tga->image);
        for (const std::uint8_t alpha : tga->alpha) out.alpha.push_back(static_cast<float>(alpha) / 255.0f);
        return out;
    }
    const std::optional<RgbImage> image = decodeImage(bytes, most_pixels, why);
    if (!image) return {};
    return floatsOf(*image);
}

#ifndef TSPACE_HAS_OPENEXR
std::optional<std::vector<std::uint8_t>> encodeExr(const FloatImage&, unsigned) { return {}; }
#endif

#ifndef TSPACE_HAS_IMAGES
std::optional<std::vector<std::uint8_t>> encodePng(const FloatImage&, unsigned) { return {}; }
std::optional<std::vector<std::uint8_t>> encodePng(const RgbImage&) { return {}; }
#endif

}  // namespace tspace
