// SPDX-License-Identifier: MIT
// Texture files as images: decodes rows of texels from their blocks, and determines the channels of x, y and z in
// normal maps.
#include <algorithm>
#include <cmath>

#include "images/codecs.h"
#include "images/flip_green.h"
#include "images/float_image.h"
#include "images/image.h"
#include "images/layout_guess.h"
#include "images/textures/texture_file.h"

namespace tspace {
namespace {

std::uint64_t rowBytes(const TextureFile& texture) {
    const TexelFormat& format = texture.format;
    return format.blocksAcross(texture.size.width) * format.width * format.height * sizeof(Rgba);
}

/// A mip level of a texture file, decompressed if necessary.
class TextureLevel {
  public:
    explicit TextureLevel(const TextureFile& texture)
        : texture_(texture), format_(texture.format), blocks_(texture.level) {}

    bool unpack() {
        if (texture_.repacking != Repacking::none) {
            unpacked_.resize(static_cast<std::size_t>(texture_.levelBytes()));
            const bool is_done = texture_.repacking == Repacking::basisLz
                                     ? unpackBasisLz(texture_, unpacked_)
                                     : unpackLevel(texture_.repacking, texture_.level, unpacked_);
            if (!is_done) return false;
            blocks_ = unpacked_;
        }
        if (format_.decode != nullptr) return true;
        format_ = texelFormat(TexelKind::rgba32f);
        std::vector<std::uint8_t> texels(static_cast<std::size_t>(format_.block_bytes * texture_.size.pixels()));
        if (!decodeAstc(texture_, blocks_, texels)) return false;
        unpacked_ = std::move(texels);
        blocks_ = unpacked_;
        return true;
    }

    /// Calls put(row, texels) for each row of the image, in any order.
    template <class Put>
    void forRows(const Put& put) const {
        const std::uint32_t width = texture_.size.width, height = texture_.size.height;
        const auto across = static_cast<std::size_t>(format_.blocksAcross(width));
        const std::size_t stride = across * format_.width;
        std::vector<Rgba> rows(stride * format_.height);
        std::array<Rgba, 16> block{};
        const std::uint8_t* at = blocks_.data();
        for (std::uint32_t top = 0; top < height; top += format_.height) {
            for (std::size_t column = 0; column < across; ++column, at += format_.block_bytes) {
                format_.decode(format_, at, block.data());
                for (std::size_t y = 0; y < format_.height; ++y)
                    std::copy_n(&block[y * format_.width], format_.width, &rows[y * stride + column * format_.width]);
            }
            for (std::uint32_t y = 0; y < format_.height && top + y < height; ++y) {
                const std::span<Rgba> row = std::span(rows).subspan(y * stride, width);
                arrange(row);
                put(texture_.turns_rows ? height - 1 - top - y : top + y, row);
            }
        }
    }

  private:
    /// Applies the channel swizzle and the column order of the file.
    void arrange(std::span<Rgba> row) const {
        constexpr std::array<std::uint8_t, 4> kPlain = {0, 1, 2, 3};
        if (texture_.swizzle != kPlain) {
            for (Rgba& texel : row) {
                const Rgba from = texel;
                for (std::size_t i = 0; i < 4; ++i) {
                    const std::uint8_t source = texture_.swizzle[i];
                    texel[i] = source < 4 ? from[source] : source == TextureFile::kOne ? 1.0F : 0.0F;
                }
            }
        }
        if (texture_.turns_columns) std::reverse(row.begin(), row.end());
    }

    const TextureFile& texture_;
    TexelFormat format_;  ///< format of blocks_
    ByteSpan blocks_;
    std::vector<std::uint8_t> unpacked_ = {};
};

/// Returns whether the alpha of decoded texels can differ from 1.
bool hasAlpha(const TextureFile& texture) {
    const std::uint8_t source = texture.swizzle[3];
    return source != TextureFile::kOne && (source != 3 || texture.format.channels == 4);
}

std::optional<TextureFile> openTexture(ByteSpan bytes, std::uint64_t most_pixels, std::string& why,
                                       std::size_t level = 0) {
    Result<TextureFile> texture = readTextureHeader(bytes);
    if (!texture) {
        why = texture.error().message;
        return {};
    }
    if (level != 0) {
        if (level >= texture->levels.size()) {
            why = "the texture has no mip level " + std::to_string(level) + "; its last mip level is " +
                  std::to_string(texture->levels.size() - 1);
            return {};
        }
        const TextureFile::Place& place = texture->levels[level];
        texture->level = bytes.subspan(place.at, place.bytes);
        texture->level_number = level;
        for (std::uint32_t* side : {&texture->size.width, &texture->size.height})
            *side = std::max<std::uint32_t>(*side >> level, 1);
    }
    if (isTooLarge(texture->size, bytes.size(), most_pixels, why)) return {};
    return *std::move(texture);
}

std::string brokenTexture(const TextureFile& texture) {
    return std::string("the ") + texture.container + " is damaged";
}

void guessLayout(FloatImage& image) {
    if (image.alpha.empty() || !(image.texture.layout == MapLayout{})) return;
    LayoutDetector guess;
    for (std::size_t i = 0; i < image.texels.size(); ++i) guess.add(image.texels[i], image.alpha[i]);
    if (const std::optional<MapLayout> layout = guess.layout()) {
        image.texture.layout = *layout;
        image.texture.is_guessed = true;
    }
}

}  // namespace

Result<TextureFile> readTextureHeader(ByteSpan bytes) {
    return imageFormat(bytes) == ImageFormat::ktx2 ? readKtx2Header(bytes) : readDdsHeader(bytes);
}

std::optional<TextureFacts> textureFacts(ByteSpan bytes) {
    const ImageFormat format = imageFormat(bytes);
    if (format != ImageFormat::ktx2 && format != ImageFormat::dds) return {};
    const Result<TextureFile> texture = readTextureHeader(bytes);
    if (!texture) return {};
    return TextureFacts{.name = texture->name(),
                        .layout = texture->layout,
                        .is_srgb = texture->is_srgb,
                        .has_blocks = texture->format.width > 1,
                        .level_count = static_cast<std::uint32_t>(std::max<std::size_t>(texture->levels.size(), 1))};
}

ImageClaim claimOfTexture(ByteSpan bytes) {
    const Result<TextureFile> texture = readTextureHeader(bytes);
    if (!texture) return {};
    const std::uint64_t pixel_bytes = texture->format.is_float ? 16 + 3 : 3;
    std::uint64_t unpacked = texture->repacking == Repacking::none ? 0 : texture->levelBytes();
    // The ASTC decoder needs memory for all texels as floats, and for its own tables.
    constexpr std::uint64_t kTables = std::uint64_t{8} << 20;
    if (texture->format.decode == nullptr) unpacked += sizeof(Rgba) * texture->size.pixels() + kTables;
    return {texture->size, pixel_bytes * texture->size.pixels() + unpacked + rowBytes(*texture)};
}

std::optional<FloatImage> decodeFloatTexture(ByteSpan bytes, std::uint64_t most_pixels, std::string& why,
                                             std::size_t level_number, ImageUse use) {
    const std::optional<TextureFile> texture = openTexture(bytes, most_pixels, why, level_number);
    if (!texture) return {};
    TextureLevel level(*texture);
    why = brokenTexture(*texture);
    if (!level.unpack()) return {};
    const std::size_t width = texture->size.width;
    FloatImage image{texture->size.width,
                     texture->size.height,
                     texture->format.bits,
                     std::vector<Vec3>(static_cast<std::size_t>(texture->size.pixels())),
                     {}};
    if (hasAlpha(*texture)) image.alpha.resize(image.texels.size());
    level.forRows([&](std::size_t y, std::span<const Rgba> row) {
        for (std::size_t x = 0; x < row.size(); ++x) {
            image.texels[y * width + x] = {row[x][0], row[x][1], row[x][2]};
            if (!image.alpha.empty()) image.alpha[y * width + x] = row[x][3];
        }
    });
    image.texture = {.name = texture->name(), .layout = texture->layout, .is_srgb = texture->is_srgb};
    if (texture->format.is_float) readFloats(use, image);
    guessLayout(image);
    // Most block formats have an alpha channel, whether it is used or not.
    if (std::all_of(image.alpha.begin(), image.alpha.end(), [](float alpha) { return alpha == 1; }))
        image.alpha.clear();
    return image;
}

std::optional<RgbImage> decodeTexture(ByteSpan bytes, std::uint64_t most_pixels, std::string& why, ImageUse use) {
    const std::optional<TextureFile> texture = openTexture(bytes, most_pixels, why);
    if (!texture) return {};
    if (texture->format.is_float) {
        const std::optional<FloatImage> floats = decodeFloatTexture(bytes, most_pixels, why, 0, use);
        if (!floats) return {};
        return roundedImage(*floats);
    }
    RgbImage image{texture->size.width, texture->size.height, {}};
    TextureLevel level(*texture);
    why = brokenTexture(*texture);
    if (!level.unpack()) return {};
    image.rgb.resize(static_cast<std::size_t>(3 * texture->size.pixels()));
    level.forRows([&](std::size_t y, std::span<const Rgba> row) {
        std::uint8_t* at = image.rgb.data() + 3 * y * image.width;
        for (const Rgba& texel : row) {
            for (std::size_t i = 0; i < 3; ++i) *at++ = roundedChannel(texel[i]);
        }
    });
    return image;
}

std::vector<std::uint8_t> decodeTextureAlpha(ByteSpan bytes) {
    const Result<TextureFile> texture = readTextureHeader(bytes);
    if (!texture || !hasAlpha(*texture)) return {};
    TextureLevel level(*texture);
    if (!level.unpack()) return {};
    std::vector<std::uint8_t> alpha(static_cast<std::size_t>(texture->size.pixels()));
    level.forRows([&](std::size_t y, std::span<const Rgba> row) {
        std::uint8_t* at = alpha.data() + y * texture->size.width;
        for (const Rgba& texel : row) *at++ = roundedChannel(texel[3]);
    });
    return alpha;
}

// Inverts green of a texture file in place, in all levels.

Result<FlippedImage> flipTexture(ByteSpan bytes, ImageFileFormat format) {
    const Result<TextureFile> texture = readTextureHeader(bytes);
    if (!texture) return texture.error();
    const TexelFormat& texels = texture->format;
    constexpr const char* kWritePng = "; use flip-green -o OUT.png to write a PNG";
    if (texture->repacking != Repacking::none)
        return Error{ErrorCode::unsupportedFile,
                     "the KTX2 is supercompressed (Zstandard, zlib or BasisLZ) and cannot be rewritten" +
                         std::string(kWritePng)};
    TextureFacts facts{.layout = texture->layout};
    if (texels.channels == 4 && facts.layout == MapLayout{}) {
        std::string why;
        const std::optional<FloatImage> image = decodeFloatTexture(bytes, kMaxModelMapPixels, why);
        if (!image) return Error{ErrorCode::invalidFile, why};
        facts = image->texture;
    }
    // The stored channel that contains y; usually the one that the swizzle maps to green.
    const std::uint8_t source = texture->swizzle[static_cast<std::size_t>(facts.layout.y.channel)];
    const bool is_masked_out = texels.masks[0] != 0 && source < texels.masks.size() && texels.masks[source] == 0;
    if (source >= texels.channels || texels.channels == 1 || is_masked_out)
        return Error{ErrorCode::unsupportedFile, "the texture is gray, so it has no separate green channel"};
    if (texels.invert == nullptr)
        return Error{ErrorCode::unsupportedFile, "the image is " + texture->name() +
                                                     ", whose blocks cannot store inverted green exactly" + kWritePng};
    FlippedImage flipped{
        {bytes.begin(), bytes.end()},
        {.format = format, .width = texture->size.width, .height = texture->size.height, .bits = texels.bits}};
    if (facts.is_guessed && facts.layout.y.channel == MapChannel::alpha)
        flipped.report.warnings.emplace_back("the texels look like x in red and y in alpha, so alpha was inverted");
    if (texture->cut_count != 0)
        flipped.report.warnings.push_back("the file ends before the last " + std::to_string(texture->cut_count) +
                                          " of " + std::to_string(texture->levels.size() + texture->cut_count) +
                                          " mip levels; their remaining bytes were not changed");
    for (const TextureFile::Place& level : texture->levels) {
        for (std::size_t at = 0; at + texels.block_bytes <= level.bytes; at += texels.block_bytes)
            texels.invert(texels, flipped.bytes.data() + level.at + at, source);
    }
    return flipped;
}

}  // namespace tspace
