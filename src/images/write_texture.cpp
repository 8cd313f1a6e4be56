// SPDX-License-Identifier: MIT
#include "images/write_texture.h"

#include <string>
#include <string_view>

namespace tspace {

namespace {

constexpr std::uint32_t kBlockBytes = 16;

class TextureBytes {
  public:
    void add8(std::uint8_t number) { bytes.push_back(number); }
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

/// The data format descriptor of BC5: its colour model, linear, two samples of 64 bits.
std::vector<std::uint8_t> bc5Description(bool is_signed) {
    constexpr std::uint8_t kModel = 132, kUnknownPrimaries = 0, kLinear = 1, kSigned = 0x40;
    constexpr std::uint32_t kBytes = 60, kVersion = 2, kBlock = 56;
    TextureBytes out;
    out.add32(kBytes);
    out.add32(0);
    out.add16(kVersion);
    out.add16(kBlock);
    for (const std::uint8_t byte : {kModel, kUnknownPrimaries, kLinear, std::uint8_t{0}}) out.add8(byte);
    for (const std::uint8_t byte : {3, 3, 0, 0, 16, 0, 0, 0, 0, 0, 0, 0}) out.add8(byte);
    for (std::uint8_t channel = 0; channel < 2; ++channel) {
        out.add16(64U * channel);
        out.add8(63);
        out.add8(static_cast<std::uint8_t>(channel | (is_signed ? kSigned : 0)));
        out.add32(0);
        out.add32(is_signed ? 0x80000000U : 0U);
        out.add32(is_signed ? 0x7fffffffU : 0xffffffffU);
    }
    return out.bytes;
}

std::vector<std::uint8_t> keysAndValues() {
    TextureBytes out;
    constexpr std::string_view kPairs[] = {std::string_view("KTXorientation\0rd\0", 18),
                                           std::string_view("KTXswizzle\0rg01\0", 16),
                                           std::string_view("KTXwriter\0tspace\0", 17)};
    for (const std::string_view pair : kPairs) {
        out.add32(static_cast<std::uint32_t>(pair.size()));
        out.add(pair);
        out.fillTo(4);
    }
    return out.bytes;
}

}  // namespace

std::vector<std::uint8_t> writeDds(const Bc5Texture& texture) {
    const auto levels = static_cast<std::uint32_t>(texture.levels.size());
    constexpr std::uint32_t kPlain = 0x81007, kWithLevels = 0x20000, kCaps = 0x1000, kCapsOfLevels = 0x400008;
    constexpr std::uint32_t kHasCode = 4, kUnsigned = 83, kSigned = 84, kFlat = 3;
    TextureBytes out;
    out.add("DDS ");
    for (const std::uint32_t number : {124U, kPlain | (levels > 1 ? kWithLevels : 0), texture.height, texture.width,
                                       static_cast<std::uint32_t>(texture.levels.front().size()), 0U, levels})
        out.add32(number);
    out.bytes.resize(76);
    out.add32(32);
    out.add32(kHasCode);
    out.add("DX10");
    out.bytes.resize(108);
    out.add32(kCaps | (levels > 1 ? kCapsOfLevels : 0));
    out.bytes.resize(128);
    for (const std::uint32_t number : {texture.is_signed ? kSigned : kUnsigned, kFlat, 0U, 1U, 0U}) out.add32(number);
    for (const std::vector<std::uint8_t>& level : texture.levels) out.add(level);
    return out.bytes;
}

std::vector<std::uint8_t> writeKtx2(const Bc5Texture& texture) {
    constexpr std::uint32_t kUnsigned = 141, kSigned = 142, kHead = 80, kEntry = 24;
    const std::vector<std::uint8_t> description = bc5Description(texture.is_signed), values = keysAndValues();
    const auto levels = static_cast<std::uint32_t>(texture.levels.size());
    const std::uint32_t description_at = kHead + kEntry * levels;
    const auto values_at = static_cast<std::uint32_t>(description_at + description.size());
    TextureBytes out;
    out.add(std::string_view("\xabKTX 20\xbb\r\n\x1a\n", 12));
    for (const std::uint32_t number :
         {texture.is_signed ? kSigned : kUnsigned, 1U, texture.width, texture.height, 0U, 0U, 1U, levels, 0U,
          description_at, static_cast<std::uint32_t>(description.size()), values_at,
          static_cast<std::uint32_t>(values.size())})
        out.add32(number);
    out.add64(0);
    out.add64(0);
    // The smallest level comes first.
    std::vector<std::uint64_t> begins(levels);
    std::uint64_t at = (values_at + values.size() + kBlockBytes - 1) / kBlockBytes * kBlockBytes;
    for (std::size_t i = levels; i-- > 0;) {
        begins[i] = at;
        at += texture.levels[i].size();
    }
    for (std::size_t i = 0; i < levels; ++i) {
        out.add64(begins[i]);
        out.add64(texture.levels[i].size());
        out.add64(texture.levels[i].size());
    }
    out.add(description);
    out.add(values);
    out.fillTo(kBlockBytes);
    for (std::size_t i = levels; i-- > 0;) out.add(texture.levels[i]);
    return out.bytes;
}

}  // namespace tspace
