// SPDX-License-Identifier: MIT
// JPEG by libjpeg-turbo, through its TurboJPEG interface, which returns errors and prints nothing.
#include <turbojpeg.h>

#include <memory>

#include "check/image.h"

namespace tspace {

namespace {

struct Destroy {
    void operator()(void* decompressor) const { tjDestroy(decompressor); }
};
using Decompressor = std::unique_ptr<void, Destroy>;

bool readSize(const Decompressor& decompressor, std::span<const std::uint8_t> bytes, int& width, int& height) {
    int subsampling = 0, color_space = 0;
    return decompressor &&
           tjDecompressHeader3(decompressor.get(), bytes.data(), bytes.size(), &width, &height, &subsampling,
                               &color_space) == 0 &&
           width > 0 && height > 0;
}

}  // namespace

bool readJpegSize(std::span<const std::uint8_t> bytes, std::uint32_t& width, std::uint32_t& height) {
    int x = 0, y = 0;
    if (!readSize(Decompressor(tjInitDecompress()), bytes, x, y)) return false;
    width = static_cast<std::uint32_t>(x);
    height = static_cast<std::uint32_t>(y);
    return true;
}

std::optional<RgbImage> decodeJpeg(std::span<const std::uint8_t> bytes) {
    // A progressive file may claim thousands of scans over all pixels. Where data are cut short the library would go on
    // with grey.
    constexpr int kFlags = TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS | TJFLAG_STOPONWARNING;
    const Decompressor decompressor(tjInitDecompress());
    int width = 0, height = 0;
    if (!readSize(decompressor, bytes, width, height)) return {};
    RgbImage image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
    image.rgb.resize(std::size_t{3} * image.width * image.height);
    if (tjDecompress2(decompressor.get(), bytes.data(), bytes.size(), image.rgb.data(), width, 0, height, TJPF_RGB,
                      kFlags) != 0) {
        return {};
    }
    return image;
}

}  // namespace tspace
