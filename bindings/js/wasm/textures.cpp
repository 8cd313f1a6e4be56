// SPDX-License-Identifier: MIT
// The first level of a KTX2 or DDS as 8 bits of red, green, blue and alpha, for pages that draw such textures. What KTX2 is packed
// with once more is unpacked by the caller.
#include "exports.h"
#include "images/codecs.h"
#include "images/texture_file.h"

using namespace tspace;

extern "C" {

/// Unpacks by Zstandard (0) or zlib (1) into exactly `size` bytes; else returns 0.
__attribute__((import_module("env"), import_name("unpack"))) int tspace_js_unpack(int zlib, const std::uint8_t* packed,
                                                                                 std::size_t bytes, std::uint8_t* to,
                                                                                 std::size_t size);
}

namespace tspace {

const char* whyNotUnpacked(Repacking) { return nullptr; }
bool unpackLevel(Repacking repacking, ByteSpan packed, std::span<std::uint8_t> out) {
    return tspace_js_unpack(repacking == Repacking::zlib ? 1 : 0, packed.data(), packed.size(), out.data(),
                            out.size()) != 0;
}

}  // namespace tspace

namespace {

struct Decoded {
    std::uint32_t width, height;
    std::uint8_t* rgba;
};
Decoded decoded;

}  // namespace

extern "C" {

/// Width, height and the place of the pixels, row by row from the top; null, with a text in errorText, where there are none.
TSPACE_JS_EXPORT(decodeTexture) const void* decodeTexturePixels(const std::uint8_t* data, std::size_t bytes) {
    constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 26;
    const ByteSpan file{data, bytes};
    std::string why = "it is no KTX2 and no DDS";
    const ImageFormat format = imageFormat(file);
    tspace_js_release(decoded.rgba);
    decoded = {};
    std::optional<RgbImage> image;
    if (format == ImageFormat::ktx2 || format == ImageFormat::dds) image = decodeTexture(file, kMostPixels, why);
    if (!image) {
        js::error = Error{ErrorCode::unsupportedFile, why};
        return nullptr;
    }
    const std::vector<std::uint8_t> alpha = decodeTextureAlpha(file);
    const std::size_t count = std::size_t{image->width} * image->height;
    auto* rgba = static_cast<std::uint8_t*>(tspace_js_allocate(4 * count));
    if (rgba == nullptr) {
        js::error = Error{ErrorCode::outOfMemory, "there is no memory for its pixels"};
        return nullptr;
    }
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < 3; ++k) rgba[4 * i + k] = image->rgb[3 * i + k];
        rgba[4 * i + 3] = alpha.empty() ? 255 : alpha[i];
    }
    decoded = {image->width, image->height, rgba};
    return &decoded;
}

}  // extern "C"
