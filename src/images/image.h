// SPDX-License-Identifier: MIT
// Images from model files, which may be malicious: format, declared size, and pixels.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "images/pixels.h"

namespace tspace {

/// Returns the format according to the first bytes, regardless of the file's metadata. TGA has no magic number: a file
/// of no other format is a TGA if its header is valid for its length. Not available in JavaScript (TSPACE_SMALL).
ImageFormat imageFormat(ByteSpan bytes);
/// Returns a name such as "PNG", "WebP" or "KTX2"; empty for an unknown format.
const char* formatName(ImageFormat format);
/// Returns a MIME type such as "image/png"; empty for an unknown format, and for TGA, which has none.
const char* mimeType(ImageFormat format);
/// Returns why this build cannot read pixels of the format, as a clause ("it is AVIF, which is not read"), or
/// null if it can.
const char* whyNotRead(ImageFormat format);

/// Returns the approximate peak memory of decodeImage for these bytes; 0 if it cannot decode them.
std::uint64_t imageWorkBytes(ByteSpan bytes);

/// Returns the size in the file's header, unchecked; at most 2^30 each. 0 if decodeImage cannot decode the file.
ImageSize claimedSize(ByteSpan bytes);

/// Decodes PNG, JPEG, WebP, EXR, KTX2, DDS and TGA, distinguished by content, rounded to 8 bits. Returns nullopt, with
/// the reason in `why` (a clause), for other formats, corrupt files, more than `most_pixels` pixels, and images
/// that are out of proportion to their file size.
std::optional<RgbImage> decodeImage(ByteSpan bytes, std::uint64_t most_pixels, std::string& why,
                                    ImageUse use = ImageUse::vectors);

/// Returns the alpha channel of an image that decodeImage supports, rounded to 8 bits; empty if it has none, or is not
/// PNG, WebP, EXR, KTX2, DDS or TGA. Needs 4 bytes per pixel in addition to the memory of decodeImage.
std::vector<std::uint8_t> decodeAlpha(ByteSpan bytes);

}  // namespace tspace
