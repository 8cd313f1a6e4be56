// SPDX-License-Identifier: MIT
#include "textures/write_texture.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>
#include <string_view>

#ifdef TSPACE_HAS_ZSTD
#include <zstd.h>
#endif

namespace tspace {
namespace {

/// Properties of a format in KTX2 and DDS: Vulkan format number, Direct3D format number (DXGI), and color model of the
/// Khronos Data Format.
struct WrittenFormat {
    TexelKind kind;
    std::uint32_t vulkan, dxgi;  ///< format numbers; 0: the container does not support the format
    std::uint8_t model, samples, sample_bits;
};
constexpr std::uint8_t kPlainModel = 1, kBc5Model = 132, kEtc2Model = 161, kAstcModel = 162;
constexpr WrittenFormat kWrittenFormats[] = {
    {TexelKind::rg8, 16, 49, kPlainModel, 2, 8},    {TexelKind::rg8s, 17, 51, kPlainModel, 2, 8},
    {TexelKind::rgba8, 37, 28, kPlainModel, 4, 8},  {TexelKind::bc5, 141, 83, kBc5Model, 2, 64},
    {TexelKind::bc5s, 142, 84, kBc5Model, 2, 64},   {TexelKind::eacRg, 155, 0, kEtc2Model, 2, 64},
    {TexelKind::eacRgs, 156, 0, kEtc2Model, 2, 64}, {TexelKind::astc, 157, 0, kAstcModel, 1, 128},
};

const WrittenFormat& writtenFormat(TexelKind kind) {
    return *std::find_if(std::begin(kWrittenFormats), std::end(kWrittenFormats),
                         [&](const WrittenFormat& format) { return format.kind == kind; });
}

class TextureBytes {
  public:
    void add8(std::uint32_t number) { add(number, 1); }
    void add16(std::uint32_t number) { add(number, 2); }
    void add32(std::uint32_t number) { add(number, 4); }
    void add64(std::uint64_t number) { add(number, 8); }
    void add(std::string_view text) {
        for (const char letter : text) bytes.push_back(static_cast<std::uint8_t>(letter));
    }
    void add(const std::vector<std::uint8_t>& more) { bytes.insert(bytes.end(), more.begin(), more.end()); }
    void fillTo(std::size_t multiple) { bytes.resize((bytes.size() + multiple - 1) / multiple * multiple); }

    std::vector<std::uint8_t> bytes = {};

  private:
    void add(std::uint64_t number, unsigned count) {
        for (unsigned i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(number >> 8 * i));
    }
};

/// Returns the Khronos data format descriptor: color model, linear transfer, and one sample per channel.
std::vector<std::uint8_t> descriptionOf(const WrittenFormat& format) {
    constexpr std::uint32_t kUnknownPrimaries = 0, kLinear = 1, kSigned = 0x40, kAlpha = 15, kVersion = 2;
    const TexelFormat texels = texelFormat(format.kind);
    const std::uint32_t block_bytes = 24 + 16 * std::uint32_t{format.samples};
    TextureBytes out;
    out.add32(4 + block_bytes);
    out.add32(0);
    out.add16(kVersion);
    out.add16(block_bytes);
    for (const std::uint32_t byte : {std::uint32_t{format.model}, kUnknownPrimaries, kLinear, 0U}) out.add8(byte);
    for (const std::uint32_t byte : {texels.width - 1U, texels.height - 1U, 0U, 0U}) out.add8(byte);
    out.add64(texels.block_bytes);
    for (std::uint32_t sample = 0; sample < format.samples; ++sample) {
        const std::uint32_t bits = format.sample_bits;
        out.add16(bits * sample);
        out.add8(bits - 1);
        out.add8((sample == 3 ? kAlpha : sample) | (texels.is_signed ? kSigned : 0));
        out.add32(0);
        const bool is_byte = bits == 8;
        out.add32(!texels.is_signed ? 0 : is_byte ? 0U - 127U : 0x80000000U);
        out.add32(texels.is_signed ? (is_byte ? 127 : 0x7fffffffU) : (is_byte ? 255 : 0xffffffffU));
    }
    return out.bytes;
}

std::vector<std::uint8_t> keysAndValues(const WrittenFormat& format) {
    TextureBytes out;
    const auto addPair = [&](std::string_view pair) {
        out.add32(static_cast<std::uint32_t>(pair.size()));
        out.add(pair);
        out.fillTo(4);
    };
    addPair(std::string_view("KTXorientation\0rd\0", 18));
    if (format.samples == 2) addPair(std::string_view("KTXswizzle\0rg01\0", 16));
    if (format.kind == TexelKind::astc) addPair(std::string_view("KTXswizzle\0ra01\0", 16));
    addPair(std::string_view("KTXwriter\0tspace\0", 17));
    return out.bytes;
}

std::optional<std::vector<std::uint8_t>> packedByZstd([[maybe_unused]] const std::vector<std::uint8_t>& level,
                                                      [[maybe_unused]] int zstd_level) {
#ifdef TSPACE_HAS_ZSTD
    std::vector<std::uint8_t> packed(ZSTD_compressBound(level.size()));
    const std::size_t count = ZSTD_compress(packed.data(), packed.size(), level.data(), level.size(), zstd_level);
    if (ZSTD_isError(count) != 0) return {};
    packed.resize(count);
    return packed;
#else
    return {};
#endif
}

}  // namespace

const char* whyNotDds(TexelKind kind) {
    if (writtenFormat(kind).dxgi != 0) return nullptr;
    return kind == TexelKind::astc ? "programs cannot read ASTC from a DDS; write a .ktx2"
                                   : "a DDS cannot contain EAC; write a .ktx2";
}

namespace {

/// Adds the Direct3D 9 pixel format, 32 bytes: a FourCC for blocks, otherwise masks. For the signed format V8U8, these
/// are masks of signed numbers.
void addOldFormat(const TexelFormat& format, const char* four_cc, TextureBytes& out) {
    constexpr std::uint32_t kAlpha = 1, kHasCode = 4, kColors = 0x40, kSigned = 0x80000;
    out.add32(32);
    if (format.width > 1) {
        out.add32(kHasCode);
        out.add(four_cc);
        for (int i = 0; i < 5; ++i) out.add32(0);
        return;
    }
    out.add32(format.is_signed ? kSigned : format.channels == 4 ? kColors | kAlpha : kColors);
    out.add32(0);
    out.add32(8U * format.block_bytes);
    for (std::uint32_t i = 0; i < 4; ++i) out.add32(i < format.channels ? 0xffU << 8 * i : 0);
}

}  // namespace

std::vector<std::uint8_t> writeDds(const Texture& texture, const char* old_four_cc) {
    const auto levels = static_cast<std::uint32_t>(texture.levels.size());
    constexpr std::uint32_t kPlain = 0x1007, kPitch = 8, kLinearSize = 0x80000, kWithLevels = 0x20000, kCaps = 0x1000,
                            kCapsOfLevels = 0x400008, kHasCode = 4, kFlat = 3;
    const TexelFormat format = texelFormat(texture.kind);
    const bool has_blocks = format.width > 1;
    const std::uint32_t flags = kPlain | (has_blocks ? kLinearSize : kPitch) | (levels > 1 ? kWithLevels : 0);
    const auto size =
        has_blocks ? static_cast<std::uint32_t>(texture.levels.front().size()) : format.block_bytes * texture.width;
    TextureBytes out;
    out.add("DDS ");
    for (const std::uint32_t number : {124U, flags, texture.height, texture.width, size, 0U, levels}) out.add32(number);
    out.bytes.resize(76);
    if (old_four_cc != nullptr) {
        addOldFormat(format, format.is_signed ? "BC5S" : old_four_cc, out);
    } else {
        out.add32(32);
        out.add32(kHasCode);
        out.add("DX10");
    }
    out.bytes.resize(108);
    out.add32(kCaps | (levels > 1 ? kCapsOfLevels : 0));
    out.bytes.resize(128);
    if (old_four_cc == nullptr) {
        for (const std::uint32_t number : {writtenFormat(texture.kind).dxgi, kFlat, 0U, 1U, 0U}) out.add32(number);
    }
    for (const std::vector<std::uint8_t>& level : texture.levels) out.add(level);
    return out.bytes;
}

const char* whyNotZstd() {
#ifdef TSPACE_HAS_ZSTD
    return nullptr;
#else
    return "this build of tspace does not support Zstandard";
#endif
}

std::optional<std::vector<std::uint8_t>> writeKtx2(const Texture& texture, int zstd_level) {
    constexpr std::uint32_t kHead = 80, kEntry = 24, kZstd = 2;
    const WrittenFormat& format = writtenFormat(texture.kind);
    const std::vector<std::uint8_t> description = descriptionOf(format), values = keysAndValues(format);
    std::vector<std::vector<std::uint8_t>> packed;
    for (std::size_t i = 0; zstd_level > 0 && i < texture.levels.size(); ++i) {
        std::optional<std::vector<std::uint8_t>> level = packedByZstd(texture.levels[i], zstd_level);
        if (!level) return {};
        packed.push_back(*std::move(level));
    }
    const std::vector<std::vector<std::uint8_t>>& stored = packed.empty() ? texture.levels : packed;
    // Supercompressed levels are not aligned.
    const std::size_t aligned =
        packed.empty() ? std::lcm(std::size_t{texelFormat(texture.kind).block_bytes}, std::size_t{4}) : 1;
    const auto levels = static_cast<std::uint32_t>(texture.levels.size());
    const std::uint32_t description_at = kHead + kEntry * levels;
    const auto values_at = static_cast<std::uint32_t>(description_at + description.size());
    TextureBytes out;
    out.add(std::string_view("\xabKTX 20\xbb\r\n\x1a\n", 12));
    for (const std::uint32_t number :
         {format.vulkan, 1U, texture.width, texture.height, 0U, 0U, 1U, levels, packed.empty() ? 0U : kZstd,
          description_at, static_cast<std::uint32_t>(description.size()), values_at,
          static_cast<std::uint32_t>(values.size())})
        out.add32(number);
    out.add64(0);
    out.add64(0);
    // The smallest level is stored first.
    std::vector<std::uint64_t> begins(levels);
    std::uint64_t at = values_at + values.size();
    for (std::size_t i = levels; i-- > 0;) {
        begins[i] = (at + aligned - 1) / aligned * aligned;
        at = begins[i] + stored[i].size();
    }
    for (std::size_t i = 0; i < levels; ++i) {
        out.add64(begins[i]);
        out.add64(stored[i].size());
        out.add64(texture.levels[i].size());
    }
    out.add(description);
    out.add(values);
    for (std::size_t i = levels; i-- > 0;) {
        out.fillTo(aligned);
        out.add(stored[i]);
    }
    return out.bytes;
}

}  // namespace tspace
