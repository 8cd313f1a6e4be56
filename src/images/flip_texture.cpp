// SPDX-License-Identifier: MIT
// Green of a texture file inverted where it lies, in all levels.
#include "images/codecs.h"
#include "images/flip_green.h"
#include "images/texture_file.h"

namespace tspace {

Result<FlippedImage> flipTexture(ByteSpan bytes, ImageFileFormat format) {
    std::string why;
    const std::optional<TextureFile> texture = readTextureHead(bytes, why);
    if (!texture)
        return Error{why.find("broken") != why.npos ? ErrorCode::invalidFile : ErrorCode::unsupportedFile, why};
    const TexelFormat& texels = texture->format;
    constexpr const char* kWritePng = "; flip-green -o OUT.png makes a PNG of it";
    if (texture->repacking != Repacking::none)
        return Error{ErrorCode::unsupportedFile,
                     "it is a KTX2 packed once more (Zstandard, zlib, BasisLZ), which is not written anew" +
                         std::string(kWritePng)};
    TextureFacts facts{.layout = texture->layout};
    if (texels.channels == 4 && facts.layout == MapLayout{}) {
        const std::optional<FloatImage> image = decodeFloatTexture(bytes, kMostModelMapPixels, why);
        if (!image) return Error{ErrorCode::invalidFile, why};
        facts = image->texture;
    }
    // Green as it is shown, or y where that is elsewhere.
    const std::uint8_t source = texture->swizzle[static_cast<std::size_t>(facts.layout.y.channel)];
    const bool is_masked_out = texels.masks[0] != 0 && source < texels.masks.size() && texels.masks[source] == 0;
    if (source >= texels.channels || texels.channels == 1 || is_masked_out)
        return Error{ErrorCode::unsupportedFile, "it is a grey texture, which has no green channel of its own"};
    if (texels.invert == nullptr)
        return Error{ErrorCode::unsupportedFile,
                     "it is " + texture->name() + ", whose blocks cannot hold inverted green exactly" + kWritePng};
    FlippedImage flipped{
        {bytes.begin(), bytes.end()},
        {.format = format, .width = texture->size.width, .height = texture->size.height, .bits = texels.bits}};
    if (facts.is_guessed && facts.layout.y.channel == MapChannel::alpha)
        flipped.report.warnings.emplace_back(
            "its texels look as if it held x in red and y in alpha: alpha is inverted");
    for (const TextureFile::Place& level : texture->levels) {
        for (std::size_t at = 0; at + texels.block_bytes <= level.bytes; at += texels.block_bytes)
            texels.invert(texels, flipped.bytes.data() + level.at + at, source);
    }
    return flipped;
}

}  // namespace tspace
