// SPDX-License-Identifier: MIT
// Images as they come out of model files, which may be hostile: what format they are, what they claim, their pixels.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "images/pixels.h"

namespace tspace {

/// Told by the first bytes, whatever a file says of itself. TGA has no mark: what is nothing else and has a head that is right for its
/// length. Not in JavaScript (TSPACE_SMALL).
ImageFormat imageFormat(ByteSpan bytes);
/// "PNG", "WebP", "KTX2"; empty for an unknown one.
const char* formatName(ImageFormat format);
/// "image/png"; empty for an unknown one, and for TGA, which has none.
const char* mimeType(ImageFormat format);
/// Null, or why this build reads no pixels of that format: half a sentence, "it is AVIF, which is not read".
const char* whyNotRead(ImageFormat format);

/// About the most memory that decodeImage holds for these bytes; 0 where it decodes nothing.
std::uint64_t imageWorkBytes(ByteSpan bytes);

/// The size in the file's header, without any check; at most 2^30 each. 0 where decodeImage decodes nothing.
ImageSize claimedSize(ByteSpan bytes);

/// Decodes PNG, JPEG, WebP, EXR, KTX2, DDS and TGA (rounded to 8 bits), told apart by content. Nothing, with the reason in `why` (half a sentence), for other
/// formats, broken files, more than `most_pixels` pixels, and images that are out of proportion to their bytes.
std::optional<RgbImage> decodeImage(ByteSpan bytes, std::uint64_t most_pixels, std::string& why,
                                    ImageUse use = ImageUse::vectors);

/// The alpha channel of an image that decodeImage decodes, rounded to 8 bits; empty where it has none, or is no PNG, WebP, KTX2, DDS or TGA.
/// Holds 4 bytes a pixel beside what decodeImage holds.
std::vector<std::uint8_t> decodeAlpha(ByteSpan bytes);

}  // namespace tspace
