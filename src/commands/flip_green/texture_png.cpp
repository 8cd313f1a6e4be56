// SPDX-License-Identifier: MIT
#include "commands/flip_green/texture_png.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "commands/shared/map_image_file.h"
#include "images/texture_vectors.h"
#include "model/io/file_error.h"

namespace tspace {

FlippedImage flippedTexturePng(ByteSpan bytes) {
    if (const char* why_not = whyNotRead(ImageFormat::png)) failFile(ErrorCode::unsupportedFile, why_not);
    std::string why;
    std::optional<FloatImage> image = decodeFloatImage(bytes, kMaxModelMapPixels, why);
    if (!image) failFile(ErrorCode::invalidFile, why);
    const std::string how_read = readTextureVectors(*image);
    for (Vec3& texel : image->texels) texel.y = 1 - texel.y;
    const unsigned bits = image->bits == 8 && how_read.empty() ? 8 : 16;
    std::optional<std::vector<std::uint8_t>> file = encodePng(*image, bits);
    if (!file) failFile(ErrorCode::outOfMemory, "the image cannot be encoded as PNG");
    FlippedImage flipped{
        *std::move(file),
        {.format = ImageFileFormat::png, .width = image->width, .height = image->height, .bits = bits}};
    // Texels of block formats and floats can have values between integers.
    const float most = bits == 8 ? 255.0F : 65535.0F;
    flipped.report.is_exact = std::all_of(image->texels.begin(), image->texels.end(), [&](const Vec3& texel) {
        constexpr float kRounding = 0.01F;  // rounding error of a float that was multiplied by 65535
        return std::fabs(texel.y * most - std::round(texel.y * most)) < kRounding;
    });
    if (!how_read.empty()) flipped.report.warnings.push_back(how_read);
    return flipped;
}

}  // namespace tspace
