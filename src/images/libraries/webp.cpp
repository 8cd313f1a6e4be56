// SPDX-License-Identifier: MIT
// Reads and writes WebP with libwebp.
#include <webp/decode.h>
#include <webp/encode.h>

#include <memory>

#include "core/base/memory.h"
#include "images/codecs.h"
#include "images/flip_green.h"

namespace tspace {
namespace {

/// Returns the header of a still image; nullopt, with the reason in `why`, for other files.
std::optional<WebPBitstreamFeatures> readHeader(ByteSpan bytes, std::string& why) {
    WebPBitstreamFeatures features;
    why = "the WebP is damaged";
    if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK) return {};
    if (features.has_animation != 0) {
        why = "the WebP is animated, which is not supported";
        return {};
    }
    if (features.width <= 0 || features.height <= 0) return {};
    return features;
}

ImageSize sizeOf(const WebPBitstreamFeatures& features) {
    return {static_cast<std::uint32_t>(features.width), static_cast<std::uint32_t>(features.height)};
}

/// Decodes into `pixels`, with `channels` bytes each: RGB or RGBA. Returns false if the image is corrupt. Throws
/// OutOfMemory.
bool decodeInto(ByteSpan bytes, ImageSize size, unsigned channels, std::vector<std::uint8_t>& pixels) {
    WebPDecoderConfig config;
    if (WebPInitDecoderConfig(&config) == 0) return false;
    config.output.colorspace = channels == 4 ? MODE_RGBA : MODE_RGB;
    config.output.is_external_memory = 1;
    config.output.u.RGBA = {
        .rgba = pixels.data(), .stride = static_cast<int>(channels * size.width), .size = pixels.size()};
    const VP8StatusCode status = WebPDecode(bytes.data(), bytes.size(), &config);
    if (status == VP8_STATUS_OUT_OF_MEMORY) throw OutOfMemory{};
    return status == VP8_STATUS_OK;
}

}  // namespace

ImageClaim claimOfWebp(ByteSpan bytes) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK) return {};
    const ImageSize size{static_cast<std::uint32_t>(features.width), static_cast<std::uint32_t>(features.height)};
    // In addition to the pixels that it returns, libwebp stores all pixels of a lossless image, and the alpha channel
    // of a lossy one, with up to 32 bits per pixel while it is decoded.
    return {size, (features.format == 2 || features.has_alpha != 0 ? 8 : 4) * size.pixels()};
}

std::optional<RgbImage> decodeWebp(ByteSpan bytes, std::uint64_t most_pixels, std::string& why) {
    const std::optional<WebPBitstreamFeatures> head = readHeader(bytes, why);
    if (!head || isTooLarge(sizeOf(*head), bytes.size(), most_pixels, why)) return {};
    const ImageSize size = sizeOf(*head);
    RgbImage image{size.width, size.height, std::vector<std::uint8_t>(3 * size.pixels())};
    if (!decodeInto(bytes, size, 3, image.rgb)) return {};
    return image;
}

Result<ChannelImage> readWebpPixels(ByteSpan bytes) {
    std::string why;
    const std::optional<WebPBitstreamFeatures> head = readHeader(bytes, why);
    if (!head)
        return Error{
            why == "the WebP is animated, which is not supported" ? ErrorCode::unsupportedFile : ErrorCode::invalidFile,
            why};
    const ImageSize size = sizeOf(*head);
    ChannelImage image{size.width, size.height, head->has_alpha != 0 ? 4U : 3U, {}};
    image.pixels.resize(image.channels * size.pixels());
    if (!decodeInto(bytes, size, image.channels, image.pixels))
        return Error{ErrorCode::invalidFile, "the WebP is damaged"};
    return image;
}

Result<std::vector<std::uint8_t>> writeWebp(const ChannelImage& image) {
    constexpr int kLevel = 3;  // compression level from 0 (fast) to 9 (small)
    WebPConfig config;
    WebPPicture picture;
    if (WebPConfigInit(&config) == 0 || WebPConfigLosslessPreset(&config, kLevel) == 0 ||
        WebPPictureInit(&picture) == 0)
        return Error{ErrorCode::internal,
                     "the installed libwebp has another version than the headers with which tspace was built"};
    config.exact = 1;
    picture.use_argb = 1;
    picture.width = static_cast<int>(image.width);
    picture.height = static_cast<int>(image.height);
    WebPMemoryWriter writer;
    WebPMemoryWriterInit(&writer);
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &writer;
    const auto import = image.channels == 4 ? WebPPictureImportRGBA : WebPPictureImportRGB;
    const bool is_done = import(&picture, image.pixels.data(), static_cast<int>(image.channels * image.width)) != 0 &&
                         WebPEncode(&config, &picture) != 0;
    WebPPictureFree(&picture);
    const std::unique_ptr<WebPMemoryWriter, decltype(&WebPMemoryWriterClear)> keeper(&writer, &WebPMemoryWriterClear);
    if (!is_done) throw OutOfMemory{};  // the only possible error after pixels and sizes were checked
    return std::vector<std::uint8_t>{writer.mem, writer.mem + writer.size};
}

}  // namespace tspace
