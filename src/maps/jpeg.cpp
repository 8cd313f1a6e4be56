// SPDX-License-Identifier: MIT
// JPEG by libjpeg-turbo, through its TurboJPEG interface, which returns errors and prints nothing.
#include <turbojpeg.h>

#include <algorithm>
#include <memory>

#include "asset/file_error.h"
#include "maps/codecs.h"
#include "maps/flip_green.h"

namespace tspace {

namespace {

struct Destroy {
    void operator()(void* decompressor) const { tjDestroy(decompressor); }
};
using Decompressor = std::unique_ptr<void, Destroy>;

struct JpegHead {
    ImageSize size = {};  ///< 0: broken
    int color_space = 0;
};

JpegHead readHead(const Decompressor& decompressor, ByteSpan bytes) {
    int width = 0, height = 0, subsampling = 0, color_space = 0;
    if (!decompressor || tjDecompressHeader3(decompressor.get(), bytes.data(), bytes.size(), &width, &height,
                                             &subsampling, &color_space) != 0) {
        return {};
    }
    if (width <= 0 || height <= 0) return {};
    return {{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)}, color_space};
}

/// A progressive file may claim thousands of scans over all pixels. Where data are cut short the library would go on
/// with grey.
bool decompress(const Decompressor& decompressor, ByteSpan bytes, ImageSize size, std::vector<std::uint8_t>& rgb) {
    constexpr int kFlags = TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS | TJFLAG_STOPONWARNING;
    rgb.resize(3 * size.pixels());
    return tjDecompress2(decompressor.get(), bytes.data(), bytes.size(), rgb.data(), static_cast<int>(size.width), 0,
                         static_cast<int>(size.height), TJPF_RGB, kFlags) == 0;
}

/// The segments for applications (Exif, colour profile) and comments. Not JFIF and Adobe, which say how the pixels are
/// stored.
void appendMetadata(ByteSpan jpeg, std::vector<std::uint8_t>& out) {
    constexpr unsigned kJfif = 0xe0, kAdobe = 0xee, kLastApplication = 0xef, kComment = 0xfe, kScan = 0xda;
    for (std::size_t at = 2; at + 4 <= jpeg.size() && jpeg[at] == 0xff && jpeg[at + 1] != kScan;) {
        const unsigned marker = jpeg[at + 1];
        const std::size_t count = 2 + (std::size_t{jpeg[at + 2]} << 8 | jpeg[at + 3]);
        if (count > jpeg.size() - at) return;
        const bool is_wanted = marker == kComment || (marker > kJfif && marker <= kLastApplication && marker != kAdobe);
        const ByteSpan segment = jpeg.subspan(at, count);
        if (is_wanted) out.insert(out.end(), segment.begin(), segment.end());
        at += count;
    }
}

}  // namespace

/// libjpeg-turbo holds pixels; and the coefficients of all components where these come in several scans.
ImageClaim claimOfJpeg(ByteSpan bytes) {
    constexpr std::size_t kHeadBytes = 4, kFrameBytes = 8;
    constexpr unsigned kProgressive = 2;  // the last two bits of a frame's marker
    ImageSize size;
    std::uint64_t components = 0;
    for (std::size_t at = 2; at + kHeadBytes + kFrameBytes < bytes.size();) {
        if (bytes[at] != 0xff || bytes[at + 1] == 0xff) {
            ++at;
            continue;
        }
        const unsigned marker = bytes[at + 1];
        const std::uint8_t* data = bytes.data() + at + kHeadBytes;
        const bool is_frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        const bool is_scan = marker == 0xda;
        if (is_frame) {
            size = {std::uint32_t{data[3]} << 8 | data[4], std::uint32_t{data[1]} << 8 | data[2]};
            components = std::min<std::uint64_t>(data[5], 4);
        }
        const bool in_scans = is_frame ? (marker & 3) == kProgressive : is_scan && data[0] < components;
        if (in_scans) return {size, size.pixels() * (3 + 2 * components)};
        if (is_scan) break;
        at += 2 + (std::size_t{bytes[at + 2]} << 8 | bytes[at + 3]);
    }
    return {size, 3 * size.pixels()};
}

std::optional<RgbImage> decodeJpeg(ByteSpan bytes, std::uint64_t most_pixels, std::string& why) {
    why = "it is a broken JPEG";
    const Decompressor decompressor(tjInitDecompress());
    const JpegHead head = readHead(decompressor, bytes);
    if (head.size.pixels() == 0 || isTooLarge(head.size, bytes.size(), most_pixels, why)) return {};
    RgbImage image{head.size.width, head.size.height, {}};
    if (!decompress(decompressor, bytes, head.size, image.rgb)) return {};
    return image;
}

ChannelImage readJpegPixels(ByteSpan bytes) {
    const Decompressor decompressor(tjInitDecompress());
    const JpegHead head = readHead(decompressor, bytes);
    if (head.size.pixels() == 0) failFile(ErrorCode::invalidFile, "it is a broken JPEG");
    if (head.color_space == TJCS_GRAY) {
        failFile(ErrorCode::unsupportedFile, "it is a grey JPEG, which has no green channel of its own");
    }
    if (head.color_space == TJCS_CMYK || head.color_space == TJCS_YCCK) {
        failFile(ErrorCode::unsupportedFile, "it is a JPEG for print (CMYK)");
    }
    ChannelImage image{head.size.width, head.size.height, 3, {}};
    if (!decompress(decompressor, bytes, head.size, image.pixels)) {
        failFile(ErrorCode::invalidFile, "it is a broken JPEG");
    }
    return image;
}

std::vector<std::uint8_t> writeJpeg(const ChannelImage& image, int quality, ByteSpan like) {
    const std::unique_ptr<void, Destroy> compressor(tjInitCompress());
    unsigned char* data = nullptr;
    unsigned long size = 0;
    const int result = !compressor ? -1
                                   : tjCompress2(compressor.get(), image.pixels.data(), static_cast<int>(image.width),
                                                 0, static_cast<int>(image.height), TJPF_RGB, &data, &size, TJSAMP_444,
                                                 quality, TJFLAG_ACCURATEDCT);
    const std::unique_ptr<unsigned char, decltype(&tjFree)> keeper(data, &tjFree);
    if (result != 0) throw OutOfMemory{};  // all that can go wrong with pixels and sizes that were checked
    const ByteSpan packed(data, size);
    // Behind the mark of the beginning and the segment that says JFIF.
    const std::size_t head = 4 + (std::size_t{packed[4]} << 8 | packed[5]);
    std::vector<std::uint8_t> out(packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(head));
    appendMetadata(like, out);
    out.insert(out.end(), packed.begin() + static_cast<std::ptrdiff_t>(head), packed.end());
    return out;
}

}  // namespace tspace
