// SPDX-License-Identifier: MIT
// Headers of PNG and JPEG files, read without a library.
#include <algorithm>

#include "images/codecs.h"
#include "images/flip_green.h"

namespace tspace {

namespace {

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

ImageClaim claimOfPng(ByteSpan bytes) {
    constexpr std::size_t kWidthAt = 16, kHeightAt = 20;  // of the header chunk, which is the first
    if (bytes.size() < kHeightAt + 4) return {};
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i) value = value << 8 | bytes[at + i];
        return std::min(value, std::uint32_t{1} << 30);  // no product overflows
    };
    const ImageSize size{number(kWidthAt), number(kHeightAt)};
    return {size, 3 * size.pixels() + 64 * std::uint64_t{size.width}};
}

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

std::vector<std::uint8_t> joinJpeg(ByteSpan packed, ByteSpan like) {
    // Behind the mark of the beginning and the segment that says JFIF.
    constexpr std::size_t kMark = 2, kSizeAt = 4;
    const bool has_jfif = packed.size() > kSizeAt + 1 && packed[kMark] == 0xff && packed[kMark + 1] == 0xe0;
    const std::size_t count = has_jfif ? kMark + (std::size_t{packed[kSizeAt]} << 8 | packed[kSizeAt + 1]) : 0;
    const std::size_t head = std::min(packed.size(), kMark + count);
    std::vector<std::uint8_t> out(packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(head));
    appendMetadata(like, out);
    out.insert(out.end(), packed.begin() + static_cast<std::ptrdiff_t>(head), packed.end());
    return out;
}

}  // namespace tspace
