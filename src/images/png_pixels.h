// SPDX-License-Identifier: MIT
// Pixels of a PNG out and in again; its chunks are in flip_png.cpp. Bindings have other decoders in the place of
// libspng.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "images/image.h"
#include "tspace/result.h"

namespace tspace {

struct PngHeader {
    /// Colour types.
    static constexpr std::uint8_t kPalette = 3, kHasColor = 2, kHasAlpha = 4;

    std::uint32_t width = 0, height = 0;
    std::uint8_t bits = 8, color = kHasColor;
    bool is_interlaced = false;

    [[nodiscard]] std::size_t channels() const { return (color & kHasAlpha) != 0 ? 4 : 3; }
    [[nodiscard]] std::size_t rowBytes() const { return channels() * (bits / 8) * width; }
};

Error brokenPng();

/// The number of 4 bytes that begins at `at`, which there must be.
std::uint32_t pngNumber(ByteSpan bytes, std::size_t at);

/// 255 - x and 65535 - x are x with all bits inverted. `step`: bytes from one green to the next.
void invertGreenSamples(std::span<std::uint8_t> bytes, std::size_t step, std::size_t sample_bytes);

/// The pixels of a PNG of RGB or RGBA, green inverted, as a PNG of the same header.
Result<std::vector<std::uint8_t>> packInverted(ByteSpan bytes, const PngHeader& header);

/// An error (or code ok) where the pixels of a PNG with a palette are broken.
Error checkPixels(ByteSpan bytes, const PngHeader& header);

}  // namespace tspace
