// SPDX-License-Identifier: MIT
// Reads and writes JPEG with libjpeg-turbo, through its TurboJPEG interface, which returns errors and prints nothing.
#include <turbojpeg.h>

#include <cstring>
#include <memory>

#include "core/base/memory.h"
#include "images/codecs.h"
#include "images/flip_green.h"

namespace tspace {
namespace {

struct Destroy {
    void operator()(void* decompressor) const { tjDestroy(decompressor); }
};
using Decompressor = std::unique_ptr<void, Destroy>;

Decompressor makeDecompressor() {
    Decompressor made(tjInitDecompress());
    if (!made) throw OutOfMemory{};
    return made;
}

/// Returns whether a call succeeded. Throws OutOfMemory if the error message mentions memory ("Insufficient memory",
/// "Memory allocation failure").
bool succeeds(int result, const Decompressor& decompressor) {
    if (result != 0 && std::strstr(tjGetErrorStr2(decompressor.get()), "emory") != nullptr) throw OutOfMemory{};
    return result == 0;
}

struct JpegHead {
    ImageSize size = {};  ///< 0 if the header is corrupt
    int color_space = 0;

    [[nodiscard]] bool isForPrint() const { return color_space == TJCS_CMYK || color_space == TJCS_YCCK; }
};

JpegHead readHead(const Decompressor& decompressor, ByteSpan bytes) {
    int width = 0, height = 0, subsampling = 0, color_space = 0;
    if (!succeeds(tjDecompressHeader3(decompressor.get(), bytes.data(), bytes.size(), &width, &height, &subsampling,
                                      &color_space),
                  decompressor))
        return {};
    if (width <= 0 || height <= 0) return {};
    return {{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)}, color_space};
}

/// Decompresses to RGB. Limits the number of scans, because a progressive file may declare thousands of scans over all
/// pixels. Stops at warnings, because the library would fill truncated data with gray.
bool decompress(const Decompressor& decompressor, ByteSpan bytes, ImageSize size, std::vector<std::uint8_t>& rgb) {
    constexpr int kFlags = TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS | TJFLAG_STOPONWARNING;
    rgb.resize(3 * size.pixels());
    return succeeds(tjDecompress2(decompressor.get(), bytes.data(), bytes.size(), rgb.data(),
                                  static_cast<int>(size.width), 0, static_cast<int>(size.height), TJPF_RGB, kFlags),
                    decompressor);
}

}  // namespace

std::optional<RgbImage> decodeJpeg(ByteSpan bytes, std::uint64_t most_pixels, std::string& why) {
    why = "the JPEG is damaged";
    const Decompressor decompressor = makeDecompressor();
    const JpegHead head = readHead(decompressor, bytes);
    if (head.size.pixels() == 0 || isTooLarge(head.size, bytes.size(), most_pixels, why)) return {};
    if (head.isForPrint()) {
        why = "the JPEG is CMYK (for print), which is not supported; convert it to RGB";
        return {};
    }
    RgbImage image{head.size.width, head.size.height, {}};
    if (!decompress(decompressor, bytes, head.size, image.rgb)) return {};
    return image;
}

Result<ChannelImage> readJpegPixels(ByteSpan bytes) {
    const Decompressor decompressor = makeDecompressor();
    const JpegHead head = readHead(decompressor, bytes);
    if (head.size.pixels() == 0) return Error{ErrorCode::invalidFile, "the JPEG is damaged"};
    if (head.color_space == TJCS_GRAY)
        return Error{ErrorCode::unsupportedFile, "the JPEG is gray, so it has no separate green channel"};
    if (head.isForPrint()) {
        return Error{ErrorCode::unsupportedFile,
                     "the JPEG is CMYK (for print), which is not supported; convert it to RGB"};
    }
    ChannelImage image{head.size.width, head.size.height, 3, {}};
    if (!decompress(decompressor, bytes, head.size, image.pixels))
        return Error{ErrorCode::invalidFile, "the JPEG is damaged"};
    return image;
}

Result<std::vector<std::uint8_t>> writeJpeg(const ChannelImage& image, int quality, ByteSpan like) {
    const std::unique_ptr<void, Destroy> compressor(tjInitCompress());
    unsigned char* data = nullptr;
    unsigned long size = 0;
    const int result = !compressor ? -1
                                   : tjCompress2(compressor.get(), image.pixels.data(), static_cast<int>(image.width),
                                                 0, static_cast<int>(image.height), TJPF_RGB, &data, &size, TJSAMP_444,
                                                 quality, TJFLAG_ACCURATEDCT);
    const std::unique_ptr<unsigned char, decltype(&tjFree)> keeper(data, &tjFree);
    if (result != 0) throw OutOfMemory{};  // the only possible error after pixels and sizes were checked
    return joinJpeg({data, size}, like);
}

}  // namespace tspace
