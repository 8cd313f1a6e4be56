// SPDX-License-Identifier: MIT
// Reads TGA according to "Truevision TGA File Format Specification", version 2.0 (1991). A TGA has no magic number at
// its start, and in version 1 none at its end either, so every header field must be valid.
#include <algorithm>
#include <array>

#include "core/base/numbers.h"
#include "images/codecs.h"

namespace tspace {
namespace {

constexpr std::size_t kHeadBytes = 18, kMaxOfPacket = 128;

enum class TgaKind : std::uint8_t { palette = 1, colors = 2, gray = 3 };

struct TgaHeader {
    TgaKind kind = TgaKind::colors;
    bool is_packed = false, is_from_the_top = false, is_from_the_right = false;
    ImageSize size = {};
    unsigned pixel_bits = 0, entry_bits = 0, alpha_bits = 0;
    std::size_t first_entry = 0, entry_count = 0;
    std::size_t palette_at = 0, pixels_at = 0;

    [[nodiscard]] std::size_t pixelBytes() const { return pixel_bits / 8; }
    /// Returns the number of bits of a pixel, or of a palette entry if the image has a palette; both have the same
    /// format.
    [[nodiscard]] unsigned storedBits() const { return kind == TgaKind::palette ? entry_bits : pixel_bits; }
    [[nodiscard]] bool hasAlpha() const {
        const bool is_bit = kind != TgaKind::gray && storedBits() == 16;
        return is_bit ? alpha_bits == 1 : storedBits() == (kind == TgaKind::gray ? 16 : 32);
    }
};

bool areBitsRight(const TgaHeader& head) {
    const auto is_color = [](unsigned bits) { return bits == 16 || bits == 24 || bits == 32; };
    const unsigned pixel = head.pixel_bits, alpha = head.alpha_bits;
    if (alpha != 0 && alpha != 8 && !(alpha == 1 && head.kind != TgaKind::gray && head.storedBits() == 16))
        return false;
    switch (head.kind) {
        case TgaKind::palette: return pixel == 8 && is_color(head.entry_bits) && head.entry_count != 0;
        case TgaKind::colors: return is_color(pixel);
        case TgaKind::gray: return pixel == 8 || pixel == 16;
    }
    return false;
}

/// Returns the minimum size of the pixel data: packets of 128 equal pixels if it is run-length encoded.
std::uint64_t minBytes(const TgaHeader& head) {
    const std::uint64_t pixels = head.size.pixels();
    if (!head.is_packed) return pixels * head.pixelBytes();
    return (pixels + kMaxOfPacket - 1) / kMaxOfPacket * (1 + head.pixelBytes());
}

/// Parses the header. Returns nullopt if the file is not a supported TGA, or is too short for its pixels.
std::optional<TgaHeader> readTgaHeader(ByteSpan bytes) {
    constexpr std::uint8_t kPacked = 8, kFromTheRight = 0x10, kFromTheTop = 0x20, kReserved = 0xc0, kAlphaBits = 0x0f;
    if (bytes.size() < kHeadBytes) return {};
    const auto number = [&](std::size_t at) { return loadLittleEndian<std::uint16_t>(bytes.data() + at); };
    const unsigned kind = bytes[2] & ~unsigned{kPacked};
    if (kind < 1 || kind > 3) return {};
    const bool has_palette = kind == 1;
    const bool has_entries = bytes[3] != 0 || bytes[4] != 0 || bytes[5] != 0 || bytes[6] != 0 || bytes[7] != 0;
    if (bytes[1] != (has_palette ? 1 : 0) || (has_entries && !has_palette)) return {};
    TgaHeader head{.kind = static_cast<TgaKind>(kind), .is_packed = (bytes[2] & kPacked) != 0};
    const std::uint8_t descriptor = bytes[17];
    head.is_from_the_top = (descriptor & kFromTheTop) != 0;
    head.is_from_the_right = (descriptor & kFromTheRight) != 0;
    head.size = {number(12), number(14)};
    head.pixel_bits = bytes[16];
    head.entry_bits = bytes[7];
    head.alpha_bits = descriptor & kAlphaBits;
    head.first_entry = number(3);
    head.entry_count = number(5);
    head.palette_at = kHeadBytes + bytes[0];
    head.pixels_at = head.palette_at + head.entry_count * (head.entry_bits / 8);
    if ((descriptor & kReserved) != 0 || head.size.pixels() == 0 || !areBitsRight(head)) return {};
    if (bytes.size() < head.pixels_at || bytes.size() - head.pixels_at < minBytes(head)) return {};
    return head;
}

struct Texel {
    std::uint8_t red = 0, green = 0, blue = 0, alpha = 255;
    bool exists = true;  ///< false: the palette has no such entry
};

/// Converts a channel from 5 bits to the nearest 8-bit value.
std::uint8_t widened(unsigned bits) { return static_cast<std::uint8_t>((bits * 255 + 15) / 31); }

Texel colorOf(const std::uint8_t* at, unsigned bits) {
    if (bits == 16) {
        const unsigned word = loadLittleEndian<std::uint16_t>(at);
        const auto alpha = static_cast<std::uint8_t>((word >> 15) * 255);
        return {widened(word >> 10 & 31), widened(word >> 5 & 31), widened(word & 31), alpha};
    }
    return {at[2], at[1], at[0], bits == 32 ? at[3] : std::uint8_t{255}};
}

class TgaReader {
  public:
    TgaReader(ByteSpan bytes, const TgaHeader& head) : bytes_(bytes), head_(head) {
        if (head.kind != TgaKind::palette) return;
        palette_.fill({.exists = false});
        for (std::size_t i = 0; i < head.entry_count && head.first_entry + i < palette_.size(); ++i)
            palette_[head.first_entry + i] =
                colorOf(bytes.data() + head.palette_at + i * (head.entry_bits / 8), head.entry_bits);
    }

    /// Reads the image. Returns false if it is corrupt.
    bool read(TgaImage& out) {
        const std::uint64_t pixels = head_.size.pixels();
        const std::size_t step = head_.pixelBytes();
        out.image = {head_.size.width, head_.size.height, std::vector<std::uint8_t>(3 * pixels)};
        if (head_.hasAlpha()) out.alpha.resize(pixels);
        std::size_t at = head_.pixels_at;
        for (std::uint64_t i = 0; i < pixels;) {
            std::uint64_t count = pixels;
            bool is_run = false;
            if (head_.is_packed) {
                if (at == bytes_.size()) return false;
                constexpr std::uint8_t kRun = 0x80;
                is_run = (bytes_[at] & kRun) != 0;
                count = std::uint64_t{bytes_[at++]} % kRun + 1;
                if (count > pixels - i || bytes_.size() - at < (is_run ? 1 : count) * step) return false;
            }
            for (const std::uint64_t end = i + count; i < end; ++i) {
                if (!put(bytes_.data() + at, out)) return false;
                if (!is_run) at += step;
            }
            if (is_run) at += step;
        }
        return true;
    }

  private:
    [[nodiscard]] Texel texelAt(const std::uint8_t* at) const {
        if (head_.kind == TgaKind::palette) return palette_[*at];
        if (head_.kind == TgaKind::gray)
            return {at[0], at[0], at[0], head_.pixel_bits == 16 ? at[1] : std::uint8_t{255}};
        return colorOf(at, head_.pixel_bits);
    }

    bool put(const std::uint8_t* at, TgaImage& out) {
        const Texel texel = texelAt(at);
        const std::size_t x = head_.is_from_the_right ? head_.size.width - 1 - column_ : column_;
        const std::size_t y = head_.is_from_the_top ? row_ : head_.size.height - 1 - row_;
        const std::size_t to = y * head_.size.width + x;
        out.image.rgb[3 * to] = texel.red;
        out.image.rgb[3 * to + 1] = texel.green;
        out.image.rgb[3 * to + 2] = texel.blue;
        if (!out.alpha.empty()) out.alpha[to] = texel.alpha;
        if (++column_ == head_.size.width) {
            column_ = 0;
            ++row_;
        }
        return texel.exists;
    }

    ByteSpan bytes_;
    const TgaHeader& head_;
    std::array<Texel, 256> palette_ = {};
    std::size_t column_ = 0, row_ = 0;  ///< position of the next pixel, relative to the corner where the file starts
};

}  // namespace

bool isTga(ByteSpan bytes) { return readTgaHeader(bytes).has_value(); }

ImageClaim claimOfTga(ByteSpan bytes) {
    const std::optional<TgaHeader> head = readTgaHeader(bytes);
    if (!head) return {};
    return {head->size, 4 * head->size.pixels()};
}

std::optional<TgaImage> decodeTgaPixels(ByteSpan bytes, std::uint64_t most_pixels, std::string& why) {
    why = "the TGA is damaged";
    const std::optional<TgaHeader> head = readTgaHeader(bytes);
    if (!head || isTooLarge(head->size, bytes.size(), most_pixels, why)) return {};
    TgaImage out;
    if (!TgaReader(bytes, *head).read(out)) return {};
    // Some programs write 0 to the fourth byte although it means nothing to them, and declare no alpha. Others write
    // alpha but do not declare it. So undeclared alpha is ignored only if it is 0 in all pixels.
    const bool is_declared = head->alpha_bits != 0;
    const bool is_all_zero = std::all_of(out.alpha.begin(), out.alpha.end(), [](std::uint8_t a) { return a == 0; });
    if (!is_declared && is_all_zero) out.alpha = {};
    out.is_gray = head->kind == TgaKind::gray;
    return out;
}

std::optional<RgbImage> decodeTga(ByteSpan bytes, std::uint64_t most_pixels, std::string& why) {
    std::optional<TgaImage> image = decodeTgaPixels(bytes, most_pixels, why);
    if (!image) return {};
    return std::move(image->image);
}

}  // namespace tspace
