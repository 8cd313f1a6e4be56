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

}  // namespace

bool readJpegSize(std::span<const std::uint8_t> bytes, std::uint32_t& width, std::uint32_t& height) {
    const Decompressor decompressor(tjInitDecompress());
    int x = 0, y = 0, subsampling = 0, color_space = 0;
    if (!decompressor ||
        tjDecompressHeader3(decompressor.get(), bytes.data(), bytes.size(), &x, &y, &subsampling, &color_space) != 0 ||
        x <= 0 || y <= 0) {
        return false;
    }
    width = static_cast<std::uint32_t>(x);
    height = static_cast<std::uint32_t>(y);
    return true;
}

std::optional<RgbImage> decodeJpeg(std::span<const std::uint8_t> bytes, std::uint32_t width, std::uint32_t height) {
    // A progressive file may claim thousands of scans over all pixels. Where data are cut short the library would go on
    // with grey.
    constexpr int kFlags = TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS | TJFLAG_STOPONWARNING;
    const Decompressor decompressor(tjInitDecompress());
    if (!decompressor) return {};
    RgbImage image{width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height)};
    if (tjDecompress2(decompressor.get(), bytes.data(), bytes.size(), image.rgb.data(), static_cast<int>(width), 0,
                      static_cast<int>(height), TJPF_RGB, kFlags) != 0) {
        return {};
    }
    return image;
}

}  // namespace tspace
