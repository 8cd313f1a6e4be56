// SPDX-License-Identifier: MIT
// Parses the header of a DDS file, according to Microsoft's Programming Guide for DDS.
#include <algorithm>
#include <bit>
#include <iterator>
#include <string_view>

#include "images/layout_guess.h"
#include "images/textures/texture_file.h"

namespace tspace {
namespace {

constexpr std::uint32_t codeOf(const char (&text)[5]) {
    std::uint32_t code = 0;
    for (unsigned i = 0; i < 4; ++i) code |= std::uint32_t{static_cast<std::uint8_t>(text[i])} << 8 * i;
    return code;
}

/// A texel format with its DXGI number, or with its FourCC (which may be a Direct3D 9 format number).
struct NamedFormat {
    std::uint32_t code;
    TexelKind kind;
    bool is_srgb = false;
};
constexpr NamedFormat kDxgiFormats[] = {
    {2, TexelKind::rgba32f},      {6, TexelKind::rgb32f},       {10, TexelKind::rgba16f},
    {11, TexelKind::rgba16},      {13, TexelKind::rgba16s},     {16, TexelKind::rg32f},
    {24, TexelKind::rgb10a2},     {27, TexelKind::rgba8},       {28, TexelKind::rgba8},
    {29, TexelKind::rgba8, true}, {31, TexelKind::rgba8s},      {34, TexelKind::rg16f},
    {35, TexelKind::rg16},        {37, TexelKind::rg16s},       {41, TexelKind::r32f},
    {49, TexelKind::rg8},         {51, TexelKind::rg8s},        {54, TexelKind::r16f},
    {56, TexelKind::r16},         {58, TexelKind::r16s},        {61, TexelKind::r8},
    {63, TexelKind::r8s},         {70, TexelKind::bc1},         {71, TexelKind::bc1},
    {72, TexelKind::bc1, true},   {73, TexelKind::bc2},         {74, TexelKind::bc2},
    {75, TexelKind::bc2, true},   {76, TexelKind::bc3},         {77, TexelKind::bc3},
    {78, TexelKind::bc3, true},   {79, TexelKind::bc4},         {80, TexelKind::bc4},
    {81, TexelKind::bc4s},        {82, TexelKind::bc5},         {83, TexelKind::bc5},
    {84, TexelKind::bc5s},        {87, TexelKind::bgra8},       {88, TexelKind::bgrx8},
    {91, TexelKind::bgra8, true}, {93, TexelKind::bgrx8, true}, {97, TexelKind::bc7},
    {98, TexelKind::bc7},         {99, TexelKind::bc7, true}};
constexpr NamedFormat kOldFormats[] = {{codeOf("DXT1"), TexelKind::bc1},
                                       {codeOf("DXT2"), TexelKind::bc2},
                                       {codeOf("DXT3"), TexelKind::bc2},
                                       {codeOf("DXT4"), TexelKind::bc3},
                                       {codeOf("DXT5"), TexelKind::bc3},
                                       {codeOf("RXGB"), TexelKind::bc3},
                                       {codeOf("ATI1"), TexelKind::bc4},
                                       {codeOf("BC4U"), TexelKind::bc4},
                                       {codeOf("BC4S"), TexelKind::bc4s},
                                       {codeOf("ATI2"), TexelKind::bc5},
                                       {codeOf("A2XY"), TexelKind::bc5},
                                       {codeOf("BC5U"), TexelKind::bc5},
                                       {codeOf("BC5S"), TexelKind::bc5s},
                                       {36, TexelKind::rgba16},
                                       {110, TexelKind::rgba16s},
                                       {111, TexelKind::r16f},
                                       {112, TexelKind::rg16f},
                                       {113, TexelKind::rgba16f},
                                       {114, TexelKind::r32f},
                                       {115, TexelKind::rg32f},
                                       {116, TexelKind::rgba32f}};

class DdsReader {
  public:
    explicit DdsReader(ByteSpan bytes) : bytes_(bytes) {}

    Result<TextureFile> read() {
        constexpr std::size_t kHeadBytes = 128, kHeightAt = 12, kWidthAt = 16;
        if (bytes_.size() < kHeadBytes || number(4) != kHeadBytes - 4) return why_;
        texture_.container = "DDS";
        texture_.size = {std::min(number(kWidthAt), kMaxTextureSide), std::min(number(kHeightAt), kMaxTextureSide)};
        data_at_ = kHeadBytes;
        if (texture_.size.pixels() == 0 || !isPicture() || !findFormat()) return why_;
        why_ = damaged();
        const std::uint64_t wanted = texture_.levelBytes();
        if (wanted > bytes_.size() - data_at_) return why_;
        texture_.level = bytes_.subspan(data_at_, static_cast<std::size_t>(wanted));
        listLevels();
        return std::move(texture_);
    }

  private:
    static Error damaged() { return {ErrorCode::invalidFile, "the DDS is damaged"}; }
    static Error unsupported(std::string why) { return {ErrorCode::unsupportedFile, std::move(why)}; }

    [[nodiscard]] std::uint32_t number(std::size_t at) const { return little32(bytes_.data() + at); }

    /// Lists the levels in order; truncated levels are skipped.
    void listLevels() {
        constexpr std::size_t kCountAt = 28;
        constexpr std::uint32_t kMaxLevels = 31;
        const std::uint32_t count = std::clamp<std::uint32_t>(number(kCountAt), 1, kMaxLevels);
        std::size_t at = data_at_;
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto side = [&](std::uint32_t texels) { return std::max<std::uint32_t>(texels >> i, 1); };
            const std::uint64_t wanted = texture_.format.bytesOf(side(texture_.size.width), side(texture_.size.height));
            if (wanted > bytes_.size() - at) {
                texture_.cut_count = count - i;
                return;
            }
            texture_.levels.push_back({at, static_cast<std::size_t>(wanted)});
            at += static_cast<std::size_t>(wanted);
        }
    }

    bool isPicture() {
        constexpr std::size_t kCapsAt = 112;
        constexpr std::uint32_t kCube = 0x200, kVolume = 0x200000;
        const std::uint32_t caps = number(kCapsAt);
        if ((caps & kCube) != 0) why_ = unsupported("the DDS is a cube map, not a single image");
        if ((caps & kVolume) != 0) why_ = unsupported("the DDS is three-dimensional, not a single image");
        return (caps & (kCube | kVolume)) == 0;
    }

    bool findFormat() {
        constexpr std::size_t kFlagsAt = 80, kCodeAt = 84;
        constexpr std::uint32_t kHasCode = 4;
        if ((number(kFlagsAt) & kHasCode) == 0) return findMasks(number(kFlagsAt));
        const std::uint32_t code = number(kCodeAt);
        if (code == codeOf("DX10")) return findDxgi();
        if (!choose(kOldFormats, code)) {
            why_ = unsupported("the DDS has the format " + codeText(code) + ", which is not supported");
            return false;
        }
        // The game Doom 3 uses this code for DXT5 with red in alpha.
        if (code == codeOf("RXGB")) texture_.layout.x.channel = MapChannel::alpha;
        return true;
    }

    template <std::size_t count>
    bool choose(const NamedFormat (&formats)[count], std::uint32_t code) {
        const auto* const found = std::find_if(std::begin(formats), std::end(formats),
                                               [&](const NamedFormat& format) { return format.code == code; });
        if (found == std::end(formats)) return false;
        texture_.format = texelFormat(found->kind);
        texture_.is_srgb = found->is_srgb;
        if (texture_.format.channels == 2) texture_.layout = twoChannelLayout(MapChannel::red, MapChannel::green);
        return true;
    }

    bool findDxgi() {
        constexpr std::size_t kMoreBytes = 20;
        constexpr std::uint32_t kFlat = 3, kCube = 4;
        if (bytes_.size() - data_at_ < kMoreBytes) return false;
        const std::uint32_t format = number(data_at_), dimension = number(data_at_ + 4), flags = number(data_at_ + 8),
                            layers = number(data_at_ + 12);
        data_at_ += kMoreBytes;
        if (dimension != kFlat) why_ = unsupported("the DDS is one- or three-dimensional, not an image");
        if (layers > 1) why_ = unsupported("the DDS is an array of several images");
        if ((flags & kCube) != 0) why_ = unsupported("the DDS is a cube map, not a single image");
        if (dimension != kFlat || layers > 1 || (flags & kCube) != 0) return false;
        if (choose(kDxgiFormats, format)) return true;
        why_ = unsupported("the DDS has the DXGI format " + std::to_string(format) + ", which is not supported");
        return false;
    }

    /// Reads channels described by masks, with up to 32 bits per texel.
    bool findMasks(std::uint32_t flags) {
        constexpr std::uint32_t kAlpha = 1, kOnlyAlpha = 2, kColors = 0x40, kGray = 0x20000, kSigned = 0x80000;
        constexpr std::size_t kBitsAt = 88, kMasksAt = 92;
        const std::uint32_t bits = number(kBitsAt);
        why_ = unsupported("the pixel format of the DDS is not supported");
        if ((flags & kSigned) != 0) return findSigned(bits);
        if ((flags & (kColors | kGray)) == 0 || (flags & kOnlyAlpha) != 0) return false;
        why_ = damaged();
        if (bits == 0 || bits > 32 || bits % 8 != 0) return false;
        texture_.format = texelFormat(TexelKind::masked);
        texture_.format.block_bytes = static_cast<std::uint8_t>(bits / 8);
        auto& masks = texture_.format.masks;
        const bool is_gray = (flags & kColors) == 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const bool is_there = i == 3 ? (flags & kAlpha) != 0 : i == 0 || !is_gray;
            masks[i] = is_there ? number(kMasksAt + 4 * i) : 0;
            const std::uint32_t ones = masks[i] == 0 ? 0 : masks[i] >> std::countr_zero(masks[i]);
            if ((ones & (ones + 1)) != 0 || (bits < 32 && masks[i] >> bits != 0))
                return false;  // the bits of a channel are not contiguous, or the mask is out of range
            if (ones > 255) texture_.format.bits = 16;
        }
        if (masks[0] == 0) return false;
        texture_.format.channels = masks[3] != 0 ? 4 : is_gray || masks[1] == 0 ? 1 : masks[2] == 0 ? 2 : 3;
        if (texture_.format.channels == 2) texture_.layout = twoChannelLayout(MapChannel::red, MapChannel::green);
        return true;
    }

    /// Reads the Direct3D 9 formats V8U8, V16U16 and Q8W8V8U8.
    bool findSigned(std::uint32_t bits) {
        constexpr std::size_t kFirstMaskAt = 92;
        const std::uint32_t first = number(kFirstMaskAt);
        const bool is_two = bits == 16 && first == 0xff, is_wide = bits == 32 && first == 0xffff;
        const bool is_four = bits == 32 && first == 0xff;
        if (!is_two && !is_wide && !is_four) return false;
        texture_.format = texelFormat(is_two ? TexelKind::rg8s : is_wide ? TexelKind::rg16s : TexelKind::rgba8s);
        if (!is_four) texture_.layout = twoChannelLayout(MapChannel::red, MapChannel::green);
        return true;
    }

    static std::string codeText(std::uint32_t code) {
        std::string text;
        for (unsigned i = 0; i < 4; ++i) {
            const auto letter = static_cast<char>(code >> 8 * i & 255);
            if (letter < ' ' || letter > '~') return std::to_string(code);
            text += letter;
        }
        return text;
    }

    ByteSpan bytes_;
    Error why_ = damaged();
    TextureFile texture_ = {};
    std::size_t data_at_ = 0;
};

}  // namespace

Result<TextureFile> readDdsHeader(ByteSpan bytes) { return DdsReader(bytes).read(); }

}  // namespace tspace
