// SPDX-License-Identifier: MIT
// Encodes TGA according to the "Truevision TGA File Format Specification", version 2.0 (1991): a header of 18 bytes,
// blue, green and red of each pixel, and a footer that identifies the version.
#include "images/tga.h"

#include <cmath>
#include <string_view>

namespace tspace {
namespace {

std::optional<std::vector<std::uint8_t>> headOf(std::uint32_t width, std::uint32_t height, bool has_alpha) {
    constexpr std::uint32_t kMaxSide = 65535;
    if (width > kMaxSide || height > kMaxSide) return {};
    constexpr std::uint8_t kTrueColor = 2, kFromTheTop = 0x20, kAlphaBits = 8;
    std::vector<std::uint8_t> file(18);
    file.reserve(file.size() + std::size_t{has_alpha ? 4U : 3U} * width * height + 26);
    file[2] = kTrueColor;
    file[12] = static_cast<std::uint8_t>(width & 0xff);
    file[13] = static_cast<std::uint8_t>(width >> 8);
    file[14] = static_cast<std::uint8_t>(height & 0xff);
    file[15] = static_cast<std::uint8_t>(height >> 8);
    file[16] = has_alpha ? 32 : 24;
    file[17] = has_alpha ? kFromTheTop | kAlphaBits : kFromTheTop;
    return file;
}

/// Appends the footer, which declares that there are no developer and extension areas.
void addFooter(std::vector<std::uint8_t>& file) {
    constexpr std::string_view kSignature = "TRUEVISION-XFILE.";
    file.insert(file.end(), 8, 0);
    file.insert(file.end(), kSignature.begin(), kSignature.end());
    file.push_back(0);
}

}  // namespace

std::optional<std::vector<std::uint8_t>> encodeTga(const FloatImage& image) {
    const bool has_alpha = !image.alpha.empty();
    std::optional<std::vector<std::uint8_t>> file = headOf(image.width, image.height, has_alpha);
    if (!file) return {};
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        const Vec3& texel = image.texels[i];
        for (const float channel : {texel.z, texel.y, texel.x})
            file->push_back(std::isfinite(channel) ? roundedChannel(channel) : 0);
        if (has_alpha) file->push_back(roundedChannel(image.alpha[i]));
    }
    addFooter(*file);
    return file;
}

std::optional<std::vector<std::uint8_t>> encodeTga(const RgbImage& image) {
    std::optional<std::vector<std::uint8_t>> file = headOf(image.width, image.height, false);
    if (!file) return {};
    for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3)
        file->insert(file->end(), {image.rgb[i + 2], image.rgb[i + 1], image.rgb[i]});
    addFooter(*file);
    return file;
}

}  // namespace tspace
